// A buffer over the frames of a case, beside what it promises: `bounded=[a, b]`, `conserves=1e-6`.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace glint {

struct InvariantCurve {
    struct Point {
        int frame = 0;                 // the last of those that it holds
        double low = 0.0, high = 0.0;  // of all components in all of them
        double drift = 0.0;            // how far the sum went at most, as a share of the magnitudes
        int frames = 1;                // how many it holds
    };

    std::string buffer{};
    std::optional<std::array<double, 2>> bounded{};
    std::optional<double> conserves{};
    std::vector<Point> points{};

    // The next frame. Some hundred points are kept however long it goes on: neighbours become one.
    void add(const Point& point);
};

// Reading throws nlohmann::json::exception for what is no curve.
nlohmann::ordered_json to_json(const InvariantCurve& curve);
InvariantCurve curve_from_json(const nlohmann::ordered_json& json);

}  // namespace glint
