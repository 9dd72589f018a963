// The GLSL text of one pass: prologue, `main`, then the user's text.
#pragma once

#include "glsl/zeros.h"
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
    // What is unset in these bytes of Scene::text gets values that show, in place of 0.
    std::optional<Span> marked{};
};

// The scene's text with every tweak as a constant, on the same lines. A declaration may span lines;
// its line ends are kept.
EditedText specialised_text(const Preset& preset);

// The GLSL ES 3.00 text that the driver sees for one pass.
struct PassText {
    std::string text;
    std::size_t user_begin = 0, user_end = 0;  // bytes of it that are the user's
    EditMap map;                               // from these to Scene::text
    std::vector<Unset> unset;                  // of Scene::text

    // The byte of Scene::text that one of these stands for; nothing for the host's own text.
    std::optional<std::size_t> origin(std::size_t at) const;
};
PassText pass_text(const Preset& preset, std::size_t pass, const ProgramOptions& options);

}  // namespace glint
