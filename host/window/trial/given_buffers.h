// Buffers that another process has drawn, read here as if they were pictures.
#pragma once

#include "render/renderer.h"
#include "window/trial/refiner.h"

#include <cstddef>
#include <span>
#include <vector>

namespace glint {

struct GivenPicture {
    std::size_t sampler = 0;  // as in sampler_at
    GivenBuffer given;
    std::size_t output = 0;
};

// Whoever reads such a buffer in this preset reads a picture from now on, and nobody draws it.
std::vector<GivenPicture> as_pictures(Preset& preset, const std::vector<GivenBuffer>& buffers);

// Those that something reads.
void hand_over(const std::vector<GivenPicture>& pictures, std::span<const std::byte> memory,
               Renderer& renderer);

}  // namespace glint
