// The GLSL text of one pass: prologue, `main`, then the user's text.
#pragma once

#include "scene/passes.h"

#include <compare>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

// Which of the values that nothing sets: the how manieth on which line of the user's text.
struct UnsetPlace {
    int line = 0;    // from 1
    int number = 0;  // from 0
    auto operator<=>(const UnsetPlace&) const = default;
};
struct UnsetRange {
    UnsetPlace begin, end;
};

struct ProgramOptions {
    bool specialise = true;                 // write the tweaks in as constants
    std::optional<std::size_t> constant{};  // without `specialise`: this one alone
    bool average = false;  // the picture in linear light at a sub-pixel position, to be added up
    bool tiles = false;    // the picture is drawn in tiles, each at an origin of its own
    bool clamp_to_bytes = false;  // with `average`: what a display would clip is clipped first
    // Those that get values which show in a picture, in place of 0 (glsl/zeros.h).
    std::optional<UnsetRange> marked{};
};

// The scene's text with every tweak, or one alone, as a constant, on the same lines. A declaration
// may span lines; its line ends are kept.
std::string specialised_text(const Preset& preset, std::optional<std::size_t> only = {});

// The GLSL ES 3.00 text that the driver sees for one pass.
struct PassText {
    // A place of the text, behind which its line is longer than the user's. What stands in these
    // characters stands for the place itself.
    struct Widened {
        int line = 0, column = 0;  // from 1
        int by = 0;                // characters; less than 0 where a macro's use was written out
    };
    // A value that the text reads before setting it.
    struct UnsetValue {
        UnsetPlace place;
        int column = 0;  // in the user's text, in characters from 1
        std::string name;
        bool is_result = false;  // of the function of that name
    };
    std::string text;
    int prologue_lines = 0;  // the user's text starts on the next line
    std::vector<Widened> widened{};
    std::vector<UnsetValue> unset{};  // in the order of the text
};
PassText pass_text(const Preset& preset, std::size_t pass, const ProgramOptions& options);

}  // namespace glint
