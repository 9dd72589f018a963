// The list of keys.
#include "ui/interface.h"
#include "ui/shortcuts.h"
#include "ui/widgets.h"

#include <algorithm>

namespace glint {
namespace {

// "F1, ?": an action's first keys and those that follow without a meaning of their own.
std::string all_keys(std::size_t index) {
    std::string keys = kShortcuts[index].keys;
    for (std::size_t i = index + 1; i < kShortcuts.size() && !*kShortcuts[i].meaning; ++i)
        keys += std::string(", ") + kShortcuts[i].keys;
    return keys;
}

void key_rows(const Theme& theme, int columns) {
    if (!ImGui::BeginTable("keys", 2 * columns, ImGuiTableFlags_SizingFixedFit)) return;
    int column = 0;
    for (std::size_t i = 0; i < kShortcuts.size(); ++i) {
        if (!*kShortcuts[i].meaning) continue;
        if (column == 0) ImGui::TableNextRow();
        ImGui::TableNextColumn();
        text_in(colours::kAccent, all_keys(i));
        ImGui::TableNextColumn();
        text_in(colours::kText, kShortcuts[i].meaning);
        if (column + 1 < columns) {
            ImGui::SameLine();
            ImGui::Dummy({theme.px(16), 0});
        }
        column = (column + 1) % columns;
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
    text_in(colours::kText, "Keys", theme.bold);
    ImGui::SameLine();
    ImGui::SetCursorPosX(ImGui::GetWindowWidth() - ImGui::GetStyle().WindowPadding.x -
                         ImGui::GetFrameHeight());
    if (icon_button(theme, "close", Icon::close, "Close", {.colour = colours::kDim}))
        build.settings.help = false;
    key_rows(theme, screen.x > theme.px(900) ? 2 : 1);
    ImGui::Dummy({0, theme.px(4)});
    text_in(colours::kDim, "All other keys and the mouse over the picture belong to the scene.");
    ImGui::End();
}

}  // namespace glint
