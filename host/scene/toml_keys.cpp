#include "scene/toml_keys.h"

#include "base/diagnostic.h"

#include <fmt/format.h>

#include <algorithm>

namespace glint {
namespace {

// Behind the text in quotes that begins at `at`, or at the end of the line that leaves it open.
std::size_t end_of_quotes(std::string_view toml, std::size_t at) {
    const char quote = toml[at];
    const std::string_view three = quote == '"' ? "\"\"\"" : "'''";
    const bool is_long = toml.substr(at, 3) == three;
    const std::string_view closing = is_long ? three : three.substr(0, 1);
    for (at += closing.size(); at < toml.size(); ++at) {
        if (toml.substr(at, closing.size()) == closing) return at + closing.size();
        if (toml[at] == '\n' && !is_long) return at;
        if (toml[at] == '\\' && quote == '"') ++at;
    }
    return toml.size();
}

}  // namespace

std::optional<std::size_t> find_deep_key(std::string_view toml) {
    std::optional<std::size_t> begin;  // of what may be a key
    int dots = 0;
    for (std::size_t at = 0; at < toml.size();) {
        const char c = toml[at];
        if (c == '#') {
            at = std::min(toml.find('\n', at), toml.size());
            continue;
        }
        if (std::string_view("\n=,[{").find(c) != std::string_view::npos) {
            begin.reset();
            dots = 0;
        } else if (!begin && c != ' ' && c != '\t') {
            begin = at;
        }
        if (c == '.' && ++dots >= kMostKeyParts) return begin;
        at = c == '"' || c == '\'' ? end_of_quotes(toml, at) : at + 1;
    }
    return std::nullopt;
}

std::string unknown_key(std::string_view key, std::span<const std::string> known) {
    if (std::ranges::find(known, key) != known.end()) return {};
    return fmt::format("unknown key {}; known are {}{}", in_quotes(key), fmt::join(known, ", "),
                       did_you_mean(key, known));
}

}  // namespace glint
