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

std::string explanation(const Build& build, std::size_t index) {
    const Tweak& tweak = build.facts.scene->tweaks[index];
    std::string text = tweak.description.empty() ? tweak.name : tweak.description;
    text += fmt::format("\n\n{} {}", glsl_name(tweak.type), tweak.name);
    text += fmt::format("\ndefault {}", format_value(tweak, tweak.initial));
    if (has_range(tweak)) text += fmt::format(", from {} to {}", *tweak.min, *tweak.max);
    if (!tweak.unit.empty()) text += " " + tweak.unit;
    text += fmt::format("\nin the file {}", format_value(tweak, build.tweaks.written(index)));
    if (tweak.quality) text += "\nquality: trades error for time";
    if (!takes_random(tweak)) text += "\na random look leaves it alone";
    if (tweak.reference) text += "\nreference " + format_value(tweak, *tweak.reference);
    return text +
           "\n\nDouble-click resets to the file's value, then to the default; right-click for "
           "more; "
           "Ctrl+click a slider types a value.";
}

void wish_lock(Build& build, std::size_t index) {
    using enum TweakEdit::What;
    wish(build, {.what = build.tweaks.locked(index) ? unlock : lock, .index = index});
}

void context_menu(Build& build, std::size_t index) {
    if (!ImGui::BeginPopupContextItem("menu")) return;
    const TweakValues& tweaks = build.tweaks;
    const Tweak& tweak = build.facts.scene->tweaks[index];
    using enum TweakEdit::What;
    const auto entry = [&](const char* words, const TweakValue& value, TweakEdit::What what) {
        const std::string text = fmt::format("{} ({})", words, format_value(tweak, value));
        if (ImGui::MenuItem(text.c_str(), nullptr, false, value != tweaks.value(index)))
            wish(build, {.what = what, .index = index});
    };
    entry("Reset to the file's", tweaks.written(index), reset);
    entry("Reset to the default", tweak.initial, reset_to_default);
    if (ImGui::MenuItem("Lock", nullptr, tweaks.locked(index))) wish_lock(build, index);
    if (ImGui::MenuItem("Copy value"))
        ImGui::SetClipboardText(format_value(tweak, tweaks.value(index)).c_str());
    ImGui::Separator();
    if (ImGui::MenuItem("Reset all to the defaults", nullptr, false, tweaks.any_changed()))
        wish(build, {.what = reset_all_to_defaults});
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
    area("label", {width, height});
    if (is_pressed_by_key()) ImGui::OpenPopup("menu");
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0))
        wish(build, {.what = TweakEdit::What::reset, .index = index});
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float middle = corner.y + 0.5f * height;
    // Filled: it is not as the file has it. A ring: the file has it so, other than the default.
    const ImVec2 dot{corner.x + theme.px(3), middle};
    if (!build.tweaks.is_as_written(index))
        list.AddCircleFilled(dot, theme.px(2.5f), colours::kAccent);
    else if (changed)
        list.AddCircle(dot, theme.px(2.5f), colours::kAccent, 0, theme.px(1));
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
    tip(theme, explanation(build, index));
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
    // By its name: what is held stays held where a save brings it to another place.
    ImGui::PushID(build.facts.scene->tweaks[index].name.c_str());
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
    const bool is_told_of = state.told_of == build.facts.scene->tweaks[index].name;
    if (is_told_of && state.told_at == build.tweaks.value(index)) {
        ImGui::SetCursorPosX(control_x);
        ImGui::PushTextWrapPos(left + whole);
        text_in(colours::kWarning, state.told);
        ImGui::PopTextWrapPos();
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
