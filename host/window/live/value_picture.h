// A value in every pixel, as a person looks at it: as a picture, and as numbers.
#pragma once

#include "media/image.h"
#include "window/ui/probe_facts.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <vector>

namespace glint {

struct ValueMap {
    glm::ivec2 size{0};
    int components = 0;
    std::vector<glm::vec4> values{};   // rows bottom up
    std::vector<std::byte> reached{};  // 0: not
};

// Without a row.
ValueFacts facts_of(const ValueMap& map);
// That of a pixel; NaN where it was not reached.
std::vector<glm::vec4> row_of(const ValueMap& map, int y);

// From the smallest value to the largest; around 0, blue below and orange above; or with lines at
// even steps. NaN and Inf are magenta, what was not reached is a dark grid.
Image picture_of(const ValueMap& map, const ValueFacts& facts, ValueLook look);
// Counts, from black over red and yellow to white.
Image heat_of(const ValueMap& map, const ValueFacts& facts);

}  // namespace glint
