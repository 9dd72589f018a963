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

LineMeans means_of_lines(const std::vector<float>& picture, glm::ivec2 size, int axis) {
    LineMeans means;
    means.fill(std::vector<double>(static_cast<std::size_t>(size[axis])));
    std::size_t at = 0;
    for (int y = 0; y < size.y; ++y)
        for (int x = 0; x < size.x; ++x, at += 4)
            for (std::size_t c = 0; c < 3; ++c)
                means[c][static_cast<std::size_t>(axis == 0 ? x : y)] +=
                    shown(picture[at + c]) / size[1 - axis];
    return means;
}

double lone_line(const LineMeans& means) {
    double most = 0.0;
    for (const std::vector<double>& of : means)
        for (std::size_t i = 1; i + 1 < of.size(); ++i)
            most = std::max(most, beyond(of[i - 1], of[i], of[i + 1]));
    return most;
}

double lone_border(const LineMeans& means) {
    double most = 0.0;
    for (const std::vector<double>& of : means) {
        if (of.size() < 3) continue;
        const auto step = [&](std::size_t i) { return std::abs(of[i + 1] - of[i]); };
        const std::size_t last = of.size() - 2;
        most = std::max({most, step(0) - step(1), step(last) - step(last - 1)});
    }
    return most;
}

double largest_step(const LineMeans& means) {
    double most = 0.0;
    for (const std::vector<double>& of : means)
        for (std::size_t i = 0; i + 1 < of.size(); ++i)
            most = std::max(most, std::abs(of[i + 1] - of[i]));
    return most;
}

}  // namespace glint
