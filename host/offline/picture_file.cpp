#include "offline/picture_file.h"

#include "media/image.h"
#include "media/parts.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace glint {

bool is_picture_file(const std::filesystem::path& file) {
    return can_write(file);
}

namespace {

// What a still says of itself.
void read_meaning(const std::filesystem::path& file, ComparedPicture& picture) {
    for (const auto& [name, value] : read_texts(file)) {
        picture.is_drawn |= name.starts_with("glint:");
        if (name == "glint:pass" && value != "image") picture.buffer = value;
    }
    picture.is_light = !picture.is_drawn;
}

}  // namespace

ComparedPicture read_compared_picture(const std::filesystem::path& file) {
    const Image image = read_image(file);
    ComparedPicture result{.size = image.size, .bytes = image.type == ChannelType::u8};
    const auto channels = static_cast<std::size_t>(image.channels);
    const std::size_t count =
        static_cast<std::size_t>(image.size.x) * static_cast<std::size_t>(image.size.y);
    const auto value = [&](std::size_t i) {
        if (result.bytes) return static_cast<float>(image.pixels[i]) / 255.0f;
        float v = 0.0f;
        std::memcpy(&v, image.pixels.data() + i * sizeof v, sizeof v);
        return v;
    };
    result.rgba.reserve(count * 4);
    for (std::size_t i = 0; i < count; ++i) {
        for (std::size_t c = 0; c < 3; ++c)
            result.rgba.push_back(value(i * channels + (channels < 3 ? 0 : c)));
        const bool has_alpha = channels % 2 == 0;
        result.rgba.push_back(has_alpha ? value(i * channels + channels - 1) : 1.0f);
    }
    if (holds_light(file)) read_meaning(file, result);
    return result;
}

void round_to_bytes(std::span<float> rgba, std::span<const float> kept) {
    constexpr float kHalf = 0.502f;  // and what llvmpipe's scale by 255/256 adds
    for (std::size_t i = 0; i < rgba.size(); ++i) {
        if (std::isnan(rgba[i])) continue;
        const float bytes = std::clamp(rgba[i], 0.0f, 1.0f) * 255.0f;
        const bool is_kept = std::abs(bytes - kept[i] * 255.0f) < kHalf;
        rgba[i] = is_kept ? kept[i] : std::round(bytes) / 255.0f;
    }
}

void write_shown(const std::filesystem::path& file, std::span<const float> rgba, glm::ivec2 size) {
    std::vector<std::byte> rgb;
    rgb.reserve(rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < rgba.size(); ++i) {
        if (i % 4 == 3) continue;
        const float shown = rgba[i] > 0.0f ? std::min(rgba[i], 1.0f) : 0.0f;
        rgb.push_back(static_cast<std::byte>(std::lround(shown * 255.0f)));
    }
    write_rgb(file, std::move(rgb), size);
}

void write_rgb(const std::filesystem::path& file, std::vector<std::byte> rgb, glm::ivec2 size) {
    write_image(file, {.size = size, .channels = 3, .pixels = std::move(rgb)});
}

}  // namespace glint
