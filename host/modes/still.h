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
    double shutter = 0.0;          // degrees that it stays open, 360 a frame; over the samples
    FileFormat format{};
    std::optional<int> settle{};  // frames drawn with time held; the preset's otherwise
    std::string pass = "image";
    StateOptions state{};
    int tile = 0;  // pixels: the side of the parts in which to draw; 0: as suits the size
};

// Throws what main() turns into exit codes.
void run_still(const StillOptions& options, const Stopwatch& since_start);

}  // namespace glint
