// The list of keys.
#include "window/ui/interface.h"
#include "window/ui/shortcuts.h"
#include "window/ui/widgets.h"

#include <algorithm>
#include <vector>

namespace glint {
namespace {

// "F1, ?": an action's first keys and those that follow without a meaning of their own.
std::string all_keys(std::size_t index) {
    std::string keys = kShortcuts[index].keys;
    for (std::size_t i = index + 1; i < kShortcuts.size() && !*kShortcuts[i].meaning; ++i)
        keys += std::string(", ") + kShortcuts[i].keys;
    return keys;
}

// The indices of the table's rows: what has a meaning of its own.
std::vector<std::size_t> rows() {
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < kShortcuts.size(); ++i)
        if (*kShortcuts[i].meaning) found.push_back(i);
    return found;
}

// Read downwards, then to the next column.
void key_rows(const Theme& theme, int columns) {
    const auto keys = rows();
    const std::size_t count = static_cast<std::size_t>(columns);
    const std::size_t lines = (keys.size() + count - 1) / count;
    if (!ImGui::BeginTable("keys", 2 * columns, ImGuiTableFlags_SizingFixedFit)) return;
    for (std::size_t line = 0; line < lines; ++line) {
        ImGui::TableNextRow();
        for (std::size_t i = line; i < keys.size(); i += lines) {
            ImGui::TableNextColumn();
            text_in(colours::kAccent, all_keys(keys[i]));
            ImGui::TableNextColumn();
            text_in(colours::kText, kShortcuts[keys[i]].meaning);
            if (i + lines >= keys.size()) continue;
            ImGui::SameLine();
            ImGui::Dummy({theme.px(16), 0});
        }
    }
    ImGui::EndTable();
}

}  // namespace

void help_panel(Build& build) {
    const Theme& theme = build.theme;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float margin = theme.px(8);
    ImGui::SetNextWindowPos({0.5f * screen.x, 0.5f * screen.y}, 0, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({theme.px(120), theme.px(60)},
                                        {screen.x - 2 * margin, screen.y - 2 * margin});
    ImGui::Begin("help", &build.settings.help,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize);
    ImGui::AlignTextToFramePadding();
    text_in(colours::kText, "Keys", theme.bold);
    ImGui::SameLine();
    ImGui::SetCursorPosX(ImGui::GetWindowContentRegionMax().x - ImGui::GetFrameHeight());
    if (icon_button(theme, "close", Icon::close, "Close", {.colour = colours::kDim}))
        build.settings.help = false;
    key_rows(theme, screen.x > theme.px(900) ? 2 : 1);
    ImGui::Dummy({0, theme.px(4)});
    ImGui::PushTextWrapPos(std::min(theme.px(620), screen.x - theme.px(60)));
    text_in(
        colours::kDim,
        "In a panel that has the keys: arrows move, Space presses, or takes hold of a slider, "
        "which arrows then move; Enter types its value; Space on a name opens its menu. Esc gives "
        "the keys back to the scene, as does a click on the picture. All others are the scene's.");
    ImGui::PopTextWrapPos();
    ImGui::End();
}

}  // namespace glint
