#include "window/trial/given_buffers.h"

#include <algorithm>
#include <stdexcept>

namespace glint {
namespace {

bool is_read(const CompiledScene& scene, std::size_t sampler) {
    return std::ranges::any_of(scene.programs, [&](const PassProgram& program) {
        return std::ranges::find(program.samplers, sampler, &SamplerUniform::sampler) !=
               program.samplers.end();
    });
}

PixelView view_of(const GivenPicture& picture, std::span<const std::byte> memory) {
    const glm::ivec2 size = picture.given.size;
    const std::size_t bytes =
        static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * 4 * sizeof(float);
    return {.size = size,
            .floats = true,
            .data = memory.subspan(picture.given.begin + picture.output * bytes, bytes)};
}

}  // namespace

std::vector<GivenPicture> as_pictures(Preset& preset, const std::vector<GivenBuffer>& buffers) {
    std::vector<GivenPicture> pictures;
    auto& own = preset.scene.samplers;
    for (std::size_t i = 0; i < sampler_count(preset); ++i) {
        Sampler& sampler = i < own.size() ? own[i] : preset.channels.at(i - own.size());
        const auto given = std::ranges::find(buffers, sampler.pass, &GivenBuffer::pass);
        if (sampler.source != Source::buffer || given == buffers.end()) continue;
        sampler.source = Source::image;
        pictures.push_back({i, *given, sampler.output});
    }
    return pictures;
}

SentPictures send_ahead(const Preset& preset, const std::vector<GivenPicture>& pictures,
                        std::span<const std::byte> memory) {
    SentPictures sent;
    for (const GivenPicture& picture : pictures) {
        const PixelView view = view_of(picture, memory);
        const bool mipmaps = sampler_at(preset, picture.sampler).filter == Filter::mipmap;
        sent.try_emplace(picture.sampler, view, mipmaps).first->second.send(view, view.size.y);
    }
    return sent;
}

void hand_over(const std::vector<GivenPicture>& pictures, std::span<const std::byte> memory,
               SentPictures& sent, Renderer& renderer) {
    for (const GivenPicture& picture : pictures) {
        if (!is_read(renderer.scene(), picture.sampler)) continue;
        if (!picture.given.is_known) {
            renderer.set_image(picture.sampler, view_of(picture, memory));
            continue;
        }
        const auto known = sent.find(picture.sampler);
        if (known == sent.end()) throw std::runtime_error("A map was not given.");
        renderer.set_image(picture.sampler, known->second);
    }
}

}  // namespace glint
