#include "window/ui/interface.h"

#include "window/ui/widgets.h"

#include <imgui_internal.h>

#include <algorithm>
#include <utility>

namespace glint {
namespace {

constexpr float kNoticeStays = 4.0f, kNoticeFades = 0.6f;  // s

// ImGui does so only where the keyboard moves through all items. What must be answered, and a field
// that is typed into, see to the key themselves.
void close_popup_by_key() {
    const auto& popups = GImGui->OpenPopupStack;
    if (popups.empty() || ImGui::GetIO().WantTextInput) return;
    const ImGuiWindow* top = popups.back().Window;
    if (top && (top->Flags & ImGuiWindowFlags_Modal)) return;
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)))
        ImGui::ClosePopupToLevel(popups.Size - 1, true);
}

}  // namespace

Wishes Interface::build(const Facts& facts, const TweakValues& tweaks, Transport& transport,
                        PanelSettings& settings) {
    Wishes wishes;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    Build build{facts, tweaks, transport, settings, wishes, theme_, layout_};
    layout_before_ = layout_;
    follow_notice(facts);
    close_popup_by_key();
    if (screen.x >= 1.0f && screen.y >= 1.0f && settings.visible) {
        if (!facts.shows_picture && !facts.file.empty()) ground(build);
        waiting_label(build);
        pixel_grid(build);
        shown_labels(build);
        wipe_handle(build);
        top_bar(build, diagnostics_);
        if (!facts.scene && facts.file.empty())
            start_page(build);
        else
            panels(build);
        if (settings.help) help_panel(build);
    }
    if (screen.x >= 1.0f && !settings.visible) error_line(build);
    dialogs(build, saving_, new_scene_);
    if (screen.x >= 1.0f && notice_age_ < kNoticeStays)
        notice(build, std::clamp((kNoticeStays - notice_age_) / kNoticeFades, 0.0f, 1.0f));
    tweaks_.edits.follow(wishes);
    return wishes;
}

void Interface::panels(Build& build) {
    const PanelSettings& settings = build.settings;
    if (!settings.transport) layout_.transport = {};
    if (settings.transport) transport_panel(build, transport_);
    layout_.arrange(
        theme_, ImGui::GetIO().DisplaySize,
        {settings.tweaks, settings.passes, settings.browser, settings.study, settings.check});
    if (settings.tweaks) tweaks_panel(build, tweaks_);
    if (settings.passes) passes_panel(build);
    if (settings.browser) browser_panel(build);
    if (settings.study) study_panel(build, study_);
    if (settings.check) check_panel(build);
    diagnostics_panel(build, diagnostics_);
}

void Interface::follow_notice(const Facts& facts) {
    notice_age_ += std::min(ImGui::GetIO().DeltaTime, 0.1f);
    if (facts.notice == notice_) return;
    notice_ = facts.notice;
    notice_age_ = notice_.empty() ? kNoticeStays : 0.0f;
}

// A window with a size of its own choice is hidden while it finds it; tables inside take a pass
// more.
bool Interface::is_behind() {
    unsigned extents = 0;
    for (const ImGuiWindow* window : GImGui->Windows) {
        if (!window->Active) continue;
        const ImVec2 extent[] = {window->Pos, window->Size, window->ContentSize};
        extents = ImHashData(extent, sizeof extent, extents);
        extents = ImHashData(&window->Hidden, sizeof window->Hidden, extents);
    }
    const bool has_moved = std::exchange(extents_, extents) != extents;
    return has_moved || layout_ != layout_before_;
}

bool Interface::is_moving() const {
    const bool tip_is_due = GImGui->HoveredId != 0 && GImGui->HoveredIdTimer < 0.4f;
    const bool dims = GImGui->DimBgRatio > 0.0f && GImGui->DimBgRatio < 1.0f;
    return notice_age_ < kNoticeStays || tip_is_due || dims;
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
    ImGui::PushTextWrapPos(std::max(screen.x - theme.px(32), theme.px(60)));
    text_in(colours::kText, build.facts.notice);
    ImGui::PopTextWrapPos();
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace glint
