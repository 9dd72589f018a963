// Pictures of files that others are compared with.
#pragma once

#include <glm/vec2.hpp>

#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace glint {

// Whether a file of this name is a picture, and no scene or preset.
bool is_picture_file(const std::filesystem::path& file);

struct ComparedPicture {
    glm::ivec2 size{0};
    std::vector<float> rgba{};  // as the file has them, rows bottom up; a grey one's three times;
                                // alpha 1 where there is none
    bool bytes = false;         // the file keeps 8 bits a channel
    bool is_light = false;      // linear; else as a display shows it, in sRGB
    bool is_drawn = false;      // the file says that this program drew it
    std::string buffer{};       // the file says that these are its numbers, and no colours
};

// An EXR holds linear light, as OpenEXR says, and so does an HDR, as Radiance does, unless this
// program wrote it. Throws std::runtime_error as read_image does.
ComparedPicture read_compared_picture(const std::filesystem::path& file);

// What a file of 8 bits a channel would keep of drawn values; not-a-number stays what it is. Half
// way between two bytes, where drivers differ, it is the one that `kept` has, which such a file did
// keep.
void round_to_bytes(std::span<float> rgba, std::span<const float> kept);

// The picture as a display shows it, in a PNG file; throws as write_image does.
void write_shown(const std::filesystem::path& file, std::span<const float> rgba, glm::ivec2 size);
void write_rgb(const std::filesystem::path& file, std::vector<std::byte> rgb, glm::ivec2 size);

}  // namespace glint
