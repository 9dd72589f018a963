// How long something takes.
#pragma once

#include <chrono>

namespace glint {

// Since it was made or restarted.
class Stopwatch {
public:
    double ms() const {
        return std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
    }
    double seconds() const { return ms() / 1000.0; }
    // Milliseconds so far.
    double restart() {
        const double elapsed = ms();
        start_ = Clock::now();
        return elapsed;
    }

private:
    using Clock = std::chrono::steady_clock;
    Clock::time_point start_ = Clock::now();
};

}  // namespace glint
