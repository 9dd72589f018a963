// Stores at the index of a loop, which llvmpipe puts one further where the loop's next index is
// reckoned in the same statement.
//
// Of `w[i] = w[i + 1]` in a loop that steps i, Mesa 22.3 (gallivm) keeps i and i + 1 in one
// register, since it has done with i once it knows which element is meant; but it looks i up once
// more where it stores. A zero that it does not know is added to such an index, which is then a
// number of its own.
#pragma once

#include "glsl/edits.h"

namespace glint {

// Adds to the indices that are a stepped variable and nothing else, in loops in which the variable
// and its step are added once more.
void mend_stored_indices(const Reading& reading, Edits& edits);

}  // namespace glint
