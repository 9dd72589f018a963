// The GLSL text of one pass: prologue, `main`, then the user's text.
#pragma once

#include "scene/preset.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

// The passes that draw the picture itself and a block of sound; the others are indices into
// Scene::passes.
inline constexpr std::size_t kImagePass = static_cast<std::size_t>(-1);
inline constexpr std::size_t kSoundPass = static_cast<std::size_t>(-2);
inline bool fills_a_buffer(std::size_t pass) {
    return pass < kSoundPass;
}

// Sound comes in blocks of so many pixels, a sample each, row by row; iFrame counts them. A block
// is 0.19 s: short enough to be made just before it is heard.
inline constexpr int kSoundBlockWidth = 512, kSoundBlockRows = 16;
inline constexpr int kSampleRate = 44100;  // Hz

// The name a person knows a pass by: "image", "sound", or that of the first sampler that it fills.
std::string pass_name(const Scene& scene, std::size_t pass);

// A sampler that some pass may read: one of the scene's, or one of the four channels of a preset.
const Sampler& sampler_at(const Preset& preset, std::size_t index);  // channels follow the scene's
std::size_t sampler_count(const Preset& preset);
// The one that a pass knows by this name.
std::optional<std::size_t> find_sampler(const Preset& preset, std::size_t pass,
                                        std::string_view name);

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
