// A value in every pixel as a picture.
#include "window/live/value_picture.h"

#include <gtest/gtest.h>

namespace glint::value_picture_test {
namespace {

// One column, the largest value at the bottom.
ValueMap column() {
    return {.size = {1, 3},
            .components = 1,
            .values = {glm::vec4(2.0f), glm::vec4(1.0f), glm::vec4(0.0f)},
            .reached = {std::byte{1}, std::byte{1}, std::byte{0}}};
}

TEST(ValuePicture, StandsAsTheSceneDoes) {
    const ValueMap map = column();
    const ValueFacts facts = facts_of(map);
    EXPECT_EQ(facts.unreached, 1u);
    for (const Image& image : {picture_of(map, facts, ValueLook::range), heat_of(map, facts)}) {
        ASSERT_EQ(image.pixels.size(), 12u);
        EXPECT_EQ(image.pixels[0], std::byte{255}) << "rows of an image run bottom up";
        EXPECT_LT(image.pixels[8], std::byte{64}) << "not reached";
    }
}

}  // namespace
}  // namespace glint::value_picture_test
