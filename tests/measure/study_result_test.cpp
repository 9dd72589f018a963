#include "measure/study/result.h"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

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

// The other row was told apart after a round; then the machine became half as fast.
TEST(StudyTimes, AreBesideEachOtherWhateverRoundsARowWasIn) {
    glint::Study study;
    study.rows = {row(1.0, 1.0), row(0.9, 0.9)};
    study.rows[0].is_preset = true;
    for (std::vector<double>* times : {&study.rows[0].times.wall, &study.rows[0].times.processor})
        times->resize(60, 2.0);
    glint::judge(study, {}, true);
    EXPECT_DOUBLE_EQ(study.rows[0].ms.median, 2.0);
    EXPECT_DOUBLE_EQ(study.rows[1].ms.median, 1.8);
    EXPECT_DOUBLE_EQ(study.rows[1].ms.high, 1.8);
}

TEST(StudyOwnError, OfTwoSeedsIsSharedByBoth) {
    EXPECT_DOUBLE_EQ(own_error(std::sqrt(2.0), {SecondWork::Kind::seed, 1.0}, {.order = 0.5}), 1.0);
}

// 1/n - 1/2n = 1/2n: of n samples that 2n contain half of the variance is seen.
TEST(StudyOwnError, OfSamplesThatTheSecondContainsIsMoreThanIsSeen) {
    EXPECT_DOUBLE_EQ(own_error(std::sqrt(0.5), {SecondWork::Kind::more, 2.0}, {.order = 0.5}), 1.0);
}

TEST(StudyOwnError, ThatIsMeasuredIsThisShareOfTheDifference) {
    EXPECT_DOUBLE_EQ(own_error(0.5, {SecondWork::Kind::share, 0.25}, {.order = 1.0}), 0.125);
}

TEST(StudyOwnError, OfAnOrderIsWhatTheSecondsStepLeaves) {
    EXPECT_DOUBLE_EQ(own_error(0.5, {SecondWork::Kind::more, 2.0}, {.order = 1.0}), 1.0);
    EXPECT_DOUBLE_EQ(own_error(15.0 / 16, {SecondWork::Kind::more, 2.0}, {.order = 4.0}), 1.0);
    EXPECT_DOUBLE_EQ(own_error(1.0, {SecondWork::Kind::more, 0.5}, {.order = 1.0}), 1.0)
        << "of half the work";
    EXPECT_DOUBLE_EQ(own_error(0.5, {SecondWork::Kind::more, 2.0}, {}), 1.0) << "as of order 1";
}

// The preset's own row and another, each so far from the reference, which claims to be off by
// `own`.
bool is_told_nearer(double row_error, double own_error, double own, std::vector<double> apart) {
    glint::Study study;
    study.rows = {row(1.0, 1.0), row(1.0, 1.0)};
    study.rows[0].is_preset = true;
    study.rows[0].error = glint::Difference{.rmse = own_error};
    study.rows[1].error = glint::Difference{.rmse = row_error};
    study.rows[1].apart = std::move(apart);
    study.reference_error = glint::Difference{.rmse = own};
    glint::judge(study, {.second_work = {SecondWork::Kind::another, 1.0}}, true);
    return study.rows[1].nearer;
}

TEST(StudyNearer, IsToldOfPicturesThatDifferByLessThanTheReferenceMayHide) {
    EXPECT_FALSE(is_told_nearer(1.4, 1.7, 0.7, {})) << "each may be off by all of it";
    EXPECT_FALSE(is_told_nearer(1.4, 1.7, 0.7, {1.6, 0.0})) << "they have little in common";
    EXPECT_TRUE(is_told_nearer(1.4, 1.7, 0.7, {0.6, 0.0})) << "most of their errors is the same";
    EXPECT_FALSE(is_told_nearer(1.7, 1.4, 0.7, {0.6, 0.0}));
    EXPECT_TRUE(is_told_nearer(1.4, 1.7, 0.0, {3.1, 0.0})) << "to the truth itself";
}

// The worst truth for the verdict: the reference is off along what the two pictures differ by.
TEST(StudyNearer, IsNeverWrongWhereverTheTruthLiesWithinTheReferencesError) {
    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    int told = 0, told_apart_from_errors_alone = 0;
    for (int i = 0; i < 2000; ++i) {
        // Two pictures of which much is the same, as seen from the reference.
        const glm::dvec3 shared(normal(random), normal(random), normal(random));
        const glm::dvec3 a = shared + 0.2 * glm::dvec3(normal(random), normal(random), 0.0);
        const glm::dvec3 b = shared + 0.2 * glm::dvec3(normal(random), normal(random), 0.0);
        const double off = 0.1 + 0.1 * (i % 10);
        const glm::dvec3 truth = off * glm::normalize(a - b);
        const bool nearer =
            is_told_nearer(glm::length(a), glm::length(b), off, {glm::distance(a, b), 0.0});
        told += nearer;
        told_apart_from_errors_alone += is_told_nearer(glm::length(a), glm::length(b), off, {});
        if (!nearer) continue;
        ASSERT_LT(glm::distance(a, -truth), glm::distance(b, -truth)) << i;
        ASSERT_LT(glm::distance(a, truth), glm::distance(b, truth)) << i;
    }
    EXPECT_GT(told, 3 * told_apart_from_errors_alone);
}

// Four rows of order one beside a reference of which so many pixels are no numbers.
glint::Study beside_reference(std::size_t not_finite) {
    glint::Study study{.reference = "4096", .second = "8192"};
    for (const double work : {1.0, 2.0, 4.0, 8.0}) {
        study.rows.push_back(row(work, work));
        study.rows.back().work = work;
        study.rows.back().error = glint::Difference{.rmse = 0.1 / work, .max = 0.1};
    }
    study.reference_not_finite = not_finite;
    if (not_finite == 0) study.reference_error = glint::Difference{.rmse = 1e-5, .max = 1e-5};
    glint::judge(study, {.second_work = glint::kTwiceTheWork}, true);
    return study;
}

// Explicit Euler blows up where its steps are too long, and is of order one where they are not.
TEST(StudyOrder, IsThatOfTheRowsThatAreStable) {
    glint::Study study{.reference = "4096", .second = "8192"};
    const double errors[] = {40.0, 9.0, 2.0, 0.012, 0.0051, 0.0025, 0.00124};
    double work = 1.0;
    for (const double error : errors) {
        study.rows.push_back(row(work, work));
        study.rows.back().work = work;
        study.rows.back().error = glint::Difference{.rmse = error, .max = error};
        work *= 2.0;
    }
    for (glint::StudyRow& one : study.rows)  // the one before is off by twice as much
        one.apart.assign(study.rows.size(), one.error->rmse);
    study.reference_error = glint::Difference{.rmse = 1e-6, .max = 1e-6};
    glint::judge(study, {.second_work = glint::kTwiceTheWork}, true);
    ASSERT_TRUE(study.order);
    EXPECT_NEAR(*study.order, 1.05, 0.1);
    EXPECT_TRUE(study.findings.empty()) << study.findings.front();
}

TEST(StudyReferenceThatIsNotFinite, IsToldAndNothingIsJudgedByIt) {
    const glint::Study sound = beside_reference(0), broken = beside_reference(7);
    EXPECT_TRUE(sound.converges && sound.order && sound.findings.empty());
    EXPECT_FALSE(broken.converges);
    EXPECT_FALSE(broken.order);
    ASSERT_EQ(broken.findings.size(), 1u);
    EXPECT_NE(broken.findings[0].find("4096, is not finite in 7 pixels"), std::string::npos);
    for (const glint::StudyRow& one : broken.rows) {
        EXPECT_TRUE(one.failed.empty());
        EXPECT_FALSE(one.pareto || one.nearer || one.near_reference);
    }
    EXPECT_NE(glint::to_table(broken).find("own error is not known: 7 of its pixels"),
              std::string::npos);
}

TEST(StudyReferenceThatIsNotFinite, IsNoneToMeasureAnotherBy) {
    glint::Study study = beside_reference(0);
    study.reference_error = glint::Difference{.rmse = 0.0, .not_finite = 5};
    glint::judge(study, {.second_work = glint::kTwiceTheWork}, true);
    EXPECT_TRUE(study.converges) << "the rows near a reference that is finite";
    EXPECT_EQ(study.own_error, 0.0);
    ASSERT_EQ(study.findings.size(), 1u);
    EXPECT_NE(study.findings[0].find("8192, is not finite in 5 pixels"), std::string::npos);
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
