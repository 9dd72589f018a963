// Where in a function an expression can be evaluated beside a line.
#pragma once

#include "glsl/reading.h"

#include <cstdint>
#include <string>

namespace glint {

// Beside a brace, or behind or before a statement.
struct ProbeRoom {
    std::uint32_t brace = kNone, statement = kNone;
    bool is_behind = false;
};

// Behind the last statement of the line (its bytes), as it stands in no other of that line; before
// what leaves the place; at the head of a loop's or a function's body. A note stands behind all of
// the line, where that holds the whole of a loop, too.
ProbeRoom room_at(const Reading& reading, Span line, std::uint32_t function, bool is_note);

// The expression with what stands for gl_FragCoord, whose own counts cells; in a text with a main()
// of its own also for gl_FragColor (render/pass_text.h).
std::string with_own_names(const std::string& expression, bool is_in_main);

// Why an expression is not to be evaluated in this text: what it calls would change variables of
// it. "" where nothing does.
std::string refusal_of_calls(const Reading& text, const std::string& expression);

}  // namespace glint
