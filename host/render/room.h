// Whether buffers fit into the driver and into memory. Each of these throws std::runtime_error that
// says which one does not, and what to do.
#pragma once

#include "render/buffer.h"

#include <span>
#include <string>

namespace glint {

struct WantedBuffer {
    std::string name;
    BufferShape shape;
};

// Beyond the driver's limit on a side.
void require_drawable(const WantedBuffer& wanted);

// Together beyond the system's memory, where that is what the driver takes.
void require_memory(std::span<const WantedBuffer> wanted);

// Refused by the driver when it was made.
void require_room(const Buffer& made, const std::string& name);

}  // namespace glint
