// What a budget has chosen, as a quality of a preset.
#pragma once

#include "measure/rows/study.h"
#include "measure/study/options.h"

#include <vector>

namespace glint {

// Before minutes of work: whether what a budget finds can be written to the file `output`. Throws
// UsageError, or Stop with what is wrong with the file told.
void require_preset_output(const StudyOptions& options);

// It becomes a quality of the preset in that file, which keeps what else it has; where there is
// none, of the studied one. Throws Stop where nothing was chosen.
void write_best(const StudyOptions& options, const std::vector<Study>& studies);

}  // namespace glint
