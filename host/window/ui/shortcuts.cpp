#include "window/ui/shortcuts.h"

#include <algorithm>
#include <cstring>

namespace glint {
namespace {

// GLFW numbers keys by their place on an American keyboard; Ctrl+Z is the key that says Z.
int as_labelled(int key) {
    if (key < GLFW_KEY_A || key > GLFW_KEY_Z) return key;
    const char* name = glfwGetKeyName(key, 0);
    if (!name || std::strlen(name) != 1) return key;
    if (*name >= 'a' && *name <= 'z') return GLFW_KEY_A + (*name - 'a');
    return key;
}

}  // namespace

std::optional<Action> action_of(int key, int modifiers) {
    const int labelled = as_labelled(key);
    const int pressed = modifiers & ~(GLFW_MOD_CAPS_LOCK | GLFW_MOD_NUM_LOCK);
    const auto found = std::ranges::find_if(kShortcuts, [&](const Shortcut& shortcut) {
        return shortcut.key == labelled && shortcut.modifiers == pressed;
    });
    if (found == kShortcuts.end()) return std::nullopt;
    return found->action;
}

const char* keys_of(Action action) {
    const auto found = std::ranges::find(kShortcuts, action, &Shortcut::action);
    return found == kShortcuts.end() ? "" : found->keys;
}

}  // namespace glint
