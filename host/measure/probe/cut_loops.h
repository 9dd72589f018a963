// Loops that the driver ends before they are done.
#pragma once

#include "measure/probe/options.h"
#include "scene/preset.h"

namespace glint {

// Warns where what was drawn of this frame is not what the text says, because llvmpipe has ended
// loops of it. Counts at few pixels, and only where the text has loops that may take so many turns;
// nothing of simulations, which another size changes.
void say_cut_loops(Preset preset, const ProbeOptions& options);

// The same of a scene's sound, if it has one, at its start. Makes a context of its own.
void say_cut_loops_of_sound(const Preset& preset, const ViewOptions& view);

}  // namespace glint
