// What a person may fill a channel with that a pasted text reads and nothing fills.
#pragma once

#include "window/live/playground.h"
#include "window/ui/panels.h"

#include <vector>

namespace glint {

// The empty channels of the open scene. Each is offered noise; one that reads a plane the scene's
// buffers, too, and the first pictures of the folder that holds the scene or its preset.
std::vector<EmptyChannel> empty_channels(Playground& playground);

}  // namespace glint
