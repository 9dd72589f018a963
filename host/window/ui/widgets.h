// Small parts that several panels use.
#pragma once

#include "window/ui/icons.h"

#include <string>
#include <string_view>

namespace glint {

struct ButtonLook {
    bool on = false;  // lit by the accent
    bool enabled = true;
    ImU32 colour = 0;   // 0: by state
    float side = 0.0f;  // screen units; 0: a frame's height
};

// An invisible button that shows when the keyboard stands on it. True when it is pressed.
bool area(const char* id, ImVec2 size, int flags = 0);

// Whether the keyboard pressed the last item in this frame: Space does.
bool is_pressed_by_key();

// Gives the keyboard to the last item.
void focus_last_item();

// A square button. `id` is unlike those of its neighbours; the tip tells what it does.
bool icon_button(const Theme& theme, const char* id, Icon icon, const char* tip,
                 const ButtonLook& look = {});

// A flat button with text, lit while it is on.
bool text_button(const Theme& theme, const char* text, bool on, const char* tip);

// A track of this width, filled from `origin` to where the value lies; both are fractions. The text
// stands in it. True while a person moves it.
bool slider(const Theme& theme, const char* id, float width, double& fraction,
            const std::string& text, double origin = 0.0);

// The same for a number in a range, even in the logarithm if `log`. Right-click sets `rest`.
struct Range {
    double min, max, rest;
    bool log = false;
};
bool number_slider(const Theme& theme, const char* id, float width, float& number,
                   const Range& range, const std::string& text);

// A text in the colour and font; no formatting signs, no "##".
void text_in(ImU32 colour, std::string_view text, ImFont* font = nullptr);

// Draws one line of text into the width, with an ellipsis where it is too long. True if it was cut.
bool text_within(ImDrawList& list, ImVec2 position, float width, ImU32 colour,
                 std::string_view text);

// A tooltip over the last item, wrapped at a readable width.
void tip(const Theme& theme, std::string_view text);

// Moves on in the line if an item of this width still fits, else to the next line.
void same_line_if_fits(float width);

// Text for a place where ImGui reads printf signs.
std::string escaped(std::string_view text);

}  // namespace glint
