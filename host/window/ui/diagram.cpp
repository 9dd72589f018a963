#include "window/ui/diagram.h"

#include "window/ui/number_text.h"
#include "window/ui/widgets.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace glint {
namespace {

constexpr ImU32 kGrid = IM_COL32(255, 255, 255, 18);
constexpr ImU32 kBand = IM_COL32(255, 128, 118, 30);

// Decades between two ends, over a length of the screen.
struct Axis {
    double low = 1.0, high = 1.0;
    float begin = 0.0f, end = 0.0f;  // screen units

    float at(double value) const {
        const double t = std::log(value / low) / std::log(high / low);
        return begin + static_cast<float>(std::clamp(t, 0.0, 1.0)) * (end - begin);
    }
};

bool has_point(const StudyRow& row) {
    return row.failed.empty() && row.error && row.ms.median > 0.0;
}

// Room round what is shown, and never less than a bit of a decade.
Axis axis_over(const std::vector<double>& values, double room) {
    Axis axis{1.0, 10.0};
    if (values.empty()) return axis;
    axis.low = *std::ranges::min_element(values) / room;
    axis.high = *std::ranges::max_element(values) * room;
    return axis;
}

// All of an axis in one way: as plain numbers, or as powers of ten.
std::string tick_text(const Axis& axis, double value) {
    const bool plain = axis.low > 9e-4 && axis.high < 1e5;
    return plain ? fmt::format("{:.3g}", value) : power_text(value);
}

class Diagram {
public:
    Diagram(const Theme& theme, const Study& study, const DiagramLook& look, ImVec2 corner)
        : theme_(theme),
          study_(study),
          look_(look),
          corner_(corner),
          list_(*ImGui::GetWindowDrawList()) {
        find_axes();
    }

    std::optional<std::size_t> row_under(ImVec2 mouse) const;
    void draw();

private:
    void find_axes();
    void draw_ground();
    void draw_ticks();
    void draw_reference_error();
    void draw_lines();
    void draw_point(std::size_t row);
    void draw_label(std::size_t row);
    ImVec2 place(const StudyRow& row) const {
        // On a logarithmic axis no error has no place: it stands on the ground.
        return {x_.at(row.ms.median), row.error->rmse > 0.0 ? y_.at(row.error->rmse) : y_.begin};
    }
    float line() const { return ImGui::GetTextLineHeight(); }
    float end_x() const { return corner_.x + look_.size.x; }
    float end_y() const { return corner_.y + look_.size.y; }

    struct Box {
        ImVec2 low, high;
        bool overlaps(const Box& other) const {
            return low.x < other.high.x && other.low.x < high.x && low.y < other.high.y &&
                   other.low.y < high.y;
        }
    };

    const Theme& theme_;
    const Study& study_;
    const DiagramLook& look_;
    ImVec2 corner_;
    ImDrawList& list_;
    Axis x_, y_;
    std::vector<Box> taken_;  // by labels and points
};

void Diagram::find_axes() {
    std::vector<double> ms, errors;
    for (const StudyRow& row : study_.rows) {
        if (!has_point(row)) continue;
        ms.push_back(row.ms.median);
        if (row.error->rmse > 0.0) errors.push_back(row.error->rmse);
    }
    if (study_.reference_rmse() > 0.0) errors.push_back(study_.reference_rmse());
    x_ = axis_over(ms, 1.3);
    y_ = axis_over(errors, 2.5);
    float widest = ImGui::CalcTextSize("10\u207b\u2074").x;
    for (const double value : round_ticks(y_.low, y_.high))
        widest = std::max(widest, ImGui::CalcTextSize(tick_text(y_, value).c_str()).x);
    x_.begin = corner_.x + widest + theme_.px(10);
    x_.end = end_x() - theme_.px(10);
    y_.begin = end_y() - 2 * line() - theme_.px(6);
    y_.end = corner_.y + std::round(1.5f * line()) + theme_.px(6);
}

void Diagram::draw_ground() {
    list_.AddRectFilled(corner_, {end_x(), end_y()}, colours::kField, theme_.px(4));
    list_.AddRectFilled({x_.begin, y_.end}, {x_.end, y_.begin}, IM_COL32(24, 26, 29, 255));
    const float top = corner_.y + theme_.px(4);
    list_.AddText({corner_.x + theme_.px(6), top}, colours::kDim, "RMSE");
    const char* below = study_.knob == "settle" ? "ms, all frames" : "ms a frame";
    const float width = ImGui::CalcTextSize(below).x;
    list_.AddText({x_.end - width, end_y() - line() - theme_.px(2)}, colours::kDim, below);
}

void Diagram::draw_ticks() {
    float free_from = -std::numeric_limits<float>::max();
    for (const double value : round_ticks(x_.low, x_.high)) {
        const float x = x_.at(value);
        list_.AddLine({x, y_.end}, {x, y_.begin}, kGrid);
        const std::string text = tick_text(x_, value);
        const float half = 0.5f * ImGui::CalcTextSize(text.c_str()).x;
        if (x - half < free_from || x + half > end_x()) continue;
        list_.AddText({x - half, y_.begin + theme_.px(3)}, colours::kDim, text.c_str());
        free_from = x + half + theme_.px(8);
    }
    float free_to = std::numeric_limits<float>::max();
    for (const double value : round_ticks(y_.low, y_.high)) {
        const float y = y_.at(value);
        list_.AddLine({x_.begin, y}, {x_.end, y}, kGrid);
        if (y + 0.5f * line() > free_to) continue;
        const std::string text = tick_text(y_, value);
        const float width = ImGui::CalcTextSize(text.c_str()).x;
        list_.AddText({x_.begin - width - theme_.px(4), y - 0.5f * line()}, colours::kDim,
                      text.c_str());
        free_to = y - 0.5f * line() - theme_.px(2);
    }
}

// What lies in the band cannot be told from the reference.
void Diagram::draw_reference_error() {
    if (study_.reference_rmse() <= 0.0) return;
    const float y = y_.at(study_.reference_rmse());
    list_.AddRectFilled({x_.begin, y}, {x_.end, y_.begin}, kBand);
    list_.AddLine({x_.begin, y}, {x_.end, y}, colours::kError, theme_.px(1));
    const ImVec2 at{x_.begin + theme_.px(6), y + theme_.px(2)};
    text_within(list_, at, x_.end - at.x, colours::kDim, "error of the reference");
    taken_.push_back({at, {at.x + ImGui::CalcTextSize("error of the reference").x, at.y + line()}});
}

// The order of the values, faint; and over it the frontier that no row beats.
void Diagram::draw_lines() {
    std::vector<const StudyRow*> frontier;
    for (const StudyRow& row : study_.rows) {
        if (!has_point(row)) continue;
        list_.PathLineTo(place(row));
        if (row.pareto) frontier.push_back(&row);
    }
    list_.PathStroke(IM_COL32(160, 166, 175, 90), ImDrawFlags_None, theme_.px(1));
    std::ranges::sort(frontier, {}, [](const StudyRow* row) { return row->ms.median; });
    for (const StudyRow* row : frontier) list_.PathLineTo(place(*row));
    list_.PathStroke(colours::kWarning, ImDrawFlags_None, theme_.px(2));
}

void Diagram::draw_point(std::size_t index) {
    const StudyRow& row = study_.rows[index];
    if (!has_point(row)) return;
    const ImVec2 at = place(row);
    const bool hovered = look_.hovered == index;
    const float radius = theme_.px(hovered ? 6 : 4.5f);
    const ImU32 colour = row.pareto ? colours::kAccent : colours::kDim;
    list_.AddLine({x_.at(row.ms.low), at.y}, {x_.at(row.ms.high), at.y}, colour, theme_.px(1));
    if (row.is_reference || row.error->rmse <= 0.0) {
        const float s = radius + theme_.px(1);
        list_.AddTriangleFilled({at.x - s, at.y - s}, {at.x + s, at.y - s}, {at.x, at.y + s},
                                colour);
    } else {
        list_.AddCircleFilled(at, radius, colour);
    }
    // Whoever is within the reference's own error has a hole: the figure says little.
    if (row.near_reference) list_.AddCircleFilled(at, 0.45f * radius, colours::kField);
    if (look_.current == index || look_.chosen == index)
        list_.AddCircle(at, radius + theme_.px(3), colours::kText, 0,
                        theme_.px(look_.chosen == index ? 2 : 1));
    taken_.push_back({{at.x - radius, at.y - radius}, {at.x + radius, at.y + radius}});
}

// Beside its point, at the first side where it hides nothing; else it is left to the tooltip.
void Diagram::draw_label(std::size_t index) {
    const StudyRow& row = study_.rows[index];
    if (!has_point(row)) return;
    const ImVec2 at = place(row), size = ImGui::CalcTextSize(row.value.c_str());
    const float away = theme_.px(8);
    const std::array<ImVec2, 4> corners = {ImVec2{at.x + away, at.y - size.y},
                                           {at.x - away - size.x, at.y - size.y},
                                           {at.x + away, at.y},
                                           {at.x - away - size.x, at.y}};
    for (const ImVec2& corner : corners) {
        const Box box{corner, {corner.x + size.x, corner.y + size.y}};
        const bool inside = box.low.x >= x_.begin && box.high.x <= x_.end && box.low.y >= y_.end &&
                            box.high.y <= y_.begin;
        if (!inside ||
            std::ranges::any_of(taken_, [&](const Box& other) { return box.overlaps(other); }))
            continue;
        list_.AddText(corner, row.pareto ? colours::kText : colours::kDim, row.value.c_str());
        taken_.push_back(box);
        return;
    }
}

void Diagram::draw() {
    draw_ground();
    draw_ticks();
    draw_reference_error();
    list_.PushClipRect(corner_, {end_x(), end_y()}, true);
    draw_lines();
    for (std::size_t i = 0; i < study_.rows.size(); ++i) draw_point(i);
    for (const bool pareto : {true, false})
        for (std::size_t i = 0; i < study_.rows.size(); ++i)
            if (study_.rows[i].pareto == pareto) draw_label(i);
    list_.PopClipRect();
}

std::optional<std::size_t> Diagram::row_under(ImVec2 mouse) const {
    std::optional<std::size_t> nearest;
    float least = theme_.px(14);
    for (std::size_t i = 0; i < study_.rows.size(); ++i) {
        if (!has_point(study_.rows[i])) continue;
        const ImVec2 at = place(study_.rows[i]);
        const float distance = std::hypot(at.x - mouse.x, at.y - mouse.y);
        if (distance >= least) continue;
        least = distance;
        nearest = i;
    }
    return nearest;
}

}  // namespace

std::vector<double> round_ticks(double low, double high) {
    const double decades = std::log10(high / low);
    const std::vector<double> digits =
        decades > 2.5   ? std::vector<double>{1}
        : decades > 0.9 ? std::vector<double>{1, 2, 5}
        : decades > 0.4
            ? std::vector<double>{1, 1.5, 2, 3, 4, 5, 7}
            : std::vector<double>{1, 1.2, 1.4, 1.6, 1.8, 2, 2.5, 3, 3.5, 4, 4.5, 5, 6, 7, 8, 9};
    std::vector<double> ticks;
    if (!(low > 0.0) || !std::isfinite(decades)) return ticks;
    for (double power = std::floor(std::log10(low)); power <= std::log10(high); ++power) {
        for (const double digit : digits) {
            const double value = digit * std::pow(10.0, power);
            if (value >= low && value <= high) ticks.push_back(value);
        }
    }
    return ticks;
}

std::optional<std::size_t> diagram(const Theme& theme, const Study& study,
                                   const DiagramLook& look) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::InvisibleButton("diagram", look.size);
    const bool hovered = ImGui::IsItemHovered();
    Diagram drawn(theme, study, look, corner);
    drawn.draw();
    return hovered ? drawn.row_under(ImGui::GetIO().MousePos) : std::nullopt;
}

}  // namespace glint
