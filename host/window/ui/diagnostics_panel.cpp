// What is wrong with the text, over the last good picture: place, message, the line and a caret.
#include "base/source_line.h"
#include "window/ui/interface.h"
#include "window/ui/widgets.h"

#include <fmt/format.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

namespace glint {
namespace {

std::string summary(std::span<const Diagnostic> diagnostics) {
    const auto errors = std::ranges::count(diagnostics, Severity::error, &Diagnostic::severity);
    const auto warnings = std::ssize(diagnostics) - errors;
    const auto counted = [](auto count, const char* word) {
        return count == 0 ? std::string()
                          : fmt::format("{} {}{}", count, word, count == 1 ? "" : "s");
    };
    const std::string a = counted(errors, "error"), b = counted(warnings, "warning");
    return a.empty() || b.empty() ? a + b : a + ", " + b;
}

// Reads the lines again when there is something new to say.
void follow(const Facts& facts, DiagnosticsState& state) {
    std::string told;
    for (const Diagnostic& diagnostic : facts.diagnostics) told += to_string(diagnostic) + "\n";
    for (const EmptyChannel& channel : facts.empty_channels) told += channel.name + "\n";
    if (told == state.told) return;
    state.told = std::move(told);
    state.open = has_errors(facts.diagnostics) || !facts.empty_channels.empty();
    state.shown.clear();
    for (const Diagnostic& diagnostic : facts.diagnostics)
        state.shown.push_back({diagnostic, read_source_line(diagnostic.place)});
    // What has to be mended stands first.
    std::ranges::stable_partition(state.shown, [](const DiagnosticsState::Shown& shown) {
        return shown.diagnostic.severity == Severity::error;
    });
}

ImU32 colour_of(Severity severity) {
    return severity == Severity::error ? colours::kError : colours::kWarning;
}

std::string place_text(const Place& place) {
    const std::string name = std::filesystem::path(place.file).filename().string();
    if (place.line <= 0) return name;
    if (place.column <= 0) return fmt::format("{}:{}", name, place.line);
    return fmt::format("{}:{}:{}", name, place.line, place.column);
}

void source_line(const Theme& theme, const DiagnosticsState::Shown& shown) {
    if (shown.source.empty()) return;
    ImGui::PushFont(theme.mono);
    const Place& place = shown.diagnostic.place;
    const std::string number = fmt::format("{:>4}  ", place.line);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float digit = ImGui::CalcTextSize("0").x;
    const auto left = static_cast<int>(number.size());
    const int room = static_cast<int>(ImGui::GetContentRegionAvail().x / digit) - left;
    const SourceLine line = shown_line(shown.source, place.column, std::max(room, 20));
    text_in(colours::kDim, number);
    ImGui::SameLine(0, 0);
    text_in(colours::kText, line.text);
    if (line.caret >= 0) {
        const float x = corner.x + digit * static_cast<float>(left + line.caret);
        const float y = corner.y + ImGui::GetTextLineHeight() - theme.px(1);
        ImGui::GetWindowDrawList()->AddText({x, y}, colour_of(shown.diagnostic.severity), "^");
        ImGui::Dummy({1, theme.px(6)});
    }
    ImGui::PopFont();
}

void entry(Build& build, const DiagnosticsState::Shown& shown) {
    const Theme& theme = build.theme;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float indent = theme.px(12);
    ImGui::Indent(indent);
    ImGui::BeginGroup();
    text_in(colour_of(shown.diagnostic.severity), place_text(shown.diagnostic.place), theme.mono);
    ImGui::PushTextWrapPos(0.0f);
    text_in(colours::kText, shown.diagnostic.text);
    ImGui::PopTextWrapPos();
    source_line(theme, shown);
    ImGui::EndGroup();
    ImGui::Unindent(indent);
    const ImVec2 after = ImGui::GetCursorScreenPos();
    const float bottom = ImGui::GetItemRectMax().y;
    ImGui::SetCursorScreenPos(corner);
    if (area("edit", {std::max(width, 1.0f), bottom - corner.y}))
        build.wishes.edit = shown.diagnostic;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    if (ImGui::IsItemHovered()) {
        list.AddRectFilled(corner, {corner.x + width, bottom}, IM_COL32(255, 255, 255, 12),
                           theme.px(4));
        ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
    }
    list.AddRectFilled(corner, {corner.x + theme.px(3), bottom},
                       colour_of(shown.diagnostic.severity), theme.px(2));
    tip(theme, "Click to open the editor here: " + shown.diagnostic.place.file);
    ImGui::SetCursorScreenPos(after);
}

void buttons(Build& build, DiagnosticsState& state) {
    const Theme& theme = build.theme;
    if (text_button(theme, "Edit", false, "Open $EDITOR at the first place (Ctrl+E)"))
        build.wishes.edit = state.shown.front().diagnostic;
    ImGui::SameLine(0, theme.px(4));
    if (icon_button(theme, "close", Icon::close, "Hide; the bar at the top shows it again",
                    {.colour = colours::kDim}))
        state.open = false;
}

// The summary, the buttons on the right, and the note between them or, where it is narrow, beneath.
void heading(Build& build, DiagnosticsState& state) {
    const Theme& theme = build.theme;
    const bool errors = has_errors(build.facts.diagnostics);
    const char* note = "";
    if (errors)
        note =
            build.facts.scene ? "The last good picture keeps running." : "There is no picture yet.";
    ImGui::AlignTextToFramePadding();
    text_in(errors ? colours::kError : colours::kWarning, summary(build.facts.diagnostics),
            theme.bold);
    const float width =
        ImGui::CalcTextSize("Edit").x + ImGui::GetFrameHeight() + theme.px(2 * 8 + 4);
    ImGui::SameLine();
    const float room = ImGui::GetContentRegionAvail().x - width;
    const bool fits = ImGui::CalcTextSize(note).x + theme.px(16) < room;
    const float right = ImGui::GetCursorPosX() + room;
    if (fits) text_in(colours::kDim, note);
    if (fits) ImGui::SameLine();
    ImGui::SetCursorPosX(std::max(right, ImGui::GetCursorPosX()));
    buttons(build, state);
    ImGui::PushTextWrapPos(0.0f);
    if (!fits) text_in(colours::kDim, note);
    ImGui::PopTextWrapPos();
}

// One click fills a channel that the scene reads and nothing fills.
void offers(Build& build, const EmptyChannel& channel) {
    const Theme& theme = build.theme;
    ImGui::Indent(theme.px(12));
    ImGui::AlignTextToFramePadding();
    text_in(colours::kDim, fmt::format("Fill {} with", channel.name));
    for (const EmptyChannel::Offer& offer : channel.offers) {
        same_line_if_fits(ImGui::CalcTextSize(offer.label.c_str()).x + theme.px(16));
        if (text_button(theme, offer.label.c_str(), false, "Saving the preset keeps it"))
            build.wishes.fill = offer.filler;
    }
    ImGui::Unindent(theme.px(12));
}

// Between the columns, or over their lower parts where too little is left between them.
Area place(const Build& build) {
    const Theme& theme = build.theme;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    Area area = build.layout.free;
    if (area.size.x < theme.px(420)) {
        area.corner.x = theme.px(8);
        area.size.x = std::max(screen.x - theme.px(16), 1.0f);
    }
    const float width = std::min(area.size.x, theme.px(760));
    area.corner.x += std::round(0.5f * (area.size.x - width));
    area.size.x = width;
    return area;
}

}  // namespace

void diagnostics_button(Build& build, DiagnosticsState& state) {
    follow(build.facts, state);
    if (state.shown.empty()) return;
    const bool errors = has_errors(build.facts.diagnostics);
    ImGui::SameLine();
    ImGui::PushStyleColor(ImGuiCol_Text, errors ? colours::kError : colours::kWarning);
    if (ImGui::Button((summary(build.facts.diagnostics) + "###diagnostics").c_str()))
        state.open = !state.open;
    ImGui::PopStyleColor();
    tip(build.theme, state.open ? "Hide the list" : "Show the list");
}

void error_line(Build& build) {
    const auto error =
        std::ranges::find(build.facts.diagnostics, Severity::error, &Diagnostic::severity);
    if (error == build.facts.diagnostics.end()) return;
    const Theme& theme = build.theme;
    const std::string text =
        place_text(error->place) + "  " + error->text.substr(0, error->text.find('\n'));
    const char* hint = "Tab shows all";
    const float margin = theme.px(8), width = ImGui::GetIO().DisplaySize.x - 2 * margin;
    const float hint_width = ImGui::CalcTextSize(hint).x;
    ImDrawList& list = *ImGui::GetForegroundDrawList();
    const float bottom = margin + ImGui::GetTextLineHeight() + theme.px(8);
    list.AddRectFilled({margin, margin}, {margin + width, bottom}, colours::kPanel, theme.px(4));
    list.AddRectFilled({margin, margin}, {margin + theme.px(3), bottom}, colours::kError);
    const ImVec2 at{margin + theme.px(12), margin + theme.px(4)};
    const float room = width - hint_width - theme.px(36);
    text_within(list, at, room, colours::kError, text);
    if (room > theme.px(120))
        list.AddText({margin + width - hint_width - theme.px(12), at.y}, colours::kDim, hint);
}

void diagnostics_panel(Build& build, DiagnosticsState& state) {
    follow(build.facts, state);
    if (state.shown.empty() || !state.open) return;
    const Area area = place(build);
    ImGui::SetNextWindowPos({area.corner.x, area.bottom()}, 0, {0.0f, 1.0f});
    ImGui::SetNextWindowSizeConstraints({area.size.x, 0},
                                        {area.size.x, std::max(0.5f * area.size.y, 1.0f)});
    ImGui::Begin("diagnostics", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    // Over panels that were opened since; what is chosen from a list is chosen first.
    if (!ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel))
        ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
    heading(build, state);
    for (std::size_t i = 0; i < state.shown.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        ImGui::Dummy({0, 0});
        entry(build, state.shown[i]);
        ImGui::PopID();
    }
    for (const EmptyChannel& channel : build.facts.empty_channels) {
        ImGui::PushID(channel.name.c_str());
        offers(build, channel);
        ImGui::PopID();
    }
    ImGui::End();
}

}  // namespace glint
