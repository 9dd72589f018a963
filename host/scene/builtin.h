// The uniforms that the host declares itself, Shadertoy's and iTick.
#pragma once

#include <string_view>
#include <vector>

namespace glint {

// A uniform that the host declares itself.
struct HostUniform {
    std::string_view type;   // "sampler" stands for every sampler type
    std::string_view array;  // the length, or ""
};

// What other programs feed and this one too, where the text declares it: the Book of Shaders, GLSL
// Sandbox, twigl, three.js, and the site in its first years.
struct ForeignName {
    std::string_view type, name;
    std::string_view words;  // what it is here: "iMouse.xy / iResolution.xy"
};
// Null for any other.
const ForeignName* find_foreign_name(std::string_view type, std::string_view name);

// The built-in of this name, or null.
const HostUniform* find_builtin(std::string_view name);

// Of all of these, and of those of other programs.
std::vector<std::string_view> builtin_names();

}  // namespace glint
