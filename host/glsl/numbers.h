// Numbers of a text that may be fed from outside, so that another number needs no other program.
#pragma once

#include "glsl/edits.h"

#include <string_view>
#include <vector>

namespace glint {

// Puts elements of `array`, a uniform of vec4s, in the place of the numbers that stand in the
// bodies of these functions (by number, as Reading::reached_from tells), and adds their values,
// four to an element. These are floats, and whole numbers that a constructor of floats is given.
// What must be constant is left: the value of a `const`. So are 0 and 1, which compilers fold into
// what stands around them; as exponents of pow() whole numbers, whose base may be negative, and
// 0.5, which is a root; a divisor of 0; what stands within a macro that glsl/edits.h leaves alone.
// `constants`, of a text from which other functions are left out: global constants of literals
// alone, such as `const vec3 kSun = vec3(1.0, 0.9, 0.7);`, are fed where functions use them, and
// left out; not those that other constants are made of.
std::vector<float> feed_numbers(const Reading& reading, const std::vector<bool>& functions,
                                std::string_view array, bool constants, Edits& edits);

}  // namespace glint
