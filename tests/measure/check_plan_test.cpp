// How long a check waits for a frame.
#include "measure/check/process.h"

#include <gtest/gtest.h>

namespace glint {
namespace {

TEST(FrameWait, IsBoundedByTheSecondsThatAreLeftAndByTheHang) {
    EXPECT_EQ(frame_wait_seconds(60.0, 110.0, 100.0), 60.0);
    EXPECT_EQ(frame_wait_seconds(60.0, 110.0, 25.0), 25.0);
    EXPECT_EQ(frame_wait_seconds(60.0, 10.0, 10.0), 10.0);
    EXPECT_EQ(frame_wait_seconds(60.0, 10.0, 0.001), 10.0);  // the last frame has its chance
    EXPECT_EQ(frame_wait_seconds(1.0, 10.0, 10.0), 1.0);
    EXPECT_EQ(frame_wait_seconds(60.0, 0.0, 0.0), 60.0);  // no limit
}

}  // namespace
}  // namespace glint
