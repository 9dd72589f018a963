#include "measure/rows/heat.h"

#include "measure/rows/difference.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace glint {
namespace {

void push(std::vector<std::byte>& rgb, double value) {
    rgb.push_back(static_cast<std::byte>(std::lround(std::clamp(value, 0.0, 1.0) * 255.0)));
}

// The five colours at 0, 1, 2, 3 and 4.
void push_colour(std::vector<std::byte>& rgb, double value) {
    constexpr std::array<std::array<double, 3>, 5> kSteps = {
        {{0, 0, 0}, {0.1, 0.1, 0.6}, {0.7, 0.1, 0.5}, {1.0, 0.6, 0.1}, {1, 1, 1}}};
    const double at = std::clamp(value, 0.0, 3.999999);
    const auto step = static_cast<std::size_t>(at);
    for (std::size_t c = 0; c < 3; ++c)
        push(rgb, std::lerp(kSteps[step][c], kSteps[step + 1][c], at - static_cast<double>(step)));
}

}  // namespace

std::vector<std::byte> difference_heat(std::span<const float> picture,
                                       std::span<const float> reference, Values values) {
    std::vector<std::byte> rgb;
    rgb.reserve(picture.size() / 4 * 3);
    for (std::size_t i = 0; i + 3 < picture.size(); i += 4) {
        double most = 0.0;
        bool finite = true;
        for (std::size_t c = i; c < i + channels_of(values); ++c) {
            finite &= std::isfinite(picture[c]) && std::isfinite(reference[c]);
            const double x = in_light(picture[c], values);
            const double r = in_light(reference[c], values);
            most = std::max(most, std::abs(x - r));
        }
        if (finite)
            push_colour(rgb, most > 0.0 ? std::log10(most) + 4.0 : 0.0);
        else
            rgb.insert(rgb.end(), {std::byte{255}, std::byte{0}, std::byte{255}});
    }
    return rgb;
}

std::vector<std::byte> heat(std::span<const float> map) {
    std::vector<std::byte> rgb;
    rgb.reserve(map.size() * 3);
    for (const float v : map) push_colour(rgb, 4.0 * v);
    return rgb;
}

}  // namespace glint
