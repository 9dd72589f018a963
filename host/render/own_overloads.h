// Functions of a text's own by the names of some that GLSL has.
#pragma once

#include "glsl/edits.h"

#include <string>
#include <vector>

namespace glint {

// Of each parameter: `vec3`, `float[]`.
using Types = std::vector<std::string>;
Types types_of(const Reading& reading, const Function& function);

// Chromium lets a text define `mix`, `texture`, `textureLod`, `texelFetch` and `textureSize` for
// types of its own choice, and GLSL ES 1.00 and desktop GLSL nearly all, as `int mod(int a, int
// b)`; Mesa refuses any function of these names, as GLSL ES 3.00 says. What stands before the text
// then makes functions of another name of the known ones, and a macro gives that name to the text's
// own as well. Empty where the text defines none.
std::string own_overloads(const Reading& reading);

// The same by changing the text, for those names that in some places must stay GLSL's, such as in
// the values of constants. They have no macros.
void rename_overloads(const Reading& reading, Edits& edits);

}  // namespace glint
