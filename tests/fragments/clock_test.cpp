// The clock that scenes are fed by, against the sum of what it was told.
//
// Q2: at most 10 ms off. (tests/scene/transport_test.cpp asks it of every frame of a month at 60
// Hz.)
#include "scene/transport.h"
#include "worst_case.h"

namespace glint::clock_test {
namespace {

// Two days at any rate, the frames as uneven as those of a machine that is busy.
TEST(Clock, FollowsTheWallClockWhateverTheCase) {
    Bar off("Q2 clock: off after two days, ms", 10.0);
    search_worst(3, 40, {&off}, [&](Dials& dials) {
        const double hz = dials.between_logs(24.0, 240.0), uneven = dials.share();
        const double start = dials.between_logs(1e-3, 3e7);
        Transport transport(start);
        transport.advance(0.0);
        const double begun = transport.time();
        long double wall = 0.0L;
        std::uint32_t bits = dials.number;
        while (wall < 2.0L * 86400.0L) {
            bits = bits * 1664525u + 1013904223u;
            const double seconds = (1.0 + uneven * (bits / 4294967296.0 - 0.5)) / hz;
            transport.advance(seconds);
            wall += seconds;
        }
        const long double moved = static_cast<long double>(transport.time()) - begun;
        off.see(static_cast<double>(1e3L * std::abs(moved - wall)),
                fmt::format("{:.5g} Hz, uneven by {:.3g}, from {:.6g} s", hz, uneven, start));
    });
}

}  // namespace
}  // namespace glint::clock_test
