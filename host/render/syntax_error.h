// What a driver means by "syntax error", in words for who wrote the text.
#pragma once

#include "glsl/preprocess.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace glint {

// What a driver may say in several ways.
inline constexpr std::string_view kInnerFunction =
    "a function begins within another one, which GLSL has not; is a '}' missing before it?";

// Of `#else if A`, which leaves the #if without its end.
inline constexpr std::string_view kConditionBehind =
    "; a condition stands behind #if and #elif alone";

struct SyntaxError {
    std::string text;        // what is wrong, and what to do
    std::size_t token = 0;   // where
    bool is_behind = false;  // that token, in whose line something is missing
};

// Reads "syntax error, unexpected X, expecting Y or Z", as Bison writes it with Mesa's names of
// tokens, of the token `at` of a text (the count: its end). Nothing for other complaints, and where
// another token stands there than the complaint says.
std::optional<SyntaxError> read_syntax_error(std::string_view complaint,
                                             std::span<const Token> tokens, std::size_t at);

// The same of the preprocessor, of which no token tells more; `complaint` where it is another one.
std::string read_preprocessor_error(std::string complaint);

// What it says of a condition that is none.
inline constexpr std::string_view kNoCondition =
    "this is not expected here; behind #if stand whole numbers, names, operators and defined()";

// Where the expression behind #if or #elif goes wrong as it is written, without a look at what
// macros stand for; null where it does not.
const Token* wrong_in_condition(std::span<const Token> condition, std::span<const Macro> macros);

}  // namespace glint
