#include "measure/study/result.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using glint::Clock;

glint::StudyRow row(double wall, double processor) {
    return {.times = {.wall = {wall}, .gpu = {wall}, .processor = {processor}}};
}

Clock clock_of(const glint::StudyRow& a, const glint::StudyRow& b) {
    glint::Study study;
    study.rows = {a, b};
    glint::judge(study, {}, true);
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

using glint::own_error;
using glint::SecondWork;

TEST(StudyOwnError, OfTwoSeedsIsSharedByBoth) {
    EXPECT_DOUBLE_EQ(own_error(std::sqrt(2.0), {SecondWork::Kind::seed, 1.0}, 0.5), 1.0);
}

// 1/n - 1/2n = 1/2n: of n samples that 2n contain half of the variance is seen.
TEST(StudyOwnError, OfSamplesThatTheSecondContainsIsMoreThanIsSeen) {
    EXPECT_DOUBLE_EQ(own_error(std::sqrt(0.5), {SecondWork::Kind::more, 2.0}, 0.5), 1.0);
}

TEST(StudyOwnError, ThatIsMeasuredIsThisShareOfTheDifference) {
    EXPECT_DOUBLE_EQ(own_error(0.5, {SecondWork::Kind::share, 0.25}, 1.0), 0.125);
}

TEST(StudyOwnError, OfAnOrderIsWhatTheSecondsStepLeaves) {
    EXPECT_DOUBLE_EQ(own_error(0.5, {SecondWork::Kind::more, 2.0}, 1.0), 1.0);
    EXPECT_DOUBLE_EQ(own_error(15.0 / 16, {SecondWork::Kind::more, 2.0}, 4.0), 1.0);
    EXPECT_DOUBLE_EQ(own_error(1.0, {SecondWork::Kind::more, 0.5}, 1.0), 1.0) << "of half the work";
    EXPECT_DOUBLE_EQ(own_error(0.5, {SecondWork::Kind::more, 2.0}, {}), 1.0) << "as of order 1";
}

// What several views have in common is judged again.
TEST(StudyNotes, StandOnceHoweverOftenAStudyIsJudged) {
    glint::Study study;
    study.rows = {row(1.0, 1.0), row(2.0, 2.0)};
    for (glint::StudyRow& one : study.rows) one.error = glint::Difference{.rmse = 0.01};
    study.reference_error = glint::Difference{.rmse = 0.01};
    const glint::Knob knob{.notes = {"assumed"}};
    glint::judge(study, knob, true);
    EXPECT_EQ(study.notes.size(), 2u);
    glint::judge(study, knob, true);
    EXPECT_EQ(study.notes.size(), 2u);
}

}  // namespace
