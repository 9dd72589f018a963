#include "measure/study/labels.h"

#include <algorithm>
#include <optional>
#include <sstream>

namespace glint {
namespace {

constexpr double kCharacter = 7.8;   // pixels, on average
constexpr double kLongLine = 230.0;  // pixels, beyond which a text goes on in another line
constexpr double kDot = 4.0;         // half of what a point takes
constexpr double kBar = 2.0;         // half of its bar's height
constexpr double kAside = 8.0;       // from a point to its text
constexpr double kSteps[] = {1, -1, 0, 2, -2, 3, -3};  // up and down, in heights

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        const bool fits = !lines.empty() && text_width(lines.back() + " " + word) <= kLongLine;
        if (fits)
            lines.back() += " " + word;
        else
            lines.push_back(word);
    }
    return lines;
}

Box round(const LabelledPoint& point) {
    return {point.at - kDot, point.at + kDot};
}

Box bar_of(const LabelledPoint& point) {
    return {{point.low, point.at.y - kBar}, {point.high, point.at.y + kBar}};
}

// Where a text of this size may stand beside a point, the best first.
std::vector<Box> places(const glm::dvec2& at, const glm::dvec2& size) {
    std::vector<Box> list;
    for (const double step : kSteps) {
        for (const double left : {at.x + kAside, at.x - kAside - size.x, at.x - 0.5 * size.x}) {
            const double middle = at.y + 0.5 * step * (size.y + 2.0 * kDot);
            list.push_back({{left, middle - 0.5 * size.y}, {left + size.x, middle + 0.5 * size.y}});
        }
    }
    return list;
}

bool is_inside(const Box& box, const Box& area) {
    return box.low.x >= area.low.x && box.low.y >= area.low.y && box.high.x <= area.high.x &&
           box.high.y <= area.high.y;
}

}  // namespace

double text_width(const std::string& text) {
    return kCharacter * static_cast<double>(text.size());
}

std::vector<PlacedLine> place_labels(std::span<const LabelledPoint> points, const Box& area) {
    std::vector<Box> taken, bars;
    for (const LabelledPoint& point : points) {
        taken.push_back(round(point));
        bars.push_back(bar_of(point));
    }
    std::vector<PlacedLine> placed;
    for (const LabelledPoint& point : points) {
        const std::vector<std::string> lines = lines_of(point.text);
        if (lines.empty()) continue;
        glm::dvec2 size{0.0, kTextHeight * static_cast<double>(lines.size())};
        for (const std::string& line : lines) size.x = std::max(size.x, text_width(line));
        std::optional<Box> found, crossing;
        for (const Box& box : places(point.at, size)) {
            const auto meets = [&](const Box& other) { return box.meets(other); };
            if (found || !is_inside(box, area) || std::ranges::any_of(taken, meets)) continue;
            if (!std::ranges::any_of(bars, meets))
                found = box;
            else if (!crossing)
                crossing = box;
        }
        if (!found) found = crossing;
        if (!found) continue;
        taken.push_back(*found);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            const double down = kTextHeight * (static_cast<double>(i) + 0.5);
            placed.push_back({{found->low.x, found->high.y - down}, lines[i]});
        }
    }
    return placed;
}

}  // namespace glint
