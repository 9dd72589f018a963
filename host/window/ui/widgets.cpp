#include "window/ui/widgets.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

namespace glint {

bool area(const char* id, ImVec2 size, int flags) {
    const bool pressed = ImGui::InvisibleButton(id, size, flags);
    const ImGuiLastItemData& item = GImGui->LastItemData;
    ImGui::RenderNavHighlight(item.Rect, item.ID, ImGuiNavHighlightFlags_TypeThin);
    return pressed;
}

bool is_pressed_by_key() {
    return GImGui->NavActivateId != 0 && GImGui->NavActivateId == GImGui->LastItemData.ID;
}

void focus_last_item() {
    ImGui::SetFocusID(GImGui->LastItemData.ID, ImGui::GetCurrentWindow());
    GImGui->NavDisableHighlight = false;
    ImGui::SetScrollHereY();
}

bool icon_button(const Theme& theme, const char* id, Icon icon, const char* tip_text,
                 const ButtonLook& look) {
    const float side = look.side > 0.0f ? look.side : ImGui::GetFrameHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const bool pressed = area(id, {side, side}) && look.enabled;
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

namespace {

void draw_track(const Theme& theme, float width, double fraction, double origin, bool hot) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 end{corner.x + width, corner.y + ImGui::GetFrameHeight()};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float round = theme.px(4);
    list.AddRectFilled(corner, end, hot ? colours::kFieldHovered : colours::kField, round);
    const float grab = ImGui::GetStyle().GrabMinSize, inset = 2.0f;  // as SliderBehavior insets it
    const float travel = std::max(width - 2 * inset - grab, 0.0f);
    const auto place = [&](double t) {
        if (t <= 0.0) return corner.x;
        if (t >= 1.0) return end.x;
        return corner.x + inset + 0.5f * grab + static_cast<float>(t) * travel;
    };
    const float left = place(std::min(fraction, origin));
    const float right = place(std::max(fraction, origin));
    if (right - left < 0.5f) return;
    ImDrawFlags corners = ImDrawFlags_RoundCornersNone;
    if (left == corner.x) corners = ImDrawFlags_RoundCornersLeft;
    if (right == end.x)
        corners = left == corner.x ? ImDrawFlags_RoundCornersAll : ImDrawFlags_RoundCornersRight;
    list.AddRectFilled({left, corner.y}, {right, end.y}, colours::kAccentFill, round, corners);
}

}  // namespace

bool slider(const Theme& theme, const char* id, float width, double& fraction,
            const std::string& text, double origin) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 end{corner.x + width, corner.y + ImGui::GetFrameHeight()};
    const ImGuiID held = ImGui::GetActiveID();
    const bool is_held = held && held == ImGui::GetID(id);
    const bool hovered =
        !held && ImGui::IsWindowHovered() && ImGui::IsMouseHoveringRect(corner, end);
    draw_track(theme, width, fraction, origin, hovered || is_held);
    for (const ImGuiCol colour :
         {ImGuiCol_FrameBg, ImGuiCol_FrameBgHovered, ImGuiCol_FrameBgActive})
        ImGui::PushStyleColor(colour, IM_COL32(0, 0, 0, 0));
    // The grab shows under the mouse only: at rest nothing stands in the way of the number.
    if (!hovered && !is_held) ImGui::PushStyleColor(ImGuiCol_SliderGrab, IM_COL32(0, 0, 0, 0));
    ImGui::SetNextItemWidth(width);
    constexpr double kZero = 0.0, kOne = 1.0;
    const bool moved = ImGui::SliderScalar(
        id, ImGuiDataType_Double, &fraction, &kZero, &kOne, escaped(text).c_str(),
        ImGuiSliderFlags_NoRoundToFormat | ImGuiSliderFlags_NoInput);
    ImGui::PopStyleColor(hovered || is_held ? 3 : 4);
    return moved;
}

bool number_slider(const Theme& theme, const char* id, float width, float& number,
                   const Range& range, const std::string& text) {
    const auto fraction_of = [&](double value) {
        const double t = range.log ? std::log(value / range.min) / std::log(range.max / range.min)
                                   : (value - range.min) / (range.max - range.min);
        return std::clamp(t, 0.0, 1.0);
    };
    double fraction = fraction_of(static_cast<double>(number));
    const double origin = range.min < 0.0 ? fraction_of(0.0) : 0.0;
    if (slider(theme, id, width, fraction, text, origin)) {
        number =
            static_cast<float>(range.log ? range.min * std::pow(range.max / range.min, fraction)
                                         : range.min + fraction * (range.max - range.min));
        return true;
    }
    if (!ImGui::IsItemClicked(1)) return false;
    number = static_cast<float>(range.rest);
    return true;
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
    // ImGui counts how long the mouse rests on what has an id; texts and drawings have none.
    const ImGuiLastItemData item = GImGui->LastItemData;
    if (item.ID == 0)
        ImGui::ItemHoverable(
            item.Rect, ImHashData(&item.Rect, sizeof item.Rect, ImGui::GetCurrentWindowRead()->ID));
    if (GImGui->HoveredIdTimer < 0.35f) return;      // s; not at every passing of the mouse
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, 1.0f);  // of what is disabled it says why
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme.px(10), theme.px(8)});
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(theme.px(340));
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
    ImGui::PopStyleVar(2);
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
