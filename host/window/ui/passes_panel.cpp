// Looking inside: the passes with their times, and how the viewer shows one of their outputs.
#include "window/ui/interface.h"
#include "window/ui/viewer_controls.h"
#include "window/ui/widgets.h"

#include <fmt/format.h>

#include <algorithm>

namespace glint {
namespace {

bool is_picture(const std::string& sampler) {
    return sampler.empty() || sampler == "image";
}

bool shows(const PassView& view, const std::string& sampler) {
    return view.sampler == sampler || (is_picture(view.sampler) && is_picture(sampler));
}

bool shows_any(const PassView& view, const PassFact& pass) {
    if (pass.outputs.empty()) return shows(view, pass.name);
    return std::ranges::any_of(pass.outputs,
                               [&](const std::string& output) { return shows(view, output); });
}

void view_output(Build& build, const std::string& sampler) {
    PassView& view = build.settings.view;
    view.sampler = is_picture(sampler) ? "" : sampler;
    view.centre = glm::dvec2(0.5);
    view.zoom = 0.0;
}

std::string state_text(const Build& build, const PassFact& pass) {
    std::string text = fmt::format("{} \u00d7 {} \u00b7 {}", pass.size.x, pass.size.y, pass.runs);
    if (!pass.drawn) text += " \u00b7 skipped";
    if (build.facts.specialised) text += " \u00b7 specialised";
    return text;
}

// The time as a bar beside those of the other passes.
void draw_bar(const Theme& theme, ImVec2 corner, float width, double share, bool drawn) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float height = theme.px(3);
    list.AddRectFilled(corner, {corner.x + width, corner.y + height}, colours::kField, theme.px(1));
    const float length = width * static_cast<float>(std::clamp(share, 0.0, 1.0));
    list.AddRectFilled(corner, {corner.x + length, corner.y + height},
                       drawn ? colours::kAccent : colours::kFaint, theme.px(1));
}

void draw_pass(Build& build, const PassFact& pass, ImVec2 corner, float width, double slowest) {
    const Theme& theme = build.theme;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float inset = theme.px(8), line = ImGui::GetTextLineHeight();
    const std::string ms = fmt::format("{:.2f} ms", pass.ms);
    const float ms_width = ImGui::CalcTextSize(ms.c_str()).x;
    const float left = corner.x + inset, right = corner.x + width - inset;
    float y = corner.y + theme.px(4);
    list.AddText({right - ms_width, y}, pass.drawn ? colours::kText : colours::kDim, ms.c_str());
    const float room = right - ms_width - inset - left;
    const float name = std::min(ImGui::CalcTextSize(pass.name.c_str()).x, room);
    text_within(list, {left, y}, room, colours::kText, pass.name);
    text_within(list, {left + name + inset, y}, room - name - inset, colours::kDim, pass.entry);
    y += line + theme.px(2);
    text_within(list, {left, y}, right - left, colours::kDim, state_text(build, pass));
    y += line + theme.px(4);
    draw_bar(theme, {left, y}, right - left, slowest > 0.0 ? pass.ms / slowest : 0.0, pass.drawn);
}

void pass_row(Build& build, const PassFact& pass, double slowest) {
    const Theme& theme = build.theme;
    const float width = std::max(ImGui::GetContentRegionAvail().x, 1.0f);
    const float height = 2 * ImGui::GetTextLineHeight() + theme.px(18);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    if (area("pass", {width, height}))
        view_output(build, pass.outputs.empty() ? pass.name : pass.outputs.front());
    const bool shown = shows_any(build.settings.view, pass);
    if (shown || ImGui::IsItemHovered())
        ImGui::GetWindowDrawList()->AddRectFilled(
            corner, {corner.x + width, corner.y + height},
            shown ? IM_COL32(105, 178, 236, 36) : IM_COL32(255, 255, 255, 14), theme.px(4));
    tip(theme, fmt::format("{} ({})\n{}\nClick to view it.", pass.name, pass.entry,
                           state_text(build, pass)));
    draw_pass(build, pass, corner, width, slowest);
    if (pass.outputs.size() < 2) return;
    ImGui::Indent(theme.px(8));
    for (const std::string& output : pass.outputs) {
        if (&output != &pass.outputs.front())
            same_line_if_fits(ImGui::CalcTextSize(output.c_str()).x + theme.px(16));
        if (text_button(theme, output.c_str(), shows(build.settings.view, output), ""))
            view_output(build, output);
    }
    ImGui::Unindent(theme.px(8));
    ImGui::Dummy({0, theme.px(2)});
}

void pass_list(Build& build) {
    double slowest = 0.0, sum = 0.0;
    for (const PassFact& pass : build.facts.passes) {
        slowest = std::max(slowest, pass.ms);
        if (pass.drawn) sum += pass.ms;
    }
    for (std::size_t i = 0; i < build.facts.passes.size(); ++i) {
        ImGui::PushID(static_cast<int>(i));
        pass_row(build, build.facts.passes[i], slowest);
        ImGui::PopID();
    }
    ImGui::Indent(build.theme.px(8));
    text_in(colours::kDim, build.facts.passes.empty() ? "Nothing is drawn yet."
                                                      : fmt::format("together {:.2f} ms", sum));
    ImGui::Unindent(build.theme.px(8));
}

}  // namespace

void passes_panel(Build& build) {
    begin_panel(build, PanelId::passes, "Passes", build.settings.passes);
    begin_body();
    pass_list(build);
    ImGui::Separator();
    viewer_controls(build);
    end_panel(build, PanelId::passes);
}

}  // namespace glint
