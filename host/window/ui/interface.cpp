#include "window/ui/interface.h"

#include "window/ui/widgets.h"

#include <imgui_internal.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

namespace glint {
namespace {

constexpr float kNoticeStays = 4.0f, kNoticeFades = 0.6f;  // s

// ImGui does so only where the keyboard moves through all items. What must be answered, and a field
// that is typed into, see to the key themselves.
void close_popup_by_key() {
    const auto& popups = GImGui->OpenPopupStack;
    const ImGuiIO& io = ImGui::GetIO();
    if (popups.empty() || io.WantTextInput) return;
    if (io.ConfigFlags & ImGuiConfigFlags_NavEnableKeyboard) return;
    const ImGuiWindow* top = popups.back().Window;
    if (top && (top->Flags & ImGuiWindowFlags_Modal)) return;
    if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape)))
        ImGui::ClosePopupToLevel(popups.Size - 1, true);
}

// Those that the keyboard goes through, in this order.
constexpr const char* kPanels[] = {"bar",   "start", "Tweaks", "Passes",      "Browser",
                                   "Study", "Check", "Source", "diagnostics", "transport"};

// As they stood in the frame before.
std::vector<ImGuiWindow*> open_panels() {
    std::vector<ImGuiWindow*> open;
    for (const char* name : kPanels) {
        ImGuiWindow* window = ImGui::FindWindowByName(name);
        if (window && window->WasActive && !window->Hidden) open.push_back(window);
    }
    return open;
}

void focus_panel(int step) {
    const std::vector<ImGuiWindow*> open = open_panels();
    if (open.empty()) return;
    const int count = static_cast<int>(open.size());
    const ImGuiWindow* now = GImGui->NavWindow ? GImGui->NavWindow->RootWindow : nullptr;
    const auto at = static_cast<int>(std::ranges::find(open, now) - open.begin());
    // From nowhere to the tweaks, where there are some: the bar has keys of its own.
    const int first = open.size() > 1 && GImGui->NavDisableHighlight ? 1 : 0;
    const bool is_new = at == count || GImGui->NavDisableHighlight;
    const int next = is_new ? (step > 0 ? first : count - 1) : (at + step + count) % count;
    ImGuiWindow* window = open[static_cast<std::size_t>(next)];
    ImGui::ClearActiveID();
    ImGui::FocusWindow(window);
    ImGui::NavInitWindow(window, true);
    GImGui->NavDisableHighlight = false;
}

// Which panel has the keyboard is seen from afar.
void outline(const Theme& theme) {
    const ImGuiWindow* window = GImGui->NavWindow ? GImGui->NavWindow->RootWindow : nullptr;
    if (!window || !window->Active) return;
    ImGui::GetForegroundDrawList()->AddRect(window->Pos, window->Rect().Max, colours::kAccent,
                                            window->WindowRounding, 0, theme.px(1.5f));
}

}  // namespace

// The scene has the keyboard until a person gives it to the panels, and after Esc or a click on the
// picture again. A dialog has it as long as it waits for an answer.
void Interface::follow_keys(PanelSettings& settings) {
    ImGuiIO& io = ImGui::GetIO();
    const bool had = had_keys_;
    const bool escapes = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    const bool clicks_scene = io.MouseClicked[0] && !GImGui->HoveredWindow;
    if ((had && escapes && !is_busy_) || clicks_scene || !settings.visible) settings.keys = false;
    keys_moved_ = settings.keys != had || settings.next_panel != 0;
    had_keys_ = settings.keys;
    if (settings.keys || ImGui::GetTopMostPopupModal())
        io.ConfigFlags |= ImGuiConfigFlags_NavEnableKeyboard;
    else
        io.ConfigFlags &= ~ImGuiConfigFlags_NavEnableKeyboard;
    const int step = std::exchange(settings.next_panel, 0);
    if (settings.keys && step != 0) focus_panel(step);
    if (had && !settings.keys) {
        ImGui::ClearActiveID();
        ImGui::FocusWindow(nullptr);
    }
}

Wishes Interface::build(const Facts& facts, const TweakValues& tweaks, const Transport& transport,
                        PanelSettings& settings) {
    Wishes wishes;
    const ImVec2 screen = ImGui::GetIO().DisplaySize;
    Build build{facts, tweaks, transport, settings, wishes, theme_, layout_};
    layout_before_ = layout_;
    follow_notice(facts);
    close_popup_by_key();
    follow_keys(settings);
    start_picture(build);
    if (screen.x >= 1.0f && screen.y >= 1.0f && settings.visible) {
        if (!facts.shows_picture && !facts.file.empty()) ground(build);
        waiting_label(build, diagnostics_.open);
        pixel_grid(build);
        shown_labels(build);
        probe_mark(build);
        wipe_handle(build);
        top_bar(build, diagnostics_);
        if (!facts.scene && facts.file.empty())
            start_page(build);
        else
            panels(build);
        if (settings.help) help_panel(build);
        if (settings.keys) outline(theme_);
    }
    if (screen.x >= 1.0f && !settings.visible) error_line(build);
    dialogs(build, saving_, new_scene_);
    if (screen.x >= 1.0f && notice_age_ < kNoticeStays)
        notice(build, std::clamp((kNoticeStays - notice_age_) / kNoticeFades, 0.0f, 1.0f));
    tweaks_.edits.follow(wishes);
    is_busy_ = ImGui::GetActiveID() != 0 || ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup);
    return wishes;
}

void Interface::panels(Build& build) {
    const PanelSettings& settings = build.settings;
    if (!settings.transport) layout_.transport = {};
    if (settings.transport) transport_panel(build, transport_);
    layout_.arrange(theme_, ImGui::GetIO().DisplaySize,
                    {settings.tweaks, settings.passes, settings.browser, settings.study,
                     settings.check, settings.source});
    if (settings.tweaks) tweaks_panel(build, tweaks_);
    if (settings.passes) passes_panel(build);
    if (settings.browser) browser_panel(build);
    if (settings.study) study_panel(build, study_);
    if (settings.check) check_panel(build);
    if (settings.source) source_panel(build, source_);
    diagnostics_panel(build, diagnostics_);
}

void Interface::follow_notice(const Facts& facts) {
    notice_age_ += std::min(ImGui::GetIO().DeltaTime, 0.1f);
    if (facts.notice == notice_ && facts.notice_number == notice_number_) return;
    notice_ = facts.notice;
    notice_number_ = facts.notice_number;
    notice_age_ = facts.notice.empty() ? kNoticeStays : 0.0f;
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
    const bool focus_moves = std::exchange(keys_moved_, false) || GImGui->NavAnyRequest;
    return has_moved || layout_ != layout_before_ || focus_moves;
}

bool Interface::is_moving() const {
    const bool tip_is_due = GImGui->HoveredId != 0 && GImGui->HoveredIdTimer < 0.4f;
    const bool dims = GImGui->DimBgRatio > 0.0f && GImGui->DimBgRatio < 1.0f;
    const ImGuiIO& io = ImGui::GetIO();
    const bool repeats = (io.ConfigFlags & ImGuiConfigFlags_NavEnableKeyboard) &&
                         std::ranges::find(io.KeysDown, true) != std::end(io.KeysDown);
    return notice_age_ < kNoticeStays || tip_is_due || dims || repeats;
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
    ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
    ImGui::PushTextWrapPos(std::max(screen.x - theme.px(32), theme.px(60)));
    text_in(colours::kText, build.facts.notice);
    ImGui::PopTextWrapPos();
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace glint
