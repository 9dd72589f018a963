// `glint sequence`: many frames of a scene to numbered pictures, to a film, or to another program.
#pragma once

#include "offline/options.h"
#include "scene/preset.h"

namespace glint {

// Throws what main() turns into exit codes. Frame k is, bit for bit, the still of `--frame k`.
// Gives back what was drawn, at its last frame.
Preset run_sequence(const SequenceOptions& options);

}  // namespace glint
