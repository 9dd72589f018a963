// What a study concludes from noisy clocks: simulated ones, whose truth is known.
#include "measure/study/result.h"
#include "measure/study/rounds.h"
#include "measure/study/statistics.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

namespace glint {
namespace {

// A machine that others use: a load that drifts and jumps, frames that waver, and now and then one
// that waits for a whole turn of the scheduler.
class BusyMachine {
public:
    BusyMachine(std::vector<double> true_ms, std::uint64_t seed)
        : true_ms_(std::move(true_ms)), random_(seed), phase_(7.0 * uniform()) {}

    FrameTime draw(std::size_t row) {
        const double slow = 1.0 + 0.3 * std::sin(phase_ + now_ms_ / 3000.0);
        if (uniform() < 0.003) jump_ = 1.0 + 0.5 * uniform();
        const double wavers = std::exp(0.05 * normal_(random_));
        const double waits = uniform() < 0.05 ? 4.0 + 10.0 * uniform() : 0.0;
        const double ms = true_ms_[row] * slow * jump_ * wavers + waits;
        now_ms_ += ms;
        return {.wall = ms, .gpu = ms, .processor = ms};
    }
    double now_ms() const { return now_ms_; }

private:
    double uniform() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

    std::vector<double> true_ms_;
    std::mt19937_64 random_;
    std::normal_distribution<double> normal_;
    double phase_, jump_ = 1.0, now_ms_ = 0.0;
};

struct Timed {
    Rounds rounds;
    TimeVerdicts verdicts;
    double seconds;
};

Timed timed(const std::vector<double>& true_ms, std::uint64_t seed, double seconds = 60.0) {
    BusyMachine machine(true_ms, seed);
    const auto draw = [&](std::size_t row) { return machine.draw(row); };
    Rounds rounds = time_rounds(true_ms.size(), draw, {.seconds = seconds, .on_software = true});
    std::vector<std::vector<double>> times;
    for (const FrameTimes& row : rounds.rows) times.push_back(row.wall);
    const TimeVerdicts verdicts(times, rounds.look);
    return {std::move(rounds), verdicts, machine.now_ms() / 1000.0};
}

TEST(StudyTimes, FivePercentAreToldApartInNinetyFiveOfAHundredRunsWithinAMinute) {
    int told = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const Timed run = timed({20.0, 21.0}, seed);
        told += run.verdicts.of(0, 1) == TimeVerdict::faster &&
                run.verdicts.of(1, 0) == TimeVerdict::slower && run.seconds < 61.0;
    }
    EXPECT_GE(told, 95);
}

TEST(StudyTimes, TheSameWorkIsToldApartInFiveOfAHundredRunsAtMost) {
    int wrong = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed)
        wrong += timed({20.0, 20.0}, seed, 10.0).verdicts.of(0, 1) != TimeVerdict::not_told_apart;
    EXPECT_LE(wrong, 5);
}

// Thirty-six pairs, of which a test for each at one in twenty would get two wrong.
TEST(StudyTimes, NineRowsOfTheSameWorkAreToldApartInFiveOfAHundredRunsAtMost) {
    int wrong = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        const Timed run = timed(std::vector<double>(9, 8.0), seed, 4.0);
        bool any = false;
        for (std::size_t a = 0; a < 9; ++a)
            for (std::size_t b = 0; b < 9; ++b)
                any |= run.verdicts.of(a, b) != TimeVerdict::not_told_apart;
        wrong += any;
    }
    EXPECT_LE(wrong, 5);
}

TEST(StudyTimes, RowsThatAreToldApartTakePartNoMore) {
    const Timed run = timed({5.0, 5.0, 50.0}, 1);
    EXPECT_EQ(run.rounds.rows[2].wall.size(), 15u);
    EXPECT_GT(run.rounds.rows[0].wall.size(), 15u);
    EXPECT_EQ(run.rounds.rows[0].wall.size(), run.rounds.rows[1].wall.size());
}

// Half a minute would hold 300 000 rounds of so small frames, whose statistics take minutes.
TEST(StudyTimes, RowsAtTheEdgeOfWhatIsAskedForEndAfterSomeThousandRounds) {
    std::array<int, 2> drawn{};
    const auto draw = [&](std::size_t row) {
        const int round = drawn[row]++;
        const double off = (round % 2 ? 1e-4 : -1e-4) * (1 + round / 2 % 100);
        const double ms = row == 0 ? 0.05 : 0.05 * std::exp(kEnough + off);
        return FrameTime{.wall = ms, .gpu = ms, .processor = ms};
    };
    const auto rounds = [&](int least) {
        drawn = {};
        time_rounds(2, draw, {.least = least, .on_software = true});
        return drawn[0];
    };
    EXPECT_GT(rounds(15), 1000);
    EXPECT_LE(rounds(15), 5000);
    EXPECT_EQ(rounds(6000), 6000) << "--frames asks for them";
}

TEST(StudyTimes, AMediansIntervalHoldsTheMedianInNineOfTenRuns) {
    int holds = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        std::mt19937_64 random(seed);
        std::normal_distribution<double> normal(10.0, 1.0);
        std::vector<double> values;
        for (int i = 0; i < 60; ++i) values.push_back(normal(random));
        const Interval interval = median_interval(values);
        EXPECT_EQ(interval.low, median_interval(values).low) << "the same each time";
        holds += interval.low <= 10.0 && 10.0 <= interval.high;
    }
    EXPECT_GE(holds, 90);
}

// Of 2^4 ways to give four ranks their signs one has no rank above, and two have at most the first.
TEST(StudyTimes, RanksAreCountedExactly) {
    const std::vector<double> below = {-1.0, -2.0, -3.0, -4.0}, one = {1.0, -2.0, -3.0, -4.0};
    EXPECT_DOUBLE_EQ(chance_below(below, 0.0), 1.0 / 16);
    EXPECT_DOUBLE_EQ(chance_below(one, 0.0), 2.0 / 16);
    EXPECT_DOUBLE_EQ(chance_below(below, -5.0), 1.0);
    // Ranks of 3, 6, …, 60 above: 630, of which evenly strewn signs have 915 +- 135.8.
    std::vector<double> many;
    for (int i = 1; i <= 60; ++i) many.push_back(i % 3 == 0 ? i : -i);
    EXPECT_NEAR(chance_below(many, 0.0), 0.0181, 0.0005);
}

// A study of rows whose errors halve, as one that was run on this machine would be judged.
std::vector<bool> frontier(const std::vector<double>& true_ms, const std::vector<double>& errors,
                           std::uint64_t seed, double own_error, double seconds = 30.0) {
    const Timed run = timed(true_ms, seed, seconds);
    // By a second seed, of which each has its part.
    Study study{.reference_error = Difference{.rmse = own_error * std::numbers::sqrt2},
                .look = run.rounds.look};
    for (std::size_t i = 0; i < true_ms.size(); ++i) {
        study.rows.push_back({.times = run.rounds.rows[i], .error = Difference{.rmse = errors[i]}});
    }
    judge(study, {.second_work = {SecondWork::Kind::seed, 1.0}}, true);
    std::vector<bool> stars;
    for (const StudyRow& row : study.rows) stars.push_back(row.pareto);
    return stars;
}

// Steps that end early cost nothing more; one row is slower and worse.
TEST(StudyTimes, FrontiersOfRepeatedRunsAgree) {
    const std::vector<double> ms = {4.0, 4.8, 6.5, 8.0, 8.0, 8.0, 12.0};
    const std::vector<double> errors = {0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.08};
    const std::vector<bool> truth = {true, true, true, false, false, true, false};
    int agree = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed)
        agree += frontier(ms, errors, seed, 1e-4) == truth;
    EXPECT_GE(agree, 95);
}

// 1.8 % are told where there is time enough, and not where there is little.
TEST(StudyTimes, AStepThatNobodyAsksForGivesNoStarHoweverLongItIsTimed) {
    for (const double seconds : {3.0, 30.0, 300.0}) {
        int agree = 0;
        for (std::uint64_t seed = 0; seed < 20; ++seed) {
            const std::vector<bool> stars =
                frontier({5.0, 5.09}, {0.02, 0.01}, seed, 1e-4, seconds);
            agree += stars == std::vector<bool>{false, true};
        }
        EXPECT_GE(agree, 19) << seconds << " s";
    }
}

// Each later look asks for more.
TEST(StudyTimes, WhatWasToldApartStaysSoAfterManyRoundsOfOthers) {
    std::vector<std::vector<double>> times(7, std::vector<double>(960, 5.0));
    times[6].assign(15, 6.0);
    EXPECT_EQ(TimeVerdicts(times, 0).of(6, 0), TimeVerdict::slower);
    EXPECT_EQ(TimeVerdicts(times, 6).of(6, 0), TimeVerdict::slower);
    // Six rounds, 12, 24, 48 and 70: the last look was cut short.
    times.assign(7, std::vector<double>(70, 5.0));
    times[6].assign(12, 6.0);
    EXPECT_EQ(TimeVerdicts(times, 4).of(6, 0), TimeVerdict::slower);
}

TEST(StudyTimes, AnErrorThatIsNotToldApartIsNoReasonForMoreTime) {
    EXPECT_EQ(frontier({5.0, 8.0}, {0.011, 0.010}, 1, 1e-3), (std::vector<bool>{true, false}));
    EXPECT_EQ(frontier({5.0, 8.0}, {0.011, 0.010}, 1, 1e-4), (std::vector<bool>{true, true}));
}

TEST(StudyTimes, AVerdictIsBesideThePresetsOwnValue) {
    Study study{.rows = {{.times = {{5, 5}, {5, 5}, {5, 5}}},
                         {.times = {{5, 5}, {5, 5}, {5, 5}}, .is_preset = true}}};
    judge(study, {}, true);
    EXPECT_EQ(study.rows[0].verdict, TimeVerdict::not_told_apart);
    EXPECT_FALSE(study.rows[1].verdict);
}

}  // namespace
}  // namespace glint
