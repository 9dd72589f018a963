// Programs that are slow for where they happen to stand in memory are compiled again.
#include "measure/study/placement.h"

#include <gtest/gtest.h>

#include <random>
#include <utility>
#include <vector>

namespace glint::study_placement_test {
namespace {

// A driver that puts programs in places of which it is known how slow they are.
class Driver {
public:
    explicit Driver(std::vector<double> paces, double noise = 0.0)
        : paces_(std::move(paces)), noise_(noise) {}

    int find() {
        return find_quick_place({.compile_again =
                                     [&] {
                                         aside_ = drawing_;
                                         drawing_ = paces_[++compiled_ % paces_.size()];
                                     },
                                 .swap = [&] { std::swap(aside_, drawing_); },
                                 .frame_ms =
                                     [&] {
                                         std::normal_distribution<double> wavers(1.0, noise_);
                                         return 10.0 * drawing_ * wavers(random_);
                                     }});
    }
    double pace() const { return drawing_; }

private:
    std::vector<double> paces_;
    double noise_;
    std::size_t compiled_ = 0;
    double drawing_ = paces_[0], aside_ = 0.0;
    std::mt19937 random_{1};
};

TEST(StudyPlacement, AProgramStaysWhereThreeAreAlike) {
    Driver driver({1.0, 1.0, 1.0, 9.0});
    EXPECT_EQ(driver.find(), 2);
    EXPECT_EQ(driver.pace(), 1.0);
}

TEST(StudyPlacement, TheQuickestOfSeveralPlacesIsKept) {
    for (const std::vector<double>& paces : {std::vector{1.12, 1.0, 1.0},
                                             {1.0, 1.12, 1.0},
                                             {1.0, 1.0, 1.12},
                                             {1.2, 1.12, 1.0, 1.0},
                                             {1.05, 1.05, 1.0, 1.005}}) {
        Driver driver(paces);
        driver.find();
        EXPECT_LE(driver.pace(), 1.01) << testing::PrintToString(paces);
    }
}

TEST(StudyPlacement, ADriverOfWhichNoTwoPlacesAreAlikeIsGivenUpOn) {
    Driver driver({1.5, 1.0, 1.3, 1.1, 1.2, 0.5});
    EXPECT_EQ(driver.find(), 4);
    EXPECT_EQ(driver.pace(), 1.0);
}

// As they were found on llvmpipe, on a machine whose frames waver by a hundredth.
TEST(StudyPlacement, OfAThousandProgramsHardlyOneStaysInASlowPlace) {
    std::mt19937 random(7);
    int slow = 0, compiled = 0;
    for (int run = 0; run < 1000; ++run) {
        std::vector<double> paces;
        for (int i = 0; i < 8; ++i)
            paces.push_back(random() % 7 == 0 ? 1.03 + 0.17 * static_cast<double>(random()) /
                                                           static_cast<double>(std::mt19937::max())
                                              : 1.0);
        Driver driver(paces, 0.01);
        compiled += driver.find();
        slow += driver.pace() > 1.0;
    }
    EXPECT_LE(slow, 15);
    EXPECT_LE(compiled, 2500);
}

}  // namespace
}  // namespace glint::study_placement_test
