// Zeros that divide, hidden from the driver's compiler.
#pragma once

#include "glsl/edits.h"
#include "glsl/zeros.h"

#include <string_view>
#include <unordered_set>
#include <vector>

namespace glint {

// A float that the compiler cannot know to be 0; with `_i` behind it, an int.
inline constexpr std::string_view kHiddenZero = "glint_zero";

// Mesa 22.3 makes garbage of `w / z` where it finds out that z is 0 and does not know w, so in the
// first turn of a loop that it unrolls; browsers make it infinite. Where a variable divides, and is
// given a written zero, a constant of zero or ours (of `unset`, glsl/zeros.h), kHiddenZero is
// added: `z = 0.0` becomes `z = 0.0 + glint_zero`, and so does an argument. What a divisor adds to
// is no zero for long: `w / (z + 1.0)` is left alone.
//
// So is what is made of a uniform that becomes a constant with a 0 in it, one of `zero_uniforms`,
// or of a constant of the text that is 0, and divides: `w / (softness * 0.1)` becomes `w /
// ((softness+glint_zero) * 0.1)`, and so do values of variables and arguments that divide, and of
// what these are made of.
//
// Not constants that divide by themselves: mend_division_by_zero() sees to them.
void hide_zeros(const Reading& reading, const std::vector<Unset>& unset,
                const std::unordered_set<std::string_view>& zero_uniforms, Edits& edits);

}  // namespace glint
