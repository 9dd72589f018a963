// Where the driver puts a program in memory.
#pragma once

#include <functional>

namespace glint {

// Two of one text, of which one draws.
struct Placement {
    std::function<void()>
        compile_again;           // draws, in place of the one that drew, which stands aside
    std::function<void()> swap;  // the one that stands aside draws
    std::function<double()> frame_ms;
};

// On a software renderer the same program, compiled anew, takes 4 to 20 % longer in about one of
// eight places, for as long as it stays there, so that whoever compares two programs of one place
// each compares the places, too (Mytkowicz, Diwan, Hauswirth, Sweeney, "Producing Wrong Data
// Without Doing Anything Obviously Wrong!", 2009). Compiles again, twice at the least, until the
// quickest place has its like, and leaves the quickest. Returns how often it did.
int find_quick_place(const Placement& placement);

}  // namespace glint
