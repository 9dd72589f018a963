// Where something stands that plays in a loop.
#pragma once

#include <algorithm>
#include <cmath>

namespace glint {

struct LoopPlace {
    double rounds = 0.0;  // whole ones that are over
    double into = 0.0;    // s, from 0 up to its length
};

// `time` and `length` in s. The tolerance forgives times such as 0.3 s, a rounding below three
// rounds of 0.1 s.
inline LoopPlace place_in_loop(double time, double length) {
    const double rounds = std::floor(time / length + 1e-9);
    return {rounds, std::max(time - rounds * length, 0.0)};
}

}  // namespace glint
