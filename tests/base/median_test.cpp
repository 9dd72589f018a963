#include "base/median.h"

#include <gtest/gtest.h>

namespace glint::median_test {
namespace {

TEST(Median, IsTheMiddleAndHalfWayBetweenTheTwoOfAnEvenNumber) {
    EXPECT_EQ(median_of({}), 0.0);
    EXPECT_EQ(median_of({3.0}), 3.0);
    EXPECT_EQ(median_of({900.0, 1.0, 2.0}), 2.0);
    EXPECT_EQ(median_of({4.0, 900.0, 1.0, 2.0}), 3.0);
}

}  // namespace
}  // namespace glint::median_test
