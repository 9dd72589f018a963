// What a text can do without: functions that nothing calls, comments, blank lines.
#pragma once

#include "glsl/edits.h"

#include <string>
#include <string_view>
#include <vector>

namespace glint {

// Whether a text is understood so well that functions may be left out of it.
bool can_be_lean(const Reading& reading);

// Leaves out the functions that are not reached (by number, as Reading::reached_from tells), unless
// something else would go with them: a macro's definition, one side of an #if.
void leave_out_functions(const Reading& reading, const std::vector<bool>& reached, Edits& edits);

// The same tokens in the same order, on lines of their own where they began one; directives as they
// are.
std::string without_comments(std::string_view text);

}  // namespace glint
