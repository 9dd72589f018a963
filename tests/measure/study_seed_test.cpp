// Whether another seed tells how far a reference is from the truth.
#include "measure/study/seed.h"

#include <gtest/gtest.h>

#include <cmath>

namespace glint::study_seed_test {
namespace {

constexpr double kReference = 1024.0;

// Rows of these works, each so far off the reference; two seeds are apart by `seeds`.
bool moves_something_else(double seeds, double (*error)(double work), bool named = false) {
    Study study;
    study.reference_error = Difference{.rmse = seeds, .max = seeds};
    for (double work = 1.0; work <= 512.0; work *= 2.0)
        study.rows.push_back({.work = work, .error = Difference{.rmse = error(work), .max = 1.0}});
    study.rows.push_back({.work = 900.0, .error = Difference{.rmse = 1e-9, .max = 1.0}});
    study.rows.push_back({.work = 512.0, .error = Difference{.rmse = 0.0, .max = 0.0}});
    Knob knob{.name = "steps", .reference = {.work = kReference}};
    knob.second = knob.more = knob.reference;
    knob.second_work = {SecondWork::Kind::seed, 1.0};
    knob.names_second = named;
    return seed_moves_something_else(study, knob);
}

double of_samples(double work) {
    return std::sqrt(1.0 / work - 1.0 / kReference);
}

double of_midpoints(double work) {
    return 1.0 / (work * work);
}

TEST(StudySeed, MovesSomethingElseThanAMethodThatIsFarNearer) {
    EXPECT_TRUE(moves_something_else(0.01, of_midpoints));
    EXPECT_FALSE(moves_something_else(0.01, of_midpoints, true)) << "--second names it";
    EXPECT_FALSE(moves_something_else(1e-7, of_midpoints)) << "the rows are farther off";
    EXPECT_FALSE(moves_something_else(std::sqrt(2.0 / kReference), of_samples));
}

}  // namespace
}  // namespace glint::study_seed_test
