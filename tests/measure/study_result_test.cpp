#include "measure/study/result.h"

#include <gtest/gtest.h>

namespace {

using glint::Clock;

glint::StudyRow row(double wall, double processor) {
    return {.times = {.wall = {wall}, .gpu = {wall}, .processor = {processor}}};
}

Clock clock_of(const glint::StudyRow& a, const glint::StudyRow& b) {
    glint::Study study;
    study.rows = {a, b};
    glint::judge(study, true, true);
    return study.clock;
}

TEST(StudyClock, IsTheWallWhereAllRowsHadTheSameProcessors) {
    EXPECT_EQ(clock_of(row(40.0, 78.0), row(20.0, 38.0)), Clock::wall);
}

TEST(StudyClock, IsTheProcessorsWhereOthersTookSomeAway) {
    EXPECT_EQ(clock_of(row(40.0, 78.0), row(30.0, 38.0)), Clock::processor);
}

// A frame that draws next to nothing is one processor's work on the quietest machine.
TEST(StudyClock, IsTheWallBesideAFrameTooShortToBeShared) {
    EXPECT_EQ(clock_of(row(40.0, 78.0), row(1.10, 1.15)), Clock::wall);
}

}  // namespace
