// `glint check`: scenes and presets at every extreme that a person or a long night can bring them
// to.
#pragma once

#include "measure/check/options.h"

namespace glint {

// Throws Stop with exit code 6 when a case fails, after all files have been checked, or with the
// code of the first file that could not be checked.
void run_check(const CheckOptions& options);

}  // namespace glint
