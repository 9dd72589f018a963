// What buffers promise, drawn over the frames of a case.
#pragma once

#include "measure/rows/curve.h"

#include <span>
#include <string>

namespace glint {

// An <svg> file: a diagram for each promise, the bounds dashed; "" without gnuplot or two points.
std::string svg_curves(std::span<const InvariantCurve> curves);

}  // namespace glint
