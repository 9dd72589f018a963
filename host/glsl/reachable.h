// Leaving out of a text what one function does not need.
#pragma once

#include <string>
#include <string_view>

namespace glint {

// The text with the functions, constants, structs and globals alone that `entry` reaches, by name,
// and without uniforms. Preprocessor lines all stay; comments stay with what they stand before.
std::string reachable_text(std::string_view text, std::string_view entry);

}  // namespace glint
