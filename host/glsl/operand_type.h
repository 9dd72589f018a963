// The type of an operand: of `s.hits[i].p`, `m[1]`, `pick()`.
#pragma once

#include "glsl/variables.h"

#include <optional>
#include <string>

namespace glint {

struct OperandType {
    std::string name;
    std::uint32_t structure = kNone;  // into structs, of one of the text's
    int lengths = 0;                  // of an array: how many times it can be indexed as one
};

// Of a variable or a call in this function's body, and the members, swizzles and indices behind it;
// nothing of a sum and what else is no operand alone, or has a type that is not known.
std::optional<OperandType> type_of_operand(const Reading& reading, const Variables& variables,
                                           TokenRange operand, std::uint32_t function);

}  // namespace glint
