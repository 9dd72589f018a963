// What a scene's author would want to know, though it compiles: what is unused, hidden, or too
// long.
//
//     float wave; //@ allow shadowed-name       a finding on this line, or, where the comment
//     stands
//                                               alone, on the line below, is not wanted
#pragma once

#include "scene/passes.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

struct PlacedFinding {
    std::string name;  // "unused-function"
    Place place;
    std::string text;
};

// A text of a pass that was not looked into, and why.
struct Unread {
    Place place;
    std::string why;
};

// Whether it is of a loop that llvmpipe may end before it is done.
bool is_of_long_loop(const PlacedFinding& finding);

struct Lint {
    std::vector<PlacedFinding> findings;  // by file and line; each once, however many passes
    std::vector<Unread> unread;           // then nothing is said of texts
};

// All names of findings, those of `measure/second_opinion.h` too.
std::span<const std::string> finding_names();

// A pass is used where the picture, the sound or a used pass names one of its samplers in what its
// entry function reaches, whatever the tweaks switch off. Files that are included may hold more
// than the scene uses.
Lint lint(const Preset& preset);

// Takes away what the text allows, and sorts.
void drop_allowed(const Scene& scene, std::vector<PlacedFinding>& findings);

}  // namespace glint
