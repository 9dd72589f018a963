// The control of one tweak, by its type: slider, drag field, pad, colour, checkbox, menu.
#pragma once

#include "window/ui/interface.h"

namespace glint {

// Draws the control at the cursor into this width of screen units.
void tweak_control(Build& build, TweaksState& state, std::size_t index, float width);

}  // namespace glint
