// The GLSL text of one pass: prologue, `main`, then the user's text.
#pragma once

#include "glsl/finding.h"
#include "glsl/probe.h"
#include "glsl/zeros.h"
#include "scene/passes.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

struct ProgramOptions {
    bool specialise = true;                // write the tweaks in as constants
    std::vector<std::size_t> constants{};  // without `specialise`: these alone
    // Without `specialise`: a tweak's declaration becomes the name that named_tweak() gives, for
    // whoever defines it as one thing or the other, and a division by one has names as well
    // (glsl/division.h).
    bool named = false;
    bool average = false;  // the picture in linear light at a sub-pixel position, to be added up
    bool tiles = false;    // the picture is drawn in tiles, each at an origin of its own
    bool clamp_to_bytes = false;  // with `average`: what a display would clip is clipped first
    // Without the functions that the pass does not reach, comments and blank lines: an edit of
    // these leaves the text as it is. It has no way back to the scene's text, so that what is wrong
    // with it is told by one that is not lean.
    bool lean = false;
    bool feed = false;  // without `specialise`: numbers come from outside too (glsl/numbers.h)
    // What is unset in these bytes of Scene::text gets values that show, in place of 0.
    std::optional<Marked> marked{};
};

// Whether an index may be made of a tweak, by number, where this is the scene's text. Such a one is
// never a constant: with a number that it can tell is out of the array's range no driver compiles.
std::vector<bool> index_tweaks(const Scene& scene, const Reading& reading);

// The scene's text with every tweak as a constant, or as a variable where an index may be made of
// it, on the same lines. A declaration may span lines; its line ends are kept.
EditedText specialised_text(const Preset& preset);

// "glint_tweak3".
std::string named_tweak(std::size_t tweak);

// The uniform of vec4s that numbers are fed by.
inline constexpr const char* kNumbers = "glint_numbers";

// What stands for gl_FragColor in a text with a main() of its own, as long as that.
inline constexpr std::string_view kPlainColour = "glFragColor_";

// The GLSL ES 3.00 text that the driver sees for one pass.
struct PassText {
    std::string text;
    std::size_t pass = kImagePass;
    std::size_t user_begin = 0, user_end = 0;  // bytes of it that are the user's
    EditMap map;                               // from these to Scene::text
    std::vector<Unset> unset;                  // of Scene::text
    std::vector<Finding> refused{};            // of Scene::text, where all of it is here
    std::vector<float> numbers;                // of kNumbers, where they are fed
    Probed probed;                             // places are bytes of Scene::text

    // The byte of Scene::text that one of these stands for; nothing for the host's own text.
    std::optional<std::size_t> origin(std::size_t at) const;
};

// Whether the text declares a name for all of itself: as a global or a macro.
bool declares(const Reading& reading, std::string_view name);

// Whether a text gives a name a meaning of its own, in all of itself: it declares no uniform of the
// host's then.
bool means_its_own(const Reading& reading, std::string_view name);

// With a wish, the text tells what happens in it, in two more outputs (glsl/probe.h).
PassText pass_text(const Preset& preset, std::size_t pass, const ProgramOptions& options,
                   const ProbeWish* probe = nullptr);

}  // namespace glint
