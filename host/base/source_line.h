// The line of a file that a diagnostic speaks of, ready to be shown.
#pragma once

#include "base/diagnostic.h"

#include <string>
#include <string_view>

namespace glint {

// Reads it; "" when the file cannot be read or has no such line.
std::string read_source_line(const Place& place);

struct SourceLine {
    std::string text;  // tabs expanded; cut to what is near the column, with "…" where it was cut
    int caret = -1;    // cell of `text` under which the caret stands; -1: nowhere
};

// How wide characters are: all of one cell, or as a terminal has them, two for CJK, none for marks
// over others. What would move a terminal's cursor is a '?' there.
enum class Cells { equal, terminal };

// As it is shown in this many cells. Columns count characters from 1; 0 is none.
SourceLine shown_line(std::string_view line, int column, int width, Cells cells = Cells::equal);

}  // namespace glint
