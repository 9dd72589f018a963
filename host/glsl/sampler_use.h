// What kind of texture a text takes a sampler for.
#pragma once

#include "glsl/reading.h"

#include <string_view>

namespace glint {

// "samplerCube" or "sampler3D" where everything that is done with the sampler of this name says so,
// and "" otherwise: by parameters that it is handed to, and by how many components a place has, of
// which three are a direction but where whole texels are counted.
std::string_view sampler_used_as(const Reading& reading, std::string_view name);

}  // namespace glint
