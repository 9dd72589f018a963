#include "window/ui/layout.h"

#include <algorithm>

namespace glint {
namespace {

constexpr float kMargin = 8.0f, kNarrowest = 200.0f;          // points
constexpr float kNarrowestSource = 520.0f;                    // a line of text, and its values
constexpr float kWidestColumn = 0.45f, kBothColumns = 0.72f;  // of the screen

// Shares a height: who wants less than an even share leaves the rest to the others.
void share(std::array<float, kPanelCount>& heights, float available) {
    auto sorted = heights;
    std::ranges::sort(sorted);
    float limit = available;
    auto left = static_cast<float>(std::ranges::count_if(sorted, [](float h) { return h > 0.0f; }));
    for (const float height : sorted) {
        if (height <= 0.0f) continue;
        limit = available / left;
        if (height > limit) break;
        available -= height;
        left -= 1.0f;
    }
    for (float& height : heights) height = std::min(height, std::max(limit, 0.0f));
}

}  // namespace

void Layout::arrange(const Theme& theme, ImVec2 screen, const std::array<bool, kPanelCount>& open) {
    std::array<float, 2> widths{};
    for (std::size_t i = 0; i < kPanelCount; ++i) {
        const auto side = static_cast<std::size_t>(places.side[i]);
        if (!open[i]) continue;
        const bool is_text = i == static_cast<std::size_t>(PanelId::source);
        const float least = is_text ? kNarrowestSource : kNarrowest;
        const float wished = theme.px(std::max(places.width[side], least));
        widths[side] = std::max(widths[side], std::min(wished, kWidestColumn * screen.x));
    }
    const float both = widths[0] + widths[1];
    if (both > kBothColumns * screen.x)
        for (float& width : widths) width *= kBothColumns * screen.x / both;

    const float margin = theme.px(kMargin);
    for (const Side side : {Side::left, Side::right})
        fill_column(theme, screen, side, widths[static_cast<std::size_t>(side)], open);
    const float begin = widths[0] > 0.0f ? widths[0] + 2 * margin : margin;
    const float end = screen.x - (widths[1] > 0.0f ? widths[1] + 2 * margin : margin);
    const float top = bar.size.y > 0.0f ? bar.bottom() + margin : margin;
    const float bottom = transport.size.y > 0.0f ? transport.corner.y - margin : screen.y - margin;
    free = {{begin, top}, {std::max(end - begin, 0.0f), std::max(bottom - top, 0.0f)}};
}

// Below the bar of toggles where that reaches over the column.
float Layout::column_top(const Theme& theme, ImVec2 screen, Side side, float width) const {
    const float margin = theme.px(kMargin);
    if (bar.size.y <= 0.0f) return margin;
    const bool is_under = side == Side::left || bar.right() + margin > screen.x - margin - width;
    return is_under ? bar.bottom() + margin : margin;
}

void Layout::fill_column(const Theme& theme, ImVec2 screen, Side side, float width,
                         const std::array<bool, kPanelCount>& open) {
    const float margin = theme.px(kMargin);
    const float top = column_top(theme, screen, side, width);
    const float bottom = transport.size.y > 0.0f ? transport.corner.y - margin : screen.y - margin;
    std::array<float, kPanelCount> heights{};
    int count = 0;
    for (std::size_t i = 0; i < kPanelCount; ++i) {
        if (!open[i] || places.side[i] != side) continue;
        heights[i] = std::max(wanted[i], theme.px(60));
        ++count;
    }
    share(heights, bottom - top - margin * static_cast<float>(std::max(count - 1, 0)));
    const float x = side == Side::left ? margin : screen.x - margin - width;
    float y = top;
    for (std::size_t i = 0; i < kPanelCount; ++i) {
        if (heights[i] <= 0.0f) continue;
        areas[i] = {{std::round(x), std::round(y)}, {std::round(width), std::round(heights[i])}};
        y += heights[i] + margin;
    }
}

}  // namespace glint
