#include "window/live/kept_maps.h"

#include "base/hash.h"
#include "base/readable_file.h"
#include "base/temporary_file.h"

#include <fmt/format.h>

#include <exception>
#include <utility>
#include <vector>

namespace glint {
namespace {

namespace fs = std::filesystem;

// More takes as long to read as to draw.
constexpr std::size_t kMostBytes = std::size_t{64} << 20;

std::size_t bytes_of(const Renderer& renderer) {
    std::size_t bytes = 0;
    for (const std::size_t index : renderer.maps()) bytes += renderer.buffer(index).byte_count();
    return bytes;
}

// Constants are part of the programs' texts.
std::string digest_of(const Preset& preset, const Renderer& renderer, const ProgramShelf& shelf,
                      const std::string& driver) {
    Hash digest;
    digest.add(driver);
    for (const std::size_t index : renderer.maps()) {
        const PassProgram& program = renderer.scene().programs[index];
        const std::string* text = shelf.text_of(program.id);
        if (!text) return "";
        digest.add(*text);
        const BufferShape& shape = renderer.buffer(index).shape();
        digest.add(fmt::format("{} {} {} {} {} {}", shape.size.x, shape.size.y,
                               static_cast<int>(shape.format), shape.outputs, shape.cube,
                               shape.mipmaps));
        for (const SamplerUniform& uniform : program.samplers) {
            const Sampler& read = sampler_at(preset, uniform.sampler);
            digest.add(fmt::format("{} {} {} {} {}", read.name, read.pass, read.output,
                                   static_cast<int>(read.filter), static_cast<int>(read.wrap)));
        }
    }
    return digest.text();
}

}  // namespace

void KeptMaps::give(const Preset& preset, Renderer& renderer, const ProgramShelf& shelf,
                    const std::string& driver) {
    forget();
    const std::size_t bytes = bytes_of(renderer);
    if (files_.folder().empty() || bytes == 0 || bytes > kMostBytes) return;
    const std::string name = digest_of(preset, renderer, shelf, driver);
    if (name.empty()) return;
    const fs::path file = files_.folder() / name;
    std::error_code error;
    if (!fs::is_regular_file(file, error)) {
        name_ = name;
        return;
    }
    try {
        const std::string kept = read_whole_file(file, bytes);
        if (!renderer.set_map_bytes(std::as_bytes(std::span(kept)))) name_ = name;
    } catch (const std::exception&) {
        name_ = name;  // not whole, or not ours: they are drawn
    }
}

void KeptMaps::keep(const Renderer& renderer) {
    const std::string name = std::exchange(name_, {});
    std::optional<std::vector<std::byte>> bytes = renderer.map_bytes();
    if (name.empty() || !bytes) return;
    files_.keep(
        name, [bytes = std::move(*bytes)](const fs::path& file) { write_whole_file(file, bytes); });
}

}  // namespace glint
