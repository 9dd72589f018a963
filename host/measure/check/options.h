// What `check` is asked for.
#pragma once

#include "offline/options.h"

namespace glint {

// How hard a check tries.
struct Effort {
    std::optional<int> frames{}, random{};  // kFrames and kRandom, as far as the seconds allow
    // How long the search goes on, in units of it, whatever the clock says.
    std::optional<int> tries{};
    int inject = 3;  // texels that are poisoned at once; 0: no such cases
    // What the cases of one file may take. Then the rest is left out, and says so; a frame that is
    // being drawn then is waited for 10 s. A group of cases may take 0.3 of what is left when it
    // begins. 0: no limit.
    double seconds = 110.0;
    static constexpr int kFrames = 2000, kRandom = 64;

    // Whether more than this share of the seconds has passed.
    bool over(double ms, double share = 1.0) const {
        return seconds > 0.0 && ms > share * seconds * 1000.0;
    }
};

struct CheckOptions {
    std::vector<std::filesystem::path> files;
    ViewOptions view;  // but for its file; its size is the one that cases are drawn at
    Effort effort;
    std::filesystem::path output = "glint-check";  // a folder, for pictures of failures
    std::filesystem::path junit{};                 // a file; empty: none
    std::string only;                              // cases whose name begins so; empty: all
    double hang_seconds = 60.0;                    // how long one frame may take
    bool lines = false;                            // of JSON on stdout, as cases end
};

}  // namespace glint
