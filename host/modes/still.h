// `glint still`: one frame of a scene to a picture file.
#pragma once

#include "modes/snapshot.h"

#include <optional>

namespace glint {

struct StillOptions {
    ViewOptions view;
    std::filesystem::path output;
    std::optional<double> time{};  // s; the preset's otherwise
    std::optional<int> frame{};    // instead of a time, at `fps`
    double fps = 60.0;             // the rate at which a stateful scene is simulated
    int samples = 1;               // sub-pixel positions averaged in linear light
    std::optional<int> settle{};   // frames drawn with time held; the preset's otherwise
    std::string pass = "image";
    StateOptions state{};
    int tile = 0;  // pixels; 0: draw the picture in one go
};

// Throws what main() turns into exit codes.
void run_still(const StillOptions& options, const Stopwatch& since_start);

}  // namespace glint
