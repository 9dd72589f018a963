// The program's keys: one table for the window, which obeys them, and for the help, which lists
// them.
//
// Plain letters, digits, arrows and space belong to the scene, whose keyboard texture reads them.
// The program keeps to Ctrl, function keys, Tab, Esc and "?".
#pragma once

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <array>
#include <optional>

namespace glint {

enum class Action {
    play_pause,
    step,
    reset,
    mute,
    tweaks,
    passes,
    browser,
    transport,
    study,
    check,
    source,
    hide_panels,
    close_panels,
    search,
    next_panel,
    panel_before,
    undo,
    redo,
    randomise,
    save,
    save_as,
    revert,
    still,
    record,
    edit,
    full_screen,
    free_aspect,
    help,
    quit,
};

struct Shortcut {
    Action action;
    int key;  // GLFW_KEY_…; letters as the keyboard's own layout names them
    int modifiers;
    const char* keys;     // "Ctrl+S"
    const char* meaning;  // "" for a second key of the action before
};

inline constexpr int kControl = GLFW_MOD_CONTROL, kControlShift = GLFW_MOD_CONTROL | GLFW_MOD_SHIFT;

inline constexpr std::array kShortcuts = {
    Shortcut{Action::play_pause, GLFW_KEY_SPACE, kControl, "Ctrl+Space", "play, pause"},
    Shortcut{Action::step, GLFW_KEY_PERIOD, kControl, "Ctrl+.", "one frame forward"},
    Shortcut{Action::reset, GLFW_KEY_R, kControl, "Ctrl+R", "time back to zero"},
    Shortcut{Action::mute, GLFW_KEY_M, kControl, "Ctrl+M", "sound off and on"},
    Shortcut{Action::tweaks, GLFW_KEY_T, kControl, "Ctrl+T", "tweaks"},
    Shortcut{Action::passes, GLFW_KEY_P, kControl, "Ctrl+P", "passes: look inside"},
    Shortcut{Action::browser, GLFW_KEY_O, kControl, "Ctrl+O", "browser: scenes and presets"},
    Shortcut{Action::transport, GLFW_KEY_B, kControl, "Ctrl+B", "transport bar"},
    Shortcut{Action::study, GLFW_KEY_D, kControl, "Ctrl+D", "study: error against time"},
    Shortcut{Action::check, GLFW_KEY_K, kControl, "Ctrl+K", "check: stability"},
    Shortcut{Action::source, GLFW_KEY_I, kControl, "Ctrl+I", "source: why is this pixel so?"},
    Shortcut{Action::hide_panels, GLFW_KEY_TAB, 0, "Tab", "hide or show all panels"},
    Shortcut{Action::close_panels, GLFW_KEY_ESCAPE, 0, "Esc",
             "keys back to the scene; close help, browser, full screen"},
    Shortcut{Action::search, GLFW_KEY_F, kControl, "Ctrl+F", "search the tweaks"},
    Shortcut{Action::next_panel, GLFW_KEY_F6, 0, "F6", "keys to the next panel"},
    Shortcut{Action::panel_before, GLFW_KEY_F6, GLFW_MOD_SHIFT, "Shift+F6",
             "keys to the panel before"},
    Shortcut{Action::undo, GLFW_KEY_Z, kControl, "Ctrl+Z", "undo"},
    Shortcut{Action::redo, GLFW_KEY_Z, kControlShift, "Ctrl+Shift+Z", "redo"},
    Shortcut{Action::redo, GLFW_KEY_Y, kControl, "Ctrl+Y", ""},
    Shortcut{Action::randomise, GLFW_KEY_G, kControl, "Ctrl+G",
             "random look; not camera, quality, locks"},
    Shortcut{Action::save, GLFW_KEY_S, kControl, "Ctrl+S", "save the preset"},
    Shortcut{Action::save_as, GLFW_KEY_S, kControlShift, "Ctrl+Shift+S", "save as a new preset"},
    Shortcut{Action::revert, GLFW_KEY_R, kControlShift, "Ctrl+Shift+R", "revert to the file"},
    Shortcut{Action::still, GLFW_KEY_F12, 0, "F12", "write a still"},
    Shortcut{Action::record, GLFW_KEY_F9, 0, "F9", "record mouse and keys"},
    Shortcut{Action::edit, GLFW_KEY_E, kControl, "Ctrl+E",
             "open $EDITOR at the first error, or the scene"},
    Shortcut{Action::full_screen, GLFW_KEY_F11, 0, "F11", "full screen"},
    Shortcut{Action::free_aspect, GLFW_KEY_F, kControlShift, "Ctrl+Shift+F",
             "free aspect: the picture fills the window"},
    Shortcut{Action::help, GLFW_KEY_F1, 0, "F1", "this list"},
    Shortcut{Action::help, GLFW_KEY_SLASH, GLFW_MOD_SHIFT, "?", ""},
    Shortcut{Action::quit, GLFW_KEY_Q, kControl, "Ctrl+Q", "quit"},
};

// What a key asks for; nothing if it is the scene's. Locks (caps, num) do not count.
std::optional<Action> action_of(int key, int modifiers);

// The keys of an action, for a tooltip: "Ctrl+S".
const char* keys_of(Action action);

}  // namespace glint
