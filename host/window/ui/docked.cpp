// The frame of a docked panel: heading, close, dragging to the other side, height by content.
#include "window/ui/interface.h"
#include "window/ui/widgets.h"

#include <imgui_internal.h>

#include <algorithm>

namespace glint {
namespace {

Side other_side_of(float x) {
    return x < 0.5f * ImGui::GetIO().DisplaySize.x ? Side::left : Side::right;
}

// The heading is also the handle that takes the panel to the other side.
void heading(Build& build, PanelId id, const char* title, bool& open) {
    const Theme& theme = build.theme;
    const float height = ImGui::GetFrameHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = std::max(ImGui::GetContentRegionAvail().x - height, 1.0f);
    // Only the mouse drags.
    ImGui::PushItemFlag(ImGuiItemFlags_NoNav | ImGuiItemFlags_NoNavDefaultFocus, true);
    area("handle", {width, height});
    ImGui::PopItemFlag();
    if (ImGui::IsItemActive() && ImGui::IsMouseDragging(0, theme.px(24)))
        build.layout.places.side[static_cast<std::size_t>(id)] =
            other_side_of(ImGui::GetIO().MousePos.x);
    ImGui::PushFont(theme.bold);
    const float text_top = corner.y + 0.5f * (height - ImGui::GetFontSize());
    text_within(*ImGui::GetWindowDrawList(), {corner.x, text_top}, width, colours::kText, title);
    ImGui::PopFont();
    ImGui::SameLine(0.0f, 0.0f);
    ImGui::PushItemFlag(ImGuiItemFlags_NoNavDefaultFocus, true);
    if (icon_button(theme, "close", Icon::close, "Close", {.colour = colours::kDim})) open = false;
    ImGui::PopItemFlag();
}

// A person drags the inner border; the width belongs to the column.
void follow_width(Build& build, PanelId id, const Area& area) {
    const float width = ImGui::GetWindowWidth();
    if (width == area.size.x || !ImGui::IsMouseDown(0)) return;
    const auto index = static_cast<std::size_t>(id);
    const auto side = static_cast<std::size_t>(build.layout.places.side[index]);
    build.layout.places.width[side] = width / build.theme.scale;
}

}  // namespace

void begin_panel(Build& build, PanelId id, const char* title, bool& open) {
    const Area& area = build.layout.areas[static_cast<std::size_t>(id)];
    ImGui::SetNextWindowPos(area.corner);
    ImGui::SetNextWindowSize(area.size);
    ImGui::SetNextWindowSizeConstraints({build.theme.px(120), area.size.y},
                                        {ImGui::GetIO().DisplaySize.x, area.size.y});
    ImGui::Begin(title, nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
    follow_width(build, id, area);
    heading(build, id, title, open);
}

void begin_body() {
    ImGui::BeginChild("body", {0, 0}, false, ImGuiWindowFlags_NavFlattened);
}

void end_panel(Build& build, PanelId id) {
    const float body = ImGui::GetCursorPosY() - ImGui::GetStyle().ItemSpacing.y;
    ImGui::EndChild();
    const float top = ImGui::GetItemRectMin().y - ImGui::GetWindowPos().y;
    build.layout.wanted[static_cast<std::size_t>(id)] =
        top + body + ImGui::GetStyle().WindowPadding.y;
    ImGui::End();
}

}  // namespace glint
