// Pixels to and from files. The only part that knows libpng and OpenImageIO.
#pragma once

#include <glm/vec2.hpp>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace glint {

enum class ChannelType { u8, f32 };

// Interleaved pixels, rows bottom up as in GL. Files are top down; the turn happens here and
// nowhere else.
struct Image {
    glm::ivec2 size{0};
    int channels = 0;  // 1 to 4
    ChannelType type = ChannelType::u8;
    std::vector<std::byte> pixels;  // size.x * size.y * channels values, tightly packed
};

// How a file keeps a picture, where its kind leaves a choice; empty and 0: what suits most.
struct FileFormat {
    std::string values{};       // exr: "float", or "half" for 16-bit floats
    std::string compression{};  // exr, tif: OpenImageIO's names, such as zips or dwaa:45
    int quality = 0;            // jpg: 1 to 100
    bool tiled = false;         // exr, tif: in squares of kFileTile pixels, for readers of parts
};
constexpr int kFileTile = 64;

// Why a file of this name cannot be kept so, as a whole sentence; empty when it can.
std::string refusal_of(const std::filesystem::path& file, const FileFormat& format);

// Name and value, kept in the file where its format can (PNG text, EXR attributes; comments of an
// HDR, which keep short lines of ours alone).
using Metadata = std::vector<std::pair<std::string, std::string>>;

// Why a picture of this size cannot be kept in a file of this name, as a whole sentence; empty when
// it can.
std::string size_refusal(const std::filesystem::path& file, glm::ivec2 size);

// Bytes of memory that writing a picture takes beside its pixels, at the most. `shape` is as for
// ImageWriter.
std::size_t encoder_bytes(const std::filesystem::path& file, const Image& shape);

// Starts loading the image library on another thread where writing `file` needs it (jpg, tif and
// hdr do, and reading anything but PNG), so that the GPU need not wait. Safe to call at any time,
// and never required. Call it once the context stands: the driver is loaded through the same lock.
void prepare_image_library(const std::filesystem::path& file);

// Whether the extension is one of png exr jpg jpeg tif tiff hdr.
bool can_write(const std::filesystem::path& file);

// Whether files of this kind hold float values (exr, tif, hdr); the others hold bytes.
bool holds_floats(const std::filesystem::path& file);

// Whether what others write into files of this kind is linear light (exr, hdr).
bool holds_light(const std::filesystem::path& file);

// Whether files of this kind keep metadata, and before the pixels (png, exr).
bool begins_with_metadata(const std::filesystem::path& file);

class BandEncoder;
class TemporaryFile;

// Whether files of this kind may be tiled (exr, tif).
bool has_tiles(const std::filesystem::path& file);

// Writes a picture band by band, the top one first, so that it need never be in memory as a whole.
// Without finish() nothing stays behind. All throw as write_image does.
class ImageWriter {
public:
    // `shape` says size, channels and type; its pixels do not matter.
    ImageWriter(const std::filesystem::path& file, const Image& shape,
                const Metadata& metadata = {}, const FileFormat& format = {});
    ~ImageWriter();
    ImageWriter(const ImageWriter&) = delete;
    ImageWriter& operator=(const ImageWriter&) = delete;

    // The rows below those that were written, as wide as the picture. Where the file is tiled, all
    // bands but the last have a multiple of kFileTile rows.
    void write(const Image& band);

    // Gives the file its name once all rows are there.
    void finish();

private:
    std::filesystem::path file_;
    int channels_;  // of the file: some kinds have no alpha
    std::unique_ptr<TemporaryFile> out_;
    std::unique_ptr<BandEncoder> encoder_;
};

// Writes beside `file` and renames when whole: an interrupted call leaves what was there before. u8
// images go to png, jpg; f32 images to exr (32-bit float, lossless, unless told otherwise), tif,
// hdr. Alpha is written as it is, never multiplied in; jpg and hdr have none. Equal calls give
// equal files. Throws std::runtime_error with a whole sentence that names the file.
void write_image(const std::filesystem::path& file, const Image& image,
                 const Metadata& metadata = {}, const FileFormat& format = {});

// What a picture file says of itself before its pixels, and what reading it takes.
struct ImageFacts {
    glm::ivec2 size{0};
    int channels = 0;  // 1 to 4
    ChannelType type = ChannelType::u8;
    std::size_t pixel_bytes = 0;    // of memory, for the Image
    std::size_t decoder_bytes = 0;  // and beside it, while it is read
};

// Throws as read_image does, but for what only the pixels show.
ImageFacts read_image_facts(const std::filesystem::path& file);

// The same picture with so many channels: grey spreads, alpha goes with one or three of them.
Image with_channels(const Image& image, int channels);

// Reads png, jpg, exr, hdr, tif with 1 to 4 channels (more are dropped); 8-bit files give u8 with
// no colour conversion, deeper ones f32. Throws std::runtime_error with a whole sentence when the
// file is missing, truncated or not an image.
Image read_image(const std::filesystem::path& file);

}  // namespace glint
