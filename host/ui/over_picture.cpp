// What is drawn on the picture itself: the handle of the wipe, and values on magnified pixels.
#include "ui/interface.h"
#include "ui/number_text.h"
#include "ui/widgets.h"

#include <algorithm>
#include <cmath>

namespace glint {

// The window draws the line; here is what a hand takes hold of.
void wipe_handle(Build& build) {
    if (!build.settings.wipe || !build.facts.scene) return;
    const Theme& theme = build.theme;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const Area& free = build.layout.free;
    const float radius = theme.px(12);
    const float x = build.settings.wipe_position * screen.x;
    const float y = free.corner.y + 0.5f * free.size.y;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0, 0});
    ImGui::SetNextWindowPos({x - radius, y - radius});
    ImGui::SetNextWindowSize({2 * radius, 2 * radius});
    ImGui::Begin("wipe", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground |
                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::InvisibleButton("handle", {2 * radius, 2 * radius});
    const bool hot = ImGui::IsItemActive() || ImGui::IsItemHovered();
    if (hot) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    if (ImGui::IsItemActive())
        build.settings.wipe_position =
            std::clamp(ImGui::GetIO().MousePos.x / std::max(screen.x, 1.0f), 0.0f, 1.0f);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddCircleFilled({x, y}, radius - 1.0f, hot ? colours::kAccent : colours::kText);
    const float inner = theme.px(7), tip_x = theme.px(3);
    for (const float side : {-1.0f, 1.0f})
        list.AddTriangleFilled({x + side * inner, y}, {x + side * tip_x, y - theme.px(4)},
                               {x + side * tip_x, y + theme.px(4)}, colours::kPanel);
    ImGui::End();
    ImGui::PopStyleVar();
}

// Four numbers on every pixel that is large enough for them.
void pixel_grid(Build& build) {
    const Theme& theme = build.theme;
    const ImVec2 ratio = ImGui::GetIO().DisplayFramebufferScale;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    if (ratio.x <= 0.0f || ratio.y <= 0.0f) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    ImGui::PushFont(theme.mono);
    const float line = ImGui::GetFontSize();
    for (const GridPixel& pixel : build.facts.grid) {
        const auto side = static_cast<float>(pixel.side) / ratio.x;
        if (side < 4.5f * line) continue;
        const float x = static_cast<float>(pixel.centre.x) / ratio.x;
        float y = screen.y - static_cast<float>(pixel.centre.y) / ratio.y - 2 * line;
        const float light = 0.3f * pixel.shown.r + 0.6f * pixel.shown.g + 0.1f * pixel.shown.b;
        const ImU32 ink = light > 0.5f ? IM_COL32(0, 0, 0, 255) : IM_COL32(255, 255, 255, 255);
        for (int i = 0; i < 4; ++i, y += line) {
            const std::string text = short_number(static_cast<double>(pixel.value[i]));
            const float width = ImGui::CalcTextSize(text.c_str()).x;
            if (width < side) list.AddText({x - 0.5f * width, y}, ink, text.c_str());
        }
    }
    ImGui::PopFont();
}

}  // namespace glint
