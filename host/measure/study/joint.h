// All quality tweaks of a scene together: which joint settings are the best within a budget.
#pragma once

#include "gl/context.h"
#include "measure/study/measure.h"
#include "measure/study/plan.h"

namespace glint {

// Whether the options name a budget.
bool has_budget(const StudyOptions& options);

// Searches over the values of these knobs, and gives what was found as the values of one: the
// settings near the budget that nothing beats, and the preset's own. What counts as the truth is
// the picture with all references at once. Throws UsageError for a budget that is none.
Knob joint_knob(const Preset& preset, const std::vector<Knob>& knobs, const StudyOptions& options,
                Context& context, const MeasureOptions& how);

// Which row the budget chooses, when all have been measured.
void choose_best(Study& study, const StudyOptions& options);

}  // namespace glint
