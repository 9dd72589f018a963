// How each kind of file is written and read; image.cpp chooses among these.
#pragma once

#include "base/readable_file.h"
#include "base/temporary_file.h"
#include "media/image.h"

namespace glint {

// Puts a picture that image.cpp has checked into a file without giving it its name. Throws
// std::runtime_error.
class BandEncoder {
public:
    virtual ~BandEncoder() = default;
    virtual void write(const Image& band) = 0;  // the rows below those written before
    virtual void finish() = 0;                  // after the last
};

// The references must outlive the encoder, but for `shape`, `metadata` and `format`.
std::unique_ptr<BandEncoder> encode_png(TemporaryFile& out, const std::filesystem::path& file,
                                        const Image& shape, const Metadata& metadata);

// Through OpenImageIO, loaded at the first call. `codec` is its name for the kind of file.
std::unique_ptr<BandEncoder> encode_by_oiio(TemporaryFile& out, const std::filesystem::path& file,
                                            const char* codec, const Image& shape,
                                            const Metadata& metadata, const FileFormat& format);
void prepare_oiio();

// All readers return a checked picture. They throw std::runtime_error, with the name `file`.
Image read_png(const std::filesystem::path& file, const ReadableFile& in);
Image read_by_oiio(const std::filesystem::path& file, const ReadableFile& in, const char* format);

// The same without its pixels.
Image read_png_shape(const std::filesystem::path& file, const ReadableFile& in);
Image read_shape_by_oiio(const std::filesystem::path& file, const ReadableFile& in,
                         const char* format);

// An image of this size, without room for its pixels. Throws when a side is not 1 to kMaxSide.
Image make_shape(const std::filesystem::path& file, glm::ivec2 size, int channels,
                 ChannelType type);
void make_room(Image& shape);

constexpr int kMaxSide = 16384;             // of what is read: textures are no larger
constexpr int kMaxWrittenSide = 1'000'000;  // libpng's own limit

std::size_t bytes_per_row(const Image& image);
std::size_t bytes_of_pixels(const Image& shape);

// How many rows of a picture go to OpenImageIO at once, which copies them: a multiple of kFileTile.
int rows_at_once(const Image& shape);

}  // namespace glint
