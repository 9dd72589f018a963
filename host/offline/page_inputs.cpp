#include "offline/page_inputs.h"

#include "media/sound.h"
#include "offline/input_files.h"

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <zlib.h>

#include <array>
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

// The texture that is made: its format, and what bytes for it WebGL calls what they are.
Json texture_json(glm::ivec3 size, int faces, int channels, bool floats) {
    constexpr std::array kFormats = {"r", "rg", "rgb", "rgba"};
    constexpr std::array kLayouts = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
    const auto at = static_cast<std::size_t>(channels - 1);
    return {{"format", fmt::format("{}{}", kFormats.at(at), floats ? "32f" : "8")},
            {"layout", kLayouts.at(at)},
            {"size", {size.x, size.y, size.z}},
            {"faces", faces}};
}

// The sizes of a cubemap have no third one, but it has faces.
Json texture_json(SamplerType type, glm::ivec2 size, int slices, int channels, bool floats) {
    const bool is_cube = type == SamplerType::samplerCube;
    return texture_json({size, is_cube ? 1 : slices}, is_cube ? slices : 1, channels, floats);
}

Json sound_json(const Sampler& sampler) {
    const Sound sound = read_sound(sampler.files.front());
    Json json = texture_json({512, 2, 1}, 1, 1, false);
    json["seconds"] = sound.seconds();
    json["data"] = inlined(std::as_bytes(std::span(sound.samples)));
    return json;
}

Json pixels_json(const Sampler& sampler, const TextureLimits& limits) {
    InputContent pixels = decode_input(sampler, limits);
    add_alpha(pixels);
    Json json =
        texture_json(sampler.type, pixels.size, pixels.slices, pixels.channels, pixels.floats);
    if (pixels.floats) json["floats"] = true;
    json["data"] = inlined(pixels.bytes);
    return json;
}

Json noise_json(const Sampler& sampler) {
    const bool is_cube = sampler.type == SamplerType::samplerCube;
    Json json = texture_json(sampler.type, glm::ivec2(sampler.noise_size),
                             is_cube ? static_cast<int>(kCubeFaces) : sampler.noise_size.z,
                             sampler.noise_channels, false);
    json["channels"] = sampler.noise_channels;
    json["plays"] = sampler.plays;
    return json;
}

// A texture's kind, as WebGL names it behind TEXTURE_.
const char* kind_of(SamplerType type) {
    switch (type) {
        case SamplerType::sampler2D:
            return "2D";
        case SamplerType::sampler3D:
            return "3D";
        case SamplerType::samplerCube:
            return "CUBE_MAP";
    }
    return "";
}

// What WebGL's samplers are told, as pairs of its numbers.
Json modes_json(const Sampler& sampler) {
    const int wrap = sampler.wrap == Wrap::clamp    ? GL_CLAMP_TO_EDGE
                     : sampler.wrap == Wrap::repeat ? GL_REPEAT
                                                    : GL_MIRRORED_REPEAT;
    const int large = sampler.filter == Filter::nearest ? GL_NEAREST : GL_LINEAR;
    const int small = sampler.filter == Filter::mipmap ? GL_LINEAR_MIPMAP_LINEAR : large;
    return {{GL_TEXTURE_WRAP_S, wrap},
            {GL_TEXTURE_WRAP_T, wrap},
            {GL_TEXTURE_WRAP_R, wrap},
            {GL_TEXTURE_MAG_FILTER, large},
            {GL_TEXTURE_MIN_FILTER, small}};
}

}  // namespace

Json page_input(const Sampler& sampler, const TextureLimits& limits) {
    const auto made = [&](const char* source, const Json& content) {
        Json input = {{"source", source},
                      {"kind", kind_of(sampler.type)},
                      {"filter", kFilterNames.of(sampler.filter)},
                      {"modes", modes_json(sampler)}};
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
            return made("keyboard", texture_json({256, 3, 1}, 1, 1, false));
    }
    return made("none", Json::object());
}

}  // namespace glint
