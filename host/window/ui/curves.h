// What buffers promise, over the frames of a case of the check.
#pragma once

#include "measure/rows/curve.h"
#include "window/ui/theme.h"

namespace glint {

// Draws a diagram for each promise, one below the other, as wide as there is room at ImGui's
// cursor; the bounds stand in it as lines. The tip tells frame and values under the mouse.
void invariant_curve(const Theme& theme, const InvariantCurve& curve);

}  // namespace glint
