// `glint bench`: what a frame costs, pass by pass.
#pragma once

#include "measure/options.h"

namespace glint {

void run_bench(const BenchOptions& options);

}  // namespace glint
