// Times of several rows, taken in rounds: in each one a frame of every row, in an order drawn at
// random, so that a load that comes and goes meets all rows alike.
#pragma once

#include "measure/rows/study.h"

#include <functional>
#include <span>
#include <vector>

namespace glint {

struct RoundsOptions {
    int least = 15;         // rounds
    double seconds = 30.0;  // on the wall, after which no look is waited for
    bool on_software = false;
    std::size_t anchor = 0;  // a row that takes part in all rounds
};

struct Rounds {
    std::vector<FrameTimes> rows;
    std::vector<double> all_passes;  // ms, by row: of a frame that draws every pass
    int look = 0;                    // as in TimeVerdicts, of the last one
};

// After the least rounds, and whenever there are twice as many, verdicts are looked at; rows that
// are told from all others, or known to be alike, take part no more, but for the anchor. There are
// 4096 rounds at most, or the least. `draw` draws and times one frame of a row. `told`, when there
// is one, hears of each look.
struct FrameTime {
    double wall = 0.0, gpu = 0.0, processor = 0.0;  // ms
};
Rounds time_rounds(std::size_t rows, const std::function<FrameTime(std::size_t)>& draw,
                   const RoundsOptions& options,
                   const std::function<void(const Rounds&)>& told = {});

// Which clock tells best. Timer queries of a renderer `on_software` lie.
Clock best_clock(std::span<const FrameTimes> rows, bool on_software);

const std::vector<double>& times_by(Clock clock, const FrameTimes& row);

}  // namespace glint
