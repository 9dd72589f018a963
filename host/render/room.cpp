#include "render/room.h"

#include "base/memory.h"
#include "gl/context.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

namespace glint {
namespace {

constexpr const char* kMakeSmaller =
    "Make the picture smaller with --size, or give buffers a size= or scale= of their own.";

std::string amount(std::size_t bytes) {
    constexpr double kMebibyte = 1 << 20;
    const auto mebibytes = static_cast<double>(bytes) / kMebibyte;
    if (mebibytes < 1024.0) return fmt::format("{:.0f} MiB", mebibytes);
    return fmt::format("{:.1f} GiB", mebibytes / 1024.0);
}

}  // namespace

int largest_side() {
    return texture_limits().side;
}

TextureLimits texture_limits() {
    TextureLimits limits{.in_memory = draws_in_software()};
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limits.side);
    glGetIntegerv(GL_MAX_CUBE_MAP_TEXTURE_SIZE, &limits.cube_side);
    return limits;
}

std::size_t free_memory() {
    constexpr std::size_t kForTheProgram = std::size_t{64} << 20;
    const std::size_t available = available_memory();
    return available - std::min(available / 4, kForTheProgram);
}

void require_drawable(const WantedBuffer& wanted) {
    const glm::ivec2 size = wanted.shape.size;
    const int limit = largest_side();
    if (size.x <= limit && size.y <= limit) return;
    throw NoRoom(fmt::format("{} is {}x{} pixels; this driver draws up to {}x{}. {}", wanted.name,
                             size.x, size.y, limit, limit, kMakeSmaller));
}

// A driver that draws on the processor takes what it is asked for, and when memory ends, the system
// kills whom it likes.
void require_memory(std::span<const WantedBuffer> wanted) {
    if (!draws_in_software()) return;
    std::vector<WantedMemory> memory;
    for (const WantedBuffer& one : wanted) {
        const std::size_t bytes = byte_count(one.shape);
        memory.push_back({one.name, one.shape.mipmaps ? bytes / 3 * 4 : bytes});
    }
    require_memory(memory, kMakeSmaller);
}

void require_memory(std::span<const WantedMemory> wanted, const std::string& advice) {
    if (wanted.empty()) return;
    std::size_t all = 0;
    for (const WantedMemory& one : wanted) all += one.bytes;
    const std::size_t free = free_memory();
    if (all <= free) return;
    const WantedMemory& largest = *std::ranges::max_element(wanted, {}, &WantedMemory::bytes);
    const std::string part =
        wanted.size() > 1 ? fmt::format(", {} of it", amount(largest.bytes)) : "";
    throw NoRoom(fmt::format("{} of memory is needed{} for {}, and {} is free. {}", amount(all),
                             part, largest.name, amount(free), advice));
}

void require_room(const Buffer& made, const std::string& name) {
    if (made.is_whole()) return;
    take_complaint();  // it is told here
    const BufferShape& shape = made.shape();
    throw NoRoom(
        fmt::format("{} is {}x{} pixels and takes {}, for which this driver has no room. {}", name,
                    shape.size.x, shape.size.y, amount(byte_count(shape)), kMakeSmaller));
}

}  // namespace glint
