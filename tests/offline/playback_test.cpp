// Frames of a scene that is played at a fixed rate.
#include "offline/common.h"

#include <gtest/gtest.h>

namespace glint::playback_test {
namespace {

TEST(Playback, EndsAtItsTimeWithAFrameOfTheRestOfIt) {
    const Playback playback{.end = 1.01};
    EXPECT_EQ(playback.last_frame(), 61);
    const Frame last = playback.frame({}, 61);
    EXPECT_EQ(last.time, 1.01);
    EXPECT_NEAR(last.time_delta, 0.01, 1e-12);
    EXPECT_EQ(playback.frame({}, 60).time, 1.0);
}

// A year has more frames than 2^30; beyond 2^31 iFrame cannot count them, and stays.
TEST(Playback, FramesAreOneFrameApartAfterYears) {
    constexpr double kYear = 365.0 * 86400.0;
    for (const double years : {0.5, 1.0, 1.5, 100.0}) {
        const Playback playback{.end = years * kYear};
        const int last = playback.last_frame();
        const Frame frame = playback.frame({}, last);
        EXPECT_EQ(frame.time, years * kYear);
        EXPECT_GT(frame.frame, 0);
        // Doubles of a hundred years are half a microsecond apart.
        EXPECT_NEAR(frame.time_delta, 1.0 / 60, 1e-6) << years << " years";
        EXPECT_NEAR(playback.frame({}, last - 5).time, frame.time - 5.0 / 60, 1e-5);
    }
    EXPECT_EQ(Playback{.end = kYear}.last_frame(), 1892160000);
}

// A simulation would make them up in its first frame, which lasts for ever.
TEST(Playback, FramesBeforeThoseThatAreCountedAreNotCaughtUpWith) {
    for (const int index : {0, 1, 120})
        EXPECT_LT(Playback{.end = 1e9}.frame({}, index).longest_catch_up, 0.1) << index;
    EXPECT_GT(Playback{.end = 1e6}.frame({}, 0).longest_catch_up, 1e6);
}

}  // namespace
}  // namespace glint::playback_test
