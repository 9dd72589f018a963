// Loops that are tested at their end, for drivers that draw in software.
//
// llvmpipe leaves a loop only at its end: where the test stands at the beginning, as in a `for`, it
// draws the body once more with nothing to show for it, and a loop of no turns once. (It skips no
// `if` either, so that a loop of one turn in its place costs twice as much.) So
//     for (A; B; C) D
// becomes
//     { A; bool go = (B); do { if (go) { D } } while (go && ((C), (B))); }
// which does the same. A plain `if (B) do …` tells Mesa how long `k < (wanted ? 30 : 0)` goes on,
// and has it write out all turns, which are then drawn where none is wanted.
#pragma once

#include <string>
#include <string_view>

namespace glint {

// On the same lines; columns move. What is not understood stays, and so do loops of which a part
// comes from a macro, whose test declares something or calls a function of the text.
std::string test_loops_at_end(std::string_view text);

}  // namespace glint
