#include "measure/rows/number_json.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>

namespace glint {

using nlohmann::ordered_json;

ordered_json number_json(double value) {
    if (std::isnan(value)) return "nan";
    if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
    const auto single = static_cast<float>(value);
    return static_cast<double>(single) == value ? std::stod(fmt::format("{}", single)) : value;
}

double number_from(const ordered_json& json) {
    if (json.is_number_integer()) return static_cast<double>(json.get<std::int64_t>());
    if (json.is_number()) return static_cast<double>(json.get<float>());
    const std::string word = json.get<std::string>();
    if (word == "nan") return std::numeric_limits<double>::quiet_NaN();
    const double infinite = std::numeric_limits<double>::infinity();
    return word == "inf" ? infinite : -infinite;
}

}  // namespace glint
