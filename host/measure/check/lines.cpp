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

double lone_line(const std::vector<float>& picture, glm::ivec2 size, int axis) {
    const LineMeans means = means_of_lines(picture, size, axis);
    // Of pixels, in the mean: a line that is half of one side and half of the other is an edge.
    const auto by_pixels = [&](std::size_t channel, std::size_t line) {
        const auto value = [&](std::size_t at, int across) {
            const int x = axis == 0 ? static_cast<int>(at) : across;
            const int y = axis == 0 ? across : static_cast<int>(at);
            return shown(picture[static_cast<std::size_t>(y * size.x + x) * 4 + channel]);
        };
        double sum = 0.0;
        for (int k = 0; k < size[1 - axis]; ++k)
            sum += beyond(value(line - 1, k), value(line, k), value(line + 1, k));
        return sum / size[1 - axis];
    };
    double most = 0.0;
    for (std::size_t c = 0; c < means.size(); ++c)
        for (std::size_t i = 1; i + 1 < means[c].size(); ++i) {
            const double out = beyond(means[c][i - 1], means[c][i], means[c][i + 1]);
            if (out > most) most = std::max(most, std::min(out, by_pixels(c, i)));
        }
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
