// What a probe has found in a shader: values at a pixel, along a line, over a picture; what it
// costs; where a fault was born. Plain facts, and the one JSON that `--json` and the window share.
#pragma once

#include <glm/vec2.hpp>
#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace glint {

// One value of a variable, parameter, condition or expression.
struct ProbeValue {
    std::string file{};
    int line = 0, column = 0;  // from 1
    std::string function{};
    std::string name{};    // `p.xz`, `hit.nor`, `m[0]`; of what was returned, the function's
    std::string kind{};    // "assigned", "parameter", "returned", "condition", "reached", …
    std::string type{};    // "vec3"; empty of what was only reached
    int hit = 0;           // the how manieth this is, from 1
    int hits = 0;          // how many there are
    int order = 0;         // among all that was noted
    std::size_t site = 0;  // of the program that told it; not written
    std::vector<double> value{};
};

// A value at every pixel of a row, a column, a picture, or at every frame.
struct ProbeSeries {
    std::string along{};                        // "x", "y", "time", "map"
    ProbeValue what{};                          // without a value
    std::vector<double> at{};                   // pixel, or s; of a map nothing
    std::vector<std::vector<double>> values{};  // empty where it was not reached
    std::vector<double> min{}, max{};           // of the finite ones, by component; min > max: none
    std::size_t nan = 0, infinite = 0, unreached = 0;
};

struct ProbeLineCost {
    std::string file{};
    int line = 0;
    std::string function{}, name{}, kind{};  // "turn", "read", "call"
    double a_pixel = 0.0, most = 0.0;        // mean and largest count
};
struct ProbeCost {
    std::array<double, 3> mean{}, most{};  // turns of loops, reads, calls; of a pixel
    std::vector<ProbeLineCost> lines{};    // the dearest first
    // How well a count goes with milliseconds (Pearson), over sizes and times, and over times
    // alone, sizes taken for alike; none where it does not vary.
    std::array<std::optional<double>, 3> explains{}, explains_views{};
    struct Run {
        glm::ivec2 size{0};
        double time = 0.0, ms = 0.0;
        std::array<double, 3> counts{};
    };
    std::vector<Run> runs{};
};

// The first thing that went wrong.
struct ProbeFault {
    std::string file{};
    int line = 0, column = 0;
    std::string function{}, expression{}, what{};  // "division by zero"
    std::vector<double> operands{};
    std::string pass{};
    std::optional<int> face{};  // of a cube
    glm::ivec2 pixel{0};
    int frame = 0;
    std::size_t pixels = 0;   // of the pass in that frame that have a fault there
    bool is_seen = false;     // the pixel's colour is not finite
    bool has_result = false;  // whatever a driver makes of it, it is a number
};

struct Probing {
    std::string scene{}, renderer{}, pass{};
    glm::ivec2 size{0}, pixel{0};
    int frame = 0;
    double time = 0.0;
    // Whether the instrumented program draws what the plain one draws: "bits", "bytes" (no display
    // shows a difference), or what differs.
    std::string same{};
    std::vector<ProbeValue> values{};
    std::vector<ProbeSeries> series{};
    std::optional<ProbeCost> cost{};
    std::optional<ProbeFault> first_bad{};
    std::vector<std::string> notes{};  // what could not be told, and why
};

// Numbers that are not finite are "nan", "inf" and "-inf".
nlohmann::ordered_json to_json(const Probing& probing);
// Values, notes and costs without runs, which the window shows. Throws nlohmann::json::exception
// for what is none.
Probing probing_from_json(const nlohmann::ordered_json& json);

// `(0.25, 1, -3e-09)`, as tables show it.
std::string shown_value(const std::vector<double>& value, const std::string& type);
// `water.frag:412: sqrt(x): sqrt of -3.1e-09, pixel 17,40, frame 212`.
std::string sentence_of(const ProbeFault& fault);

}  // namespace glint
