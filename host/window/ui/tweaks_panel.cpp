// The tweaks: tools for all of them, a search, and groups of rows.
#include "base/words.h"
#include "window/ui/interface.h"
#include "window/ui/tweak_row.h"
#include "window/ui/widgets.h"

#include <fmt/format.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cctype>
#include <utility>

namespace glint {
namespace {

constexpr std::size_t kSearchAbove = 8;  // tweaks

bool matches(const Tweak& tweak, const std::string& search) {
    if (search.empty()) return true;
    return in_small_letters(tweak.name + " " + tweak.group + " " + tweak.description)
               .find(in_small_letters(search)) != std::string::npos;
}

void sets(Build& build) {
    using enum TweakEdit::What;
    const Theme& theme = build.theme;
    const bool is_a = build.tweaks.shown() == TweakSet::a;
    if (text_button(theme, "A", is_a, "Show and change the first set of values"))
        wish(build, {.what = show, .shown = TweakSet::a});
    ImGui::SameLine(0, theme.px(2));
    if (text_button(theme, "B", !is_a, "Show and change the second set of values"))
        wish(build, {.what = show, .shown = TweakSet::b});
    ImGui::SameLine(0, theme.px(2));
    const char* copy_tip = is_a ? "Copy these values to set B" : "Copy these values to set A";
    if (icon_button(theme, "copy", Icon::copy, copy_tip)) wish(build, {.what = copy_to_other});
    ImGui::SameLine(0, theme.px(2));
    bool& wipe = build.settings.wipe;
    if (icon_button(theme, "wipe", Icon::wipe,
                    "Wipe: this set left of a line, the other right of it", {.on = wipe}))
        wipe = !wipe;
}

void tools(Build& build, TweaksState& state) {
    using enum TweakEdit::What;
    const TweakValues& tweaks = build.tweaks;
    const Theme& theme = build.theme;
    if (icon_button(theme, "undo", Icon::undo, "Undo (Ctrl+Z)", {.enabled = tweaks.can_undo()}))
        wish(build, {.what = undo});
    ImGui::SameLine(0, theme.px(2));
    if (icon_button(theme, "redo", Icon::redo, "Redo (Ctrl+Shift+Z)",
                    {.enabled = tweaks.can_redo()}))
        wish(build, {.what = redo});
    ImGui::SameLine(0, theme.px(2));
    bool is_any_new = false;
    for (std::size_t i = 0; i < tweaks.size(); ++i) is_any_new |= !tweaks.is_as_written(i);
    if (icon_button(theme, "reset all", Icon::revert,
                    "Reset all tweaks to the file's values, then to their defaults",
                    {.enabled = is_any_new || tweaks.any_changed()}))
        wish(build, {.what = reset_all});
    ImGui::SameLine(0, theme.px(2));
    if (icon_button(
            theme, "random", Icon::dice,
            "Random values (Ctrl+G) for all tweaks with a range, but camera, quality and what is "
            "locked"))
        wish(build, {.what = randomise, .seed = static_cast<std::uint32_t>(state.random())});
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
    if (!build.settings.wipe) return;
    const bool is_a = build.tweaks.shown() == TweakSet::a;
    number_slider(build.theme, "##wipe place", ImGui::GetContentRegionAvail().x,
                  build.settings.wipe_position, {0.0, 1.0, 0.5}, is_a ? "A | B" : "B | A");
}

void search_field(Build& build, TweaksState& state) {
    const bool begins = std::exchange(build.settings.search, false);
    state.searches = state.searches || begins;
    if (build.facts.scene->tweaks.size() <= kSearchAbove && !state.searches) {
        state.search.clear();
        return;
    }
    const float button = ImGui::GetFrameHeight();
    ImGui::SetNextItemWidth(state.search.empty() ? -1.0f : -button - build.theme.px(2));
    if (begins) ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputTextWithHint(
        "##search", "Search (Ctrl+F)", &state.search,
        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    state.focus_first |= entered && build.settings.keys;
    // Esc puts back what stood there, unless it comes with another key; it leaves all the same.
    const bool has_keys = ImGui::IsItemActive() || ImGui::IsItemDeactivated();
    const bool leaves = has_keys && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    if (leaves) {
        ImGui::ClearActiveID();
        build.settings.keys = false;
    }
    if (leaves || ImGui::IsItemDeactivated()) state.searches = !state.search.empty();
    if (state.search.empty()) return;
    ImGui::SameLine(0, build.theme.px(2));
    if (icon_button(build.theme, "clear", Icon::clear, "Show all")) state.search.clear();
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
    // As of its rows: a dot, and how many differ from the file; else a ring, and how many of the
    // file's differ from the defaults.
    const auto unsaved = std::ranges::count_if(
        group.tweaks, [&](std::size_t index) { return !build.tweaks.is_as_written(index); });
    const auto changed =
        unsaved > 0 ? unsaved : std::ranges::count_if(group.tweaks, [&](std::size_t index) {
            return build.tweaks.changed(index);
        });
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
    const ImVec2 dot{x - theme.px(7), y};
    if (unsaved > 0)
        list.AddCircleFilled(dot, theme.px(2.5f), colours::kAccent);
    else
        list.AddCircle(dot, theme.px(2.5f), colours::kAccent, 0, theme.px(1));
    return open;
}

void rows(Build& build, TweaksState& state) {
    const auto groups = groups_of(*build.facts.scene, state.search);
    if (groups.empty()) state.focus_first = false;
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
        for (const std::size_t index : group.tweaks) tweak_row(build, state, index);
        ImGui::Dummy({0, build.theme.px(2)});
    }
}

}  // namespace

void tweaks_panel(Build& build, TweaksState& state) {
    begin_panel(build, PanelId::tweaks, "Tweaks", build.settings.tweaks);
    const Scene* scene = build.facts.scene;
    const bool has_scene = scene && scene->tweaks.size() == build.tweaks.size();
    if (has_scene && !scene->tweaks.empty()) {
        tools(build, state);
        wipe_place(build);
        search_field(build, state);
    }
    begin_body();
    if (has_scene) rows(build, state);
    if (!has_scene)
        text_in(colours::kDim, !build.facts.waits_for.empty() ? "They come with the first frame."
                               : build.facts.file.empty()
                                   ? "No scene is open."
                                   : "They come once the scene has no errors.");
    end_panel(build, PanelId::tweaks);
}

}  // namespace glint
