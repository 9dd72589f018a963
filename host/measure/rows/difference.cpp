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

bool is_finite(const float* rgb) {
    return std::isfinite(rgb[0]) && std::isfinite(rgb[1]) && std::isfinite(rgb[2]);
}

}  // namespace

double decode_srgb(double value) {
    const double v = std::abs(value);
    const double light = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    return std::copysign(light, value);
}

Difference difference(std::span<const float> picture, std::span<const float> reference,
                      bool encoded) {
    Difference result;
    double squares = 0.0, relative = 0.0, byte_squares = 0.0;
    std::size_t off = 0, count = 0;
    for (std::size_t i = 0; i + 3 < std::min(picture.size(), reference.size()); i += 4) {
        if (!is_finite(&picture[i]) || !is_finite(&reference[i])) {
            ++result.not_finite;
            result.reference_not_finite += !is_finite(&reference[i]);
            continue;
        }
        bool is_off = false;
        for (std::size_t c = i; c < i + 3; ++c) {
            const double x = encoded ? decode_srgb(picture[c]) : picture[c];
            const double r = encoded ? decode_srgb(reference[c]) : reference[c];
            const double d = x - r;
            squares += d * d;
            relative += d * d / (r * r + 0.01);
            result.max = std::max(result.max, std::abs(d));
            const int bytes = to_byte(picture[c]) - to_byte(reference[c]);
            byte_squares += static_cast<double>(bytes * bytes);
            is_off |= std::abs(bytes) > 1;
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
    const auto pixels = static_cast<double>(count), values = 3.0 * pixels;
    result.rmse = std::sqrt(squares / values);
    result.relative_mse = relative / values;
    result.share_off = static_cast<double>(off) / pixels;
    result.psnr = byte_squares == 0.0 ? std::numeric_limits<double>::infinity()
                                      : 10.0 * std::log10(255.0 * 255.0 / (byte_squares / values));
    return result;
}

std::size_t pixels_not_finite(std::span<const float> picture) {
    std::size_t count = 0;
    for (std::size_t i = 0; i + 3 < picture.size(); i += 4) count += !is_finite(&picture[i]);
    return count;
}

double size_of_values(std::span<const float> picture) {
    std::vector<float> values;
    for (std::size_t i = 0; i < picture.size(); ++i)
        if (i % 4 != 3 && std::isfinite(picture[i])) values.push_back(std::abs(picture[i]));
    if (values.empty()) return 1.0;
    const auto reached = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 9 / 10);
    std::nth_element(values.begin(), reached, values.end());
    const float size = *reached > 0.0f ? *reached : std::ranges::max(values);
    return size > 0.0f ? static_cast<double>(size) : 1.0;
}

std::size_t worst_pixel(std::span<const float> picture, std::span<const float> reference,
                        bool encoded) {
    std::size_t worst = 0;
    double most = 0.0;
    for (std::size_t i = 0; i < std::min(picture.size(), reference.size()); ++i) {
        if (i % 4 == 3) continue;
        const double x = encoded ? decode_srgb(picture[i]) : picture[i];
        const double r = encoded ? decode_srgb(reference[i]) : reference[i];
        if (std::abs(x - r) <= most) continue;
        most = std::abs(x - r);
        worst = i / 4;
    }
    return worst;
}

}  // namespace glint
