// The head of a volume: u32 signature, u32 x, y, z, u8 channels, u8 layout, u16 format.
#include "media/volume.h"

#include "base/readable_file.h"
#include "base/temporary_file.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>

namespace glint {
namespace {

constexpr std::size_t kHeadBytes = 20;
constexpr std::uint32_t kMostVoxels = 2048;  // along a side: what every desktop GL takes
constexpr std::uint16_t kBytes = 0, kFloats = 10;

static_assert(std::endian::native == std::endian::little);

template <class T>
T number_at(const std::array<char, kHeadBytes>& bytes, std::size_t at) {
    T value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

// What the head says, held against the length of the file.
VolumeFacts facts_in(const std::filesystem::path& file, const ReadableFile& in) {
    std::array<char, kHeadBytes> head{};
    if (in.read(head, 0) < kHeadBytes) throw cannot_read(file, "It is too short for a volume");
    const glm::uvec3 size(number_at<std::uint32_t>(head, 4), number_at<std::uint32_t>(head, 8),
                          number_at<std::uint32_t>(head, 12));
    const int channels = number_at<std::uint8_t>(head, 16);
    const auto format = number_at<std::uint16_t>(head, 18);
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
    // Before there is any room for them.
    if (in.size() - kHeadBytes != wanted) {
        throw cannot_read(file,
                          fmt::format("It holds {} bytes of voxels where its head tells of {}",
                                      in.size() - kHeadBytes, wanted));
    }
    return {.size = size,
            .channels = channels,
            .type = format == kFloats ? ChannelType::f32 : ChannelType::u8,
            .bytes = wanted};
}

}  // namespace

VolumeFacts read_volume_facts(const std::filesystem::path& file) {
    return facts_in(file, ReadableFile(file));
}

Volume read_volume(const std::filesystem::path& file) {
    const ReadableFile in(file);
    const VolumeFacts facts = facts_in(file, in);
    std::vector<std::byte> voxels(facts.bytes);
    const std::span room(reinterpret_cast<char*>(voxels.data()), voxels.size());
    if (in.read(room, kHeadBytes) < room.size())
        throw cannot_read(file, "It became shorter while it was read");
    return {.size = facts.size,
            .channels = facts.channels,
            .type = facts.type,
            .voxels = std::move(voxels)};
}

}  // namespace glint
