#include "offline/input_room.h"

#include "media/image.h"
#include "media/volume.h"
#include "render/room.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace glint {
namespace {

namespace fs = std::filesystem;

constexpr const char* kAdvice = "Make the file's picture smaller.";

void require_texture(const fs::path& file, glm::ivec2 size, int limit) {
    if (std::max(size.x, size.y) <= limit) return;
    throw std::runtime_error(
        fmt::format("{} makes a texture of {}x{} pixels; this driver takes up to {}x{}. {}",
                    file.string(), size.x, size.y, limit, limit, kAdvice));
}

// Drivers keep three channels as four. The mipmaps are a third more.
std::size_t texture_bytes(std::size_t pixel_bytes, int channels) {
    return pixel_bytes / static_cast<std::size_t>(channels) *
           static_cast<std::size_t>(channels == 3 ? 4 : channels) / 3 * 4;
}

void require(const fs::path& file, const ImageFacts& facts, std::size_t copies, std::size_t texture,
             const TextureLimits& limits) {
    std::vector<WantedMemory> wanted = {
        {"the pixels of " + file.string(), facts.pixel_bytes + copies},
        {"decoding " + file.string(), facts.decoder_bytes}};
    if (limits.in_memory) wanted.push_back({"the texture of " + file.string(), texture});
    require_memory(wanted, kAdvice);
}

// Grey becomes three channels.
ImageFacts facts_of(const fs::path& file) {
    ImageFacts facts = read_image_facts(file);
    if (facts.channels > 2) return facts;
    facts.pixel_bytes /= static_cast<std::size_t>(facts.channels);
    facts.channels += 2;
    facts.pixel_bytes *= static_cast<std::size_t>(facts.channels);
    return facts;
}

void require_for_image(const fs::path& file, const TextureLimits& limits) {
    const ImageFacts facts = facts_of(file);
    require_texture(file, facts.size, limits.side);
    require(file, facts, 0, texture_bytes(facts.pixel_bytes, facts.channels), limits);
}

// All its pictures are there before the first face is. Turning it over takes one more copy.
void require_for_cube(const Sampler& sampler, const TextureLimits& limits) {
    const fs::path& file = sampler.files.front();
    ImageFacts facts = facts_of(file);
    const bool is_faces = sampler.files.size() > 1;
    const int side = is_faces                      ? facts.size.x
                     : facts.size.x < facts.size.y ? facts.size.x / 3
                                                   : facts.size.x / 4;
    require_texture(file, glm::ivec2(side), limits.cube_side);
    const std::size_t pixels = static_cast<std::size_t>(std::max(facts.size.x, 1)) *
                               static_cast<std::size_t>(std::max(facts.size.y, 1));
    const std::size_t cube = facts.pixel_bytes / pixels * 6 * static_cast<std::size_t>(side) *
                             static_cast<std::size_t>(side);
    facts.pixel_bytes *= sampler.files.size();
    require(file, facts, cube * (sampler.vflip ? 2 : 1), texture_bytes(cube, facts.channels),
            limits);
}

void require_for_volume(const fs::path& file, const TextureLimits& limits) {
    const VolumeFacts facts = read_volume_facts(file);
    require(file, {.pixel_bytes = facts.bytes}, 0, texture_bytes(facts.bytes, facts.channels),
            limits);
}

}  // namespace

void require_room_for_files(const Sampler& sampler, const TextureLimits& limits) {
    switch (sampler.source) {
        case Source::image:
            return require_for_image(sampler.files.front(), limits);
        case Source::cube:
            return require_for_cube(sampler, limits);
        case Source::volume:
            return require_for_volume(sampler.files.front(), limits);
        case Source::none:
        case Source::buffer:
        case Source::noise:
        case Source::keyboard:
        case Source::sound:
            return;
    }
}

}  // namespace glint
