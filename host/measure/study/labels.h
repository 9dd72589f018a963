// Where the texts beside the points of a diagram stand, so that none hides another.
#pragma once

#include <glm/vec2.hpp>

#include <span>
#include <string>
#include <vector>

namespace glint {

// All in pixels of a diagram, y up.
struct Box {
    glm::dvec2 low, high;
    bool meets(const Box& b) const {
        return low.x < b.high.x && b.low.x < high.x && low.y < b.high.y && b.low.y < high.y;
    }
};

struct LabelledPoint {
    glm::dvec2 at;
    double low, high;  // x, from where to where its bar goes
    std::string text;  // "": none; its words may be set in several lines
};

// One line of a text: `at` is the middle of its left end.
struct PlacedLine {
    glm::dvec2 at;
    std::string text;
};

// The width of a text in the diagrams' type, at most; of DejaVu Sans, which is a wide one.
double text_width(const std::string& text);
constexpr double kTextHeight = 15.0;  // of a line

// The first points choose first. A text that has no place inside `area` beside its point, free of
// points and of other texts, is left out; one that crosses a bar is so only where it must.
std::vector<PlacedLine> place_labels(std::span<const LabelledPoint> points, const Box& area);

}  // namespace glint
