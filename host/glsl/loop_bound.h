// How many turns a loop may take, as far as its text says so.
#pragma once

#include "glsl/constants.h"

#include <limits>

namespace glint {

// As many turns as no loop takes: what is added to its counter is lost.
inline constexpr double kEndless = std::numeric_limits<double>::infinity();

struct LoopBound {
    enum class Kind : std::uint8_t {
        number,  // at most `turns`
        some,    // something counts towards an end; how far is not known
        none     // nothing that can be read ends it
    };
    Kind kind = Kind::none;
    double turns = 0.0;
};

// Of a `for`, `while` or `do`, by its number among the statements: what its condition and the
// breaks that stand right in its body compare with a counter. A counter without a first value
// counts from 0.
LoopBound loop_bound(const Reading& reading, const Constants& constants, std::uint32_t loop);

}  // namespace glint
