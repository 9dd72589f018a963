// Numbers of a text that may be fed from outside, so that another number needs no other program.
#pragma once

#include "glsl/edits.h"

#include <string_view>
#include <unordered_set>
#include <vector>

namespace glint {

// Puts elements of `array`, a uniform of vec4s, in the place of the floats that stand in the bodies
// of these functions (by number, as Reading::reached_from tells), and adds their values, four to an
// element. What must be constant is left: the value of a `const`. So are 0 and 1, which compilers
// fold into what stands around them; the exponents of pow(), whose base may be negative where they
// are whole numbers; a divisor of 0; what stands within a macro that glsl/edits.h leaves alone.
std::vector<float> feed_numbers(const Reading& reading, const std::vector<bool>& functions,
                                std::string_view array, Edits& edits);

}  // namespace glint
