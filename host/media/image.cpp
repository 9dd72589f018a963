// Chooses how a file is written by its name and how it is read by its first bytes.
#include "media/image.h"

#include "base/canonical_name.h"
#include "base/names.h"
#include "base/readable_file.h"
#include "media/codecs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

namespace glint {
namespace {

namespace fs = std::filesystem;

enum class Codec { png, exr, jpeg, tiff, hdr };

// The first of each kind's names is its usual one.
constexpr Names<Codec, 7> kExtensions = {{{Codec::png, ".png"},
                                          {Codec::exr, ".exr"},
                                          {Codec::jpeg, ".jpg"},
                                          {Codec::jpeg, ".jpeg"},
                                          {Codec::tiff, ".tif"},
                                          {Codec::tiff, ".tiff"},
                                          {Codec::hdr, ".hdr"}}};
constexpr Names<Codec, 5> kOiioNames = {{{Codec::png, "png"},
                                         {Codec::exr, "openexr"},
                                         {Codec::jpeg, "jpeg"},
                                         {Codec::tiff, "tiff"},
                                         {Codec::hdr, "hdr"}}};

struct Signature {
    std::string_view bytes;
    Codec codec;
};

using namespace std::string_view_literals;
constexpr Signature kSignatures[] = {
    {"\x89PNG\r\n\x1a\n"sv, Codec::png},
    {"\x76\x2f\x31\x01"sv, Codec::exr},
    {"\xff\xd8\xff"sv, Codec::jpeg},
    {"II*\0"sv, Codec::tiff},
    {"MM\0*"sv, Codec::tiff},
    {"II+\0"sv, Codec::tiff},
    {"MM\0+"sv, Codec::tiff},
    {"#?"sv, Codec::hdr},
};

bool has_floats(Codec codec) {
    return codec == Codec::exr || codec == Codec::tiff || codec == Codec::hdr;
}

// As its name says.
std::optional<Codec> codec_of(const fs::path& file) {
    return kExtensions.find(ending_of(file));
}

std::size_t bytes_per_value(ChannelType type) {
    return type == ChannelType::f32 ? 4 : 1;
}

// Empty where both sides are within the limit.
std::string size_complaint(glm::ivec2 size, int limit) {
    if (size.x >= 1 && size.y >= 1 && size.x <= limit && size.y <= limit) return "";
    return fmt::format("The picture is {} x {}, and a side may be 1 to {}", size.x, size.y, limit);
}

int largest_side_of(Codec codec) {
    return codec == Codec::jpeg ? 65500 : kMaxWrittenSide;  // libjpeg's own
}

void check_shape(const fs::path& file, const Image& image, Codec codec) {
    const auto cause = size_complaint(image.size, largest_side_of(codec));
    if (!cause.empty()) throw cannot_write(file, cause);
    if (image.channels < 1 || image.channels > 4) {
        throw cannot_write(file, fmt::format("The picture has {} channels", image.channels));
    }
    if ((image.type == ChannelType::f32) != has_floats(codec)) {
        throw cannot_write(file, fmt::format("This kind of file holds {}, the picture does not",
                                             has_floats(codec) ? "floats" : "bytes"));
    }
}

// As many as the picture has, where the kind of file takes them.
int channels_in_file(Codec codec, int channels) {
    switch (codec) {
        case Codec::png:
        case Codec::exr:
        case Codec::tiff:
            return channels;
        case Codec::jpeg:
            return channels < 3 ? 1 : 3;
        case Codec::hdr:
            return 3;
    }
    return channels;
}

// OpenImageIO takes any other name in silence, and one of its own instead. Some take a level.
bool is_compression(Codec codec, std::string_view name) {
    constexpr std::string_view kForExr[] = {"none",  "rle", "zip",  "zips", "piz",
                                            "pxr24", "b44", "b44a", "dwaa", "dwab"};
    constexpr std::string_view kForTiff[] = {"none", "lzw", "zip", "packbits"};
    const std::string_view level = name.substr(std::min(name.find(':'), name.size()));
    name.remove_suffix(level.size());
    const bool plain = level.empty();
    const bool digits = level.size() > 1 && level.size() < 5 &&
                        level.find_first_not_of("0123456789", 1) == level.npos;
    if (codec == Codec::tiff) return plain && std::ranges::count(kForTiff, name) > 0;
    if (codec != Codec::exr || std::ranges::count(kForExr, name) == 0) return false;
    return plain || (digits && (name.starts_with("zip") || name.starts_with("dwa")));
}

// Noise of the largest size takes half of this; nobody searches a hole of 20 GB for its end.
constexpr std::size_t kLargestJpeg = std::size_t{2} << 30;

Codec codec_by_content(const fs::path& file, const ReadableFile& in) {
    std::array<char, 16> buffer{};
    const std::string_view head(buffer.data(), in.read(buffer, 0));
    if (head.empty()) throw cannot_read(file, "The file is empty");
    for (const auto& [bytes, codec] : kSignatures) {
        if (head.substr(0, bytes.size()) != bytes) continue;
        if (codec == Codec::jpeg && in.size() > kLargestJpeg)
            throw cannot_read(file,
                              fmt::format("It is larger than any jpg of {0} x {0}", kMaxSide));
        return codec;
    }
    throw cannot_read(file, "It is not a png, jpg, exr, hdr or tif picture");
}

// Where the scans of a JPEG begin, behind the segments of its head. Of these `see` hears the
// marker.
template <class See>
std::size_t scans_of(const ReadableFile& in, See see) {
    std::array<unsigned char, 4> head{};
    const auto read = [&](std::size_t at) {
        return in.read({reinterpret_cast<char*>(head.data()), head.size()}, at) == head.size();
    };
    std::size_t place = 2;  // behind the start marker
    while (read(place) && head[0] == 0xFF && head[1] != 0xDA) {
        see(head[1]);
        place += head[1] == 0xFF ? 1U : 2U + head[2] * 256U + head[3];
    }
    return place;
}

// libjpeg fills what a cut file lacks with grey and says nothing. A whole file has its end marker
// after the first scan; within a scan the marker's bytes cannot occur.
bool jpeg_has_end(const ReadableFile& in) {
    std::size_t place = scans_of(in, [](int) {});
    std::vector<char> chunk(1 << 20);
    char last = 0;
    for (std::size_t got; (got = in.read(chunk, place)) > 0; place += got) {
        const std::string_view bytes(chunk.data(), got);
        if (last == '\xff' && bytes.front() == '\xd9') return true;
        if (bytes.find("\xff\xd9") != bytes.npos) return true;
        last = bytes.back();
    }
    return false;
}

bool is_progressive_jpeg(const ReadableFile& in) {
    bool progressive = false;
    scans_of(in, [&](int marker) { progressive |= marker == 0xC2; });
    return progressive;
}

constexpr int kDecodedRows = 256;  // at once by OpenImageIO

// libjpeg keeps 16 bits for each value of a picture that comes in many passes.
std::size_t decoder_bytes(const ReadableFile& in, Codec codec, const Image& shape) {
    if (codec == Codec::png) return bytes_per_row(shape);
    if (codec == Codec::jpeg && is_progressive_jpeg(in)) return 2 * bytes_of_pixels(shape);
    return 2 * bytes_per_row(shape) *
           static_cast<std::size_t>(std::min(kDecodedRows, shape.size.y));
}

}  // namespace

std::size_t bytes_per_row(const Image& image) {
    return static_cast<std::size_t>(image.size.x) * static_cast<std::size_t>(image.channels) *
           bytes_per_value(image.type);
}

// Enough for the threads of an encoder, and full rows of tiles.
int rows_at_once(const Image& shape) {
    constexpr std::size_t kBytesAtOnce = 1 << 24;
    const std::size_t row_of_tiles = bytes_per_row(shape) * kFileTile;
    return static_cast<int>(std::max<std::size_t>(kBytesAtOnce / row_of_tiles, 1)) * kFileTile;
}

std::size_t bytes_of_pixels(const Image& shape) {
    return bytes_per_row(shape) * static_cast<std::size_t>(shape.size.y);
}

Image make_shape(const fs::path& file, glm::ivec2 size, int channels, ChannelType type) {
    if (const auto cause = size_complaint(size, kMaxSide); !cause.empty()) {
        throw cannot_read(file, cause);
    }
    return {.size = size, .channels = channels, .type = type, .pixels = {}};
}

void make_room(Image& shape) {
    shape.pixels.resize(bytes_of_pixels(shape));
}

void prepare_image_library(const fs::path& file) {
    if (codec_of(file).value_or(Codec::png) != Codec::png) prepare_oiio();
}

bool can_write(const fs::path& file) {
    return codec_of(file).has_value();
}

bool holds_floats(const fs::path& file) {
    const auto codec = codec_of(file);
    return codec && has_floats(*codec);
}

bool holds_light(const fs::path& file) {
    const auto codec = codec_of(file);
    return codec == Codec::exr || codec == Codec::hdr;
}

bool begins_with_metadata(const fs::path& file) {
    const auto codec = codec_of(file);
    return codec == Codec::png || codec == Codec::exr;
}

bool has_tiles(const fs::path& file) {
    const auto codec = codec_of(file);
    return codec == Codec::exr || codec == Codec::tiff;
}

std::string refusal_of(const fs::path& file, const FileFormat& format) {
    const Codec codec = codec_of(file).value_or(Codec::png);
    if (!format.values.empty() && codec != Codec::exr) {
        return "--format chooses between the floats of an .exr file; others leave no choice.";
    }
    if (!format.values.empty() && format.values != "half" && format.values != "float") {
        return fmt::format("--format {}: write half or float.", format.values);
    }
    if (format.quality != 0 && codec != Codec::jpeg) return "--quality is for .jpg files.";
    if (format.compression.empty() || is_compression(codec, format.compression)) return "";
    return fmt::format("--compression {}: {}.", format.compression,
                       codec == Codec::exr
                           ? "an .exr file takes none, rle, zip, zips, piz, pxr24, "
                             "b44, b44a, dwaa or dwab; zip:1 or dwaa:45 say how much"
                       : codec == Codec::tiff ? "a .tif file takes none, lzw, zip or packbits"
                                              : "only .exr and .tif files leave a choice");
}

std::string size_refusal(const fs::path& file, glm::ivec2 size) {
    const auto codec = codec_of(file);
    if (!codec) return "";
    const std::string cause = size_complaint(size, largest_side_of(*codec));
    return cause.empty() ? "" : cannot_write(file, cause).what();
}

// OpenImageIO gets so many rows at a time and makes two copies of them.
std::size_t encoder_bytes(const fs::path& file, const Image& shape) {
    if (codec_of(file).value_or(Codec::png) == Codec::png) return bytes_per_row(shape) * 2;
    const auto rows = static_cast<std::size_t>(std::min(rows_at_once(shape), shape.size.y));
    return bytes_per_row(shape) * rows * 2;
}

ImageWriter::ImageWriter(const fs::path& file, const Image& shape, const Metadata& metadata,
                         const FileFormat& format)
    : file_(file) {
    const auto named = codec_of(file);
    if (!named) {
        throw cannot_write(file, "Its name should end in .png, .exr, .jpg, .tif or .hdr");
    }
    const Codec codec = *named;
    check_shape(file, shape, codec);
    channels_ = channels_in_file(codec, shape.channels);
    const Image kept{.size = shape.size, .channels = channels_, .type = shape.type, .pixels = {}};
    out_ = std::make_unique<TemporaryFile>(file);
    encoder_ = codec == Codec::png
                   ? encode_png(*out_, file, kept, metadata)
                   : encode_by_oiio(*out_, file, kOiioNames.of(codec), kept, metadata, format);
}

ImageWriter::~ImageWriter() = default;

void ImageWriter::write(const Image& band) {
    const std::size_t bytes = bytes_of_pixels(band);
    if (band.pixels.size() != bytes) {
        throw cannot_write(file_, fmt::format("The picture has {} bytes where its size needs {}",
                                              band.pixels.size(), bytes));
    }
    if (channels_ == band.channels) return encoder_->write(band);
    encoder_->write(with_channels(band, channels_));
}

void ImageWriter::finish() {
    encoder_->finish();
    encoder_.reset();
    out_->commit();
}

void write_image(const fs::path& file, const Image& image, const Metadata& metadata,
                 const FileFormat& format) {
    ImageWriter writer(file, image, metadata, format);
    writer.write(image);
    writer.finish();
}

Image with_channels(const Image& image, int channels) {
    Image out{.size = image.size, .channels = channels, .type = image.type, .pixels = {}};
    const std::size_t value = bytes_per_value(image.type);
    const std::size_t count =
        static_cast<std::size_t>(image.size.x) * static_cast<std::size_t>(image.size.y);
    const auto from_channels = static_cast<std::size_t>(image.channels);
    const auto to_channels = static_cast<std::size_t>(channels);
    out.pixels.resize(count * to_channels * value);
    const std::byte* from = image.pixels.data();
    std::byte* to = out.pixels.data();
    for (std::size_t i = 0; i < count; ++i, from += from_channels * value) {
        for (std::size_t c = 0; c < to_channels; ++c, to += value) {
            const std::size_t grey = c == 3 ? from_channels - 1 : 0;
            std::memcpy(to, from + (image.channels < 3 ? grey : c) * value, value);
        }
    }
    return out;
}

ImageFacts read_image_facts(const fs::path& file) {
    const ReadableFile in(file);
    const Codec codec = codec_by_content(file, in);
    const Image shape = codec == Codec::png ? read_png_shape(file, in)
                                            : read_shape_by_oiio(file, in, kOiioNames.of(codec));
    return {.size = shape.size,
            .channels = shape.channels,
            .type = shape.type,
            .pixel_bytes = bytes_of_pixels(shape),
            .decoder_bytes = decoder_bytes(in, codec, shape)};
}

Image read_image(const fs::path& file) {
    const ReadableFile in(file);
    const Codec codec = codec_by_content(file, in);
    if (codec == Codec::jpeg && !jpeg_has_end(in)) throw cannot_read(file, "It is cut short");
    return codec == Codec::png ? read_png(file, in) : read_by_oiio(file, in, kOiioNames.of(codec));
}

}  // namespace glint
