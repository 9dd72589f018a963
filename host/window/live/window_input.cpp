// What a person does to the window with keys and mouse.
#include "window/live/keys.h"
#include "window/live/playground_window.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace glint {

// The fraction of the picture, as recordings keep it, of a place in the window (pixels, y up).
glm::dvec2 PlaygroundWindow::on_picture(glm::dvec2 position) const {
    const ScreenArea area = picture_area();
    const glm::dvec2 room(glm::max(area.size, glm::ivec2(1)));
    const glm::dvec2 at = position - glm::dvec2(area.origin);
    const glm::ivec2 size = playground_.still_size();  // a held one has coarser pixels
    return mouse_fraction(glm::dvec2(at.x, room.y - at.y) / room * glm::dvec2(size), size);
}

// Not on the bars beside it.
bool PlaygroundWindow::is_on_picture(glm::dvec2 position) const {
    const ScreenArea area = picture_area();
    const glm::dvec2 at = position - glm::dvec2(area.origin);
    return at.x >= 0.0 && at.y >= 0.0 && at.x < area.size.x && at.y < area.size.y;
}

void PlaygroundWindow::handle(const WindowEvent& event) {
    dirty_ = was_told_ = true;
    switch (event.kind) {
        case WindowEvent::Kind::key:
            if (!event.repeat) panels_.key(event.code, event.down);
            handle_key(event);
            break;
        case WindowEvent::Kind::text:
            panels_.character(static_cast<unsigned>(event.code));
            break;
        case WindowEvent::Kind::mouse_button:
        case WindowEvent::Kind::mouse_move:
        case WindowEvent::Kind::scroll:
            handle_mouse(event);
            break;
        case WindowEvent::Kind::drop:
            if (!event.files.empty()) take_dropped(event.files.front());
            break;
        case WindowEvent::Kind::resize:
            break;
        case WindowEvent::Kind::focus:
            if (!event.down) release_keys();
            break;
        case WindowEvent::Kind::close:
            leave({Leaving::For::quit, {}});
            break;
    }
}

// Keys that were down when the window lost the keyboard would never be seen to come up.
void PlaygroundWindow::release_keys() {
    for (const int code : held_keys_) playground_.key(code, false);
    held_keys_.clear();
}

void PlaygroundWindow::handle_key(const WindowEvent& event) {
    if (event.down && !event.repeat && run_shortcut(event.code, event.modifiers)) return;
    const int code = key_code_of(event.code);
    if (code < 0 || event.repeat) return;
    const auto held = std::find(held_keys_.begin(), held_keys_.end(), code);
    const bool is_scenes = !panels_.takes_keyboard() && !settings_.keys;
    if (event.down && is_scenes && held == held_keys_.end()) {
        held_keys_.push_back(code);
        playground_.key(code, true);
    } else if (!event.down && held != held_keys_.end()) {
        held_keys_.erase(held);
        playground_.key(code, false);
    }
}

// Of a buffer, of what is magnified and of colours that are changed there is nothing to be seen
// once the panel that shows them is closed; and nothing beside the picture at any time.
void PlaygroundWindow::settle_view() {
    PassView& view = settings_.view;
    if (!looks_inside()) {
        view.sampler.clear();
        view.channel = 0;
        view.exposure = 0.0f;
        view.tone_curve = false;
        view.zoom = 0.0;
    }
    glm::dvec2 half(0.5);  // of the view, as a fraction of the picture
    if (view.zoom > 0.0)
        half = glm::min(half, 0.5 * glm::dvec2(window_.size()) /
                                  (glm::dvec2(glm::max(viewed_size(), 1)) * view.zoom));
    view.centre = glm::clamp(view.centre, half, 1.0 - half);
}

void PlaygroundWindow::handle_mouse(const WindowEvent& event) {
    settle_view();
    const glm::dvec2 window(glm::max(window_.size(), glm::ivec2(1)));
    PassView& view = settings_.view;
    if (event.kind == WindowEvent::Kind::scroll) {
        if (panels_.takes_mouse() || !looks_inside()) return;
        const glm::dvec2 size(viewed_size());
        const double fit = std::min(window.x / size.x, window.y / size.y);
        const double zoom =
            (view.zoom > 0.0 ? view.zoom : fit) * std::exp2(event.position.y * 0.25);
        view.zoom = zoom <= fit ? 0.0 : std::min(zoom, 256.0);
        return;
    }
    const glm::dvec2 moved = event.position - mouse_;
    mouse_ = event.position;
    if (event.kind == WindowEvent::Kind::mouse_button) {
        panels_.mouse_button(event.position, event.code, event.down,
                             (event.modifiers & GLFW_MOD_CONTROL) != 0);
    }
    if (event.kind == WindowEvent::Kind::mouse_button && event.code == 0) {
        if (event.down && pin_probe(event.position)) return;
        const bool starts = event.down && !panels_.takes_mouse_at(event.position);
        panning_ = starts && !is_over_scene();
        if (starts && is_over_scene() && is_on_picture(event.position)) dragging_scene_ = true;
        if (dragging_scene_) playground_.mouse(on_picture(event.position), event.down);
        if (!event.down) dragging_scene_ = false;
        return;
    }
    // A drag that began on the scene goes on over the panels and outside the window.
    if (dragging_scene_) playground_.mouse(on_picture(event.position), true);
    if (panning_ && view.zoom > 0.0) view.centre -= moved / (glm::dvec2(viewed_size()) * view.zoom);
}

// What has been typed counts, whatever is asked for next. A frame takes the last of it from ImGui.
void PlaygroundWindow::end_typing() {
    draw_frame();
    panels_.end_typing();
    draw_frame();
}

bool PlaygroundWindow::run_shortcut(int key, int modifiers) {
    const std::optional<Action> action = action_of(key, modifiers);
    if (!action) return false;
    // A question waits; an offer does so for the next window, too.
    if (leaving_ || overwriting_ || (offer_ && *action != Action::quit)) return true;
    // What a person types into a field, and undoes there, is not meant for the window. Panels that
    // have the keyboard want none of the function keys.
    const bool moves_on = *action == Action::next_panel || *action == Action::panel_before;
    const bool is_function =
        moves_on || (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F25 && !panels_.takes_text());
    const bool plain = (modifiers == 0 || modifiers == GLFW_MOD_SHIFT) && !is_function;
    const bool undoes = *action == Action::undo || *action == Action::redo;
    if ((plain && (panels_.takes_keyboard() || settings_.keys)) || (undoes && panels_.takes_text()))
        return false;
    if (panels_.is_typing()) end_typing();
    act(*action);
    return true;
}

// Esc: what stands over the scene, or else the full screen.
void PlaygroundWindow::close_one() {
    ProbeView& probe = settings_.probe;
    if (settings_.source && (probe.value || probe.cost || probe.pinned)) {
        if (!probe.value && !probe.cost) probe.pinned.reset();
        probe.value.reset();
        probe.cost = false;
        return;
    }
    const bool any = (settings_.visible && (settings_.help || settings_.browser)) ||
                     settings_.shown != Shown::scene;
    if (!any) {
        window_.set_full_screen(false);
        return;
    }
    settings_.help = settings_.browser = false;
    settings_.shown = Shown::scene;
}

void PlaygroundWindow::toggle_free_aspect() {
    const std::optional<glm::ivec2> frame = frame_size();
    if (!frame) return notice("No size is given that the picture could keep to; it is free.");
    settings_.free_aspect = !settings_.free_aspect;
    notice(settings_.free_aspect
               ? "Free aspect: the picture fills the window, and is saved so."
               : fmt::format("The picture keeps to {} \u00d7 {}.", frame->x, frame->y));
}

void PlaygroundWindow::flip(Action action) {
    using Flipped = std::pair<Action, bool PanelSettings::*>;
    static constexpr Flipped kFlipped[] = {
        {Action::mute, &PanelSettings::muted},          {Action::tweaks, &PanelSettings::tweaks},
        {Action::passes, &PanelSettings::passes},       {Action::browser, &PanelSettings::browser},
        {Action::transport, &PanelSettings::transport}, {Action::study, &PanelSettings::study},
        {Action::check, &PanelSettings::check},         {Action::source, &PanelSettings::source},
        {Action::help, &PanelSettings::help},
    };
    bool& setting = settings_.*std::ranges::find(kFlipped, action, &Flipped::first)->second;
    setting = !setting;
}

void PlaygroundWindow::play_or_pause() {
    const bool plays = playground_.transport().playing();
    playground_.apply(plays ? TimeEdit::What::pause : TimeEdit::What::play);
}

void PlaygroundWindow::hide_panels() {
    settings_.visible = !settings_.visible;
    notice(settings_.visible ? "" : "Panels are hidden; Tab shows them again");
}

void PlaygroundWindow::undo(bool (TweakValues::*step)()) {
    if ((playground_.tweaks.*step)()) playground_.tweaks_changed();
}

void PlaygroundWindow::act(Action action) {
    switch (action) {
        case Action::play_pause:
            return play_or_pause();
        case Action::step:
            return playground_.apply(TimeEdit::What::step);
        case Action::reset:
            return playground_.apply(TimeEdit::What::reset);
        case Action::mute:
        case Action::tweaks:
        case Action::passes:
        case Action::browser:
        case Action::transport:
        case Action::study:
        case Action::check:
        case Action::source:
        case Action::help:
            return flip(action);
        case Action::hide_panels:
            return hide_panels();
        case Action::close_panels:
            return close_one();
        case Action::search:
            settings_.visible = settings_.tweaks = settings_.keys = settings_.search = true;
            return;
        case Action::next_panel:
        case Action::panel_before:
            settings_.visible = settings_.keys = true;
            settings_.next_panel = action == Action::next_panel ? 1 : -1;
            return;
        case Action::undo:
            return undo(&TweakValues::undo);
        case Action::redo:
            return undo(&TweakValues::redo);
        case Action::randomise:
            playground_.tweaks.randomise(++random_seed_);
            return playground_.tweaks_changed();
        case Action::save:
            return save_or_ask();
        case Action::save_as:
            settings_.save_as = true;
            return;
        case Action::revert:
            return revert_or_say();
        case Action::still:
            return take_still();
        case Action::record:
            return toggle_recording();
        case Action::edit:
            return edit_first();
        case Action::full_screen:
            return toggle_full_screen();
        case Action::free_aspect:
            return toggle_free_aspect();
        case Action::quit:
            return leave({Leaving::For::quit, {}});
    }
}

std::string PlaygroundWindow::why_nothing_is_open() const {
    return awaits_first_frame() ? "It is still being compiled." : "Nothing is open.";
}

std::string PlaygroundWindow::why_no_save() const {
    if (!playground_.is_open()) return why_nothing_is_open();
    if (!is_preset(file_) || is_gone()) return "";
    if (!values_known_ || playground_.shows_older_text())
        return "It is not saved while it, or its scene, has errors.";
    const bool same_size = preset_to_save().size == playground_.as_written()->size;
    return differs_from_file() || !same_size ? "" : "Nothing has changed since it was saved.";
}

std::string PlaygroundWindow::why_no_revert() const {
    if (!playground_.is_open()) return why_nothing_is_open();
    if (!values_known_) return "The file has errors.";
    return differs_from_file() ? "" : "Nothing has changed since it was saved.";
}

void PlaygroundWindow::toggle_full_screen() {
    if (!window_.set_full_screen(!window_.is_full_screen()))
        notice("GLFW before 3.4 has no full screen under Wayland; the desktop's own key has.");
}

// A scene alone has no place for values: they go to a preset, whose name is asked for.
void PlaygroundWindow::save_or_ask() {
    const std::string why_not = why_no_save();
    if (!why_not.empty()) return notice(why_not);
    if (is_preset(file_))
        save(file_);
    else
        settings_.save_as = true;
}

void PlaygroundWindow::revert_or_say() {
    const std::string why_not = why_no_revert();
    if (!why_not.empty()) return notice(why_not);
    leave({Leaving::For::revert, {}});
}

// Where something is wrong, or else the scene itself.
void PlaygroundWindow::edit_first() {
    const Diagnostics& diagnostics = playground_.diagnostics();
    auto first = std::ranges::find(diagnostics, Severity::error, &Diagnostic::severity);
    if (first == diagnostics.end()) first = diagnostics.begin();
    edit(first == diagnostics.end() ? Diagnostic{} : *first);
}

}  // namespace glint
