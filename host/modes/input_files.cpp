#include "modes/input_files.h"

#include "image/cube.h"
#include "image/image.h"
#include "image/volume.h"
#include "modes/common.h"
#include "modes/input_room.h"
#include "render/room.h"
#include "sound/analyser.h"

#include <algorithm>

namespace glint {
namespace {

// The first row of the file becomes the bottom of the picture.
void turn_over(Image& image) {
    const auto row = image.pixels.size() / static_cast<std::size_t>(image.size.y);
    auto low = image.pixels.begin();
    auto high = image.pixels.end() - static_cast<std::ptrdiff_t>(row);
    for (; low < high;
         low += static_cast<std::ptrdiff_t>(row), high -= static_cast<std::ptrdiff_t>(row)) {
        std::swap_ranges(low, low + static_cast<std::ptrdiff_t>(row), high);
    }
}

void load_image(const Sampler& sampler, Renderer& renderer, std::size_t index) {
    Image image = read_image(sampler.files.front());
    if (!sampler.vflip) turn_over(image);
    renderer.set_image(index, {.size = image.size,
                               .channels = image.channels,
                               .floats = image.type == ChannelType::f32,
                               .data = image.pixels});
}

void load_cube(const Sampler& sampler, Renderer& renderer, std::size_t index) {
    std::vector<Image> pictures;
    for (const std::filesystem::path& file : sampler.files) pictures.push_back(read_image(file));
    Cube cube = make_cube(pictures);
    if (sampler.vflip) turn_over(cube);
    renderer.set_image(index, {.size = glm::ivec2(cube.side),
                               .slices = static_cast<int>(kCubeFaces),
                               .channels = cube.channels,
                               .floats = cube.type == ChannelType::f32,
                               .data = cube.pixels});
}

void load_volume(const Sampler& sampler, Renderer& renderer, std::size_t index) {
    const Volume volume = read_volume(sampler.files.front());
    renderer.set_image(index, {.size = glm::ivec2(volume.size),
                               .slices = volume.size.z,
                               .channels = volume.channels,
                               .floats = volume.type == ChannelType::f32,
                               .data = volume.voxels});
}

class AnalysedSound : public SoundTexture {
public:
    explicit AnalysedSound(const std::filesystem::path& file) : analyser_(read_sound(file)) {}
    std::span<const std::byte> rows_at(double time) override { return analyser_.rows_at(time); }
    double seconds() const override { return analyser_.seconds(); }

private:
    Analyser analyser_;
};

void load_sound(const Sampler& sampler, Renderer& renderer, std::size_t index) {
    renderer.set_sound(index, std::make_unique<AnalysedSound>(sampler.files.front()));
}

}  // namespace

void load_input(const Preset& preset, Renderer& renderer, std::size_t index) {
    const Sampler& sampler = sampler_at(preset, index);
    require_room_for_files(sampler);
    switch (sampler.source) {
        case Source::image:
            return load_image(sampler, renderer, index);
        case Source::cube:
            return load_cube(sampler, renderer, index);
        case Source::volume:
            return load_volume(sampler, renderer, index);
        case Source::sound:
            return load_sound(sampler, renderer, index);
        case Source::none:
        case Source::buffer:
        case Source::noise:
        case Source::keyboard:
            return;  // no files
    }
}

void load_inputs(const Preset& preset, Renderer& renderer) {
    Diagnostics diagnostics;
    for (const std::size_t sampler : renderer.inputs_needed()) {
        try {
            load_input(preset, renderer, sampler);
        } catch (const NoRoom&) {
            throw;  // nothing is wrong with the file
        } catch (const std::runtime_error& error) {
            const Place& place = sampler_at(preset, sampler).place;
            diagnostics.push_back({Severity::error, place, error.what(), true});
        }
    }
    report(diagnostics);
}

}  // namespace glint
