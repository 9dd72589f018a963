// JSON on its way to a file or to stdout.
#pragma once

#include <string>

namespace glint {

// With `indent` blanks a level; -1: all on one line. What is no UTF-8, which the names of files may
// be, becomes U+FFFD; nlohmann's own default would lose the result for it.
template <class Json>
std::string json_text(const Json& json, int indent = 2) {
    return json.dump(indent, ' ', false, Json::error_handler_t::replace);
}

}  // namespace glint
