// The files that samplers read: pictures, cubes, volumes, sounds.
#pragma once

#include "render/renderer.h"
#include "scene/preset.h"

namespace glint {

// Reads what one sampler (as in sampler_at) names into the renderer. Throws std::runtime_error.
void load_input(const Preset& preset, Renderer& renderer, std::size_t sampler);

// Reads the files that the renderer needs. Throws Stop with exit code 4, at the place that names
// the file.
void load_inputs(const Preset& preset, Renderer& renderer);

}  // namespace glint
