#include "offline/page_inputs.h"

#include "media/sound.h"
#include "offline/input_files.h"

#include <zlib.h>

#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

namespace glint {
namespace {

using Json = nlohmann::ordered_json;

std::vector<unsigned char> deflated(std::span<const std::byte> bytes) {
    uLongf size = compressBound(bytes.size());
    std::vector<unsigned char> result(size);
    const auto* from = reinterpret_cast<const Bytef*>(bytes.data());
    if (compress2(result.data(), &size, from, bytes.size(), Z_BEST_COMPRESSION) != Z_OK)
        throw std::runtime_error("There is not enough memory to compress a file for the page.");
    result.resize(size);
    return result;
}

std::string base64(const std::vector<unsigned char>& bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(bytes.size() - i, 3);
        unsigned bits = 0;
        for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < count ? bytes[i + k] : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += k <= count ? kDigits[bits >> (18 - 6 * k) & 63u] : '=';
    }
    return text;
}

std::string inlined(std::span<const std::byte> bytes) {
    return "data:application/octet-stream;base64," + base64(deflated(bytes));
}

// Browsers make no mipmaps of three floats to a texel.
void add_alpha(InputContent& pixels) {
    if (!pixels.floats || pixels.channels != 3) return;
    std::vector<float> rgb(pixels.bytes.size() / sizeof(float)), rgba;
    std::memcpy(rgb.data(), pixels.bytes.data(), pixels.bytes.size());
    for (std::size_t i = 0; i < rgb.size(); i += 3)
        rgba.insert(rgba.end(), {rgb[i], rgb[i + 1], rgb[i + 2], 1.0f});
    pixels.channels = 4;
    const auto bytes = std::as_bytes(std::span(rgba));
    pixels.bytes.assign(bytes.begin(), bytes.end());
}

Json sound_json(const Sampler& sampler) {
    const Sound sound = read_sound(sampler.files.front());
    return {{"seconds", sound.seconds()},
            {"data", inlined(std::as_bytes(std::span(sound.samples)))}};
}

Json pixels_json(const Sampler& sampler, const TextureLimits& limits) {
    InputContent pixels = decode_input(sampler, limits);
    add_alpha(pixels);
    return {{"size", {pixels.size.x, pixels.size.y, pixels.slices}},
            {"channels", pixels.channels},
            {"floats", pixels.floats},
            {"data", inlined(pixels.bytes)}};
}

Json noise_json(const Sampler& sampler) {
    const glm::ivec3 size = sampler.noise_size;
    const int slices =
        sampler.type == SamplerType::samplerCube ? static_cast<int>(kCubeFaces) : size.z;
    return {{"size", {size.x, size.y, slices}},
            {"channels", sampler.noise_channels},
            {"plays", sampler.plays}};
}

}  // namespace

Json page_input(const Sampler& sampler, const TextureLimits& limits) {
    const auto made = [&](const char* source, const Json& content) {
        Json input = {{"source", source},
                      {"type", glsl_name(sampler.type)},
                      {"filter", kFilterNames.of(sampler.filter)},
                      {"wrap", kWrapNames.of(sampler.wrap)}};
        input.update(content);
        return input;
    };
    switch (sampler.source) {
        case Source::none:
            break;
        case Source::buffer:
            return made("buffer", {{"output", sampler.output}});
        case Source::image:
        case Source::cube:
        case Source::volume:
            return made("pixels", pixels_json(sampler, limits));
        case Source::sound:
            return made("sound", sound_json(sampler));
        case Source::noise:
            return made("noise", noise_json(sampler));
        case Source::keyboard:
            return made("keyboard", Json::object());
    }
    return made("none", Json::object());
}

}  // namespace glint
