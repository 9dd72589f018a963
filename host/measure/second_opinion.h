// What WebGL 2 would refuse of a scene, by glslang's validator, the reference compiler.
#pragma once

#include "scene/lint.h"

#include <string>
#include <vector>

namespace glint {

struct SecondOpinion {
    std::vector<PlacedFinding> findings;  // called "webgl"
    std::string why_none;                 // where there is no opinion
};

// Of the text that `glint export` would write for each of these passes, however many buffers that
// takes, behind what the site puts before it. Starts the validator once for each, as many at a time
// as there are processors.
SecondOpinion second_opinion(const Preset& preset, const std::vector<std::size_t>& passes);

}  // namespace glint
