// Numbers as the panels show them, and the values that a slider stops at.
#pragma once

#include "scene/scene.h"

#include <glm/vec2.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace glint {

// One component of a tweak's value with as many digits as its range deserves, without the unit.
std::string number_text(const Tweak& tweak, double value);

// A short number for tables: "0.1234", "1.23e-5", "nan", "inf".
std::string short_number(double value);

// Three digits and a power of ten where that is shorter: "0.25", "3.64·10⁻⁴", "10⁻³".
std::string power_text(double value);

// `pixel 150, 30 of 240 × 135 (401, 81 at full size)`.
std::string pixel_text(glm::ivec2 pixel, glm::ivec2 size, std::optional<glm::ivec2> at_full_size);

// Seconds from `90`, `1:30` or `1:00:30.5`; nothing where it is no time, or a negative one.
std::optional<double> parse_clock(std::string_view text);

// Whether the tweak has a range that a slider can span.
bool has_range(const Tweak& tweak);

// Where in its range a value lies, from 0 to 1, evenly in the logarithm for log tweaks; and back,
// rounded to the tweak's step or to digits that a person would have typed.
double fraction_of(const Tweak& tweak, double value);
double value_at(const Tweak& tweak, double fraction);

}  // namespace glint
