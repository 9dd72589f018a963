// Where the operand of an operator begins and ends.
#pragma once

#include "glsl/reading.h"

#include <string>
#include <vector>

namespace glint {

// `a.x` of `((a.x))`.
TokenRange without_parentheses(const Reading& reading, TokenRange range);

// Whether this `)` ends the head of an if, for, while or switch: then it ends no operand.
bool closes_head(const Reading& reading, std::uint32_t at);

// The first token of what ends before `end`: of `a[i].x`, `(a + b)`, `f(x).y`; `end` for none.
std::uint32_t operand_begin(const Reading& reading, std::uint32_t end, std::uint32_t stop);

// The first token of the product that ends before `end`: of `a * -b / f(x)`.
std::uint32_t product_begin(const Reading& reading, std::uint32_t end, std::uint32_t stop);

// Behind a unary expression: signs, a name or number or parentheses, and what follows them.
std::uint32_t operand_end(const Reading& reading, std::uint32_t begin, std::uint32_t stop);

// What stands on both sides of a binary `+` or `-`: the sum before it, such as `a * b + c`, and the
// product behind it. Nothing of a sign.
std::vector<TokenRange> sides_of_sum(const Reading& reading, std::uint32_t at, TokenRange room);

// How many `[…]` stand side by side in it.
int bracket_pairs(const Reading& reading, TokenRange range);

// Whether it has an operation that rounds.
bool is_computed(const Reading& reading, TokenRange range);

// Of sqrt, log, …: operands outside its domain.
bool may_have_no_result(const Reading& reading, const Call& call);
// Whether a function of GLSL's own hands out this argument.
bool hands_out(std::string_view function, std::size_t argument);
// Of clamp and smoothstep, but where both are numbers that are spelled out, in their order.
bool has_bounds_to_see_to(const Reading& reading, const Call& call);

// The comma, semicolon, colon or bracket that ends what begins at `at`.
std::uint32_t expression_end(const Reading& reading, std::uint32_t at, std::uint32_t stop);

// `=`, `+=`, `<<=`, …
bool is_assignment(const Token& token);

// Tokens as a person has spelled them, on one line.
std::string close_spelling(const Reading& reading, TokenRange range);

}  // namespace glint
