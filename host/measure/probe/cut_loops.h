// Loops that the driver ends before they are done.
#pragma once

#include "measure/probe/options.h"
#include "scene/preset.h"

namespace glint {

// Warns where what was drawn of this frame is not what the text says, because llvmpipe has ended
// loops of it. Counts at few pixels, and only where the text has loops that may take so many turns;
// nothing of simulations, which another size changes.
void say_cut_loops(Preset preset, const ProbeOptions& options);

}  // namespace glint
