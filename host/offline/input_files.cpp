#include "offline/input_files.h"

#include "base/temporary_file.h"
#include "media/analyser.h"
#include "media/cube.h"
#include "media/image.h"
#include "media/volume.h"
#include "offline/common.h"
#include "offline/input_room.h"
#include "render/room.h"

#include <fmt/format.h>

#include <algorithm>
#include <new>

namespace glint {
namespace {

namespace fs = std::filesystem;

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

// As browsers hand it over: grey is a colour, and stands in red, green and blue.
Image read_coloured(const fs::path& file) {
    Image image = read_image(file);
    return image.channels < 3 ? with_channels(image, image.channels + 2) : image;
}

InputContent read_picture_input(const Sampler& sampler) {
    Image image = read_coloured(sampler.files.front());
    if (!sampler.vflip) turn_over(image);
    return {.size = image.size,
            .channels = image.channels,
            .floats = image.type == ChannelType::f32,
            .bytes = std::move(image.pixels),
            .sound = nullptr};
}

InputContent read_cube_input(const Sampler& sampler) {
    std::vector<Image> pictures;
    for (const fs::path& file : sampler.files) pictures.push_back(read_coloured(file));
    Cube cube;
    try {
        cube = make_cube(pictures);
    } catch (const std::runtime_error& problem) {
        const std::string more = sampler.files.size() > 1 ? " and the others" : "";
        throw std::runtime_error(fmt::format("Cannot make a cube of {}{}: {}",
                                             sampler.files.front().string(), more, problem.what()));
    }
    if (sampler.vflip) turn_over(cube);
    return {.size = glm::ivec2(cube.side),
            .slices = static_cast<int>(kCubeFaces),
            .channels = cube.channels,
            .floats = cube.type == ChannelType::f32,
            .bytes = std::move(cube.pixels),
            .sound = nullptr};
}

InputContent read_volume_input(const Sampler& sampler) {
    Volume volume = read_volume(sampler.files.front());
    return {.size = glm::ivec2(volume.size),
            .slices = volume.size.z,
            .channels = volume.channels,
            .floats = volume.type == ChannelType::f32,
            .bytes = std::move(volume.voxels),
            .sound = nullptr};
}

class AnalysedSound : public SoundTexture {
public:
    explicit AnalysedSound(const fs::path& file) : analyser_(read_sound(file)) {}
    std::span<const std::byte> rows_at(double time) override { return analyser_.rows_at(time); }
    double seconds() const override { return analyser_.seconds(); }

private:
    Analyser analyser_;
};

InputContent read_input(const Sampler& sampler, const TextureLimits& limits) {
    require_room_for_files(sampler, limits);
    switch (sampler.source) {
        case Source::image:
            return read_picture_input(sampler);
        case Source::cube:
            return read_cube_input(sampler);
        case Source::volume:
            return read_volume_input(sampler);
        case Source::sound: {
            InputContent input;
            input.sound = std::make_unique<AnalysedSound>(sampler.files.front());
            return input;
        }
        case Source::none:
        case Source::buffer:
        case Source::noise:
        case Source::keyboard:
            break;  // no files
    }
    return {};
}

}  // namespace

InputContent decode_input(const Sampler& sampler, const TextureLimits& limits) try {
    return read_input(sampler, limits);
} catch (const std::bad_alloc&) {
    throw cannot_read(sampler.files.front(), "There is not enough memory for it");
} catch (const std::length_error&) {
    throw cannot_read(sampler.files.front(), "There is not enough memory for it");
}

PixelView view_of(const InputContent& input) {
    return {.size = input.size,
            .slices = input.slices,
            .channels = input.channels,
            .floats = input.floats,
            .data = input.bytes};
}

void give_input(InputContent input, Renderer& renderer, std::size_t sampler) {
    if (input.sound) return renderer.set_sound(sampler, std::move(input.sound));
    renderer.set_image(sampler, view_of(input));
}

void load_inputs(const Preset& preset, Renderer& renderer) {
    const TextureLimits limits = texture_limits();
    Diagnostics diagnostics;
    for (const std::size_t sampler : renderer.inputs_needed()) {
        try {
            give_input(decode_input(sampler_at(preset, sampler), limits), renderer, sampler);
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
