// `glint bench`: what a frame costs, pass by pass.
#pragma once

#include "measure/options.h"

namespace glint {

// Draws that many frames, times each, and prints a table or JSON. Throws what main() turns into
// exit codes.
void run_bench(const BenchOptions& options);

}  // namespace glint
