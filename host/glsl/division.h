// Divisions that a driver gets wrong.
#pragma once

#include "glsl/edits.h"

#include <string_view>
#include <unordered_map>
#include <unordered_set>

namespace glint {

// Mesa 22.3 makes garbage of `w / 0.0` where the zero is a constant and `w` is not; browsers, and
// IEEE 754, make it infinite. `w * 1e39` says the same: the factor is beyond all floats.
// `zero_uniforms` are names of floats that are declared as uniforms and become constants of 0.
void mend_division_by_zero(const Reading& reading,
                           const std::unordered_set<std::string_view>& zero_uniforms, Edits& edits);

// For who watches divisors: the driver learns nothing of those that have names, and they stay.
void hide_named_zeros(const Reading& reading,
                      const std::unordered_set<std::string_view>& zero_uniforms, Edits& edits);

// For whoever writes other constants of uniforms into one text: what the mending would change where
// one is 0 becomes names, `glint_over3` for `/`, `glint_by3` for `/=`, `glint_divisor3` for the
// uniform, whose number is 3 here.
void name_divisions(const Reading& reading,
                    const std::unordered_map<std::string_view, std::size_t>& uniforms,
                    Edits& edits);

}  // namespace glint
