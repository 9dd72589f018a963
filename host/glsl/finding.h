// What a compiler takes, and a reader of the text would want to know.
#pragma once

#include "glsl/reading.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace glint {

// The functions of GLSL ES 3.00, chapter 8.
std::span<const std::string_view> built_in_functions();

// What only WebGL 2 minds.
inline constexpr std::string_view kWebGl = "webgl";

struct Finding {
    std::string_view name;             // "shadowed-name": by which a person silences it
    std::size_t at = 0;                // byte of the text
    std::string text;                  // what it is, and what to do
    std::optional<std::size_t> other;  // a second place, of which the text's end speaks
};

// What no driver may take, and Mesa does, in all of a text: values in the place of variables, and
// members of a structure that have one name.
std::vector<Finding> find_taken_by_mesa(const Reading& reading);

// Each of these looks into the functions alone for which `wanted`, by function, says so.

// Names that hide others: a local or a parameter what stands outside of it, or what the host
// declares, a function one of GLSL.
std::vector<Finding> find_shadowed_names(const Reading& reading, const std::vector<bool>& wanted,
                                         bool (*is_hosts)(std::string_view) = nullptr);

// Loops whose turns, with those of loops within them and of what they call, may come to more than
// llvmpipe lets a pixel have; and loops in which nothing can be read that ends them. `known` are
// numbers that names stand for besides the text's own constants.
std::vector<Finding> find_long_loops(const Reading& reading, const std::vector<bool>& wanted,
                                     const std::unordered_map<std::string_view, double>& known);

// Names that GLSL ES keeps for itself, and that browsers refuse where glslang and Mesa take them.
std::vector<Finding> find_reserved_names(const Reading& reading, const std::vector<bool>& wanted);

// What browsers refuse by rules of their own: `?:` for structures, arrays and void, and a mainImage
// whose colour is inout.
std::vector<Finding> find_refused_by_browsers(const Reading& reading,
                                              const std::vector<bool>& wanted);

}  // namespace glint
