// Whether the files that a scene reads fit into the driver and into memory, before they are read.
#pragma once

#include "render/room.h"
#include "scene/scene.h"

namespace glint {

// On any thread. Of an image, a cube or a volume, by what their files say of themselves. Throws
// std::runtime_error with a whole sentence that names the file: where it is unreadable, its texture
// larger than the driver's largest, or its pixels, decoder and texture more than the memory that is
// free.
void require_room_for_files(const Sampler& sampler, const TextureLimits& limits);

}  // namespace glint
