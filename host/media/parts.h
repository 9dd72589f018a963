// Buffers of many kinds in one file, bit for bit: an EXR with a part for each.
#pragma once

#include "media/image.h"

namespace glint {

struct Part {
    std::string name;
    glm::ivec2 size{0};
    int channels = 4;
    bool half = false;              // 16-bit floats, else 32-bit
    std::vector<std::byte> pixels;  // rows bottom up, tightly packed
};

struct PartsFile {
    Metadata texts;
    std::vector<Part> parts;
};

// Whatever the extension of `file`; at least one part, each with a name of its own. Not compressed.
// Throws as write_image does.
void write_parts(const std::filesystem::path& file, const PartsFile& content);

// Throws std::runtime_error when the file is missing, truncated or no EXR of up to four floats a
// pixel.
PartsFile read_parts(const std::filesystem::path& file);

// What an EXR of any kind says of itself, in its first part, and what an HDR says that this program
// wrote; nothing where it cannot be read.
Metadata read_texts(const std::filesystem::path& file);

}  // namespace glint
