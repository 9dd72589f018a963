// The GLSL text of one pass: prologue, `main`, then the user's text.
#pragma once

#include "scene/passes.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

struct ProgramOptions {
    bool specialise = true;                 // write the tweaks in as constants
    std::optional<std::size_t> constant{};  // without `specialise`: this one alone
    bool average = false;  // the picture in linear light at a sub-pixel position, to be added up
    bool tiles = false;    // the picture is drawn in tiles, each at an origin of its own
    bool clamp_to_bytes = false;  // with `average`: what a display would clip is clipped first
};

// The scene's text with every tweak, or one alone, as a constant, on the same lines. A declaration
// may span lines; its line ends are kept.
std::string specialised_text(const Preset& preset, std::optional<std::size_t> only = {});

// The GLSL ES 3.00 text that the driver sees for one pass.
struct PassText {
    // A place of the text, behind which its line is longer than the user's.
    struct Widened {
        int line = 0, column = 0;  // from 1
        int by = 0;                // characters
    };
    std::string text;
    int prologue_lines = 0;  // the user's text starts on the next line
    std::vector<Widened> widened{};
};
PassText pass_text(const Preset& preset, std::size_t pass, const ProgramOptions& options);

}  // namespace glint
