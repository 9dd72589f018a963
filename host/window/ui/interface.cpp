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
        pixel_grid(build);
        shown_labels(build);
        wipe_handle(build);
        top_bar(build, diagnostics_);
        if (!settings.transport) layout_.transport = {};
        if (settings.transport) transport_panel(build, transport_);
        layout_.arrange(
            theme_, screen,
            {settings.tweaks, settings.passes, settings.browser, settings.study, settings.check});
        if (!facts.scene) empty_hint(build);
        if (settings.tweaks) tweaks_panel(build, tweaks_);
        if (settings.passes) passes_panel(build);
        if (settings.browser) browser_panel(build);
        if (settings.study) study_panel(build, study_);
        if (settings.check) check_panel(build);
        diagnostics_panel(build, diagnostics_);
        if (settings.help) help_panel(build);
    }
    if (screen.x >= 1.0f && !settings.visible) error_line(build);
    dialogs(build, saving_);
    if (screen.x >= 1.0f && notice_age_ < kNoticeStays)
        notice(build, std::clamp((kNoticeStays - notice_age_) / kNoticeFades, 0.0f, 1.0f));
    tweaks_.edits.follow(wishes);
    return wishes;
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

void empty_hint(Build& build) {
    if (build.facts.loading || has_errors(build.facts.diagnostics)) return;
    const Theme& theme = build.theme;
    const Area& free = build.layout.free;
    const ImVec2 centre{free.corner.x + 0.5f * free.size.x, free.corner.y + 0.5f * free.size.y};
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const char* big = "Drop a .frag file here";
    const char* small = "or choose one in the browser (Ctrl+O)";
    const float line = ImGui::GetTextLineHeightWithSpacing();
    const float width = std::min(ImGui::CalcTextSize(small).x, free.size.x);
    const ImVec2 half{0.5f * width + theme.px(32), line + theme.px(24)};
    list.AddRectFilled({centre.x - half.x, centre.y - half.y},
                       {centre.x + half.x, centre.y + half.y}, colours::kPanel, theme.px(6));
    list.AddRect({centre.x - half.x, centre.y - half.y}, {centre.x + half.x, centre.y + half.y},
                 colours::kFaint, theme.px(6), 0, theme.px(1));
    ImGui::PushFont(theme.bold);
    const float big_width = ImGui::CalcTextSize(big).x;
    text_within(list, {centre.x - 0.5f * big_width, centre.y - line}, big_width + 1.0f,
                colours::kText, big);
    ImGui::PopFont();
    text_within(list, {centre.x - 0.5f * width, centre.y + theme.px(4)}, width + 1.0f,
                colours::kDim, small);
}

}  // namespace glint
