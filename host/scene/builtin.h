// The uniforms that the host declares itself, Shadertoy's and iTick.
#pragma once

#include <string_view>

namespace glint {

// A uniform that the host declares itself.
struct HostUniform {
    std::string_view type;   // "sampler" stands for every sampler type
    std::string_view array;  // the length, or ""
};

// Whether it is one that other programs feed and this one too, where the text declares it: u_time,
// u_resolution and u_mouse of the Book of Shaders, time, resolution and mouse of GLSL Sandbox.
bool is_old_name(std::string_view type, std::string_view name);

// The built-in of this name, or null.
const HostUniform* find_builtin(std::string_view name);

}  // namespace glint
