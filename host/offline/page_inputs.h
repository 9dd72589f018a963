// What samplers of a web page read: files become bytes in base64.
#pragma once

#include "render/room.h"
#include "scene/preset.h"

#include <nlohmann/json.hpp>

namespace glint {

// What fills a sampler, and how it is read. Of a buffer, which output; the plan adds the pass.
// Throws std::runtime_error that names the file.
nlohmann::ordered_json page_input(const Sampler& sampler, const TextureLimits& limits);

}  // namespace glint
