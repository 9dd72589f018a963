#include "ui/widgets.h"

#include <imgui_internal.h>

#include <algorithm>

namespace glint {

bool icon_button(const Theme& theme, const char* id, Icon icon, const char* tip_text,
                 const ButtonLook& look) {
    const float side = look.side > 0.0f ? look.side : ImGui::GetFrameHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const bool pressed = ImGui::InvisibleButton(id, {side, side}) && look.enabled;
    const bool hovered = ImGui::IsItemHovered(), held = ImGui::IsItemActive();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 end{corner.x + side, corner.y + side};
    const float round = theme.px(4);
    if (look.on) list.AddRectFilled(corner, end, colours::kAccentFill, round);
    if (look.enabled && (hovered || held)) {
        const ImU32 shine = held ? IM_COL32(255, 255, 255, 40) : IM_COL32(255, 255, 255, 24);
        list.AddRectFilled(corner, end, shine, round);
    }
    ImU32 colour = look.colour ? look.colour : colours::kText;
    if (!look.enabled) colour = colours::kFaint;
    const ImVec2 centre{0.5f * (corner.x + end.x), 0.5f * (corner.y + end.y)};
    draw_icon(list, icon, centre, std::round(0.56f * side), colour);
    tip(theme, tip_text);
    return pressed;
}

bool text_button(const Theme& theme, const char* text, bool on, const char* tip_text) {
    if (on) ImGui::PushStyleColor(ImGuiCol_Button, colours::kAccentFill);
    const bool pressed = ImGui::Button(text);
    if (on) ImGui::PopStyleColor();
    tip(theme, tip_text);
    return pressed;
}

void text_in(ImU32 colour, std::string_view text, ImFont* font) {
    if (font) ImGui::PushFont(font);
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopStyleColor();
    if (font) ImGui::PopFont();
}

bool text_within(ImDrawList& list, ImVec2 position, float width, ImU32 colour,
                 std::string_view text) {
    const char* begin = text.data();
    const char* end = begin + text.size();
    const ImVec2 size = ImGui::CalcTextSize(begin, end);
    const float right = position.x + std::max(width, 0.0f);
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::RenderTextEllipsis(&list, position, {right, position.y + size.y}, right, right, begin,
                              end, &size);
    ImGui::PopStyleColor();
    return size.x > width;
}

void tip(const Theme& theme, std::string_view text) {
    if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    if (GImGui->HoveredIdTimer < 0.35f) return;  // s; not at every passing of the mouse
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme.px(10), theme.px(8)});
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(theme.px(340));
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
    ImGui::PopStyleVar();
}

void same_line_if_fits(float width) {
    ImGui::SameLine();
    if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

std::string escaped(std::string_view text) {
    std::string result;
    for (const char c : text) result += c == '%' ? std::string("%%") : std::string(1, c);
    return result;
}

}  // namespace glint
