// What the eye sees from frame to frame.
#pragma once

#include "measure/check/case.h"

#include <string>

namespace glint {

// Share of the picture that flashes more than three times a second from this time on, s, of a
// simulation from its start, with the subject as it is; nothing where a frame was not finite.
std::optional<double> flashing_area(Check& check, double time);

// Why that is too much; "" where it is not.
std::string too_many_flashes(double area);

}  // namespace glint
