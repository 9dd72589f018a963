// `glint check`: scenes and presets at every extreme that a person or a long night can bring them
// to.
#pragma once

#include "modes/common.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace glint {

// How hard a check tries. Where a person has not said how many, a group of cases also ends when its
// seconds are over.
struct Effort {
    std::optional<int> frames, random;
    int inject = 3;  // texels that are poisoned at once; 0: no such cases
    static constexpr int kFrames = 2000, kRandom = 64;
    static constexpr double kGroupSeconds = 25.0;
};

struct CheckOptions {
    std::vector<std::filesystem::path> files;
    ViewOptions view;  // but for its file; its size is the one that cases are drawn at
    Effort effort;
    std::filesystem::path output = "glint-check";  // a folder, for pictures of failures
    std::string only;                              // cases whose name begins so; empty: all
    double hang_seconds = 60.0;                    // how long one frame may take
};

// Throws Stop with exit code 6 when a case fails, after all files have been checked, or with the
// code of the first file that could not be checked.
void run_check(const CheckOptions& options);

}  // namespace glint
