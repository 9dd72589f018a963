#include "measure/study/pair.h"

#include "base/median.h"

#include <algorithm>
#include <array>

namespace glint {
namespace {

Timing timing_of(const std::vector<double>& times) {
    const auto [least, most] = std::ranges::minmax(times);
    const Interval interval = median_interval(times);
    return {.median = median_of(times),
            .min = least,
            .max = most,
            .low = interval.low,
            .high = interval.high};
}

}  // namespace

TimedPair judged_pair(const FrameTimes& a, const FrameTimes& b, int look, bool on_software) {
    const std::array<FrameTimes, 2> rows = {a, b};
    TimedPair result{.clock = best_clock(rows, on_software)};
    const std::array<std::vector<double>, 2> times = {times_by(result.clock, a),
                                                      times_by(result.clock, b)};
    if (times[0].empty() || times[1].empty()) return result;
    result.a = timing_of(times[0]);
    result.b = timing_of(times[1]);
    result.verdict = TimeVerdicts(times, look).of(1, 0);
    // Of each round by itself: a load that comes and goes meets both.
    std::vector<double> ratios;
    for (std::size_t i = 0; i < std::min(times[0].size(), times[1].size()); ++i)
        if (times[0][i] > 0.0) ratios.push_back(times[1][i] / times[0][i]);
    result.ratio = median_of(ratios);
    result.between = median_interval(ratios);
    return result;
}

TimedPair time_pair(MeasuredScene& a, MeasuredScene& b, const RoundsOptions& options,
                    const std::function<void()>& after_frame) {
    const auto draw = [&](std::size_t row) {
        const FrameTime time = (row == 0 ? a : b).time_frame();
        if (after_frame) after_frame();
        return time;
    };
    for (int i = 0; i < 3; ++i)  // the driver compiles to machine code at the first draw
        for (const std::size_t row : {0u, 1u}) draw(row);
    for (MeasuredScene* scene : {&a, &b}) scene->find_quick_place();
    const Rounds rounds = time_rounds(2, draw, options);
    return judged_pair(rounds.rows[0], rounds.rows[1], rounds.look, options.on_software);
}

}  // namespace glint
