// The site's volumes: `.bin` files.
#pragma once

#include "media/image.h"

#include <glm/vec3.hpp>

#include <cstddef>

namespace glint {

// Interleaved voxels, x fastest, then y, then z, as in GL.
struct Volume {
    glm::ivec3 size{0};
    int channels = 0;  // 1 to 4
    ChannelType type = ChannelType::u8;
    std::vector<std::byte> voxels;
};

// What a file says of itself.
struct VolumeFacts {
    glm::ivec3 size{0};
    int channels = 0;
    ChannelType type = ChannelType::u8;
    std::size_t bytes = 0;  // of its voxels
};

// Both throw std::runtime_error with a whole sentence when the file is missing, cut short or no
// volume.
VolumeFacts read_volume_facts(const std::filesystem::path& file);
Volume read_volume(const std::filesystem::path& file);

}  // namespace glint
