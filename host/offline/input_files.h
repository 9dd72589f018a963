// The files that samplers read: pictures, cubes, volumes, sounds.
#pragma once

#include "render/renderer.h"
#include "render/room.h"
#include "scene/preset.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace glint {

// What a sampler reads, as a renderer takes it: pixels, or a sound.
struct InputContent {
    glm::ivec2 size{0};
    int slices = 1, channels = 0;
    bool floats = false;
    std::vector<std::byte> bytes;
    std::unique_ptr<SoundTexture> sound;  // null for pixels
};

// Reads and decodes what a sampler names; on any thread. Throws std::runtime_error that names the
// file, also where there is no memory for it.
InputContent decode_input(const Sampler& sampler, const TextureLimits& limits);

// Its pixels; valid while it lives.
PixelView view_of(const InputContent& input);

// Hands it to the renderer; on its thread. `sampler` is as in sampler_at.
void give_input(InputContent input, Renderer& renderer, std::size_t sampler);

// Reads the files that the renderer needs. Throws Stop with exit code 4, at the place that names
// the file.
void load_inputs(const Preset& preset, Renderer& renderer);

}  // namespace glint
