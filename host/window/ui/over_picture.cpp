// What is drawn on the picture itself: the handle of the wipe, and values on magnified pixels.
#include "window/ui/interface.h"
#include "window/ui/number_text.h"
#include "window/ui/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace glint {

namespace {

// A line of text on a dark ground, centred at x.
void label(Build& build, float x, float top, const std::string& text) {
    const Theme& theme = build.theme;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const Area& free = build.layout.free;
    const ImVec2 size = ImGui::CalcTextSize(text.c_str());
    const float half = 0.5f * size.x + theme.px(8);
    x = std::clamp(x, free.corner.x + half, std::max(free.right() - half, free.corner.x + half));
    list.AddRectFilled({x - half, top}, {x + half, top + size.y + theme.px(6)}, colours::kPanel,
                       theme.px(4));
    list.AddText({std::round(x - 0.5f * size.x), top + theme.px(3)}, colours::kText, text.c_str());
}

// The scale of heat maps, as studies write them: a decade a step.
void heat_scale(Build& build, float x, float top) {
    const Theme& theme = build.theme;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    constexpr std::array<ImU32, 5> kSteps = {
        IM_COL32(0, 0, 0, 255), IM_COL32(26, 26, 153, 255), IM_COL32(179, 26, 128, 255),
        IM_COL32(255, 153, 26, 255), IM_COL32(255, 255, 255, 255)};
    constexpr std::array<const char*, 5> kTexts = {"10\u207b\u2074", "10\u207b\u00b3",
                                                   "10\u207b\u00b2", "10\u207b\u00b9", "1"};
    const float step = theme.px(56), left = x - 2 * step, bar = theme.px(10), line = theme.px(18);
    list.AddRectFilled({left - theme.px(24), top},
                       {left + 4 * step + theme.px(24), top + bar + line + theme.px(8)},
                       colours::kPanel, theme.px(4));
    const float y = top + theme.px(6);
    for (std::size_t i = 0; i < kSteps.size(); ++i) {
        const float at = left + static_cast<float>(i) * step;
        const float half = 0.5f * ImGui::CalcTextSize(kTexts[i]).x;
        list.AddText({at - half, y + bar + theme.px(1)}, colours::kDim, kTexts[i]);
        if (i + 1 == kSteps.size()) break;
        list.AddRectFilledMultiColor({at, y}, {at + step, y + bar}, kSteps[i], kSteps[i + 1],
                                     kSteps[i + 1], kSteps[i]);
    }
}

}  // namespace

// What the pictures are that stand in the view instead of the scene.
void shown_labels(Build& build) {
    const PanelSettings& settings = build.settings;
    const Area& free = build.layout.free;
    const float top = free.corner.y + build.theme.px(8);
    const float centre = free.corner.x + 0.5f * free.size.x;
    const auto shown = std::ranges::find(build.facts.cases, settings.shown_case, &CaseResult::name);
    if (settings.shown == Shown::failure && shown != build.facts.cases.end())
        label(build, centre, top,
              shown->name + (shown->not_finite() > 0 ? ": NaN and Inf are magenta" : ""));
    const bool compares = settings.shown == Shown::wipe || settings.shown == Shown::map;
    if (!compares || settings.shown_study >= build.facts.studies.size()) return;
    const Study& study = build.facts.studies[settings.shown_study];
    if (!settings.shown_row || *settings.shown_row >= study.rows.size()) return;
    const std::string name = study.knob + " " + study.rows[*settings.shown_row].value;
    if (settings.shown == Shown::map) {
        label(build, centre, top, name + ", difference from " + study.reference);
        return heat_scale(build, centre, top + ImGui::GetTextLineHeight() + build.theme.px(12));
    }
    const float line = settings.wipe_position * ImGui::GetIO().DisplaySize.x;
    const std::string reference = "reference " + study.reference;
    const float gap = build.theme.px(16);
    label(build, line - 0.5f * ImGui::CalcTextSize(name.c_str()).x - gap, top, name);
    label(build, line + 0.5f * ImGui::CalcTextSize(reference.c_str()).x + gap, top, reference);
}

// Calm, and not black: that something will stand here is to be seen.
void ground(Build&) {
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    constexpr ImU32 kTop = IM_COL32(46, 54, 66, 255), kBottom = IM_COL32(72, 80, 92, 255);
    ImGui::GetBackgroundDrawList()->AddRectFilledMultiColor({0, 0}, screen, kTop, kTop, kBottom,
                                                            kBottom);
}

void start_picture(Build& build) {
    const StartPictureFact& picture = build.facts.start_picture;
    const ImVec2 ratio = ImGui::GetIO().DisplayFramebufferScale;
    if (picture.texture == 0 || ratio.x <= 0.0f || ratio.y <= 0.0f) return;
    const glm::vec2 scale{ratio.x, ratio.y};
    const glm::vec2 low = glm::vec2(picture.origin) / scale, size = glm::vec2(picture.size) / scale;
    const float bottom = ImGui::GetIO().DisplaySize.y - low.y;
    ImGui::GetBackgroundDrawList()->AddImage(
        reinterpret_cast<ImTextureID>(std::uintptr_t{picture.texture}), {low.x, bottom - size.y},
        {low.x + size.x, bottom}, {0, picture.share.y}, {picture.share.x, 0});
}

// In the last line of the picture: over one that is known, or over the ground.
void waiting_label(Build& build, bool list_is_open) {
    const Facts& facts = build.facts;
    const bool is_refused = facts.waits_for.empty() && !facts.scene && !facts.file.empty();
    if (facts.waits_for.empty() && (!is_refused || list_is_open)) return;
    const Area& free = build.layout.free;
    const float line = ImGui::GetTextLineHeight() + build.theme.px(6);
    const std::string text = is_refused
                                 ? "Nothing to show: the list of errors says why."
                                 : fmt::format("{}\u2026 {:.1f} s", facts.waits_for, facts.waited);
    label(build, free.corner.x + 0.5f * free.size.x,
          free.corner.y + free.size.y - line - build.theme.px(12), text);
}

// The window draws the line; here is what a hand takes hold of.
void wipe_handle(Build& build) {
    const Shown shown = build.settings.shown;
    const bool wipes = shown == Shown::wipe || (shown == Shown::scene && build.settings.wipe);
    if (!wipes || !build.facts.scene) return;
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
