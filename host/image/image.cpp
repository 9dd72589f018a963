// Chooses how a file is written by its name and how it is read by its first bytes.
#include "image/image.h"

#include "image/codecs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

namespace glint {
namespace {

namespace fs = std::filesystem;

enum class Codec { png, exr, jpeg, tiff, hdr };

struct Extension {
    std::string_view name;
    Codec codec;
};

constexpr Extension kExtensions[] = {
    {".png", Codec::png},  {".exr", Codec::exr},   {".jpg", Codec::jpeg}, {".jpeg", Codec::jpeg},
    {".tif", Codec::tiff}, {".tiff", Codec::tiff}, {".hdr", Codec::hdr},
};

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

const char* oiio_name(Codec codec) {
    switch (codec) {
        case Codec::png:
            return "png";
        case Codec::exr:
            return "openexr";
        case Codec::jpeg:
            return "jpeg";
        case Codec::tiff:
            return "tiff";
        case Codec::hdr:
            return "hdr";
    }
    return "";
}

bool has_floats(Codec codec) {
    return codec == Codec::exr || codec == Codec::tiff || codec == Codec::hdr;
}

const Extension* find_extension(const fs::path& file) {
    std::string name = file.extension().string();
    for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    const auto* found = std::find_if(std::begin(kExtensions), std::end(kExtensions),
                                     [&](const Extension& e) { return e.name == name; });
    return found == std::end(kExtensions) ? nullptr : found;
}

std::size_t bytes_per_value(ChannelType type) {
    return type == ChannelType::f32 ? 4 : 1;
}

void check_size(const fs::path& file, glm::ivec2 size, bool writing) {
    if (size.x >= 1 && size.y >= 1 && size.x <= kMaxSide && size.y <= kMaxSide) return;
    const auto cause =
        fmt::format("The picture is {} x {}, and a side may be 1 to {}", size.x, size.y, kMaxSide);
    throw writing ? cannot_write(file, cause) : cannot_read(file, cause);
}

void check_picture(const fs::path& file, const Image& image, Codec codec) {
    check_size(file, image.size, true);
    if (image.channels < 1 || image.channels > 4) {
        throw cannot_write(file, fmt::format("The picture has {} channels", image.channels));
    }
    const std::size_t bytes = bytes_per_row(image) * static_cast<std::size_t>(image.size.y);
    if (image.pixels.size() != bytes) {
        throw cannot_write(file, fmt::format("The picture has {} bytes where its size needs {}",
                                             image.pixels.size(), bytes));
    }
    if ((image.type == ChannelType::f32) != has_floats(codec)) {
        throw cannot_write(file, fmt::format("This kind of file holds {}, the picture does not",
                                             has_floats(codec) ? "floats" : "bytes"));
    }
}

// The same picture with 1 or 3 channels, for files that have no others: grey spreads, alpha goes.
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
            std::memcpy(to, from + (image.channels < 3 ? 0 : c) * value, value);
        }
    }
    return out;
}

void write_content(TemporaryFile& out, const fs::path& file, Codec codec, const Image& image,
                   const Metadata& metadata) {
    const auto through_oiio = [&](int channels) {
        if (channels == image.channels) {
            return write_by_oiio(out, file, oiio_name(codec), image, metadata);
        }
        write_by_oiio(out, file, oiio_name(codec), with_channels(image, channels), metadata);
    };
    switch (codec) {
        case Codec::png:
            return write_png(out, file, image, metadata);
        case Codec::jpeg:
            return through_oiio(image.channels < 3 ? 1 : 3);
        case Codec::exr:
        case Codec::tiff:
            return through_oiio(image.channels);
        case Codec::hdr:
            return through_oiio(3);
    }
}

Codec codec_by_content(const fs::path& file) {
    std::error_code error;
    if (fs::is_directory(file, error)) {
        throw cannot_read(file, std::generic_category().message(EISDIR));
    }
    std::ifstream in(file, std::ios::binary);
    if (!in) throw cannot_read(file, std::generic_category().message(errno));
    std::array<char, 16> buffer{};
    in.read(buffer.data(), buffer.size());
    const std::string_view head(buffer.data(), static_cast<std::size_t>(in.gcount()));
    if (head.empty()) throw cannot_read(file, "The file is empty");
    for (const auto& [bytes, codec] : kSignatures) {
        if (head.substr(0, bytes.size()) == bytes) return codec;
    }
    throw cannot_read(file, "It is not a png, jpg, exr, hdr or tif picture");
}

// libjpeg fills what a cut file lacks with grey and says nothing. A whole file has its end marker
// after the first scan; within a scan the marker's bytes cannot occur.
bool jpeg_has_end(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(bytes[i]); };
    std::size_t place = 2;  // behind the start marker
    while (place + 4 <= bytes.size() && byte(place) == 0xFF && byte(place + 1) != 0xDA) {
        place += byte(place + 1) == 0xFF ? 1U : 2U + byte(place + 2) * 256U + byte(place + 3);
    }
    return place < bytes.size() && bytes.find("\xff\xd9", place) != std::string::npos;
}

}  // namespace

std::size_t bytes_per_row(const Image& image) {
    return static_cast<std::size_t>(image.size.x) * static_cast<std::size_t>(image.channels) *
           bytes_per_value(image.type);
}

Image make_image(const fs::path& file, glm::ivec2 size, int channels, ChannelType type) {
    check_size(file, size, false);
    Image image{.size = size, .channels = channels, .type = type, .pixels = {}};
    image.pixels.resize(bytes_per_row(image) * static_cast<std::size_t>(size.y));
    return image;
}

void prepare_image_library(const fs::path& file) {
    const Extension* extension = find_extension(file);
    if (!extension || extension->codec == Codec::png) return;
    prepare_oiio();
}

bool can_write(const fs::path& file) {
    return find_extension(file) != nullptr;
}

bool holds_floats(const fs::path& file) {
    const Extension* extension = find_extension(file);
    return extension && has_floats(extension->codec);
}

void write_image(const fs::path& file, const Image& image, const Metadata& metadata) {
    const Extension* extension = find_extension(file);
    if (!extension) {
        throw cannot_write(file, "Its name should end in .png, .exr, .jpg, .tif or .hdr");
    }
    check_picture(file, image, extension->codec);
    TemporaryFile out(file);
    write_content(out, file, extension->codec, image, metadata);
    out.commit();
}

Image read_image(const fs::path& file) {
    const Codec codec = codec_by_content(file);
    if (codec == Codec::jpeg && !jpeg_has_end(file)) throw cannot_read(file, "It is cut short");
    return codec == Codec::png ? read_png(file) : read_by_oiio(file, oiio_name(codec));
}

void write_whole_file(const fs::path& file, std::span<const std::byte> bytes) {
    TemporaryFile out(file);
    out.append(bytes);
    out.commit();
}

}  // namespace glint
