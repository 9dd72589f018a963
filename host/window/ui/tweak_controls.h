// The control of one tweak, by its type: slider, drag field, pad, colour, checkbox, menu.
#pragma once

#include "window/ui/interface.h"

namespace glint {

// Draws the control of the open scene's tweak `index` at the cursor, into this width of screen
// units; at least 1. What a person does to it becomes a wish; a value that is no number is shown
// as 0, and kept until then.
void tweak_control(Build& build, TweaksState& state, std::size_t index, float width);

}  // namespace glint
