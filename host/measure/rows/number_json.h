// Numbers in JSON that may be none: a NaN or an infinity is a word there.
#pragma once

#include <nlohmann/json_fwd.hpp>

namespace glint {

// A float as the shortest number that is the same one; "nan", "inf" or "-inf".
nlohmann::ordered_json number_json(double value);
double number_from(const nlohmann::ordered_json& json);

}  // namespace glint
