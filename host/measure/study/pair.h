// How long the frames of two looks take beside each other.
#pragma once

#include "measure/study/measure.h"
#include "measure/study/statistics.h"

namespace glint {

struct TimedPair {
    Timing a{}, b{};  // ms
    Clock clock = Clock::wall;
    TimeVerdict verdict = TimeVerdict::not_told_apart;  // of b, beside a
    // What b takes of a's time, by the median of all rounds, and where that lies in 95 of 100
    // cases.
    double ratio = 0.0;
    Interval between{};
};

// Frames of both in turns. `after_frame`, when there is one, is called after each.
TimedPair time_pair(MeasuredScene& a, MeasuredScene& b, const RoundsOptions& options,
                    const std::function<void()>& after_frame = {});

// The same of times that were taken.
TimedPair judged_pair(const FrameTimes& a, const FrameTimes& b, int look, bool on_software);

}  // namespace glint
