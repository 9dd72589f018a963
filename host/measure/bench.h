// `glint bench`: what a frame costs, pass by pass.
#pragma once

#include "offline/common.h"

namespace glint {

struct BenchOptions {
    ViewOptions view;
    int frames = 60;
    bool compare = false;  // alternate specialised and uniform-fed frames and print the ratio
};

void run_bench(const BenchOptions& options);

}  // namespace glint
