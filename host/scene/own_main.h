// Texts whose picture is drawn by a main() of their own: GLSL ES 1.00 of the web, which writes
// gl_FragColor, and GLSL ES 3.00 or desktop GLSL, which declares `out vec4 colour;`.
#pragma once

#include "glsl/reading.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

// Whether main() draws the picture. One that writes a colour does where there is a mainImage, too,
// which it then calls, or not.
bool has_own_main(const Reading& reading);

// `in vec4 gl_FragCoord;`, which desktop GLSL lets a text declare again.
bool is_of_gl(const Reading& reading, const Declaration& declaration);

// GLSL ES 1.00, in which names are free that later versions have taken.
bool is_of_older_glsl(const Reading& reading);

// `out vec4 colour;`, or of type vec3: the first at location 0, or at none that is named. Null
// where the text has none.
const Declaration* colour_output(const Reading& reading);

// `vUv`, `v_texcoord`: a vector of this name is a place in the picture, from (0, 0) to (1, 1),
// which a vertex shader gives elsewhere.
bool is_coordinate_name(std::string_view name);

// How often a word stands in the text.
std::ptrdiff_t times_named(const Reading& reading, std::string_view word);

// `varying …`, `in …`, outside of all functions.
bool is_input(const Reading& reading, const Declaration& declaration);

// The tokens of those of its names that are places in the picture. Nothing of what is no input, is
// a block, or has a name that is read and that nothing feeds.
std::optional<std::vector<std::uint32_t>> fed_input(const Reading& reading,
                                                    const Declaration& declaration);

// What is wrong with a text that draws no picture, and where, in bytes; of all of it where that is
// not told.
struct NoPicture {
    std::optional<std::size_t> at;
    std::string text;
};
// Whether a main() draws a pass, and what is wrong with it. `all`: the text as read for all passes,
// of which each may have a part of its own.
struct OwnMain {
    bool draws = false;
    std::optional<NoPicture> wrong{};
};
OwnMain own_main_for(const Reading& all, std::span<const std::string> outputs);
// Of a text in which no function draws.
NoPicture why_no_picture(const Reading& reading);

}  // namespace glint
