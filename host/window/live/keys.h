// The keyboard: which JavaScript code a key of the window has, as scenes count keys.
#pragma once

namespace glint {

// The JavaScript key code (KeyboardEvent.keyCode, 0 to 255) of a GLFW key, or -1 for keys that the
// site does not know.
int key_code_of(int glfw_key);

}  // namespace glint
