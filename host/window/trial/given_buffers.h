// Buffers that another process has drawn, read here as if they were pictures.
#pragma once

#include "render/renderer.h"
#include "window/trial/refiner.h"

#include <cstddef>
#include <map>
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

// Those that are sent to the driver before a scene is there to read them, by their samplers.
using SentPictures = std::map<std::size_t, PictureUpload>;
SentPictures send_ahead(const Preset& preset, const std::vector<GivenPicture>& pictures,
                        std::span<const std::byte> memory);

// Those that something reads. Throws std::runtime_error where one is known that was not sent.
void hand_over(const std::vector<GivenPicture>& pictures, std::span<const std::byte> memory,
               SentPictures& sent, Renderer& renderer);

}  // namespace glint
