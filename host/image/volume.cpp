// The head of a volume: u32 signature, u32 x, y, z, u8 channels, u8 layout, u16 format.
#include "image/volume.h"

#include "image/temporary_file.h"

#include <fmt/format.h>

#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <system_error>

namespace glint {
namespace {

constexpr std::size_t kHeadBytes = 20;
constexpr std::uint32_t kMostVoxels = 2048;  // along a side: what every desktop GL takes
constexpr std::uint16_t kBytes = 0, kFloats = 10;

static_assert(std::endian::native == std::endian::little);

template <class T>
T number_at(const std::vector<std::byte>& bytes, std::size_t at) {
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

std::vector<std::byte> read_whole(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary | std::ios::ate);
    const auto size = in ? static_cast<std::streamoff>(in.tellg()) : std::streamoff{-1};
    // Folders open, too, and have a length of their own idea.
    if (size < 0 || !std::filesystem::is_regular_file(file))
        throw cannot_read(file, std::generic_category().message(errno ? errno : EISDIR));
    std::vector<std::byte> bytes(static_cast<std::size_t>(size));
    in.seekg(0);
    in.read(reinterpret_cast<char*>(bytes.data()), size);
    if (!in) throw cannot_read(file, std::generic_category().message(EIO));
    return bytes;
}

}  // namespace

Volume read_volume(const std::filesystem::path& file) {
    errno = 0;
    std::vector<std::byte> bytes = read_whole(file);
    if (bytes.size() < kHeadBytes) throw cannot_read(file, "It is too short for a volume");
    const glm::uvec3 size(number_at<std::uint32_t>(bytes, 4), number_at<std::uint32_t>(bytes, 8),
                          number_at<std::uint32_t>(bytes, 12));
    const int channels = number_at<std::uint8_t>(bytes, 16);
    const auto format = number_at<std::uint16_t>(bytes, 18);
    const auto is_side = [](std::uint32_t side) { return side >= 1 && side <= kMostVoxels; };
    if (!is_side(size.x) || !is_side(size.y) || !is_side(size.z) || channels < 1 || channels > 4 ||
        (format != kBytes && format != kFloats)) {
        throw cannot_read(
            file, fmt::format("Its head tells of {} x {} x {} voxels, {} channels and format {}; "
                              "known are sides from 1 to {}, 1 to 4 channels, and the formats 0 "
                              "(bytes) and 10 (floats)",
                              size.x, size.y, size.z, channels, format, kMostVoxels));
    }
    const std::uint64_t wanted = std::uint64_t{size.x} * size.y * size.z *
                                 static_cast<std::uint64_t>(channels) * (format == kFloats ? 4 : 1);
    if (bytes.size() - kHeadBytes != wanted) {
        throw cannot_read(file,
                          fmt::format("It holds {} bytes of voxels where its head tells of {}",
                                      bytes.size() - kHeadBytes, wanted));
    }
    bytes.erase(bytes.begin(), bytes.begin() + kHeadBytes);
    return {.size = size,
            .channels = channels,
            .type = format == kFloats ? ChannelType::f32 : ChannelType::u8,
            .voxels = std::move(bytes)};
}

}  // namespace glint
