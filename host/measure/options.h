// What `bench` is asked for.
#pragma once

#include "offline/options.h"

#include <filesystem>

namespace glint {

struct BenchOptions {
    ViewOptions view;
    int frames = 60;
    bool compare = false;  // alternate specialised and uniform-fed frames and print the ratio
    bool compile = false;  // time the driver's compiler instead of frames
    std::filesystem::path compile_cache{};  // of one measurement's process; see compile_bench.h
    bool compile_together = false;          // in that process, as `still` does
};

}  // namespace glint
