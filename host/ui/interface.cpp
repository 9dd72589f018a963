#include "ui/interface.h"

#include "ui/widgets.h"

#include <imgui_internal.h>

#include <algorithm>

namespace glint {
namespace {

constexpr float kNoticeStays = 4.0f, kNoticeFades = 0.6f;  // s

}  // namespace

Wishes Interface::build(const Facts& facts, History& history, Transport& transport,
                        PanelSettings& settings) {
    Wishes wishes;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    Build build{facts, history, transport, settings, wishes, theme_, layout_};
    follow_notice(facts);
    if (screen.x >= 1.0f && screen.y >= 1.0f && settings.visible) {
        top_bar(build);
        if (!settings.transport) layout_.transport = {};
        if (settings.transport) transport_panel(build, transport_);
        layout_.arrange(theme_, screen, {settings.tweaks, settings.passes, settings.browser});
        if (!facts.scene) empty_hint(build);
        if (settings.tweaks) tweaks_panel(build, tweaks_);
        if (settings.passes) passes_panel(build);
        browser_panel(build, browser_);
        diagnostics_panel(build, diagnostics_);
        if (settings.help) help_panel(build);
    }
    if (screen.x >= 1.0f && notice_age_ < kNoticeStays)
        notice(build, std::clamp((kNoticeStays - notice_age_) / kNoticeFades, 0.0f, 1.0f));
    tweaks_.edits.follow(history);
    return wishes;
}

void Interface::follow_notice(const Facts& facts) {
    notice_age_ += std::min(ImGui::GetIO().DeltaTime, 0.1f);
    if (facts.notice == notice_) return;
    notice_ = facts.notice;
    notice_age_ = notice_.empty() ? kNoticeStays : 0.0f;
}

bool Interface::is_moving() const {
    const bool tip_is_due = GImGui->HoveredId != 0 && GImGui->HoveredIdTimer < 0.4f;
    return notice_age_ < kNoticeStays || tip_is_due;
}

void notice(Build& build, float alpha) {
    const Theme& theme = build.theme;
    const Area& bar = build.layout.transport;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    const float bottom = bar.size.y > 0.0f && build.settings.visible ? bar.corner.y : screen.y;
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, alpha);
    ImGui::SetNextWindowPos({0.5f * screen.x, bottom - theme.px(16)}, 0, {0.5f, 1.0f});
    ImGui::Begin("notice", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                     ImGuiWindowFlags_NoFocusOnAppearing);
    text_in(colours::kText, build.facts.notice);
    ImGui::End();
    ImGui::PopStyleVar();
}

void empty_hint(Build& build) {
    if (build.facts.loading || has_errors(build.facts.diagnostics)) return;
    const Area& free = build.layout.free;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const float line = ImGui::GetTextLineHeightWithSpacing();
    float y = free.corner.y + 0.5f * free.size.y - line;
    for (const char* text : {"Drop a .frag file here", "or choose one in the browser (Ctrl+O)"}) {
        const float width = std::min(ImGui::CalcTextSize(text).x, free.size.x);
        text_within(list, {free.corner.x + 0.5f * (free.size.x - width), y}, width, colours::kDim,
                    text);
        y += line;
    }
    (void)build.theme;
}

}  // namespace glint
