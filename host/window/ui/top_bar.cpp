// The bar at the top: what is open, toggles for the panels, the picture's own settings.
#include "scene/preset.h"
#include "window/ui/interface.h"
#include "window/ui/shortcuts.h"
#include "window/ui/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace glint {
namespace {

void title(Build& build, float widest) {
    const Theme& theme = build.theme;
    const Facts& facts = build.facts;
    const std::string text = facts.title.empty() ? "Glint" : facts.title;
    const float height = ImGui::GetFrameHeight();
    ImGui::PushFont(theme.bold);
    const float width = std::min(ImGui::CalcTextSize(text.c_str()).x + 1.0f, widest);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    text_within(*ImGui::GetWindowDrawList(),
                {corner.x, corner.y + 0.5f * (height - ImGui::GetFontSize())}, width,
                colours::kText, text);
    ImGui::PopFont();
    const float mark = facts.unsaved ? theme.px(10) : 0.0f;
    ImGui::Dummy({width + mark, height});
    tip(theme, facts.file.string() + (facts.unsaved ? "\nnot saved (Ctrl+S)" : ""));
    if (facts.unsaved)
        ImGui::GetWindowDrawList()->AddCircleFilled(
            {corner.x + width + theme.px(6), corner.y + 0.5f * height}, theme.px(3),
            colours::kWarning);
    ImGui::SameLine();
}

// What can be done to the file; why not, where there is nothing to do.
struct FileAction {
    const char* name;
    const char* what;
    Action action;
    std::string why_not;
};

std::array<FileAction, 3> file_actions(const Facts& facts) {
    const char* save = is_preset(facts.file) ? "Save the preset" : "Save as a preset of this scene";
    return {{{"Save", save, Action::save, facts.why_no_save},
             {"Save as\u2026", "Save as another preset", Action::save_as,
              facts.scene ? "" : "Nothing is open."},
             {"Revert", "Back to what the file says; undo takes it back", Action::revert,
              facts.why_no_revert}}};
}

void wish_for(Build& build, Action action) {
    if (action == Action::revert)
        build.wishes.revert = true;
    else if (action == Action::save && is_preset(build.facts.file))
        build.wishes.save = true;
    else
        build.settings.save_as = true;
}

std::string tip_of(const FileAction& action) {
    const std::string text = fmt::format("{} ({})", action.what, keys_of(action.action));
    return action.why_not.empty() ? text : text + "\n" + action.why_not;
}

float words_width(const Facts& facts) {
    const ImGuiStyle& style = ImGui::GetStyle();
    float width = 0.0f;
    for (const FileAction& action : file_actions(facts))
        width +=
            ImGui::CalcTextSize(action.name).x + 2 * style.FramePadding.x + style.ItemSpacing.x;
    return width;
}

void file_words(Build& build) {
    for (const FileAction& action : file_actions(build.facts)) {
        ImGui::BeginDisabled(!action.why_not.empty());
        if (text_button(build.theme, action.name, false, tip_of(action).c_str()))
            wish_for(build, action.action);
        ImGui::EndDisabled();
        ImGui::SameLine(0, build.theme.px(2));
    }
}

// The same where the words have no room.
void file_menu(Build& build) {
    if (text_button(build.theme, "File", false, "Save, Save as, Revert")) ImGui::OpenPopup("file");
    if (ImGui::BeginPopup("file")) {
        for (const FileAction& action : file_actions(build.facts)) {
            if (ImGui::MenuItem(action.name, keys_of(action.action), false, action.why_not.empty()))
                wish_for(build, action.action);
            tip(build.theme, tip_of(action));
        }
        ImGui::EndPopup();
    }
    ImGui::SameLine(0, build.theme.px(2));
}

void toggle(Build& build, const char* name, Icon icon, Action action, bool& open) {
    const std::string text = fmt::format("{} ({})", name, keys_of(action));
    if (icon_button(build.theme, name, icon, text.c_str(), {.on = open})) open = !open;
    ImGui::SameLine(0, build.theme.px(2));
}

std::string pixels_text(glm::ivec2 size) {
    return fmt::format("{} \u00d7 {}", size.x, size.y);
}

void picture_popup(Build& build) {
    const Theme& theme = build.theme;
    const ImVec2 below{ImGui::GetItemRectMin().x, build.layout.bar.bottom() + theme.px(8)};
    ImGui::SetNextWindowPos(below);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme.px(12), theme.px(12)});
    const bool open = ImGui::BeginPopup("picture");
    ImGui::PopStyleVar();
    if (!open) return;
    PanelSettings& settings = build.settings;
    const float width = theme.px(220);
    text_in(colours::kText, "Picture", theme.bold);
    number_slider(theme, "##scale", width, settings.resolution_scale, {0.25, 2.0, 1.0, true},
                  fmt::format("full size \u00d7 {:.2f}", settings.resolution_scale));
    tip(theme, "Pixels of the full size for each of the window. Right-click: 1.");
    ImGui::Checkbox("hold a frame rate", &settings.hold_frame_rate);
    tip(theme, "While something moves, lowers the resolution as far as this rate needs");
    if (settings.hold_frame_rate)
        number_slider(theme, "##rate", width, settings.frame_rate, {5.0, 120.0, 20.0},
                      fmt::format("{:.0f} frames/s", settings.frame_rate));
    ImGui::Checkbox("refine what stands still", &settings.refine);
    tip(theme, "Draws at the full size, and averages 64 samples a pixel, while nothing moves");
    const glm::ivec2 frame = build.facts.frame_size;
    ImGui::BeginDisabled(frame.x == 0);
    bool is_free = frame.x == 0 || settings.free_aspect;
    if (ImGui::Checkbox("free aspect", &is_free)) settings.free_aspect = is_free;
    ImGui::EndDisabled();
    tip(theme, frame.x == 0 ? "No size is given that the picture could keep to"
                            : fmt::format("Fills the window instead of keeping to {} ({})",
                                          pixels_text(frame), keys_of(Action::free_aspect)));
    ImGui::Separator();
    text_in(colours::kDim, pixels_text(build.facts.picture_size) + " pixels");
    ImGui::PushTextWrapPos(theme.px(360));
    if (!build.facts.renderer.empty()) text_in(colours::kDim, build.facts.renderer);
    text_in(colours::kDim,
            build.facts.specialised ? "tweaks compiled in as constants" : "tweaks as uniforms");
    if (!build.facts.last_reload.empty()) text_in(colours::kDim, build.facts.last_reload);
    ImGui::PopTextWrapPos();
    ImGui::EndPopup();
}

// What is seen is not the frame that the preset draws: the bar says so.
void free_aspect(Build& build) {
    const glm::ivec2 frame = build.facts.frame_size;
    if (frame.x == 0 || !build.settings.free_aspect) return;
    ImGui::SameLine();
    const std::string text = fmt::format(
        "The picture fills the window, and is saved so. Click: the preset's {} again "
        "({})",
        pixels_text(frame), keys_of(Action::free_aspect));
    if (text_button(build.theme, "free aspect", true, text.c_str()))
        build.settings.free_aspect = false;
}

void actions(Build& build) {
    const Theme& theme = build.theme;
    if (icon_button(theme, "screen", Icon::screen, "Picture: resolution, frame rate"))
        ImGui::OpenPopup("picture");
    picture_popup(build);
    ImGui::SameLine(0, theme.px(2));
    if (icon_button(theme, "still", Icon::camera, "Write a still (F12)",
                    {.enabled = build.facts.scene != nullptr}))
        build.wishes.still = true;
    ImGui::SameLine(0, theme.px(2));
    const bool recording = build.facts.recording;
    if (icon_button(
            theme, "record", Icon::record,
            recording ? "Stop recording (F9)" : "Record mouse and keys (F9)",
            {.enabled = build.facts.scene != nullptr, .colour = recording ? colours::kError : 0}))
        build.wishes.toggle_recording = true;
    ImGui::SameLine(0, theme.px(2));
    if (icon_button(theme, "full screen", Icon::full_screen, "Full screen (F11)"))
        build.wishes.toggle_full_screen = true;
    ImGui::SameLine(0, theme.px(2));
    bool& help = build.settings.help;
    if (icon_button(theme, "help", Icon::help, "Keys (F1)", {.on = help})) help = !help;
}

}  // namespace

void top_bar(Build& build, DiagnosticsState& diagnostics) {
    const Theme& theme = build.theme;
    const float margin = theme.px(8);
    const float screen = ImGui::GetIO().DisplaySize.x;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {theme.px(8), theme.px(4)});
    ImGui::SetNextWindowPos({margin, margin});
    ImGui::Begin("bar", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize);
    const float toggles = 12 * (ImGui::GetFrameHeight() + theme.px(2)) + theme.px(60);
    const float words = words_width(build.facts);
    const bool has_room = screen - 2 * margin - toggles - words > theme.px(140);
    const float taken = toggles + (has_room ? words : theme.px(50));
    title(build, std::max(std::min(theme.px(260), screen - 2 * margin - taken), 1.0f));
    if (build.facts.scene && has_room) file_words(build);
    if (build.facts.scene && !has_room) file_menu(build);
    ImGui::SameLine(0, theme.px(8));
    PanelSettings& settings = build.settings;
    toggle(build, "Browser", Icon::browser, Action::browser, settings.browser);
    toggle(build, "Passes", Icon::passes, Action::passes, settings.passes);
    toggle(build, "Tweaks", Icon::tweaks, Action::tweaks, settings.tweaks);
    toggle(build, "Transport", Icon::clock, Action::transport, settings.transport);
    toggle(build, "Study", Icon::study, Action::study, settings.study);
    toggle(build, "Check", Icon::check, Action::check, settings.check);
    toggle(build, "Source", Icon::source, Action::source, settings.source);
    ImGui::SameLine(0, theme.px(8));
    actions(build);
    free_aspect(build);
    if (build.facts.loading) {
        ImGui::SameLine();
        ImGui::AlignTextToFramePadding();
        text_in(colours::kAccent, "compiling\u2026");
    }
    diagnostics_button(build, diagnostics);
    build.layout.bar = {ImGui::GetWindowPos(), ImGui::GetWindowSize()};
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace glint
