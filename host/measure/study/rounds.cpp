#include "measure/study/rounds.h"

#include "base/median.h"
#include "measure/study/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace glint {
namespace {

constexpr double kTimerAgreement = 0.2;  // of the wall, by which a timer query may be off
constexpr double kBusy = 1.25;           // by which rows may differ in how many processors worked
constexpr double kShared = 2.0;          // ms; a shorter frame is mostly one processor's work
constexpr double kCalm = 0.03;  // of a median, about which the wall of a free machine wavers
// By then some thousandths are told. Small frames would have a hundred thousand rounds in their
// seconds, and the statistics of so many would take minutes.
constexpr int kMostRounds = 4096;

void shuffle(std::vector<std::size_t>& order, std::mt19937_64& random) {
    for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random() % i]);
}

bool timers_agree(std::span<const FrameTimes> rows) {
    return std::ranges::all_of(rows, [](const FrameTimes& row) {
        const double wall = median_of(row.wall);
        return std::abs(median_of(row.gpu) - wall) <= kTimerAgreement * wall;
    });
}

// How far a row's times lie from their median, as a share of it.
double spread(const std::vector<double>& times) {
    const double median = median_of(times);
    std::vector<double> off;
    for (const double time : times) off.push_back(std::abs(time - median));
    return median > 0.0 ? median_of(off) / median : 0.0;
}

// How many processors worked at once, as far as that differs from row to row: where it does, others
// took them away, and the wall tells of them. So it does where it wavers, and the processor does
// not.
bool machine_is_busy(std::span<const FrameTimes> rows) {
    double least = 1e9, most = 0.0;
    std::vector<double> wall, processor;
    for (const FrameTimes& row : rows) {
        const double ms = median_of(row.wall);
        if (ms < kShared) continue;
        const double ratio = median_of(row.processor) / ms;
        least = std::min(least, ratio);
        most = std::max(most, ratio);
        wall.push_back(spread(row.wall));
        processor.push_back(spread(row.processor));
    }
    const double wavers = median_of(wall);
    return most > kBusy * least || (wavers > kCalm && wavers > 2.0 * median_of(processor));
}

void add(FrameTimes& row, const FrameTime& frame) {
    row.wall.push_back(frame.wall);
    row.gpu.push_back(frame.gpu);
    row.processor.push_back(frame.processor);
}

// Looks at the verdicts; the rows that need more rounds.
std::vector<std::size_t> open_rows(const Rounds& rounds, bool on_software) {
    const Clock clock = best_clock(rounds.rows, on_software);
    std::vector<std::vector<double>> times;
    for (const FrameTimes& row : rounds.rows) times.push_back(times_by(clock, row));
    const TimeVerdicts verdicts(times, rounds.look, kEnough);
    std::vector<std::size_t> open;
    for (std::size_t i = 0; i < times.size(); ++i)
        if (verdicts.is_open(i)) open.push_back(i);
    return open;
}

}  // namespace

Clock best_clock(std::span<const FrameTimes> rows, bool on_software) {
    if (on_software) return machine_is_busy(rows) ? Clock::processor : Clock::wall;
    return timers_agree(rows) ? Clock::gpu : Clock::wall;
}

const std::vector<double>& times_by(Clock clock, const FrameTimes& row) {
    switch (clock) {
        case Clock::wall:
            return row.wall;
        case Clock::gpu:
            return row.gpu;
        case Clock::processor:
            break;
    }
    return row.processor;
}

Rounds time_rounds(std::size_t rows, const std::function<FrameTime(std::size_t)>& draw,
                   const RoundsOptions& options, const std::function<void(const Rounds&)>& told) {
    Rounds rounds{.rows = std::vector<FrameTimes>(rows),
                  .all_passes = std::vector<double>(rows, 0.0)};
    std::vector<std::size_t> open(rows);
    std::iota(open.begin(), open.end(), std::size_t{0});
    std::mt19937_64 random(1);
    double spent_ms = 0.0;
    int done = 0;
    for (int next = options.least; !open.empty(); next *= 2) {
        if (done > 0 && next > kMostRounds) break;
        for (; done < next && (done < options.least || spent_ms < 1e3 * options.seconds); ++done) {
            shuffle(open, random);
            for (const std::size_t row : open) {
                const FrameTime frame = draw(row);
                add(rounds.rows[row], frame);
                spent_ms += frame.wall;
            }
        }
        rounds.look = static_cast<int>(std::lround(std::log2(next / options.least)));
        // One that took no part for a while would have rounds beside other ones than the others'.
        const std::vector<std::size_t> still = open_rows(rounds, options.on_software);
        std::erase_if(open, [&](std::size_t row) {
            return row != options.anchor && std::ranges::find(still, row) == still.end();
        });
        if (still.empty() || open.size() < 2) open.clear();
        if (told) told(rounds);
        if (spent_ms >= 1e3 * options.seconds) break;
    }
    return rounds;
}

}  // namespace glint
