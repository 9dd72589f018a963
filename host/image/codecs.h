// How each kind of file is written and read; image.cpp chooses among these.
#pragma once

#include "image/image.h"
#include "image/temporary_file.h"

namespace glint {

// All writers take a picture that image.cpp has checked and put the content into `out` without
// giving it its name. All readers return a checked picture. They throw std::runtime_error.

void write_png(TemporaryFile& out, const std::filesystem::path& file, const Image& image,
               const Metadata& metadata);
Image read_png(const std::filesystem::path& file);

// Through OpenImageIO, loaded at the first call. `format` is its name for the kind of file.
void prepare_oiio();
void write_by_oiio(TemporaryFile& out, const std::filesystem::path& file, const char* format,
                   const Image& image, const Metadata& metadata);
Image read_by_oiio(const std::filesystem::path& file, const char* format);

// An image of this size with room for its pixels. Throws when a side is not 1 to 16384.
Image make_image(const std::filesystem::path& file, glm::ivec2 size, int channels,
                 ChannelType type);

constexpr int kMaxSide = 16384;

std::size_t bytes_per_row(const Image& image);

}  // namespace glint
