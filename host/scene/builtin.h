// The uniforms that the host declares itself, Shadertoy's and iTick.
#pragma once

#include <string_view>

namespace glint {

// A uniform that the host declares itself.
struct HostUniform {
    std::string_view type;   // "sampler" stands for every sampler type
    std::string_view array;  // the length, or ""
};

// The built-in of this name, or null.
const HostUniform* find_builtin(std::string_view name);

}  // namespace glint
