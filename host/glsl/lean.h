// What a text can do without: functions that nothing calls, comments, blank lines, semicolons.
#pragma once

#include "glsl/edits.h"

#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace glint {

// Whether a text is understood so well that functions may be left out of it.
bool can_be_lean(const Reading& reading);

// Whether the directives within these bytes open and close conditions of their own, and do nothing
// else.
bool stands_for_itself(const Reading& reading, Span span);

// Whether nothing else would go with these tokens: a macro's definition, one side of an #if.
bool may_be_left_out(const Reading& reading, TokenRange tokens);

// Leaves out the functions that are not reached (by number, as Reading::reached_from tells) and may
// be left out.
void leave_out_functions(const Reading& reading, const std::vector<bool>& reached, Edits& edits);

// The names of global constants, each declared alone, for which nothing asks that stays; `uniforms`
// are to be such constants. They may be left out.
std::unordered_set<std::string_view> unused_constants(
    const Reading& reading, const std::vector<bool>& reached,
    const std::unordered_set<std::string_view>& uniforms);
// Leaves out those that are constants already.
void leave_out_constants(const Reading& reading, const std::unordered_set<std::string_view>& unused,
                         Edits& edits);

// Leaves out semicolons that end nothing, as behind a function, outside of all bodies: browsers
// refuse them.
void leave_out_semicolons(const Reading& reading, Edits& edits);

// The same tokens in the same order, on lines of their own where they began one; directives as they
// are.
std::string without_comments(std::string_view text);

}  // namespace glint
