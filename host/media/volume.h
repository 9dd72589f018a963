// The site's volumes: `.bin` files.
#pragma once

#include "media/image.h"

#include <glm/vec3.hpp>

#include <cstdint>

namespace glint {

// Interleaved voxels, x fastest, then y, then z, as in GL.
struct Volume {
    glm::ivec3 size{0};
    int channels = 0;  // 1 to 4
    ChannelType type = ChannelType::u8;
    std::vector<std::byte> voxels;
};

// Throws std::runtime_error with a whole sentence when the file is missing, cut short or no volume,
// or when its voxels take more than `memory` bytes.
Volume read_volume(const std::filesystem::path& file, std::size_t memory = SIZE_MAX);

}  // namespace glint
