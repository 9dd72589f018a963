// What was found of two looks, told to people and programs.
#pragma once

#include "measure/rows/difference.h"
#include "measure/study/pair.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>
#include <nlohmann/json_fwd.hpp>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace glint {

struct Comparison {
    std::array<std::string, 2> files{};  // A and B, as they were named
    std::array<std::vector<float>, 2> pictures{};
    glm::ivec2 size{0};
    Values values = Values::display;    // of the pictures
    std::string renderer{}, machine{};  // "" where both are pictures
    Difference error{};                 // of A to B
    std::vector<float> seen{};          // flip_map()
    glm::ivec2 worst{0};                // the pixel that differs most, from the left and the top
    std::array<glm::vec4, 2> at_worst{};
    std::size_t alpha_off = 0;  // pixels whose alpha, which means nothing, differs by over 1/255
    std::optional<TimedPair> times{};  // none where one is a picture
};

// Lines for a terminal.
std::string to_table(const Comparison& comparison);
nlohmann::ordered_json to_json(const Comparison& comparison);

// Into the folder: a.png, b.png, difference.png, flip.png, looks.json, and index.html, in which a
// slider wipes between the two and which needs no network. Throws std::runtime_error.
void write_comparison(const std::filesystem::path& folder, const Comparison& comparison);

}  // namespace glint
