// Two looks beside each other: `glint study A B`.
#pragma once

#include "measure/study/options.h"

namespace glint {

// Whether a call compares two files instead of studying the knobs of each. Throws UsageError for
// pictures that are not two looks.
bool compares_looks(const StudyOptions& options);

// Two presets, scenes or pictures: how far they differ, where most, and which is faster. Throws
// what main() turns into exit codes.
void run_looks(const StudyOptions& options);

}  // namespace glint
