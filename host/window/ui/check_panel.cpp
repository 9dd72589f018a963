// Numerical stability: every extreme that a scene can be brought to, worst first.
#include "window/ui/curves.h"
#include "window/ui/interface.h"
#include "window/ui/widgets.h"

#include <fmt/format.h>

#include <algorithm>

namespace glint {
namespace {

ImU32 colour_of(CaseVerdict verdict) {
    switch (verdict) {
        case CaseVerdict::fail:
            return colours::kError;
        case CaseVerdict::report:
            return colours::kWarning;
        case CaseVerdict::pass:
            return colours::kText;
        case CaseVerdict::skip:
            return colours::kDim;
    }
    return colours::kText;
}

const char* word_of(CaseVerdict verdict) {
    switch (verdict) {
        case CaseVerdict::fail:
            return "fail";
        case CaseVerdict::report:
            return "report";
        case CaseVerdict::pass:
            return "pass";
        case CaseVerdict::skip:
            return "left out";
    }
    return "";
}

std::string count_text(std::span<const CaseResult> cases) {
    const auto failed = std::ranges::count(cases, CaseVerdict::fail, &CaseResult::verdict);
    if (failed > 0) return fmt::format("{} of {} cases failed", failed, cases.size());
    return fmt::format("no failure in {} cases", cases.size());
}

void run_button(Build& build) {
    const bool running = build.facts.check_work.running;
    const float width = ImGui::CalcTextSize("Cancel").x + build.theme.px(20);
    ImGui::BeginDisabled(!build.facts.scene);
    if (running && ImGui::Button("Cancel", {width, 0})) build.wishes.cancel_check = true;
    if (!running && ImGui::Button("Run", {width, 0})) {
        build.wishes.check = true;
        build.settings.shown = Shown::scene;
        build.settings.shown_case.clear();
    }
    ImGui::EndDisabled();
    if (build.facts.cases.empty()) return;
    ImGui::SameLine();
    ImGui::AlignTextToFramePadding();
    const bool fails = build.facts.cases.front().verdict == CaseVerdict::fail;
    text_in(fails ? colours::kError : colours::kDim, count_text(build.facts.cases));
}

// Its frame comes into the view, and its command under the line; a second click puts both away.
void choose(Build& build, const CaseResult& found) {
    PanelSettings& settings = build.settings;
    const bool again = settings.shown_case == found.name;
    settings.shown_case = again ? "" : found.name;
    const bool picture = !again && !found.picture.empty();
    if (picture || settings.shown == Shown::failure)
        settings.shown = picture ? Shown::failure : Shown::scene;
}

void case_line(Build& build, const CaseResult& found) {
    const Theme& theme = build.theme;
    const float width = std::max(ImGui::GetContentRegionAvail().x, 1.0f);
    const float height = ImGui::GetTextLineHeight() + theme.px(4);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    if (area("case", {width, height})) choose(build, found);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool chosen = build.settings.shown_case == found.name;
    if (chosen || ImGui::IsItemHovered())
        list.AddRectFilled(corner, {corner.x + width, corner.y + height},
                           chosen ? IM_COL32(105, 178, 236, 36) : IM_COL32(255, 255, 255, 14),
                           theme.px(4));
    tip(theme, found.note.empty() ? found.name : found.name + "\n" + found.note);
    const float y = corner.y + theme.px(2), verdict = theme.px(58);
    text_within(list, {corner.x + theme.px(4), y}, verdict - theme.px(8), colour_of(found.verdict),
                word_of(found.verdict));
    const float room = width - verdict - theme.px(4);
    const float name = std::min(ImGui::CalcTextSize(found.name.c_str()).x, room);
    const bool fails = found.verdict == CaseVerdict::fail;
    text_within(list, {corner.x + verdict, y}, room, fails ? colours::kError : colours::kText,
                found.name);
    text_within(list, {corner.x + verdict + name + theme.px(8), y}, room - name - theme.px(8),
                colours::kDim, found.note);
}

// Under the line of the chosen case: why, and the command that shows it again.
void case_details(Build& build, const CaseResult& found) {
    const Theme& theme = build.theme;
    ImGui::Indent(theme.px(8));
    ImGui::PushTextWrapPos(0.0f);
    if (!found.note.empty()) text_in(colours::kText, found.note);
    for (const InvariantCurve& curve : found.curves) invariant_curve(theme, curve);
    if (!found.reproduce.empty()) text_in(colours::kDim, found.reproduce, theme.mono);
    ImGui::PopTextWrapPos();
    if (!found.reproduce.empty() && text_button(theme, "Copy the command", false, ""))
        ImGui::SetClipboardText(found.reproduce.c_str());
    ImGui::Unindent(theme.px(8));
    ImGui::Dummy({0, theme.px(2)});
}

void introduce_check() {
    ImGui::PushTextWrapPos(0.0f);
    text_in(colours::kDim,
            "Brings the scene to every extreme, small and out of sight: ages up to a year, all "
            "ends of its tweaks, sizes from one pixel, uneven frame rates, poisoned buffers. NaN, "
            "Inf, hangs and drifting motion fail.");
    ImGui::PopTextWrapPos();
}

}  // namespace

void check_panel(Build& build) {
    begin_panel(build, PanelId::check, "Check", build.settings.check);
    run_button(build);
    work_line(build.theme, build.facts.check_work);
    begin_body();
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {build.theme.px(8), build.theme.px(2)});
    for (const CaseResult& found : build.facts.cases) {
        ImGui::PushID(found.name.c_str());
        case_line(build, found);
        if (build.settings.shown_case == found.name) case_details(build, found);
        ImGui::PopID();
    }
    ImGui::PopStyleVar();
    ImGui::Dummy({0, 0});  // the usual distance below, by which the panel finds its height
    if (build.facts.cases.empty() && !build.facts.check_work.running) introduce_check();
    end_panel(build, PanelId::check);
}

}  // namespace glint
