// One picture of a study, and the time that its frames take.
#pragma once

#include "gl/context.h"
#include "measure/rows/study.h"
#include "measure/study/plan.h"
#include "scene/passes.h"

#include <string>
#include <vector>

namespace glint {

struct Measured {
    std::vector<float> picture;         // RGBA of what is compared, rows bottom up
    Timing wall{}, gpu{}, processor{};  // by each clock; 0 where only the picture was wanted
    double all_passes_ms = 0.0;         // of a frame that draws every pass; on the wall
};

struct MeasureOptions {
    std::size_t pass = kImagePass;  // what is compared
    std::size_t output = 0;         // which of its outputs
    bool specialise = true;         // tweaks written in as constants
    int frames = 0;                 // timed ones, after three that are not; 0: the picture alone
};

// Compiles the scene with this setting, plays it to the preset's time and draws. With settle, the
// time is that of all its frames together. `context` is current. Throws what a still throws.
Measured measure(const Preset& preset, const Setting& setting, Context& context,
                 const MeasureOptions& options);

// "Xeon …, 2 threads": the processor, and how many of its threads there are.
std::string machine_name();

}  // namespace glint
