// The pool's text, its measures, and the text with other words in it, for the tests of its parts.
#pragma once

#include "probe.h"

#include <numbers>
#include <random>
#include <sstream>

namespace glint {

using Water = GlTest;
inline constexpr double kPi = std::numbers::pi;
inline constexpr double kHalfWidth = 4.0, kHalfLength = 6.0;  // m, of the pool

inline std::string water_text() {
    std::ifstream file(GLINT_REPOSITORY "/fragments/water.frag");
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

// The scene with other defaults, so that probes see them: {"waveHeight", "0.05"}.
inline std::string with_defaults(std::string text,
                                 const std::vector<std::pair<std::string, std::string>>& defaults) {
    for (const auto& [name, value] : defaults) {
        std::size_t declared = text.find(" " + name + ";");
        while (text.compare(text.rfind('\n', declared) + 1, 7, "uniform") != 0)
            declared = text.find(" " + name + ";", declared + 1);
        const std::size_t start = text.find("//@ ", declared) + 4;
        const std::size_t end = text.find(' ', start);
        text.replace(start, end - start, value);
    }
    return text;
}

inline std::string replaced(std::string text, std::string_view old, std::string_view now) {
    std::size_t count = 0;
    for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at)) {
        text.replace(at, old.size(), now);
        at += now.size();
        ++count;
    }
    if (count == 0) throw std::runtime_error(fmt::format("the scene no longer says {}", old));
    return text;
}

// Another number of cells in the pond and what is made of it; four stand in a texel of the pond.
inline std::string with_cells(const std::string& text, glm::ivec2 cells) {
    return replaced(replaced(text, "size=256x384", fmt::format("size={}x{}", cells.x, cells.y)),
                    "size=64x384", fmt::format("size={}x{}", cells.x / 4, cells.y));
}

inline float uniform(std::mt19937& random, double low, double high) {
    return static_cast<float>(low + (high - low) * (static_cast<double>(random()) / 4294967296.0));
}

}  // namespace glint
