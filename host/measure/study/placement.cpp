#include "measure/study/placement.h"

#include "base/median.h"
#include "base/stopwatch.h"

#include <cmath>
#include <vector>

namespace glint {
namespace {

constexpr int kLeast = 2;              // compiled again, for slow places may be alike
constexpr int kMostPlaces = 5;         // more, where a machine wavers, would tell no more
constexpr double kMostSeconds = 10.0;  // a text may take a minute to compile
constexpr int kTurns = 3;              // frames of each of two places
constexpr double kSamePace = 0.02;     // less than a slow place takes more

// What a frame of the one that draws takes of one of the other's. It draws again afterwards.
double share_of_other(const Placement& placement) {
    placement.frame_ms();  // the driver compiles to machine code at the first draw
    std::vector<double> ratios;
    for (int i = 0; i < kTurns; ++i) {
        const double own = placement.frame_ms();
        placement.swap();
        ratios.push_back(own / placement.frame_ms());
        placement.swap();
    }
    return median_of(ratios);
}

}  // namespace

int find_quick_place(const Placement& placement) {
    const Stopwatch clock;
    int tried = 0;
    const auto is_enough = [&](bool has_its_like) {
        return tried == kMostPlaces - 1 || (has_its_like && tried >= kLeast) ||
               clock.seconds() > kMostSeconds;
    };
    for (bool has_its_like = false; !is_enough(has_its_like); ++tried) {
        placement.compile_again();
        const double off = std::log(share_of_other(placement));
        if (off < -kSamePace) has_its_like = false;
        if (std::abs(off) <= kSamePace) has_its_like = true;
        if (off > 0.0) placement.swap();
    }
    return tried;
}

}  // namespace glint
