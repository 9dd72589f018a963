// The search finds small places that uniform numbers miss, and the same ones every time.
#include "measure/check/search.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <iostream>

namespace glint {
namespace {

// A ball or a corner of the cube in which something fails, with or without a distance to go by.
struct Fault {
    Point centre;
    double radius = 0.0;
    bool is_told = true;  // an operation's distance from its domain; else a step
    Trial operator()(const Point& point) const {
        double squares = 0.0;
        for (std::size_t i = 0; i < point.size(); ++i)
            squares += (point[i] - centre[i]) * (point[i] - centre[i]);
        const double off = std::sqrt(squares) - radius;
        const auto told = is_told ? static_cast<float>(std::max(off, 0.0)) : 1.0f;
        return {.fails = off < 0.0, .distances = {1.0f, told}};
    }
};

int trials_of_search(const Fault& fault, int most) {
    Search search(Point(fault.centre.size(), 0.5));
    for (int k = 1; k <= most; ++k) {
        const Point point = search.next();
        const Trial trial = fault(point);
        if (trial.fails) return k;
        search.tell(point, trial);
    }
    return 0;
}

int trials_of_chance(const Fault& fault, int most, unsigned seed) {
    std::mt19937 random(seed);
    for (int k = 1; k <= most; ++k) {
        Point point(fault.centre.size());
        for (double& component : point) component = static_cast<double>(random()) / 4294967296.0;
        if (fault(point).fails) return k;
    }
    return 0;
}

TEST(Search, MeetsEveryCombinationOfEndsOfAnyThreeRanges) {
    for (const std::size_t ranges : {3u, 6u, 7u, 12u}) {
        Search search(Point(ranges, 0.5));
        search.next();
        std::vector<Point> ends;
        for (std::size_t k = 0; k < 2 * std::bit_ceil(ranges + 1); ++k)
            ends.push_back(search.next());
        for (std::size_t a = 0; a < ranges; ++a)
            for (std::size_t b = 0; b < a; ++b)
                for (std::size_t c = 0; c < b; ++c) {
                    unsigned met = 0;
                    for (const Point& p : ends)
                        met |= 1u << static_cast<int>(p[a] + 2.0 * p[b] + 4.0 * p[c]);
                    EXPECT_EQ(met, 255u) << ranges << " ranges: " << a << ", " << b << ", " << c;
                }
    }
}

TEST(Search, TriesTheUsualPointFirstAndTheSamePointsEveryTime) {
    const Fault fault{.centre = {0.2, 0.7, 0.3}, .radius = 0.0};
    Search one({0.5, 0.5, 0.5}), other({0.5, 0.5, 0.5});
    EXPECT_EQ(one.next(), Point({0.5, 0.5, 0.5}));
    other.next();
    for (int k = 0; k < 200; ++k) {
        const Point point = one.next();
        ASSERT_EQ(point, other.next());
        one.tell(point, fault(point));
        other.tell(point, fault(point));
    }
}

TEST(Search, LeavesDearRangesAloneThreeTimesOfFour) {
    const std::size_t rare = 2;
    Search search(Point(5, 0.5), rare);
    int changed = 0;
    for (int k = 0; k < 240; ++k) {
        const Point point = search.next();
        changed += point[3] != 0.5 || point[4] != 0.5;
        search.tell(point, {.distances = {static_cast<float>(point[0]) + 1.0f}});
    }
    EXPECT_GT(changed, 20);
    EXPECT_LT(changed, 80);
}

TEST(Search, TheSmallestReproducerDiffersInWhatItMust) {
    const auto fails = [](const Point& p) { return p[0] > 0.8 && p[2] < 0.3; };
    const Point found = smallest({0.95, 0.1, 0.05, 0.9}, Point(4, 0.5), fails, 100);
    EXPECT_NEAR(found[0], 0.8, 0.01);
    EXPECT_EQ(found[1], 0.5);
    EXPECT_NEAR(found[2], 0.3, 0.01);
    EXPECT_EQ(found[3], 0.5);
}

// A pole fails at one number alone, which no move meets: 0.37 in the third of these ranges.
TEST(Search, FollowsAnOperationToTheNumberOfFewDigitsAtWhichItFails) {
    int trials = 0;
    const auto attempt = [&](const Point& p) {
        ++trials;
        const double divisor = 0.2 * p[0] + 3.0 * (p[2] - 0.37) - 0.2 * 0.5;
        return Trial{.fails = divisor == 0.0,
                     .distances = {1.0f, static_cast<float>(std::abs(divisor))}};
    };
    const auto rounded = [](Point point, std::size_t axis) {
        const double hundredths = std::round(100.0 * point[axis]) / 100.0;
        if (std::abs(hundredths - point[axis]) < 1e-5) point[axis] = hundredths;
        return point;
    };
    const Point from = {0.5, 0.5, 0.42};
    const auto found =
        follow_to_zero({.operation = 1, .point = from, .distance = 0.15f}, attempt, rounded, 64);
    ASSERT_TRUE(found);
    EXPECT_EQ(*found, (Point{0.5, 0.5, 0.37}));
    EXPECT_LE(trials, 20);
}

// Of faults whose place and radius are drawn, half of them without any distance to go by.
TEST(Search, FindsTwiceWhatUniformNumbersFindAtEqualEvaluations) {
    constexpr int kFaults = 400, kTrials = 256;
    std::mt19937 random(20);
    const auto drawn = [&] { return static_cast<double>(random()) / 4294967296.0; };
    int found = 0, by_chance = 0, told = 0, told_by_chance = 0;
    for (int n = 0; n < kFaults; ++n) {
        Fault fault{
            .centre = Point(3 + n % 4), .radius = 0.02 + 0.13 * drawn(), .is_told = n % 2 == 0};
        for (double& component : fault.centre) component = drawn();
        const bool search = trials_of_search(fault, kTrials) > 0;
        const bool chance = trials_of_chance(fault, kTrials, static_cast<unsigned>(n)) > 0;
        found += search;
        by_chance += chance;
        if (!fault.is_told) continue;
        told += search;
        told_by_chance += chance;
    }
    std::cout << found << " of " << kFaults << " by search, " << by_chance << " by chance; of "
              << kFaults / 2 << " with a distance " << told << " and " << told_by_chance << '\n';
    EXPECT_GE(found, 2 * by_chance);
    EXPECT_GE(told, kFaults / 2 * 9 / 10);
}

}  // namespace
}  // namespace glint
