// A work-precision diagram: milliseconds against error, both in decades.
#pragma once

#include "measure/rows/study.h"
#include "window/ui/theme.h"

#include <optional>
#include <vector>

namespace glint {

struct DiagramLook {
    ImVec2 size{0, 0};                     // screen units
    std::optional<std::size_t> hovered{};  // rows: under the mouse, here or elsewhere
    std::optional<std::size_t> current{};  // that the tweak stands at
    std::optional<std::size_t> chosen{};   // whose picture is compared
};

// Draws it at ImGui's cursor, as an item "diagram". The row whose point is under the mouse. Rows
// without a picture, or without a time, have no point.
std::optional<std::size_t> diagram(const Theme& theme, const Study& study, const DiagramLook& look);

// Numbers of an axis that stand at round values, few enough to be read; both ends are positive.
std::vector<double> round_ticks(double low, double high);

}  // namespace glint
