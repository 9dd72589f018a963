// Texts beside the points of a diagram: none hides another.
#include "measure/study/labels.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace glint {
namespace {

constexpr Box kArea{{0.0, 0.0}, {600.0, 300.0}};

LabelledPoint point(double x, double y, const std::string& text) {
    return {.at = {x, y}, .low = x - 20.0, .high = x + 20.0, .text = text};
}

Box box_of(const PlacedLine& line) {
    const double half = 0.5 * kTextHeight;
    return {{line.at.x, line.at.y - half}, {line.at.x + text_width(line.text), line.at.y + half}};
}

TEST(StudyLabels, HideNoOtherAndNoPointAndStayInside) {
    std::vector<LabelledPoint> points;
    for (int i = 0; i < 12; ++i)
        points.push_back(
            point(550.0 - 9.0 * i, 20.0 + 6.0 * (i % 5), "samples=" + std::to_string(i)));
    const std::vector<PlacedLine> lines = place_labels(points, kArea);
    ASSERT_GE(lines.size(), 5u);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const Box box = box_of(lines[i]);
        EXPECT_GE(box.low.x, kArea.low.x);
        EXPECT_LE(box.high.x, kArea.high.x);
        EXPECT_GE(box.low.y, kArea.low.y);
        for (const LabelledPoint& p : points)
            EXPECT_FALSE(box.meets({p.at - 1.0, p.at + 1.0})) << lines[i].text;
        for (std::size_t k = 0; k < i; ++k)
            EXPECT_FALSE(box.meets(box_of(lines[k]))) << lines[i].text << " on " << lines[k].text;
    }
}

TEST(StudyLabels, ThatHaveNoPlaceAreLeftOutTheLastFirst) {
    const Box small{{0.0, 0.0}, {120.0, 40.0}};
    const std::vector<LabelledPoint> points = {point(20.0, 20.0, "a star"), point(22.0, 22.0, "b")};
    const std::vector<PlacedLine> lines = place_labels(points, small);
    ASSERT_FALSE(lines.empty());
    EXPECT_EQ(lines[0].text, "a star");
    EXPECT_TRUE(
        place_labels(std::vector{point(5.0, 5.0, "as wide as nothing here is")}, small).empty());
}

TEST(StudyLabels, WithManyWordsStandInSeveralLines) {
    const auto lines = place_labels(
        std::vector{point(100.0, 150.0, "reflections=traced reflectionSteps=64 shadowSamples=64")},
        kArea);
    ASSERT_EQ(lines.size(), 3u);
    EXPECT_EQ(lines[0].text, "reflections=traced");
    EXPECT_EQ(lines[0].at.x, lines[2].at.x);
    EXPECT_EQ(lines[0].at.y - lines[1].at.y, kTextHeight);
}

}  // namespace
}  // namespace glint
