// Names that a scene's text declares itself, which glint then must not, or must call otherwise.
// Read word by word: a regular expression takes stack for every character, and lines may be long.
#pragma once

#include <string_view>

namespace glint {

// Whether the text declares the name for all of itself: as a uniform, a macro, or a variable of
// this type. A local variable of that name, which stands indented, is no such declaration.
bool declares(std::string_view text, std::string_view type, std::string_view name);

// Whether the text defines, or declares, a function of this name with a number or vector for
// result.
bool defines_function(std::string_view text, std::string_view name);

// `#define NAME`.
bool defines_macro(std::string_view text, std::string_view name);

// `NAME(float`, also `NAME(in float`.
bool takes_float_first(std::string_view text, std::string_view function);

}  // namespace glint
