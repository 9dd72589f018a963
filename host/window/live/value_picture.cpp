#include "window/live/value_picture.h"

#include "render/viewer.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace glint {
namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

bool is_reached(const ValueMap& map, std::size_t i) {
    return map.reached[i] != std::byte{0};
}

bool is_finite(const ValueMap& map, std::size_t i) {
    for (int c = 0; c < map.components; ++c)
        if (!std::isfinite(map.values[i][c])) return false;
    return true;
}

// What isolines are drawn of: the value, or how long it is.
float height_of(const ValueMap& map, std::size_t i) {
    if (map.components == 1) return map.values[i].x;
    float sum = 0.0f;
    for (int c = 0; c < map.components; ++c) sum += map.values[i][c] * map.values[i][c];
    return std::sqrt(sum);
}

// 1, 2 or 5 times a power of ten: some ten steps over a range.
float step_of(float range) {
    if (!(range > 0.0f)) return 1.0f;
    const float power = std::pow(10.0f, std::floor(std::log10(range / 10.0f)));
    for (const float times : {1.0f, 2.0f, 5.0f})
        if (power * times * 10.0f >= range) return power * times;
    return power * 10.0f;
}

glm::vec3 in_range(const ValueMap& map, const ValueFacts& facts, std::size_t i) {
    glm::vec3 colour(0.0f);
    for (int c = 0; c < std::min(map.components, 3); ++c) {
        const float range = facts.max[c] - facts.min[c];
        colour[c] = range > 0.0f ? (map.values[i][c] - facts.min[c]) / range : 0.5f;
    }
    return map.components == 1 ? glm::vec3(colour.x) : colour;
}

glm::vec3 signed_colour(const ValueMap& map, const ValueFacts& facts, std::size_t i) {
    glm::vec3 colour(0.5f);
    for (int c = 0; c < std::min(map.components, 3); ++c) {
        const float most = std::max(std::abs(facts.min[c]), std::abs(facts.max[c]));
        colour[c] = most > 0.0f ? 0.5f + 0.5f * map.values[i][c] / most : 0.5f;
    }
    if (map.components > 1) return colour;
    constexpr glm::vec3 kBelow(0.16f, 0.42f, 0.95f), kAbove(1.0f, 0.56f, 0.12f);
    const float part = 2.0f * colour.x - 1.0f;
    return (part < 0.0f ? kBelow : kAbove) * std::sqrt(std::abs(part));
}

bool is_on_isoline(const ValueMap& map, std::size_t i, float step) {
    const std::size_t width = static_cast<std::size_t>(map.size.x);
    const float own = std::floor(height_of(map, i) / step);
    for (const std::size_t other : {i + 1, i + width}) {
        const bool is_beside = other == i + 1 && (i + 1) % width == 0;
        if (is_beside || other >= map.values.size() || !is_reached(map, other)) continue;
        if (std::floor(height_of(map, other) / step) != own) return true;
    }
    return false;
}

// Rows of both run bottom up.
template <class Colour>
Image image_of(const ValueMap& map, const Colour& colour) {
    Image image{.size = map.size, .channels = 4, .pixels = {}};
    for (int y = 0; y < map.size.y; ++y) {
        for (int x = 0; x < map.size.x; ++x) {
            const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.size.x) +
                           static_cast<std::size_t>(x);
            glm::vec3 rgb = (x / 8 + y / 8) % 2 == 0 ? glm::vec3(0.10f) : glm::vec3(0.14f);
            if (is_reached(map, i))
                rgb = is_finite(map, i) ? colour(i) : glm::vec3(1.0f, 0.0f, 1.0f);
            for (int c = 0; c < 3; ++c)
                image.pixels.push_back(
                    static_cast<std::byte>(std::lround(255.0f * glm::clamp(rgb[c], 0.0f, 1.0f))));
            image.pixels.push_back(std::byte{255});
        }
    }
    return image;
}

}  // namespace

ValueFacts facts_of(const ValueMap& map) {
    std::vector<float> rgba;
    ValueFacts facts{.components = map.components};
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        if (!is_reached(map, i)) {
            ++facts.unreached;
            continue;
        }
        for (int c = 0; c < 4; ++c) rgba.push_back(map.values[i][c]);
    }
    if (rgba.empty()) return facts;
    const BufferStatistics found = statistics(rgba);
    facts.nan = found.nan;
    facts.infinite = found.infinite;
    facts.min = found.min;
    facts.max = found.max;
    facts.histogram = found.histogram;
    return facts;
}

std::vector<glm::vec4> row_of(const ValueMap& map, int y) {
    std::vector<glm::vec4> row;
    if (y < 0 || y >= map.size.y) return row;
    for (int x = 0; x < map.size.x; ++x) {
        const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(map.size.x) +
                       static_cast<std::size_t>(x);
        row.push_back(is_reached(map, i) ? map.values[i] : glm::vec4(kNaN));
    }
    return row;
}

Image picture_of(const ValueMap& map, const ValueFacts& facts, ValueLook look) {
    if (look == ValueLook::sign)
        return image_of(map, [&](std::size_t i) { return signed_colour(map, facts, i); });
    if (look == ValueLook::range)
        return image_of(map, [&](std::size_t i) { return in_range(map, facts, i); });
    float low = std::numeric_limits<float>::infinity(), high = -low;
    for (std::size_t i = 0; i < map.values.size(); ++i) {
        if (!is_reached(map, i) || !is_finite(map, i)) continue;
        low = std::min(low, height_of(map, i));
        high = std::max(high, height_of(map, i));
    }
    const float step = step_of(high - low);
    return image_of(map, [&](std::size_t i) {
        const glm::vec3 ground = 0.15f + 0.6f * in_range(map, facts, i);
        return is_on_isoline(map, i, step) ? glm::vec3(1.0f, 0.95f, 0.5f) : ground;
    });
}

Image heat_of(const ValueMap& map, const ValueFacts& facts) {
    const float most = std::max(facts.max.x, 1.0f);
    return image_of(map, [&](std::size_t i) {
        const float part = 3.0f * map.values[i].x / most;
        return glm::vec3(part, part - 1.0f, part - 2.0f);
    });
}

}  // namespace glint
