// The GLSL text of one pass: prologue, `main`, then the user's text.
#pragma once

#include "glsl/edits.h"
#include "scene/passes.h"

#include <compare>
#include <optional>
#include <string>
#include <string_view>

namespace glint {

// Which of the values that nothing sets: the how manieth of a byte of Scene::text, at which a macro
// may stand that declares several.
struct UnsetPlace {
    std::size_t at = 0;
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

// The scene's text with every tweak as a constant, on the same lines. A declaration may span lines;
// its line ends are kept.
std::string specialised_text(const Preset& preset);

// The GLSL ES 3.00 text that the driver sees for one pass.
struct PassText {
    // A value that the text reads before setting it.
    struct UnsetValue {
        UnsetPlace place;
        std::string name;
        bool is_result = false;  // of the function of that name
    };
    std::string text;
    std::size_t user_begin = 0, user_end = 0;  // bytes of it that are the user's
    EditMap zeros;                             // from these to the text before write_zeros()
    EditMap map;                               // and from that, less user_begin, to Scene::text
    std::vector<UnsetValue> unset{};           // in the order of the text

    // The byte of Scene::text that one of these stands for; nothing for the host's own text.
    std::optional<std::size_t> origin(std::size_t at) const;
};
PassText pass_text(const Preset& preset, std::size_t pass, const ProgramOptions& options);

}  // namespace glint
