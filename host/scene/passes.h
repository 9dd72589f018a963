// Questions about a scene's passes and samplers, by their numbers and by their names.
#pragma once

#include "scene/preset.h"

#include <cstddef>
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

// The function that draws it: "mainImage", "mainSound", "mainWaves".
std::string entry_of(const Scene& scene, std::size_t pass);
// Whether that is a main() of the text's own (scene/own_main.h); without a pass, of any.
bool draws_by_main(const Scene& scene, std::size_t pass);
bool draws_by_main(const Scene& scene);

// A sampler that some pass may read: one of the scene's, or one of the four channels of a preset.
const Sampler& sampler_at(const Preset& preset, std::size_t index);  // channels follow the scene's
std::size_t sampler_count(const Preset& preset);
// What a sampler reads and how, in one line, for digests; of files neither names nor bytes.
std::string sampler_facts(const Sampler& sampler);
// The one that a pass knows by this name.
std::optional<std::size_t> find_sampler(const Preset& preset, std::size_t pass,
                                        std::string_view name);
// Those that a pass's text names, by its words. One that stands there once is declared, and not
// read.
std::vector<std::size_t> samplers_named(const Preset& preset, std::size_t pass,
                                        const std::string& text);

// The names of a pass's outputs; the picture has one, "image", and a sound "sound".
std::vector<std::string> output_names(const Scene& scene, std::size_t pass);

}  // namespace glint
