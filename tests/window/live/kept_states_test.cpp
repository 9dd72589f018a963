// Which states of a simulation are kept in memory, and which of them a jump of time begins with.
#include "window/live/kept_states.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace glint::kept_states_test {
namespace {

constexpr std::size_t kSize = 1000;  // bytes of a state

KeptStates::State state(int frame, std::size_t size = kSize) {
    PassState pass;
    pass.pass = "waves";
    pass.bytes.resize(size);
    return {.frame = frame, .time = (frame - 1) / 60.0, .passes = {pass}};
}

void play(KeptStates& states, int frames) {
    for (int k = 0; k < frames; ++k)
        if (states.wants(k)) states.keep(state(k));
}

TEST(KeptStates, AJumpBeginsWithTheLastOneBeforeIt) {
    KeptStates states;
    play(states, 601);
    EXPECT_EQ(states.nearest({.end = 5.0})->frame, 300);
    EXPECT_EQ(states.nearest({.end = 5.48})->frame, 300);
    EXPECT_EQ(states.nearest({.end = 5.5})->frame, 330);
    EXPECT_EQ(states.nearest({.end = 100.0})->frame, 600);
    EXPECT_EQ(states.nearest({.end = 0.3}), nullptr) << "from the start";
    states.clear();
    EXPECT_EQ(states.nearest({.end = 5.0}), nullptr);
    EXPECT_TRUE(states.times().empty());
}

TEST(KeptStates, OneThatLiesLaterThanTheEndIsOfNoUse) {
    KeptStates states;
    states.keep({.frame = 601, .time = 10.010, .passes = {}});
    EXPECT_EQ(states.nearest({.end = 10.005}), nullptr) << "though both end in frame 601";
    EXPECT_NE(states.nearest({.end = 10.012}), nullptr);
}

TEST(KeptStates, StayWithinTheBudgetRecentOnesDenser) {
    KeptStates states(20 * kSize);
    play(states, 60 * 600);
    const std::vector<double>& times = states.times();
    EXPECT_LE(times.size(), 20u);
    EXPECT_GE(times.size(), 10u);
    ASSERT_TRUE(std::ranges::is_sorted(times));
    const double recent = times.back() - times[times.size() - 2];
    const double old = times[times.size() / 2] - times[times.size() / 2 - 1];
    EXPECT_GT(times.back(), 599.0);
    EXPECT_LT(recent, 1.1);
    EXPECT_GT(old, 2.0 * recent);
    // A jump to any time plays no more again than a good part of how long ago that is.
    double before = 0.0;
    for (const double time : times) {
        const bool is_last = time == times.back();
        EXPECT_LE(time - before, is_last ? 1.1 : 0.7 * (times.back() - before)) << time;
        before = time;
    }
}

TEST(KeptStates, OneThatIsTooLargeIsNotKeptNorAskedForAgain) {
    KeptStates states(4 * kSize);
    states.keep(state(60, kSize + 1));
    EXPECT_TRUE(states.times().empty());
    EXPECT_FALSE(states.wants(120));
    states.clear();
    EXPECT_TRUE(states.wants(120));
}

}  // namespace
}  // namespace glint::kept_states_test
