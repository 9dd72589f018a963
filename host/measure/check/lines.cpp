#include "measure/check/lines.h"

#include <algorithm>
#include <cmath>

namespace glint {

double shown(float value) {
    return std::clamp(static_cast<double>(value), 0.0, 1.0);
}

double beyond(double before, double value, double after) {
    return std::max(
        {0.0, std::min(value - before, value - after), std::min(before - value, after - value)});
}

std::vector<double> means_of_lines(const std::vector<float>& picture, glm::ivec2 size, int axis) {
    std::vector<double> means(static_cast<std::size_t>(size[axis]));
    const double count = 3.0 * size[1 - axis];
    std::size_t at = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x, at += 4)
            for (std::size_t c = 0; c < 3; ++c)
                means[static_cast<std::size_t>(axis == 0 ? x : y)] +=
                    shown(picture[at + c]) / count;
    return means;
}

double lone_line(const std::vector<double>& means) {
    double most = 0.0;
    for (std::size_t i = 1; i + 1 < means.size(); ++i)
        most = std::max(most, beyond(means[i - 1], means[i], means[i + 1]));
    return most;
}

double lone_border(const std::vector<double>& means) {
    if (means.size() < 3) return 0.0;
    const auto step = [&](std::size_t i) { return std::abs(means[i + 1] - means[i]); };
    const std::size_t last = means.size() - 2;
    return std::max({0.0, step(0) - step(1), step(last) - step(last - 1)});
}

double largest_step(const std::vector<double>& means) {
    double most = 0.0;
    for (std::size_t i = 0; i + 1 < means.size(); ++i)
        most = std::max(most, std::abs(means[i + 1] - means[i]));
    return most;
}

}  // namespace glint
