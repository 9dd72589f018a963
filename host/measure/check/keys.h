// Which keys are worth pressing.
#pragma once

#include <string_view>
#include <vector>

namespace glint {

// All of them: arrows, space, letters and digits first, then the others.
std::vector<int> keys_in_order();

// Arrows, Space, Enter, Esc, Shift, Ctrl, letters and digits.
bool is_usual_key(int key);

// Numbers of a text that may be keys, in the order of the text.
std::vector<int> keys_named(std::string_view text);

}  // namespace glint
