// `glint bench --compile`: what the driver takes to compile each pass, with its cache empty and
// full.
#pragma once

#include "measure/options.h"

namespace glint {

// Starts itself as a process for each measurement, for drivers cache in memory, too.
void run_compile_bench(const BenchOptions& options);

// One such process: its driver's cache is options.compile_cache. One JSON object on stdout.
void run_compile_once(const BenchOptions& options);

}  // namespace glint
