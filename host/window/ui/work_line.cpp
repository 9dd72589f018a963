#include "window/ui/interface.h"
#include "window/ui/widgets.h"

#include <fmt/format.h>

#include <algorithm>

namespace glint {

void work_line(const Theme& theme, const WorkFact& work) {
    if (work.running) {
        const float width = std::max(ImGui::GetContentRegionAvail().x, 1.0f);
        const std::string text =
            work.of > 0 ? fmt::format("{} of {}", work.done, work.of) : "starting\u2026";
        const float room =
            std::max(width - ImGui::CalcTextSize(text.c_str()).x - theme.px(8), 1.0f);
        const float share =
            work.of > 0 ? static_cast<float>(work.done) / static_cast<float>(work.of) : 0.0f;
        const ImVec2 corner = ImGui::GetCursorScreenPos();
        const float y = std::round(corner.y + 0.5f * ImGui::GetTextLineHeight() - theme.px(2));
        const float end = corner.x + room, height = theme.px(4);
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddRectFilled({corner.x, y}, {end, y + height}, colours::kField, theme.px(2));
        list.AddRectFilled({corner.x, y},
                           {corner.x + std::clamp(share, 0.0f, 1.0f) * room, y + height},
                           colours::kAccent, theme.px(2));
        ImGui::Dummy({room, ImGui::GetTextLineHeight()});
        ImGui::SameLine(0, theme.px(8));
        text_in(colours::kDim, text);
    }
    ImGui::PushTextWrapPos(0.0f);
    if (!work.problem.empty()) text_in(colours::kError, work.problem);
    if (work.stale)
        text_in(colours::kWarning, "The scene or its tweaks have changed since this was measured.");
    ImGui::PopTextWrapPos();
}

}  // namespace glint
