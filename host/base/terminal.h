// Messages as a terminal shows them: colours, and the line of the text with a caret.
#pragma once

#include "base/diagnostic.h"

#include <string>

namespace glint {

struct Terminal {
    bool is_there = false;
    bool has_colours = false;
    int columns = 80;
};

// What stands at stderr. Without colours where NO_COLOR or INSIDE_EMACS is set to anything, or TERM
// is "dumb".
Terminal terminal_at_stderr();

// to_string(); on a terminal its colours, and below it the line that it speaks of. The first line
// is the same but for colours. Without a line end.
std::string shown(const Diagnostic& diagnostic, const Terminal& terminal);

// To stderr; the latter two of no place.
void say_diagnostic(const Diagnostic& diagnostic);
void say_error(std::string sentence);
void say_warning(std::string sentence);

}  // namespace glint
