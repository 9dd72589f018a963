// The line of a file that a diagnostic speaks of, ready to be shown.
#pragma once

#include "scene/diagnostic.h"

#include <string>
#include <string_view>

namespace glint {

struct SourceLine {
    std::string text;  // tabs expanded; cut to what is near the column, with "…" where it was cut
    int caret = -1;    // character of `text` under which the caret stands; -1: nowhere
};

// Reads it; "" when the file cannot be read or has no such line.
SourceLine read_source_line(const Place& place);

// The same for a line at hand. Columns count characters from 1.
SourceLine shown_line(std::string_view line, int column);

}  // namespace glint
