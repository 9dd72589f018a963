// Whether another seed tells how far a reference is from the truth.
#pragma once

#include "measure/rows/study.h"
#include "measure/study/plan.h"

namespace glint {

// Of pictures that were drawn with one seed those of less work are no nearer to each other than
// chance lets them be. Where one is nearer to the reference by far than another seed's picture is,
// the seed moves what this knob has no part in, such as the grain of a film.
bool seed_moves_something_else(const Study& study, const Knob& knob);

// Measures references by twice the work instead, and notes it.
void measure_by_work(Knob& knob);

}  // namespace glint
