// Divisions that a driver gets wrong.
#pragma once

#include "glsl/edits.h"

namespace glint {

// Mesa 22.3 makes garbage of `w / 0.0` where the zero is a literal and `w` is not; browsers, and
// IEEE 754, make it infinite. `w * 1e39` says the same: the factor is beyond all floats.
void mend_division_by_zero(const Reading& reading, Edits& edits);

}  // namespace glint
