// What a text asks of its own values: `//@ assert t >= 0.0 "behind the eye"`, `//@ watch nor`.
#pragma once

#include "measure/probe/probe.h"

#include <functional>
#include <string>
#include <vector>

namespace glint {

struct BrokenAssertion {
    std::string file{};
    int line = 0, column = 0;
    std::string expression{}, why{}, pass{};
    glm::ivec2 pixel{0};     // the first
    std::size_t pixels = 0;  // of that pass, when it was drawn with any for the first time
    std::string refused{};   // why it cannot be evaluated, and was not; "" where it was
};

bool has_assertions(const Scene& scene);

// Of all passes that `draw` has the renderer draw, from the state in which it is, in the order of
// the text, once for each pass. `draw` may look at what has been found so far. An expression that
// is none is one of them, and keeps nobody from asking the others. To be compiled as_written.
using BrokenAssertions = std::vector<BrokenAssertion>;
BrokenAssertions broken_assertions(const Preset& preset, Renderer& renderer,
                                   const ProgramOptions& options,
                                   const std::function<void(const BrokenAssertions&)>& draw);

// `assert t >= 0.0 "behind the eye" does not hold in 12 pixels of image, first at 17,40`.
std::string sentence_of(const BrokenAssertion& broken);

}  // namespace glint
