// How the panels look: colours, sizes, and with which fonts.
#pragma once

#include "window/ui/fonts.h"

#include <imgui.h>

#include <cmath>

namespace glint {

// One palette. Text stands on its ground at 4.5:1 or better; there is a single accent.
namespace colours {
inline constexpr ImU32 kPanel = IM_COL32(24, 26, 29, 242);
inline constexpr ImU32 kPopup = IM_COL32(32, 34, 38, 250);
inline constexpr ImU32 kField = IM_COL32(44, 47, 52, 255);
inline constexpr ImU32 kFieldHovered = IM_COL32(54, 58, 64, 255);
inline constexpr ImU32 kFieldActive = IM_COL32(62, 67, 74, 255);
inline constexpr ImU32 kLine = IM_COL32(255, 255, 255, 22);
inline constexpr ImU32 kText = IM_COL32(228, 230, 234, 255);
inline constexpr ImU32 kDim = IM_COL32(160, 166, 175, 255);
inline constexpr ImU32 kFaint = IM_COL32(104, 110, 119, 255);  // for marks, never for text
inline constexpr ImU32 kAccent = IM_COL32(105, 178, 236, 255);
inline constexpr ImU32 kAccentFill = IM_COL32(48, 94, 132, 255);
inline constexpr ImU32 kError = IM_COL32(255, 128, 118, 255);
inline constexpr ImU32 kWarning = IM_COL32(232, 186, 84, 255);
inline constexpr ImU32 kNotFinite = IM_COL32(255, 110, 255, 255);
}  // namespace colours

struct Theme {
    float scale = 1.0f;  // screen units a point
    ImFont *text = nullptr, *bold = nullptr, *mono = nullptr;

    float px(float points) const { return std::round(points * scale); }
};

// Sets fonts and style of the current ImGui context. `pixels` are the dots of a screen unit, more
// than 1 where windows are measured in points. The fonts outlive the context, or the next theme.
Theme make_theme(const Fonts& fonts, float pixels = 1.0f);

}  // namespace glint
