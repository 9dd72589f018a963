// How the texels of a buffer are kept: what a host of GLSL ES 3.00 can draw into.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace glint {

// One, two or four channels: bytes for [0, 1], floats of 16 bits, or of 32. What a buffer has not
// reads as 0, a missing alpha as 1; what is written there is lost.
enum class PixelFormat { r8, rg8, rgba8, r16f, rg16f, rgba16f, r32f, rg32f, rgba32f };

// "rg16f".
std::string_view name_of(PixelFormat format);
// The inverse; nothing for any other word.
std::optional<PixelFormat> parse_pixel_format(std::string_view name);
// What to write instead of a word that is none: "r8, rg8, …" and the one that was meant.
std::string expected_pixel_format(std::string_view word);

int channel_count(PixelFormat format);
// 1, 2 or 4.
int bytes_a_channel(PixelFormat format);
std::size_t bytes_a_texel(PixelFormat format);
// With as many channels; `bytes` as bytes_a_channel() says.
PixelFormat with_channel_bytes(PixelFormat format, int bytes);

}  // namespace glint
