#include "measure/rows/difference.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <vector>

namespace glint {
namespace {

int to_byte(float value) {
    return static_cast<int>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

bool is_finite(std::span<const float> picture, std::size_t pixel, Values values) {
    return std::ranges::all_of(picture.subspan(pixel, channels_of(values)),
                               [](float value) { return std::isfinite(value); });
}

}  // namespace

double decode_srgb(double value) {
    const double v = std::abs(value);
    const double light = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    return std::copysign(light, value);
}

void decode_display(std::span<float> picture) {
    for (std::size_t i = 0; i < picture.size(); ++i)
        if (i % 4 != 3) picture[i] = static_cast<float>(decode_srgb(picture[i]));
}

std::vector<float> for_display(std::vector<float> picture, Values values) {
    if (values != Values::light) return picture;
    for (std::size_t i = 0; i < picture.size(); ++i)
        if (i % 4 != 3 && picture[i] > 0.0f)
            picture[i] = picture[i] <= 0.0031308f
                             ? picture[i] * 12.92f
                             : 1.055f * std::pow(picture[i], 1.0f / 2.4f) - 0.055f;
    return picture;
}

std::size_t channels_of(Values values) {
    return values == Values::data ? 4 : 3;
}

double in_light(double value, Values values) {
    return values == Values::display ? decode_srgb(value) : value;
}

Difference difference(std::span<const float> picture, std::span<const float> reference,
                      Values values) {
    Difference result;
    double squares = 0.0, relative = 0.0, byte_squares = 0.0;
    std::size_t off = 0, count = 0;
    bool is_alpha_off = false;
    for (std::size_t i = 0; i + 3 < std::min(picture.size(), reference.size()); i += 4) {
        if (!is_finite(picture, i, values) || !is_finite(reference, i, values)) {
            ++result.not_finite;
            result.reference_not_finite += !is_finite(reference, i, values);
            continue;
        }
        bool is_off = false;
        for (std::size_t c = i; c < i + channels_of(values); ++c) {
            const double x = in_light(picture[c], values);
            const double r = in_light(reference[c], values);
            const double d = x - r;
            squares += d * d;
            relative += d * d / (r * r + 0.01);
            result.max = std::max(result.max, std::abs(d));
            const int bytes = to_byte(picture[c]) - to_byte(reference[c]);
            byte_squares += static_cast<double>(bytes * bytes);
            is_off |= std::abs(bytes) > 1;
            is_alpha_off |= c == i + 3 && d != 0.0;
        }
        off += is_off;
        ++count;
    }
    if (count == 0 && result.not_finite > 0) {  // nothing can be told
        const double unknown = std::numeric_limits<double>::quiet_NaN();
        result.rmse = result.max = result.psnr = unknown;
        result.share_off = result.relative_mse = result.flip = unknown;
    }
    if (count == 0) return result;
    const auto pixels = static_cast<double>(count);
    const double numbers = pixels * (is_alpha_off ? 4.0 : 3.0);
    result.rmse = std::sqrt(squares / numbers);
    result.relative_mse = relative / numbers;
    result.share_off = static_cast<double>(off) / pixels;
    result.psnr = byte_squares == 0.0 ? std::numeric_limits<double>::infinity()
                                      : 10.0 * std::log10(255.0 * 255.0 / (byte_squares / numbers));
    return result;
}

std::size_t pixels_not_finite(std::span<const float> picture, Values values) {
    std::size_t count = 0;
    for (std::size_t i = 0; i + 3 < picture.size(); i += 4) count += !is_finite(picture, i, values);
    return count;
}

double size_of_values(std::span<const float> picture, Values values) {
    std::vector<float> sizes;
    for (std::size_t i = 0; i < picture.size(); ++i)
        if (i % 4 < channels_of(values) && std::isfinite(picture[i]))
            sizes.push_back(std::abs(picture[i]));
    if (sizes.empty()) return 1.0;
    const auto reached = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() * 9 / 10);
    std::nth_element(sizes.begin(), reached, sizes.end());
    const float size = *reached > 0.0f ? *reached : std::ranges::max(sizes);
    return size > 0.0f ? static_cast<double>(size) : 1.0;
}

std::size_t worst_pixel(std::span<const float> picture, std::span<const float> reference,
                        Values values) {
    std::size_t worst = 0;
    double most = 0.0;
    for (std::size_t i = 0; i + 3 < std::min(picture.size(), reference.size()); i += 4) {
        if (!is_finite(picture, i, values) || !is_finite(reference, i, values)) continue;
        for (std::size_t c = i; c < i + channels_of(values); ++c) {
            const double off =
                std::abs(in_light(picture[c], values) - in_light(reference[c], values));
            if (off <= most) continue;
            most = off;
            worst = i / 4;
        }
    }
    return worst;
}

}  // namespace glint
