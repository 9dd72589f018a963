// What the source panel shows: values of the lines at a pixel, and one of them in every pixel.
#pragma once

#include "measure/rows/probe.h"

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace glint {

// Which value of a line: as its ProbeValue has it.
struct ValueName {
    std::string file{};
    int line = 0, column = 0;
    std::string name{}, kind{};
    bool operator==(const ValueName&) const = default;
};
inline ValueName name_of(const ProbeValue& value) {
    return {value.file, value.line, value.column, value.name, value.kind};
}

// How a value looks as a picture.
enum class ValueLook : std::uint8_t { range, sign, isolines };

// Edited by the panel and by clicks on the picture.
struct ProbeView {
    std::string pass{};                  // whose text runs; "" for the picture
    std::optional<glm::dvec2> pinned{};  // fraction of the picture; else the mouse is followed
    std::optional<ValueName> value{};    // stands in the view
    bool cost = false;                   // the heat map does
    ValueLook look = ValueLook::range;
};

// Of a value in every pixel.
struct ValueFacts {
    int components = 0;
    std::size_t nan = 0, infinite = 0, unreached = 0;  // pixels
    glm::vec4 min{0.0f}, max{0.0f};                    // of the finite ones, by component
    std::array<std::array<int, 64>, 4> histogram{};    // pixels; 64 bins from min to max
    std::vector<glm::vec4> row{};                      // along that of the pixel; NaN: not reached
};

struct ProbeFact {
    bool is_busy = false;              // values are on their way
    bool compiles = false;             // and have been for long enough to say so
    std::string problem{};             // why there are none; "" where there is nothing to say
    std::vector<std::string> notes{};  // what could not be watched, and why
    std::optional<glm::ivec2> pixel{};
    glm::ivec2 size{0};  // of the pass's buffer
    // The same place of the picture in its full size, where it is drawn smaller meanwhile.
    std::optional<glm::ivec2> full_pixel{};
    glm::dvec2 mark{-1.0};              // of a pinned pixel's middle, in pixels of the window, y up
    std::vector<std::string> passes{};  // that can be looked into
    std::vector<std::string> watch{};   // as the preset will keep it
    std::span<const ProbeValue> watched{}, values{};
    std::span<const std::uint8_t> ran{};  // by line of the text: 1 ran, 2 did not
    const ProbeCost* cost = nullptr;
    const ValueFacts* picture = nullptr;
};

}  // namespace glint
