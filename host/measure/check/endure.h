// Simulations over many frames, as they stand: whether they run away.
#pragma once

#include "measure/check/case.h"
#include "measure/check/drift.h"

#include <string>

namespace glint {

// The largest value that is fed back with the preset's own values, over some hundred frames; worked
// out once. Leaves the subject as it was opened, its state as at the start.
float usual_largest(Check& check);

// Plays some hundred frames of the subject as it is; why that is wrong: its state grows steadily,
// explodes beside `usual`, or breaks a promise. "" where nothing is, or where something is not
// finite, which the subject has then seen.
std::string why_not_for_long(Check& check, float usual);

// After what these curves show, which neither grew nor exploded: whether the step is unstable all
// the same, and what hides it; "" for no. `usual`: as above. The subject stands somewhere else
// afterwards.
std::string what_hides(const Check& check, const StateCurves& curves, float usual);

}  // namespace glint
