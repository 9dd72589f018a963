// What stands in the window while nothing is open: files to choose from, and a new scene.
#include "window/ui/interface.h"
#include "window/ui/widgets.h"

#include <algorithm>
#include <cmath>

namespace glint {
namespace {

constexpr float kWidest = 1120.0f, kCard = 200.0f;  // points

void invitation(Build& build) {
    const Theme& theme = build.theme;
    ImGui::PushStyleColor(ImGuiCol_Button, colours::kAccentFill);
    if (ImGui::Button("New scene\u2026")) build.settings.new_scene = true;
    ImGui::PopStyleColor();
    tip(theme, "A commented scene to begin with");
    ImGui::SameLine(0, theme.px(12));
    ImGui::AlignTextToFramePadding();
    ImGui::PushTextWrapPos(0.0f);
    text_in(colours::kDim, "or choose one, or drop a .frag or .toml file here");
    ImGui::PopTextWrapPos();
    ImGui::Dummy({0, theme.px(4)});
}

}  // namespace

void start_page(Build& build) {
    const Theme& theme = build.theme;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float margin = theme.px(8);
    const float top = build.layout.bar.bottom() + margin;
    const float width = std::max(std::min(screen.x - 2 * margin, theme.px(kWidest)), 1.0f);
    build.layout.transport = {};
    ImGui::SetNextWindowPos({std::round(0.5f * (screen.x - width)), top});
    ImGui::SetNextWindowSize({width, std::max(screen.y - margin - top, 1.0f)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme.px(16), theme.px(12)});
    ImGui::Begin("start", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBringToFrontOnFocus);
    invitation(build);
    ImGui::BeginChild("body", {0, 0}, false, ImGuiWindowFlags_NavFlattened);
    shelves(build, kCard);
    ImGui::EndChild();
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace glint
