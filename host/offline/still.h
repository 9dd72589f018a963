// `glint still`: one frame of a scene to a picture file.
#pragma once

#include "offline/picture.h"

#include <optional>

namespace glint {

struct StillOptions : PictureOptions {
    std::filesystem::path output;
    std::optional<double> time{};  // s; the preset's otherwise
    std::optional<int> frame{};    // instead of a time, at `fps`
    std::optional<int> settle{};   // frames drawn with time held; the preset's otherwise
    std::string pass = "image";
    int tile = 0;  // pixels: the longest side of the tiles in which to draw; 0: as suits the size
};

// Throws what main() turns into exit codes.
void run_still(const StillOptions& options, const Stopwatch& since_start);

}  // namespace glint
