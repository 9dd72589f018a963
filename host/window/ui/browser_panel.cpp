// Scenes and presets to choose from.
#include "scene/preset.h"
#include "window/ui/interface.h"
#include "window/ui/widgets.h"

#include <fmt/format.h>

#include <algorithm>

namespace glint {
namespace {

namespace fs = std::filesystem;

// The scene under which an entry stands: its own if it is one; for a preset the one that it names.
fs::path scene_of(const BrowserEntry& entry, std::span<const BrowserEntry> all) {
    if (!is_preset(entry.file)) return entry.file;
    if (!entry.scene.empty()) return entry.scene;
    const std::string name = entry.file.stem().string();
    for (const BrowserEntry& other : all)
        if (!is_preset(other.file) && name.starts_with(other.file.stem().string()))
            return other.file;
    return {};
}

// A scene and a preset of it may have one name: the corner says which is which.
void kind_mark(const Theme& theme, const fs::path& file, ImVec2 corner) {
    const char* word = is_preset(file) ? "preset" : "scene";
    const ImVec2 text = ImGui::CalcTextSize(word), pad{theme.px(6), theme.px(2)};
    const ImVec2 begin{corner.x + theme.px(5), corner.y + theme.px(5)};
    const ImVec2 end{begin.x + text.x + 2 * pad.x, begin.y + text.y + 2 * pad.y};
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(begin, end, IM_COL32(0, 0, 0, 180), theme.px(4));
    list.AddText({begin.x + pad.x, begin.y + pad.y},
                 is_preset(file) ? colours::kAccent : colours::kText, word);
}

void draw_card(Build& build, const BrowserEntry& entry, ImVec2 corner, float width, float picture) {
    const Theme& theme = build.theme;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 end{corner.x + width, corner.y + picture};
    const float round = theme.px(4);
    list.AddRectFilled(corner, end, colours::kField, round);
    if (entry.thumbnail) {
        // Textures have their first row at the bottom.
        const auto texture = reinterpret_cast<ImTextureID>(std::uintptr_t{entry.thumbnail});
        list.AddImageRounded(texture, corner, end, {0, 1}, {1, 0}, IM_COL32_WHITE, round);
    } else {
        const ImVec2 centre{0.5f * (corner.x + end.x), 0.5f * (corner.y + end.y)};
        draw_icon(list, is_preset(entry.file) ? Icon::tweaks : Icon::passes, centre, theme.px(20),
                  colours::kFaint);
    }
    kind_mark(theme, entry.file, corner);
    const bool open = entry.file == build.facts.file;
    if (open || ImGui::IsItemHovered())
        list.AddRect(corner, end, open ? colours::kAccent : colours::kDim, round, 0, theme.px(2));
    const std::string title = entry.title.empty() ? entry.file.filename().string() : entry.title;
    text_within(list, {corner.x, end.y + theme.px(3)}, width, open ? colours::kText : colours::kDim,
                title);
}

void card(Build& build, const BrowserEntry& entry, float width) {
    const float picture = std::round(width * 9.0f / 16.0f);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float height = picture + ImGui::GetTextLineHeight() + build.theme.px(6);
    if (area("card", {std::max(width, 1.0f), height})) build.wishes.open = entry.file;
    if (ImGui::IsItemVisible()) build.wishes.seen.push_back(entry.file);
    draw_card(build, entry, corner, width, picture);
    tip(build.theme, fmt::format("{} {}\n{}", is_preset(entry.file) ? "preset" : "scene",
                                 entry.title, entry.file.string()));
}

void cards(Build& build, const std::vector<std::size_t>& entries, float least) {
    const Theme& theme = build.theme;
    const float whole = ImGui::GetContentRegionAvail().x, gap = theme.px(8);
    const int columns = std::max(1, static_cast<int>((whole + gap) / (theme.px(least) + gap)));
    const float width =
        std::floor((whole - gap * static_cast<float>(columns - 1)) / static_cast<float>(columns));
    for (std::size_t i = 0; i < entries.size(); ++i) {
        if (i % static_cast<std::size_t>(columns) != 0) ImGui::SameLine(0, gap);
        ImGui::PushID(static_cast<int>(entries[i]));
        card(build, build.facts.browser[entries[i]], width);
        ImGui::PopID();
    }
}

std::string shelf_of(const BrowserEntry& entry, std::span<const BrowserEntry> all) {
    if (!entry.shelf.empty()) return entry.shelf;
    const fs::path scene = scene_of(entry, all);
    return scene.empty() ? "Presets" : scene.stem().string();
}

}  // namespace

void shelves(Build& build, float card_width) {
    std::vector<std::pair<std::string, std::vector<std::size_t>>> groups;
    for (std::size_t i = 0; i < build.facts.browser.size(); ++i) {
        const std::string shelf = shelf_of(build.facts.browser[i], build.facts.browser);
        auto found =
            std::ranges::find(groups, shelf, [](const auto& group) { return group.first; });
        if (found == groups.end()) found = groups.insert(found, {shelf, {}});
        found->second.push_back(i);
    }
    for (const auto& [shelf, entries] : groups) {
        text_in(colours::kText, shelf, build.theme.bold);
        cards(build, entries, card_width);
        ImGui::Dummy({0, build.theme.px(4)});
    }
}

void browser_panel(Build& build) {
    begin_panel(build, PanelId::browser, "Browser", build.settings.browser);
    if (text_button(build.theme, "New\u2026", false, "A commented scene to begin with"))
        build.settings.new_scene = true;
    begin_body();
    shelves(build, 130.0f);
    if (build.facts.browser.empty()) {
        ImGui::PushTextWrapPos(0.0f);
        text_in(colours::kDim, "Nothing is here yet. Drop a .frag file or a preset on the window.");
        ImGui::PopTextWrapPos();
    }
    end_panel(build, PanelId::browser);
}

}  // namespace glint
