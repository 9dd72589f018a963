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
//
// A loop that nothing ends, `while (true)` without a way out, llvmpipe ends after 65,535 turns; but
// to Mesa what stands behind it is never reached, so that all it would write holds what was in
// memory. It gets a test that is always true, by a uniform.
#pragma once

#include <string>
#include <string_view>

namespace glint {

// On the same lines; columns move. What is not understood stays, and so do loops of which a part
// comes from a macro, whose test declares something or calls a function of the text.
std::string test_loops_at_end(std::string_view text);

}  // namespace glint
