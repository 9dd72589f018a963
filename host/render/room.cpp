#include "render/room.h"

#include "gl/context.h"
#include "render/memory.h"

#include <fmt/format.h>

#include <stdexcept>

namespace glint {
namespace {

constexpr const char* kMakeSmaller =
    "Make the picture smaller with --size, or give buffers a size= or scale= of their own.";

double gibibytes(std::size_t bytes) {
    return static_cast<double>(bytes) / (1 << 30);
}

}  // namespace

void require_drawable(const WantedBuffer& wanted) {
    const glm::ivec2 size = wanted.shape.size;
    GLint limit = 0;
    glGetIntegerv(GL_MAX_TEXTURE_SIZE, &limit);
    if (size.x <= limit && size.y <= limit) return;
    throw std::runtime_error(fmt::format("{} is {}x{} pixels; this driver draws up to {}x{}. {}",
                                         wanted.name, size.x, size.y, limit, limit, kMakeSmaller));
}

// A driver that draws on the processor takes what it is asked for, and when memory ends, the system
// kills whom it likes.
void require_memory(std::span<const WantedBuffer> wanted) {
    if (!draws_in_software()) return;
    const WantedBuffer* largest = nullptr;
    std::size_t all = 0;
    for (const WantedBuffer& one : wanted) {
        all += byte_count(one.shape);
        if (!largest || byte_count(one.shape) > byte_count(largest->shape)) largest = &one;
    }
    const std::size_t available = available_memory();
    if (all <= available) return;
    throw std::runtime_error(fmt::format(
        "The buffers take {:.1f} GiB, {} alone {:.1f} GiB, and {:.1f} GiB of memory are free. {}",
        gibibytes(all), largest->name, gibibytes(byte_count(largest->shape)), gibibytes(available),
        kMakeSmaller));
}

void require_room(const Buffer& made, const std::string& name) {
    if (made.is_whole()) return;
    take_complaint();  // it is told here
    const BufferShape& shape = made.shape();
    throw std::runtime_error(
        fmt::format("{} is {}x{} pixels and takes {:.1f} GiB, for which this driver has no room. "
                    "{}",
                    name, shape.size.x, shape.size.y, gibibytes(byte_count(shape)), kMakeSmaller));
}

}  // namespace glint
