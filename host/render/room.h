// Whether buffers fit into the driver and into memory, and what else a run takes into the latter.
// Each of these throws NoRoom, which says what does not, and what to do.
#pragma once

#include "render/buffer.h"

#include <span>
#include <stdexcept>
#include <string>

namespace glint {

struct NoRoom : std::runtime_error {
    using std::runtime_error::runtime_error;
};

struct WantedBuffer {
    std::string name;
    BufferShape shape;
};

// What takes memory, by a name that fits behind "2.0 GiB is needed for".
struct WantedMemory {
    std::string name;
    std::size_t bytes = 0;
};

// Pixels on a side of the largest texture.
int largest_side();

// What a driver takes of textures, for threads that cannot ask it.
struct TextureLimits {
    int side = 16384, cube_side = 16384;  // pixels
    bool in_memory = true;                // beside the program's own, as a software renderer's are
};
TextureLimits texture_limits();

// Bytes that may still be taken for pictures and buffers: of what is available, the program itself
// needs some more, for libraries and shaders that are not there yet.
std::size_t free_memory();

// Beyond the driver's limit on a side.
void require_drawable(const WantedBuffer& wanted);

// Together beyond the system's memory, where that is what the driver takes.
void require_memory(std::span<const WantedBuffer> wanted);

// Together beyond the system's memory. `advice` is a sentence that says what to do.
void require_memory(std::span<const WantedMemory> wanted, const std::string& advice);

// Refused by the driver when it was made.
void require_room(const Buffer& made, const std::string& name);

}  // namespace glint
