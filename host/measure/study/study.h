// `glint study`: the error of a scene's pictures against the time that they take.
#pragma once

#include "measure/study/options.h"

namespace glint {

// With an output folder it can be stopped at any time; the same call goes on from what is done.
// Throws Stop with the code of the first file that could not be studied, after all others.
void run_study(const StudyOptions& options);

}  // namespace glint
