#include "offline/page_inputs.h"

#include "media/analyser.h"
#include "offline/input_files.h"

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <zlib.h>

#include <array>
#include <cstring>
#include <stdexcept>
#include <utility>
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

// The texture that is made: its formats, and what WebGL calls the texels that it is given. The
// sizes of a cubemap have no third one.
Json texels_json(const Sampler& sampler, glm::ivec3 size, int channels, bool floats = false) {
    constexpr std::array kFormats = {"r", "rg", "rgb", "rgba"};
    constexpr std::array kLayouts = {GL_RED, GL_RG, GL_RGB, GL_RGBA};
    const auto at = static_cast<std::size_t>(channels - 1);
    if (sampler.type == SamplerType::samplerCube) size.z = 1;
    Json json =
        page_texture(sampler.type, fmt::format("{}{}", kFormats.at(at), floats ? "32f" : "8"),
                     {.filtered = sampler.filter != Filter::nearest,
                      .mipmaps = sampler.filter == Filter::mipmap});
    json["layout"] = kLayouts.at(at);
    json["type"] = floats ? GL_FLOAT : GL_UNSIGNED_BYTE;
    json["size"] = {size.x, size.y, size.z};
    return json;
}

// The rows of every block that differs from those before it.
Json sound_json(const Sampler& sampler) {
    Analyser analyser(read_sound(sampler.files.front()));
    std::vector<std::byte> rows;
    for (long block = 0; block < analyser.settled() + analyser.round(); ++block) {
        const auto now = analyser.rows_of(block);
        rows.insert(rows.end(), now.begin(), now.end());
    }
    Json json = texels_json(sampler, {kSpectrumBins, 2, 1}, 1);
    json["seconds"] = analyser.seconds();
    json["settled"] = analyser.settled();
    json["data"] = inlined(rows);
    return json;
}

Json pixels_json(const Sampler& sampler, const TextureLimits& limits) {
    InputContent pixels = decode_input(sampler, limits);
    add_alpha(pixels);
    Json json = texels_json(sampler, {pixels.size, pixels.slices}, pixels.channels, pixels.floats);
    json["data"] = inlined(pixels.bytes);
    return json;
}

Json noise_json(const Sampler& sampler) {
    Json json = texels_json(sampler, sampler.noise_size, sampler.noise_channels);
    json["channels"] = sampler.noise_channels;
    json["plays"] = sampler.plays;
    return json;
}

// WebGL's numbers of a kind of texture, and of the first image that one has.
std::pair<int, int> target_of(SamplerType type) {
    switch (type) {
        case SamplerType::sampler2D:
            return {GL_TEXTURE_2D, GL_TEXTURE_2D};
        case SamplerType::sampler3D:
            return {GL_TEXTURE_3D, GL_TEXTURE_3D};
        case SamplerType::samplerCube:
            return {GL_TEXTURE_CUBE_MAP, GL_TEXTURE_CUBE_MAP_POSITIVE_X};
    }
    return {};
}

// The format and what may stand in for it, best first; behind each what a browser must have for it.
Json formats_json(const std::string& format, const PageTextureUse& use) {
    constexpr const char* kDrawsFloats = "EXT_color_buffer_float";
    constexpr const char* kDrawsHalves = "EXT_color_buffer_half_float";
    constexpr const char* kFiltersFloats = "OES_texture_float_linear";
    const std::size_t bits = format.find_first_of("123456789");
    const std::string channels = format.substr(0, bits);
    Json formats = Json::array();
    const auto add = [&](const std::string& name, const std::vector<const char*>& extensions) {
        formats.push_back(Json::array({name}));
        for (const char* extension : extensions) formats.back().push_back(extension);
    };
    if (format.ends_with("32f")) {
        add(format, {});
        if (use.drawn || use.mipmaps) formats.back().push_back(kDrawsFloats);
        if (use.filtered) formats.back().push_back(kFiltersFloats);
    }
    const bool draws_halves = use.drawn && format.ends_with("f");
    if (draws_halves) add(channels + "16f", {kDrawsFloats});
    if (draws_halves) add(channels + "16f", {kDrawsHalves});
    // What is never missing.
    add(use.drawn || !format.ends_with('f') ? channels + "8" : channels + "16f", {});
    return formats;
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

Json page_texture(SamplerType type, const std::string& format, const PageTextureUse& use) {
    const auto [target, image] = target_of(type);
    Json json = {{"target", target},
                 {"image", image},
                 {"faces", type == SamplerType::samplerCube ? kCubeFaces : 1},
                 {"formats", formats_json(format, use)}};
    if (use.mipmaps) json["mipmaps"] = true;
    return json;
}

Json page_unfilled(SamplerType type) {
    Sampler sampler;
    sampler.type = type;
    return page_input(sampler, {});
}

Json page_input(const Sampler& sampler, const TextureLimits& limits) {
    const auto made = [&](const char* source, const Json& content) {
        Json input = {{"source", source},
                      {"target", target_of(sampler.type).first},
                      {"output", sampler.output},
                      {"modes", modes_json(sampler)}};
        input.update(content);
        return input;
    };
    switch (sampler.source) {
        case Source::none:
            break;
        case Source::buffer:
            return made("buffer", Json::object());
        case Source::image:
        case Source::cube:
        case Source::volume:
            return made("pixels", pixels_json(sampler, limits));
        case Source::sound:
            return made("sound", sound_json(sampler));
        case Source::noise:
            return made("noise", noise_json(sampler));
        case Source::keyboard:
            return made("keyboard", texels_json(sampler, {256, 3, 1}, 1));
    }
    return made("none", texels_json(sampler, glm::ivec3(1), 4));
}

}  // namespace glint
