// Remainders that a driver gets wrong.
#pragma once

#include "glsl/edits.h"

#include <string>
#include <string_view>
#include <vector>

namespace glint {

// What stands for `%`, and its definitions for all types of whole numbers.
inline constexpr std::string_view kRemainder = "glint_rem";
std::string remainder_functions();

// Mesa 22.3 reckons `%` of ints without their signs, so that -1 % 3 is 0; elsewhere it is what
// `a / b` leaves, with the sign of a. `a % b` becomes `glint_rem(a , b)`, and `a %= b`
// `a = glint_rem(a, b)`, except where GLSL wants a constant, which the compiler reckons itself, and
// right.
struct Remainder {
    TokenRange range;            // around which what follows stands; ends with a parenthesis
    std::uint32_t sign = kNone;  // `%` or `%=`
    std::string before, instead;
};
// Not within what `edits` replaces; none of a text of more than 512, each of which is a call.
std::vector<Remainder> find_remainders(const Reading& reading, const Edits& edits);
void mend_remainders(const std::vector<Remainder>& remainders, Edits& edits);

// The same of an expression that stands in no text.
std::string with_mended_remainders(std::string_view expression);

}  // namespace glint
