// How the seconds of a check are shared out: which case may still begin, and how long a frame is
// waited for.
#pragma once

#include "measure/check/case.h"

#include <cstddef>

namespace glint {

// Who may still begin: no group of cases takes the seconds that later ones need.
class SharedSeconds {
public:
    explicit SharedSeconds(const Effort& effort) : effort_(effort) {}

    // Whether no time is left for this case, `ms` milliseconds after the first one began. To be
    // asked once for each case, in order.
    bool is_over(const Case& next, double ms);

private:
    Effort effort_;
    std::size_t group_ = static_cast<std::size_t>(-1);
    double group_end_ms_ = 0.0;
};

// How long the next frame is waited for: as long as a hang may take, but with a limit on all of it
// no longer than what is left of that, and 10 s even when nothing is.
double frame_wait_seconds(double hang_seconds, double all_seconds, double left_seconds);

}  // namespace glint
