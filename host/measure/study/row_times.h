// The times of a study's rows, out of the rounds that they were in.
#pragma once

#include "measure/rows/study.h"

namespace glint {

// Each row by each clock, and by the best; there beside each other, whatever rounds a row was in.
// Timer queries of a renderer `on_software` lie.
void take_times(Study& study, bool on_software);

}  // namespace glint
