// Where panels stand: in a column on the left or the right, as tall as what they hold, never over
// all of the picture. They remember side and width.
#pragma once

#include "window/ui/theme.h"

#include <glm/vec4.hpp>

#include <array>
#include <cstddef>

namespace glint {

enum class Side { left, right };
enum class PanelId { tweaks, passes, browser, study, check, source };
inline constexpr std::size_t kPanelCount = 6;

// A rectangle in screen units, y down.
struct Area {
    ImVec2 corner{0, 0}, size{0, 0};
    float right() const { return corner.x + size.x; }
    float bottom() const { return corner.y + size.y; }
    bool operator==(const Area& other) const {
        return corner.x == other.corner.x && corner.y == other.corner.y && size.x == other.size.x &&
               size.y == other.size.y;
    }
};

// What is remembered between runs.
struct Places {
    std::array<Side, kPanelCount> side{Side::right, Side::left, Side::left,
                                       Side::left,  Side::left, Side::left};
    std::array<float, 2> width{330.0f, 350.0f};  // points, of the columns
    bool operator==(const Places&) const = default;
};

struct Layout {
    Places places;
    // Screen units that a panel would like to be tall: what it held a frame ago.
    std::array<float, kPanelCount> wanted{};
    Area bar, transport;  // of the toggles at the top and of the transport, a frame ago

    // Found anew for each frame.
    std::array<Area, kPanelCount> areas;
    Area free;  // between the columns

    bool operator==(const Layout&) const = default;

    // Puts those that are open into their columns of a screen of this size (screen units): fills
    // their `areas`, and `free`. Where a column has no room for what they want, the tallest are cut
    // to one height, and scroll.
    void arrange(const Theme& theme, ImVec2 screen, const std::array<bool, kPanelCount>& open);

private:
    float column_top(const Theme& theme, ImVec2 screen, Side side, float width) const;
    void fill_column(const Theme& theme, ImVec2 screen, Side side, float width,
                     const std::array<bool, kPanelCount>& open);
};

}  // namespace glint
