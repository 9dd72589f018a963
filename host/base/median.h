// The middle of what was measured, where a few values are far off.
#pragma once

#include <vector>

namespace glint {

// The mean of the two in the middle where their number is even; 0 of none.
double median_of(std::vector<double> values);

}  // namespace glint
