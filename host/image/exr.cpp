// OpenEXR without a library: one uncompressed scanline part of 32-bit floats, written row by row.
//
// The format is the one of "OpenEXR File Layout": magic, version, attributes, a table with the
// place of every row, then the rows, top down, each with its channels one after the other by name.
// No date and no name of a program goes in, so that equal pictures are equal files.
#include "image/codecs.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

namespace glint {
namespace {

static_assert(std::endian::native == std::endian::little, "EXR files are little-endian");

constexpr std::int32_t kMagic = 20000630;
constexpr std::int32_t kVersion = 2;
constexpr std::int32_t kLongNames = 0x400;  // attribute names up to 255 bytes
constexpr std::int32_t kFloat = 2;

struct Channel {
    const char* name;
    int index;  // within a pixel of the image
};

// Sorted by name, as the format wants them.
std::vector<Channel> channels_by_name(int channels) {
    switch (channels) {
        case 1:
            return {{"Y", 0}};
        case 2:
            return {{"G", 1}, {"R", 0}};
        case 3:
            return {{"B", 2}, {"G", 1}, {"R", 0}};
        default:
            return {{"A", 3}, {"B", 2}, {"G", 1}, {"R", 0}};
    }
}

template <class T>
void put(std::string& out, const T& value) {
    out.append(reinterpret_cast<const char*>(&value), sizeof(T));
}

void put_attribute(std::string& out, const std::string& name, const char* type,
                   const std::string& value) {
    out += name + '\0' + type + '\0';
    put(out, static_cast<std::int32_t>(value.size()));
    out += value;
}

template <class T>
std::string bytes_of(const T& value) {
    std::string out;
    put(out, value);
    return out;
}

std::string channel_list(const std::vector<Channel>& channels) {
    std::string out;
    for (const Channel& channel : channels) {
        out += std::string(channel.name) + '\0';
        put(out, std::array<std::int32_t, 4>{kFloat, 0, 1, 1});  // type, linear, sampling in x, y
    }
    return out + '\0';
}

// Names under which the format expects something other than text.
bool has_type_of_its_own(std::string_view name) {
    constexpr std::string_view kNames[] = {"",
                                           "channels",
                                           "compression",
                                           "dataWindow",
                                           "displayWindow",
                                           "lineOrder",
                                           "pixelAspectRatio",
                                           "screenWindowCenter",
                                           "screenWindowWidth",
                                           "tiles",
                                           "chunkCount",
                                           "chromaticities",
                                           "preview",
                                           "version"};
    return std::ranges::find(kNames, name) != std::end(kNames);
}

std::string header(const Image& image, const std::vector<Channel>& channels,
                   const Metadata& metadata) {
    const std::array<std::int32_t, 4> window{0, 0, image.size.x - 1, image.size.y - 1};
    std::string out;
    put(out, kMagic);
    put(out, kVersion | kLongNames);
    put_attribute(out, "channels", "chlist", channel_list(channels));
    put_attribute(out, "compression", "compression", bytes_of(std::uint8_t{0}));
    put_attribute(out, "dataWindow", "box2i", bytes_of(window));
    put_attribute(out, "displayWindow", "box2i", bytes_of(window));
    put_attribute(out, "lineOrder", "lineOrder", bytes_of(std::uint8_t{0}));
    put_attribute(out, "pixelAspectRatio", "float", bytes_of(1.0F));
    put_attribute(out, "screenWindowCenter", "v2f", bytes_of(std::array{0.0F, 0.0F}));
    put_attribute(out, "screenWindowWidth", "float", bytes_of(1.0F));
    for (const auto& [name, value] : metadata) {
        const std::string own = name.substr(0, 240).c_str();
        put_attribute(out, has_type_of_its_own(own) ? "glint:" + own : own, "string", value);
    }
    return out + '\0';
}

}  // namespace

void write_exr(TemporaryFile& out, const Image& image, const Metadata& metadata) {
    const auto channels = channels_by_name(image.channels);
    const auto width = static_cast<std::size_t>(image.size.x);
    const auto height = static_cast<std::size_t>(image.size.y);
    const std::size_t pixel_bytes = static_cast<std::size_t>(image.channels) * sizeof(float);
    const std::size_t data_bytes = width * pixel_bytes;

    std::string head = header(image, channels, metadata);
    std::uint64_t place = head.size() + height * sizeof(std::uint64_t);
    for (std::size_t y = 0; y < height; ++y) {
        put(head, place);
        place += 2 * sizeof(std::int32_t) + data_bytes;
    }
    out.append(std::as_bytes(std::span(head)));

    std::vector<std::byte> line(2 * sizeof(std::int32_t) + data_bytes);
    for (std::size_t y = 0; y < height; ++y) {
        const std::array<std::int32_t, 2> prefix{static_cast<std::int32_t>(y),
                                                 static_cast<std::int32_t>(data_bytes)};
        std::memcpy(line.data(), prefix.data(), sizeof prefix);
        std::byte* to = line.data() + sizeof prefix;
        const std::byte* row = image.pixels.data() + (height - 1 - y) * data_bytes;
        for (const Channel& channel : channels) {
            const std::byte* from = row + static_cast<std::size_t>(channel.index) * sizeof(float);
            for (std::size_t x = 0; x < width; ++x, to += sizeof(float), from += pixel_bytes) {
                std::memcpy(to, from, sizeof(float));
            }
        }
        if (!out.append(line)) return;  // commit() says why
    }
}

}  // namespace glint
