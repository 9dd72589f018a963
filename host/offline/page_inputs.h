// What samplers of a web page read: files become bytes in base64.
#pragma once

#include "render/room.h"
#include "scene/preset.h"

#include <nlohmann/json.hpp>

#include <string>

namespace glint {

// What is done with a texture beyond reading its texels.
struct PageTextureUse {
    bool drawn = false, filtered = false, mipmaps = false;
};

// {target, image, faces, formats, mipmaps}: a texture in WebGL's numbers, and in which formats it
// may be made: [name, extension…], the first that a browser has all extensions for.
nlohmann::ordered_json page_texture(SamplerType type, const std::string& format,
                                    const PageTextureUse& use);

// A sampler that nothing fills: one texel of 0.
nlohmann::ordered_json page_unfilled(SamplerType type);

// What fills a sampler, and how it is read. Of a buffer, which output; the plan adds the pass.
// Throws std::runtime_error that names the file.
nlohmann::ordered_json page_input(const Sampler& sampler, const TextureLimits& limits);

}  // namespace glint
