// What the processes that refine and sketch have in common: an order comes, pictures go.
#pragma once

#include "render/renderer.h"
#include "window/trial/refiner.h"

#include <cstddef>
#include <span>
#include <string>

namespace glint {

// The next whole message at standard input, waited for, and bytes back. Where the window is gone,
// or has moved on, so is this process.
std::string receive_message();
void send_all(std::span<const std::byte> bytes);

// Waits for it. Where the window is gone, or has moved on, so is this process.
RefineOrder receive_refine_order();

Frame frame_of(const RefineOrder& order);

// How many samples are done, and, where there is one, the picture of them.
void send_refined(int done, Renderer* renderer);

}  // namespace glint
