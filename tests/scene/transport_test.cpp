// Time: by the wall clock, by steps, over jumps, and over a month.
#include "scene/transport.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace glint::transport_test {
namespace {

constexpr double kStep = Transport::kStep;
constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Transport started(double start = 0.0) {
    Transport transport(start);
    transport.advance(0.0);
    return transport;
}

TEST(Transport, TheFirstFrameIsFrameZeroAtTheStart) {
    for (const double start : {0.0, 12.5}) {
        Transport transport(start);
        EXPECT_TRUE(transport.wants_frame());
        const Instant first = transport.advance(3.0);
        EXPECT_EQ(first.time, start);
        EXPECT_EQ(first.frame, 0);
        EXPECT_EQ(first.time_delta, kStep);
        EXPECT_EQ(first.moved, 0.0);
        EXPECT_EQ(first.jumped, start != 0.0) << "a stateful scene is played up to its start";
    }
}

TEST(Transport, PlayingFollowsTheWallClock) {
    Transport transport = started();
    const Instant now = transport.advance(0.25);
    EXPECT_EQ(now.time, 0.25);
    EXPECT_EQ(now.time_delta, 0.25);
    EXPECT_EQ(now.moved, 0.25);
    EXPECT_EQ(now.frame, 1);
    EXPECT_FALSE(now.jumped);
}

TEST(Transport, AHitchMovesTimeAndSaysByHowMuch) {
    Transport transport = started();
    const Instant now = transport.advance(30.0);
    EXPECT_EQ(now.time, 30.0);
    EXPECT_EQ(now.moved, 30.0);
    EXPECT_FALSE(now.jumped);
}

TEST(Transport, WallTimeThatMakesNoSenseMovesNothing) {
    for (const double seconds : {-1.0, 0.0, kNotANumber, kInfinity, -kInfinity}) {
        Transport transport = started(2.0);
        const Instant now = transport.advance(seconds);
        EXPECT_EQ(now.time, 2.0) << seconds;
        EXPECT_EQ(now.time_delta, kStep) << seconds;
        EXPECT_FALSE(now.jumped) << seconds;
    }
}

TEST(Transport, PausedFramesCountOnWhileTimeStands) {
    Transport transport = started();
    transport.advance(0.5);
    transport.pause();
    EXPECT_FALSE(transport.wants_frame());
    const Instant extra = transport.advance(7.0);  // the mouse has moved
    EXPECT_EQ(extra.time, 0.5);
    EXPECT_EQ(extra.time_delta, kStep);
    EXPECT_EQ(extra.frame, 2);
    EXPECT_FALSE(extra.jumped);
}

TEST(Transport, TheFirstFrameAfterAResumeDoesNotCountThePause) {
    Transport transport = started();
    transport.advance(0.5);
    transport.pause();
    transport.play();
    EXPECT_TRUE(transport.wants_frame());
    const Instant resumed = transport.advance(3600.0);
    EXPECT_EQ(resumed.time, 0.5);
    EXPECT_EQ(resumed.time_delta, kStep);
    EXPECT_FALSE(resumed.jumped);
    EXPECT_EQ(transport.advance(0.25).time, 0.75);
}

TEST(Transport, AStepMovesOneSixtiethAndPauses) {
    Transport transport = started(1.0);
    transport.step();
    transport.step();
    EXPECT_FALSE(transport.playing());
    for (int k = 1; k <= 2; ++k) {
        EXPECT_TRUE(transport.wants_frame());
        const Instant now = transport.advance(9.0);
        EXPECT_EQ(now.time, (60 + k) / 60.0);
        EXPECT_EQ(now.time_delta, kStep);
        EXPECT_FALSE(now.jumped);
    }
    EXPECT_FALSE(transport.wants_frame());
}

TEST(Transport, AResetStartsAnewAtZero) {
    for (const bool playing : {true, false}) {
        Transport transport = started(5.0);
        transport.advance(1.0);
        if (!playing) transport.pause();
        transport.seek(3.0);
        transport.reset();
        EXPECT_TRUE(transport.wants_frame());
        const Instant now = transport.advance(0.5);
        EXPECT_EQ(now.time, 0.0);
        EXPECT_EQ(now.frame, 0);
        EXPECT_EQ(now.time_delta, kStep);
        EXPECT_TRUE(now.jumped);
        EXPECT_EQ(transport.playing(), playing);
        EXPECT_EQ(transport.advance(0.5).time, playing ? 0.5 : 0.0);
    }
}

TEST(Transport, ASeekIsAJumpUnlessItHoldsTheTime) {
    struct Case {
        double target, time;
        bool jumped;
    };
    const Case cases[] = {{3.0, 3.0, true},  {40.0, 40.0, true},        {7.0, 7.0, false},
                          {-4.0, 0.0, true}, {kInfinity, 0x1p36, true}, {kNotANumber, 7.0, false}};
    for (const bool playing : {true, false}) {
        for (const Case& c : cases) {
            Transport transport = started(7.0);
            if (!playing) transport.pause();
            transport.seek(c.target);
            EXPECT_EQ(transport.time(), c.time);
            EXPECT_EQ(transport.wants_frame(), playing || c.jumped) << c.target;
            const Instant now = transport.advance(std::isnan(c.target) ? 0.0 : 0.5);
            EXPECT_EQ(now.time, c.time) << c.target;
            EXPECT_EQ(now.jumped, c.jumped) << c.target;
            EXPECT_EQ(now.frame, 1) << "iFrame runs on";
            EXPECT_EQ(now.time_delta, kStep) << c.target;
            EXPECT_EQ(transport.playing(), playing);
        }
    }
}

TEST(Transport, AChangeOfRateNeverMakesTimeJump) {
    Transport transport = started();
    double expected = 0.0;
    for (const double rate : {1.0, 4.0, 0.1, 0.37, 2.5}) {
        transport.set_rate(rate);
        EXPECT_EQ(transport.time(), expected);
        expected += 0.5 * rate;
        EXPECT_NEAR(transport.advance(0.5).time, expected, 1e-15);
    }
}

TEST(Transport, TheRateStaysInItsRange) {
    const double cases[][2] = {{0.0, 0.1}, {-3.0, 0.1}, {100.0, 4.0}, {1.5, 1.5}};
    for (const auto& [wanted, rate] : cases) {
        Transport transport;
        transport.set_rate(wanted);
        transport.set_rate(kNotANumber);
        EXPECT_EQ(transport.rate(), rate);
    }
}

TEST(Transport, FixedStepsAreTheFramesOfASequence) {
    Transport transport;
    transport.set_fixed_step(true);
    transport.set_rate(0.1);
    for (int k = 0; k < 200'000; ++k) {
        const Instant now = transport.advance(k % 7 * 0.01);
        ASSERT_EQ(now.time, k / 60.0) << k;
        ASSERT_EQ(now.time_delta, kStep);
        ASSERT_EQ(now.frame_rate, 60.0);
    }
}

TEST(Transport, ALoopGoesOnFromItsBegin) {
    struct Case {
        Loop loop;
        double start, seconds, time;
        bool jumped;
    };
    const Case cases[] = {{{2, 6}, 3, 1, 4, false},   {{2, 6}, 0, 1, 1, false},
                          {{2, 6}, 5, 1, 2, true},    {{2, 6}, 5, 1.5, 2.5, true},
                          {{2, 6}, 5, 30, 3, true},   {{2, 6}, 20, 0.5, 4.5, true},
                          {{6, 2}, 5, 1.5, 2.5, true}};
    for (const Case& c : cases) {
        Transport transport = started(c.start);
        transport.set_loop(c.loop);
        const Instant now = transport.advance(c.seconds);
        EXPECT_EQ(now.time, c.time);
        EXPECT_EQ(now.jumped, c.jumped);
        EXPECT_EQ(now.moved, c.seconds);
        EXPECT_EQ(now.time_delta, c.jumped ? kStep : c.seconds);
    }
}

TEST(Transport, ALoopOfStepsRepeatsItsFramesExactly) {
    Transport transport;
    transport.set_fixed_step(true);
    transport.set_loop(Loop{0.0, 2.0});
    for (int k = 0; k < 1000; ++k) ASSERT_EQ(transport.advance(0.1).time, k % 120 / 60.0);
}

TEST(Transport, ALoopLastsAtLeastAStep) {
    Transport transport = started();
    transport.set_loop(Loop{1.0, 1.0});
    EXPECT_EQ(transport.loop()->end, 1.0 + kStep);
    transport.set_loop(Loop{kNotANumber, 1.0});
    EXPECT_EQ(transport.loop()->begin, 1.0) << "no number changes nothing";
    transport.set_loop(std::nullopt);
    EXPECT_EQ(transport.advance(8.0).time, 8.0);
}

TEST(Transport, APausedTimeBeyondTheLoopStays) {
    Transport transport = started(20.0);
    transport.pause();
    transport.set_loop(Loop{2.0, 6.0});
    EXPECT_FALSE(transport.wants_frame());
    EXPECT_EQ(transport.advance(0.5).time, 20.0);
    transport.step();
    EXPECT_TRUE(transport.advance(0.5).jumped);
    EXPECT_LT(transport.time(), 6.0);
}

TEST(Transport, TheFrameRateIsMeasuredByTheWallClock) {
    Transport transport = started();
    transport.set_rate(4.0);
    Instant now;
    for (int k = 0; k < 100; ++k) now = transport.advance(1.0 / 32);
    EXPECT_EQ(now.frame_rate, 32.0);
}

// Quality 2: at most 10 ms off after 30 days at 60 Hz. The sum is exact but for the rounding of its
// terms: 1/60 in double is off by 2e-19 s, 155 million times.
TEST(Transport, AMonthAtSixtyHertzDoesNotDrift) {
    constexpr int kFrames = 30 * 86400 * 60;
    Transport transport = started();
    for (int k = 0; k < kFrames; ++k) transport.advance(kStep);
    EXPECT_NEAR(transport.time(), 30 * 86400.0, 1e-9);
}

// The differences of a clock's readings telescope, however uneven the frames are and however often
// the rate changes for the same stretch.
TEST(Transport, UnevenFramesDoNotDriftFromTheClock) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> seconds(0.001, 0.04);
    Transport transport = started();
    double clock = 1e6;  // a machine that has been up for days
    const double begin = clock;
    for (int k = 0; k < 1'000'000; ++k) {
        const double next = clock + seconds(random);
        transport.advance(next - clock);
        clock = next;
    }
    EXPECT_EQ(transport.time(), clock - begin);
}

}  // namespace
}  // namespace glint::transport_test
