// `glint still`: one frame of a scene to a picture file.
#pragma once

#include "offline/common.h"

namespace glint {

// What the file of a picture whose name nobody gave says of itself.
constexpr const char* kUnasked = "glint:unasked";

// Gives back what was drawn. Throws what main() turns into exit codes.
Preset run_still(const StillOptions& options, const Stopwatch& since_start);

}  // namespace glint
