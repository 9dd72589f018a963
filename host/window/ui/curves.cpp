#include "window/ui/curves.h"

#include "window/ui/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace glint {
namespace {

using Point = InvariantCurve::Point;

// One diagram: a band between two values of each point, and lines that it should keep within.
struct Band {
    std::string name;
    double Point::*low;
    double Point::*high;
    std::vector<double> bounds;
};

class BandDiagram {
public:
    BandDiagram(const Theme& theme, const std::vector<Point>& points, const Band& band)
        : theme_(theme), points_(points), band_(band), list_(*ImGui::GetWindowDrawList()) {
        corner_ = ImGui::GetCursorScreenPos();
        size_ = {std::max(ImGui::GetContentRegionAvail().x, 1.0f), theme.px(64)};
        for (const double bound : band.bounds) include(bound);
        for (const Point& p : points) {
            include(p.*band.low);
            include(p.*band.high);
        }
        const double room = std::max(0.08 * (high_ - low_), 1e-30);
        low_ -= room;
        high_ += room;
    }

    void draw() {
        ImGui::InvisibleButton(band_.name.c_str(), size_);
        list_.AddRectFilled(corner_, {corner_.x + size_.x, corner_.y + size_.y}, colours::kField,
                            theme_.px(4));
        for (const double bound : band_.bounds)
            list_.AddLine({corner_.x, y(bound)}, {corner_.x + size_.x, y(bound)}, colours::kError,
                          theme_.px(1));
        draw_line(band_.low);
        if (band_.low != band_.high) draw_line(band_.high);
        list_.AddText({corner_.x + theme_.px(6), corner_.y + theme_.px(2)}, colours::kDim,
                      band_.name.c_str());
        const float t = (ImGui::GetMousePos().x - corner_.x) / size_.x;
        const auto last = static_cast<float>(points_.size() - 1);
        const Point& under = points_[static_cast<std::size_t>(std::clamp(t, 0.0f, 1.0f) * last)];
        tip(theme_, fmt::format("frame {}: {}", under.frame, words(under)));
    }

private:
    void include(double value) {
        low_ = std::min(low_, value);
        high_ = std::max(high_, value);
    }
    float x(std::size_t i) const {
        return corner_.x + size_.x * static_cast<float>(i) / static_cast<float>(points_.size() - 1);
    }
    float y(double value) const {
        return corner_.y + size_.y * static_cast<float>((high_ - value) / (high_ - low_));
    }
    void draw_line(double Point::*value) {
        for (std::size_t i = 0; i < points_.size(); ++i)
            list_.PathLineTo({x(i), y(points_[i].*value)});
        list_.PathStroke(colours::kAccent, ImDrawFlags_None, theme_.px(1));
    }
    std::string words(const Point& p) const {
        return band_.low == band_.high
                   ? fmt::format("{:.3g}", p.*band_.low)
                   : fmt::format("{:.4g} to {:.4g}", p.*band_.low, p.*band_.high);
    }

    const Theme& theme_;
    const std::vector<Point>& points_;
    const Band& band_;
    ImDrawList& list_;
    ImVec2 corner_, size_;
    double low_ = 1e300, high_ = -1e300;
};

}  // namespace

void invariant_curve(const Theme& theme, const InvariantCurve& curve) {
    if (curve.points.size() < 2) return;
    Band range{curve.buffer, &Point::low, &Point::high, {}};
    if (curve.bounded) range.bounds.assign(curve.bounded->begin(), curve.bounded->end());
    BandDiagram(theme, curve.points, range).draw();
    if (!curve.conserves) return;
    const Band drift{fmt::format("sum of {} off by", curve.buffer),
                     &Point::drift,
                     &Point::drift,
                     {*curve.conserves}};
    BandDiagram(theme, curve.points, drift).draw();
}

}  // namespace glint
