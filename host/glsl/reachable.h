// Leaving out of a text what one function does not need.
#pragma once

#include "glsl/edits.h"

#include <string_view>

namespace glint {

// The text with the functions, constants, structs and globals alone that `entry` reaches, by name,
// and without uniforms. Preprocessor lines stay, with the branches that are not compiled; but where
// a condition is about a name that begins with `decided`, the branch that is compiled stands in its
// place. Comments stay with what they stand before. Where the reader does not understand all of it,
// or brackets do not balance, only uniforms are left out.
EditedText reachable_text(const Reading& reading, std::string_view entry, std::string_view decided);

}  // namespace glint
