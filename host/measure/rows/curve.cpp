#include "measure/rows/curve.h"

#include "measure/rows/number_json.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <utility>

namespace glint {
namespace {

constexpr std::size_t kMostPoints = 256;

void join(InvariantCurve::Point& into, const InvariantCurve::Point& next) {
    into = {next.frame, std::min(into.low, next.low), std::max(into.high, next.high),
            std::max(into.drift, next.drift), into.frames + next.frames};
}

}  // namespace

void InvariantCurve::add(const Point& point) {
    if (!points.empty() && points.back().frames < points.front().frames)
        return join(points.back(), point);
    if (points.size() == kMostPoints) {
        for (std::size_t i = 0; i < kMostPoints / 2; ++i) {
            points[i] = points[2 * i];
            join(points[i], points[2 * i + 1]);
        }
        points.resize(kMostPoints / 2);
    }
    points.push_back(point);
}

nlohmann::ordered_json to_json(const InvariantCurve& curve) {
    nlohmann::ordered_json points = nlohmann::ordered_json::array();
    for (const InvariantCurve::Point& p : curve.points)
        points.push_back({p.frame, number_json(p.low), number_json(p.high), number_json(p.drift)});
    nlohmann::ordered_json json = {{"buffer", curve.buffer}};
    if (curve.bounded) json["bounded"] = *curve.bounded;
    if (curve.conserves) json["conserves"] = *curve.conserves;
    json["points"] = std::move(points);
    return json;
}

InvariantCurve curve_from_json(const nlohmann::ordered_json& json) {
    InvariantCurve curve;
    curve.buffer = json.at("buffer");
    if (json.contains("bounded")) curve.bounded = json.at("bounded").get<std::array<double, 2>>();
    if (json.contains("conserves")) curve.conserves = json.at("conserves").get<double>();
    for (const auto& p : json.at("points"))
        curve.points.push_back(
            {p.at(0), number_from(p.at(1)), number_from(p.at(2)), number_from(p.at(3))});
    return curve;
}

}  // namespace glint
