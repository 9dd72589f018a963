// What a study keeps of the simulations that it has played.
#include "measure/study/measure.h"

#include <gtest/gtest.h>

namespace glint {
namespace {

PassState state_of(std::size_t bytes) {
    return {.pass = "waves", .shape = {}, .steps_done = 0, .bytes = std::vector<std::byte>(bytes)};
}

TEST(StudyPlayed, GoesOnFromWhatHasComeTheFarthestAndNotTooFar) {
    Played played({true, false});
    played.keep({"a", 60, {state_of(1)}});
    played.keep({"a", 120, {state_of(2)}});
    played.keep({"b", 90, {state_of(3)}});
    ASSERT_NE(played.find("a", 200), nullptr);
    EXPECT_EQ(played.find("a", 200)->frames, 120);
    EXPECT_EQ(played.find("a", 119)->frames, 60);
    EXPECT_EQ(played.find("a", 59), nullptr);
    EXPECT_EQ(played.find("c", 200), nullptr);
}

TEST(StudyPlayed, ForgetsTheOldestWhereTheyTakeTooMuchMemory) {
    Played played({});
    for (int i = 1; i <= 3; ++i) played.keep({"a", i, {state_of(std::size_t{100} << 20)}});
    EXPECT_EQ(played.find("a", 1), nullptr);
    EXPECT_EQ(played.find("a", 2)->frames, 2);
    EXPECT_EQ(played.find("a", 3)->frames, 3);
}

}  // namespace
}  // namespace glint
