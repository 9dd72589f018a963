// The tweaks: groups of rows, each a label that resets and locks, and a control.
#include "ui/interface.h"
#include "ui/number_text.h"
#include "ui/tweak_controls.h"
#include "ui/widgets.h"

#include <fmt/format.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>

namespace glint {
namespace {

constexpr std::size_t kSearchAbove = 8;  // tweaks

// ASCII letters made small.
std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

bool matches(const Tweak& tweak, const std::string& search) {
    if (search.empty()) return true;
    return lower(tweak.name + " " + tweak.group + " " + tweak.description).find(lower(search)) !=
           std::string::npos;
}

void changed_by(Build& build, bool did) {
    build.wishes.tweaks_changed = build.wishes.tweaks_changed || did;
}

void sets(Build& build) {
    History& history = build.history;
    const Theme& theme = build.theme;
    const bool is_a = history.shown() == History::Set::a;
    if (text_button(theme, "A", is_a, "Show and change the first set of values")) {
        history.show(History::Set::a);
        changed_by(build, true);
    }
    ImGui::SameLine(0, theme.px(2));
    if (text_button(theme, "B", !is_a, "Show and change the second set of values")) {
        history.show(History::Set::b);
        changed_by(build, true);
    }
    ImGui::SameLine(0, theme.px(2));
    const char* copy_tip = is_a ? "Copy these values to set B" : "Copy these values to set A";
    if (icon_button(theme, "copy", Icon::copy, copy_tip)) {
        history.copy_to_other();
        changed_by(build, true);
    }
    ImGui::SameLine(0, theme.px(2));
    Wipe& wipe = build.settings.wipe;
    if (icon_button(theme, "wipe", Icon::wipe,
                    "Wipe: this set left of a line, the other right of it",
                    {.on = wipe == Wipe::wipe}))
        wipe = wipe == Wipe::wipe ? Wipe::off : Wipe::wipe;
}

void tools(Build& build, TweaksState& state) {
    History& history = build.history;
    const Theme& theme = build.theme;
    if (icon_button(theme, "undo", Icon::undo, "Undo (Ctrl+Z)", {.enabled = history.can_undo()}))
        changed_by(build, history.undo());
    ImGui::SameLine(0, theme.px(2));
    if (icon_button(theme, "redo", Icon::redo, "Redo (Ctrl+Shift+Z)",
                    {.enabled = history.can_redo()}))
        changed_by(build, history.redo());
    ImGui::SameLine(0, theme.px(2));
    if (icon_button(theme, "reset all", Icon::revert, "Reset all tweaks to their defaults",
                    {.enabled = history.any_changed()})) {
        history.reset_all();
        changed_by(build, true);
    }
    ImGui::SameLine(0, theme.px(2));
    if (icon_button(theme, "random", Icon::dice,
                    "Random values for all tweaks with a range that are not locked")) {
        history.randomise(static_cast<std::uint32_t>(state.random()));
        changed_by(build, true);
    }
    const float rest =
        2 * ImGui::GetFrameHeight() + theme.px(4 * 8 + 3 * 2) + ImGui::CalcTextSize("AB").x;
    const float before = ImGui::GetCursorPosY();
    same_line_if_fits(rest);
    const float room = ImGui::GetContentRegionAvail().x - rest;
    if (room > 0.0f && ImGui::GetCursorPosY() < before)
        ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room);
    sets(build);
}

void wipe_place(Build& build) {
    if (build.settings.wipe != Wipe::wipe) return;
    const bool is_a = build.history.shown() == History::Set::a;
    number_slider(build.theme, "##wipe place", ImGui::GetContentRegionAvail().x,
                  build.settings.wipe_position, {0.0, 1.0, 0.5}, is_a ? "A | B" : "B | A");
}

void search_field(Build& build, TweaksState& state) {
    if (build.facts.scene->tweaks.size() <= kSearchAbove) {
        state.search.clear();
        return;
    }
    const float button = ImGui::GetFrameHeight();
    ImGui::SetNextItemWidth(state.search.empty() ? -1.0f : -button - build.theme.px(2));
    ImGui::InputTextWithHint("##search", "Search", &state.search);
    if (state.search.empty()) return;
    ImGui::SameLine(0, build.theme.px(2));
    if (icon_button(build.theme, "clear", Icon::clear, "Show all")) state.search.clear();
}

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

void context_menu(Build& build, std::size_t index) {
    if (!ImGui::BeginPopupContextItem("menu")) return;
    History& history = build.history;
    const Tweak& tweak = build.facts.scene->tweaks[index];
    if (ImGui::MenuItem("Reset", nullptr, false, history.changed(index))) {
        history.reset(index);
        changed_by(build, true);
    }
    if (ImGui::MenuItem("Lock", nullptr, history.locked(index)))
        history.lock(index, !history.locked(index));
    if (ImGui::MenuItem("Copy value"))
        ImGui::SetClipboardText(format_value(tweak, history.value(index)).c_str());
    ImGui::Separator();
    if (ImGui::MenuItem("Reset all", nullptr, false, history.any_changed())) {
        history.reset_all();
        changed_by(build, true);
    }
    ImGui::EndPopup();
}

// Room for the marks of a row: changed on the left, the lock on the right.
float gutter(const Theme& theme) {
    return theme.px(10);
}

void label(Build& build, std::size_t index, float width) {
    const Theme& theme = build.theme;
    const Tweak& tweak = build.facts.scene->tweaks[index];
    const bool changed = build.history.changed(index);
    const float height = ImGui::GetFrameHeight();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("label", {width, height});
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(0)) {
        build.history.reset(index);
        changed_by(build, true);
    }
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
    const bool locked = build.history.locked(index);
    const ImU32 colour = locked ? colours::kAccent : IM_COL32(255, 255, 255, 46);
    const char* text =
        locked ? "Locked: random values leave it alone" : "Lock it from random values";
    if (icon_button(build.theme, "lock", locked ? Icon::locked : Icon::unlocked, text,
                    {.colour = colour}))
        build.history.lock(index, !locked);
}

void row(Build& build, TweaksState& state, std::size_t index) {
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

struct Group {
    std::string_view name;
    std::vector<std::size_t> tweaks;
};

// In the order in which the file names them first.
std::vector<Group> groups_of(const Scene& scene, const std::string& search) {
    std::vector<Group> groups;
    for (std::size_t i = 0; i < scene.tweaks.size(); ++i) {
        if (!matches(scene.tweaks[i], search)) continue;
        auto found = std::ranges::find(groups, scene.tweaks[i].group, &Group::name);
        if (found == groups.end()) found = groups.insert(found, {scene.tweaks[i].group, {}});
        found->tweaks.push_back(i);
    }
    return groups;
}

bool group_heading(Build& build, const Group& group, bool is_searched) {
    const Theme& theme = build.theme;
    const auto changed = std::ranges::count_if(
        group.tweaks, [&](std::size_t index) { return build.history.changed(index); });
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    if (is_searched) ImGui::SetNextItemOpen(true);
    const std::string name(group.name);
    ImGui::PushFont(theme.bold);
    const bool open = ImGui::CollapsingHeader((escaped(name) + "###heading").c_str(),
                                              ImGuiTreeNodeFlags_DefaultOpen);
    ImGui::PopFont();
    if (changed == 0) return open;
    const std::string count = fmt::format("{}", changed);
    const float x = corner.x + width - theme.px(10) - ImGui::CalcTextSize(count.c_str()).x;
    const float y = corner.y + 0.5f * ImGui::GetFrameHeight();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddText({x, y - 0.5f * ImGui::GetFontSize()}, colours::kAccent, count.c_str());
    list.AddCircleFilled({x - theme.px(7), y}, theme.px(2.5f), colours::kAccent);
    return open;
}

void rows(Build& build, TweaksState& state) {
    const auto groups = groups_of(*build.facts.scene, state.search);
    if (groups.empty())
        text_in(colours::kDim,
                state.search.empty() ? "This scene has no tweaks." : "Nothing found.");
    if (groups.empty() && state.search.empty()) {
        ImGui::PushTextWrapPos(0.0f);
        text_in(colours::kDim, "Declare one on a uniform's line:");
        text_in(colours::kText, "uniform float size; //@ 0.5 [0, 1]", build.theme.mono);
        ImGui::PopTextWrapPos();
    }
    for (const Group& group : groups) {
        ImGui::PushID(std::string(group.name).c_str());
        const bool open = group.name.empty() || group_heading(build, group, !state.search.empty());
        ImGui::PopID();
        if (!open) continue;
        for (const std::size_t index : group.tweaks) row(build, state, index);
        ImGui::Dummy({0, build.theme.px(2)});
    }
}

}  // namespace

void Edits::set(Build& build, std::size_t index, const TweakValue& value) {
    const ImGuiID active = ImGui::GetActiveID();
    if (held_ && held_ != active) follow(build.history);
    if (active && !held_) {
        build.history.begin();
        held_ = active;
    }
    build.history.set(index, value);
    build.wishes.tweaks_changed = true;
}

void Edits::follow(History& history) {
    if (!held_ || ImGui::GetActiveID() == held_) return;
    held_ = 0;
    history.commit();
}

void tweaks_panel(Build& build, TweaksState& state) {
    begin_panel(build, PanelId::tweaks, "Tweaks", build.settings.tweaks);
    const Scene* scene = build.facts.scene;
    const bool has_scene = scene && scene->tweaks.size() == build.history.values().size();
    if (has_scene && !scene->tweaks.empty()) {
        tools(build, state);
        wipe_place(build);
        search_field(build, state);
    }
    begin_body();
    if (has_scene) rows(build, state);
    if (!has_scene) text_in(colours::kDim, "No scene is open.");
    end_panel(build, PanelId::tweaks);
}

}  // namespace glint
