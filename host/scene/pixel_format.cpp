#include "scene/pixel_format.h"

#include "base/diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace glint {
namespace {

struct Format {
    std::string_view name;
    int channels, bytes;
};

// In the order of PixelFormat.
constexpr std::array<Format, 9> kFormats = {{{"r8", 1, 1},
                                             {"rg8", 2, 1},
                                             {"rgba8", 4, 1},
                                             {"r16f", 1, 2},
                                             {"rg16f", 2, 2},
                                             {"rgba16f", 4, 2},
                                             {"r32f", 1, 4},
                                             {"rg32f", 2, 4},
                                             {"rgba32f", 4, 4}}};
static_assert(static_cast<std::size_t>(PixelFormat::rgba32f) + 1 == kFormats.size());

const Format& facts(PixelFormat format) {
    return kFormats[static_cast<std::size_t>(format)];
}

template <class Matches>
std::optional<PixelFormat> first_that(Matches matches) {
    const auto found = std::ranges::find_if(kFormats, matches);
    if (found == kFormats.end()) return std::nullopt;
    return static_cast<PixelFormat>(found - kFormats.begin());
}

}  // namespace

std::string_view name_of(PixelFormat format) {
    return facts(format).name;
}

std::optional<PixelFormat> parse_pixel_format(std::string_view name) {
    return first_that([&](const Format& format) { return format.name == name; });
}

std::string expected_pixel_format(std::string_view word) {
    std::vector<std::string> names;
    for (const Format& format : kFormats) names.emplace_back(format.name);
    return fmt::format("{}{}", fmt::join(names, ", "), did_you_mean(word, names));
}

int channel_count(PixelFormat format) {
    return facts(format).channels;
}

int bytes_a_channel(PixelFormat format) {
    return facts(format).bytes;
}

std::size_t bytes_a_texel(PixelFormat format) {
    return static_cast<std::size_t>(channel_count(format) * bytes_a_channel(format));
}

PixelFormat with_channel_bytes(PixelFormat format, int bytes) {
    return first_that([&](const Format& other) {
               return other.channels == facts(format).channels && other.bytes == bytes;
           })
        .value_or(format);
}

}  // namespace glint
