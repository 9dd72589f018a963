#include "window/ui/tweak_row.h"

#include "window/ui/number_text.h"
#include "window/ui/tweak_controls.h"
#include "window/ui/widgets.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

namespace glint {
namespace {

std::string explanation(const Tweak& tweak) {
    std::string text = tweak.description.empty() ? tweak.name : tweak.description;
    text += fmt::format("\n\n{} {}", glsl_name(tweak.type), tweak.name);
    text += fmt::format("\ndefault {}", format_value(tweak, tweak.initial));
    if (has_range(tweak)) text += fmt::format(", from {} to {}", *tweak.min, *tweak.max);
    if (!tweak.unit.empty()) text += " " + tweak.unit;
    if (tweak.quality) text += "\nquality: trades error for time";
    if (tweak.reference) text += "\nreference " + format_value(tweak, *tweak.reference);
    return text +
           "\n\nDouble-click resets, right-click for more; Ctrl+click a slider types a value.";
}

void wish_lock(Build& build, std::size_t index) {
    using enum TweakEdit::What;
    wish(build, {.what = build.tweaks.locked(index) ? unlock : lock, .index = index});
}

void context_menu(Build& build, std::size_t index) {
    if (!ImGui::BeginPopupContextItem("menu")) return;
    const TweakValues& tweaks = build.tweaks;
    const Tweak& tweak = build.facts.scene->tweaks[index];
    if (ImGui::MenuItem("Reset", nullptr, false, tweaks.changed(index)))
        wish(build, {.what = TweakEdit::What::reset, .index = index});
    if (ImGui::MenuItem("Lock", nullptr, tweaks.locked(index))) wish_lock(build, index);
    if (ImGui::MenuItem("Copy value"))
        ImGui::SetClipboardText(format_value(tweak, tweaks.value(index)).c_str());
    ImGui::Separator();
    if (ImGui::MenuItem("Reset all", nullptr, false, tweaks.any_changed()))
        wish(build, {.what = TweakEdit::What::reset_all});
    ImGui::EndPopup();
}

// Room for the marks of a row: changed on the left, the lock on the right.
float gutter(const Theme& theme) {
    return theme.px(10);
}

void label(Build& build, std::size_t index, float width) {
    const Theme& theme = build.theme;
    const Tweak& tweak = build.facts.scene->tweaks[index];
    const bool changed = build.tweaks.changed(index);
    const float height = ImGui::GetFrameHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("label", {width, height});
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0))
        wish(build, {.what = TweakEdit::What::reset, .index = index});
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float middle = corner.y + 0.5f * height;
    if (changed)
        list.AddCircleFilled({corner.x + theme.px(3), middle}, theme.px(2.5f), colours::kAccent);
    const float mark = tweak.quality ? theme.px(14) : 0.0f;
    const ImVec2 place{corner.x + gutter(theme), middle - 0.5f * ImGui::GetFontSize()};
    const ImU32 colour = changed || ImGui::IsItemHovered() ? colours::kText : colours::kDim;
    const float room = width - gutter(theme) - mark;
    text_within(list, place, room, colour, tweak.name);
    if (tweak.quality) {
        const float text = std::min(ImGui::CalcTextSize(tweak.name.c_str()).x, room);
        const ImVec2 centre{place.x + text + theme.px(8), middle};
        list.AddNgonFilled(centre, theme.px(4), colours::kWarning, 4);
    }
    tip(theme, explanation(tweak));
    context_menu(build, index);
}

void lock_button(Build& build, std::size_t index) {
    const bool locked = build.tweaks.locked(index);
    const ImU32 colour = locked ? colours::kAccent : IM_COL32(255, 255, 255, 46);
    const char* text =
        locked ? "Locked: random values leave it alone" : "Lock it from random values";
    if (icon_button(build.theme, "lock", locked ? Icon::locked : Icon::unlocked, text,
                    {.colour = colour}))
        wish_lock(build, index);
}

}  // namespace

void tweak_row(Build& build, TweaksState& state, std::size_t index) {
    const Theme& theme = build.theme;
    ImGui::PushID(static_cast<int>(index));
    const float lock = ImGui::GetFrameHeight();
    const float whole = ImGui::GetContentRegionAvail().x;
    const float left = ImGui::GetCursorPosX();
    const bool narrow = whole < theme.px(250);
    const float label_width = narrow ? whole - lock : std::floor(0.42f * whole);
    label(build, index, label_width);
    float control_x = left + label_width;
    if (narrow) {
        ImGui::SameLine(left + whole - lock);
        lock_button(build, index);
        control_x = left + gutter(theme);
        ImGui::SetCursorPosX(control_x);
        tweak_control(build, state, index, left + whole - control_x);
    } else {
        ImGui::SameLine(control_x);
        tweak_control(build, state, index, whole - label_width - lock - theme.px(2));
        ImGui::SameLine(left + whole - lock);
        lock_button(build, index);
    }
    ImGui::PopID();
}

void Edits::set(Build& build, std::size_t index, const TweakValue& value) {
    const ImGuiID active = ImGui::GetActiveID();
    if (held_ && held_ != active) follow(build.wishes);
    if (active && !held_) {
        wish(build, {.what = TweakEdit::What::begin});
        held_ = active;
    }
    wish(build, {.what = TweakEdit::What::set, .index = index, .value = value});
}

void Edits::follow(Wishes& wishes) {
    if (!held_ || ImGui::GetActiveID() == held_) return;
    held_ = 0;
    wishes.tweaks.push_back({.what = TweakEdit::What::commit});
}

}  // namespace glint
