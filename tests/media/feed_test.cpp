// What is heard, in step with time: without a device, by a clock of the test's own.
#include "media/feed.h"

#include <gtest/gtest.h>

#include <cmath>

namespace glint::feed_test {
namespace {

constexpr std::size_t kChunk = 441;  // 10 ms

// Left is the number of the sample in 2^22ths, right its negative.
float left_of(double sample) {
    return static_cast<float>(sample / 4194304.0);
}

std::vector<float> block(long index) {
    std::vector<float> pairs;
    for (long i = 0; i < kFeedBlock; ++i) {
        const float value = left_of(static_cast<double>(index * kFeedBlock + i));
        pairs.insert(pairs.end(), {value, -value});
    }
    return pairs;
}

void make_what_is_wanted(SoundFeed& feed, double clock) {
    while (const auto wanted = feed.wanted_block(clock)) feed.add(*wanted, block(*wanted));
}

std::vector<float> listen(SoundFeed& feed, double clock, std::size_t count = kChunk) {
    std::vector<float> pairs(2 * count);
    feed.fill(pairs, clock);
    return pairs;
}

TEST(SoundFeed, IsSilentUntilItPlays) {
    SoundFeed feed;
    EXPECT_TRUE(feed.is_silent());
    EXPECT_EQ(listen(feed, 5.0), std::vector<float>(2 * kChunk, 0.0f));
    feed.follow({.playing = true, .time = 1.0, .at = 5.0});
    EXPECT_FALSE(feed.is_silent());
}

TEST(SoundFeed, PlaysTheSamplesOfTheTimeInOrder) {
    SoundFeed feed;
    feed.follow({.playing = true, .time = 1.0, .at = 5.0});
    make_what_is_wanted(feed, 5.0);
    listen(feed, 5.0);  // fades in
    for (int k = 1; k < 50; ++k) {
        const std::vector<float> pairs = listen(feed, 5.0 + 0.01 * k);
        for (std::size_t i = 0; i < kChunk; ++i) {
            const double sample = 44100.0 + 441.0 * k + static_cast<double>(i);
            ASSERT_NEAR(pairs[2 * i], left_of(sample), 1e-6) << "a rounding of the clock";
            ASSERT_EQ(pairs[2 * i + 1], -pairs[2 * i]);
        }
    }
}

TEST(SoundFeed, MakesASecondBeforehandAndNoMore) {
    SoundFeed feed;
    feed.follow({.playing = true, .time = 10.0, .at = 0.0});
    std::vector<long> made;
    while (const auto wanted = feed.wanted_block(0.0)) {
        made.push_back(*wanted);
        feed.add(*wanted, block(*wanted));
    }
    EXPECT_EQ(made.front(), 441000 / kFeedBlock) << "the one that is heard first";
    EXPECT_EQ(made.back(), 485100 / kFeedBlock);
    EXPECT_EQ(feed.wanted_block(0.2), 485100 / kFeedBlock + 1);
    feed.follow({.playing = true, .time = 10.0, .rate = 4.0, .at = 0.0});
    EXPECT_TRUE(feed.wanted_block(0.0)) << "faster needs more";
    feed.follow({.playing = false, .time = 10.0, .at = 0.0});
    EXPECT_FALSE(feed.wanted_block(1000.0)) << "while it stands, it stands";
}

// No step from one sample to the next is larger than what fading over 10 ms makes it.
void expect_no_click(const std::vector<float>& pairs, float before, float loudest) {
    float last = before;
    for (std::size_t i = 0; i < pairs.size(); i += 2) {
        EXPECT_LE(std::abs(pairs[i] - last), 3 * loudest / kChunk + 1e-4f) << i;
        last = pairs[i];
    }
}

TEST(SoundFeed, StartsStopsAndJumpsWithoutAClick) {
    SoundFeed feed;
    feed.follow({.playing = true, .time = 10.0, .at = 0.0});
    make_what_is_wanted(feed, 0.0);
    std::vector<float> pairs = listen(feed, 0.0);
    expect_no_click(pairs, 0.0f, 0.5f);
    pairs = listen(feed, 0.01);
    float last = pairs[2 * kChunk - 2];
    feed.follow({.playing = true, .time = 20.0, .at = 0.02});
    make_what_is_wanted(feed, 0.02);
    pairs = listen(feed, 0.02);
    expect_no_click(pairs, last, 1.0f);
    EXPECT_NEAR(pairs[2 * kChunk - 2], left_of(20 * 44100 + kChunk - 1), 1e-5) << "there already";
    last = pairs[2 * kChunk - 2];
    feed.follow({.playing = false, .time = 20.01, .at = 0.03});
    EXPECT_FALSE(feed.is_silent()) << "it has to fade yet";
    pairs = listen(feed, 0.03);
    expect_no_click(pairs, last, 1.0f);
    EXPECT_EQ(pairs[2 * kChunk - 2], 0.0f);
    EXPECT_TRUE(feed.is_silent());
}

TEST(SoundFeed, FollowsRateAndVolume) {
    SoundFeed feed;
    feed.follow({.playing = true, .time = 2.0, .rate = 0.5, .at = 0.0, .volume = 0.25f});
    make_what_is_wanted(feed, 0.0);
    listen(feed, 0.0);
    const std::vector<float> pairs = listen(feed, 0.01);
    for (std::size_t i = 0; i < kChunk; ++i) {
        const double sample = 88200.0 + 0.5 * (441.0 + static_cast<double>(i));
        ASSERT_NEAR(pairs[2 * i], 0.25f * left_of(sample), 1e-6);
    }
}

TEST(SoundFeed, CatchesUpWithAClockThatRunsDifferently) {
    SoundFeed feed;
    feed.follow({.playing = true, .time = 0.0, .at = 0.0});
    // The device takes 10 ms of samples in 9.99 ms: after a minute it would be 60 ms ahead.
    double clock = 0.0;
    float heard = 0.0f;
    for (int k = 0; k < 6000; ++k, clock += 0.00999) {
        make_what_is_wanted(feed, clock);
        heard = listen(feed, clock)[0];
        ASSERT_EQ(heard > 0.0f, k > 0) << k;
    }
    EXPECT_NEAR(heard * 4194304.0 / 44100.0, clock - 0.00999, 0.11)
        << "s; within what is left to be corrected at 1 % of the drift a chunk";
}

TEST(SoundFeed, WhatIsNotMadeYetIsSilent) {
    SoundFeed feed;
    feed.follow({.playing = true, .time = 3.0, .at = 0.0});
    EXPECT_EQ(listen(feed, 0.0), std::vector<float>(2 * kChunk, 0.0f));
    feed.add(feed.block_at(0.01), block(feed.block_at(0.01)));
    EXPECT_NE(listen(feed, 0.01)[10], 0.0f);
    feed.clear();
    EXPECT_EQ(listen(feed, 0.02)[10], 0.0f);
}

}  // namespace
}  // namespace glint::feed_test
