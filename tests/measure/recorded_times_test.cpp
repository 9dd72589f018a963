// What a study concludes from times that were recorded on a busy machine (tests/measure/recorded/).
#include "measure/study/result.h"
#include "measure/study/rounds.h"
#include "measure/study/statistics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

namespace glint::recorded_times_test {
namespace {

constexpr int kRuns = 100;  // begun at as many places of the record

// By row, its frames in the order in which they were drawn.
std::vector<std::vector<FrameTime>> recorded() {
    std::ifstream file(std::string(GLINT_REPOSITORY) +
                       "/tests/measure/recorded/magic-shadowSamples.txt");
    std::vector<std::vector<FrameTime>> rows;
    for (std::string line; std::getline(file, line);) {
        std::istringstream numbers(line[0] == '#' ? "" : line);
        FrameTime frame;
        for (std::size_t row = 0; numbers >> frame.wall >> frame.processor; ++row) {
            frame.gpu = frame.wall;
            rows.resize(std::max(rows.size(), row + 1));
            rows[row].push_back(frame);
        }
    }
    return rows;
}

// Frames of one row: every `step`-th from `first` on, `slower` times as long as they took.
struct Played {
    std::vector<FrameTime> frames;
    std::size_t at = 0;

    Played(const std::vector<FrameTime>& of, std::size_t first, std::size_t step, double slower) {
        for (std::size_t i = first; i < of.size(); i += step) {
            const FrameTime& frame = of[i];
            frames.push_back({.wall = slower * frame.wall,
                              .gpu = slower * frame.gpu,
                              .processor = slower * frame.processor});
        }
    }
    FrameTime next() { return frames[at++ % frames.size()]; }
};

Rounds timed(std::vector<Played> rows, int run, double seconds) {
    for (Played& row : rows)
        row.at = static_cast<std::size_t>(run) * row.frames.size() / std::size_t{kRuns};
    return time_rounds(rows.size(), [&](std::size_t row) { return rows[row].next(); },
                       {.seconds = seconds, .on_software = true});
}

// Of the same work, in neighbouring rounds, of which the second takes so much longer.
TimeVerdict verdict(const std::vector<FrameTime>& of, int run, double slower) {
    const Rounds rounds = timed({Played(of, 0, 2, 1.0), Played(of, 1, 2, slower)}, run, 60.0);
    const Clock clock = best_clock(rounds.rows, true);
    std::vector<std::vector<double>> times;
    for (const FrameTimes& row : rounds.rows) times.push_back(times_by(clock, row));
    return TimeVerdicts(times, rounds.look).of(1, 0);
}

TEST(RecordedTimes, FivePercentAreToldApartInNinetyFiveOfAHundredRunsWithinAMinute) {
    const auto rows = recorded();
    ASSERT_EQ(rows.size(), 6u);
    for (const std::size_t row : {0u, 5u}) {
        int told = 0;
        for (int run = 0; run < kRuns; ++run)
            told += verdict(rows[row], run, 1.05) == TimeVerdict::slower;
        EXPECT_GE(told, 95) << "row " << row;
    }
}

TEST(RecordedTimes, TheSameWorkIsToldApartInFiveOfAHundredRunsAtMost) {
    const auto rows = recorded();
    int wrong = 0;
    for (int run = 0; run < kRuns; ++run)
        wrong += verdict(rows[run % rows.size()], run, 1.0) != TimeVerdict::not_told_apart;
    EXPECT_LE(wrong, 5);
}

TEST(RecordedTimes, FrontiersOfRepeatedRunsAgree) {
    const std::vector<double> errors = {0.00406, 0.00339, 0.00254, 0.00153, 0.000928, 0.000436};
    const auto rows = recorded();
    std::map<std::string, int> frontiers;
    for (int run = 0; run < kRuns; ++run) {
        std::vector<Played> played;
        for (const auto& row : rows) played.emplace_back(row, 0, 1, 1.0);
        const Rounds rounds = timed(played, run, 30.0);
        Study study{.reference_error = Difference{.rmse = 1e-4}, .look = rounds.look};
        for (std::size_t i = 0; i < errors.size(); ++i)
            study.rows.push_back({.times = rounds.rows[i], .error = Difference{.rmse = errors[i]}});
        judge(study, {}, true);
        std::string stars;
        for (const StudyRow& row : study.rows) stars += row.pareto ? '*' : ' ';
        ++frontiers[stars];
    }
    int most = 0;
    for (const auto& [stars, count] : frontiers) most = std::max(most, count);
    EXPECT_GE(most, 95) << frontiers.size() << " frontiers";
}

}  // namespace
}  // namespace glint::recorded_times_test
