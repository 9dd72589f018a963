// `glint bench`: what a frame costs, pass by pass.
#pragma once

#include "offline/common.h"

namespace glint {

struct BenchOptions {
    ViewOptions view;
    int frames = 60;
    bool compare = false;  // alternate specialised and uniform-fed frames and print the ratio
    bool compile = false;  // time the driver's compiler instead of frames
    std::filesystem::path compile_cache{};  // of one measurement's process; see compile_bench.h
};

void run_bench(const BenchOptions& options);

}  // namespace glint
