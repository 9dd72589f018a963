#include "scene/toml_keys.h"

#include "base/diagnostic.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

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

std::string better_said(std::string_view complaint) {
    constexpr std::pair<std::string_view, std::string_view> kSaid[] = {
        {"unescaped control characters",
         "this text is not closed on its line, or holds a control character; end it with a second "
         "\""},
        {"string: encountered end-of-file", "this text is never closed; end it with a second \""},
        {"saw 'f'", "a number of TOML ends without an f; write 0.5"},
        {"saw ';'", "a line of TOML ends without a ';'; take it out"},
        {"expected decimal digit",
         "a number has digits on both sides of its point; write 0.5, 1.0"},
        {"whitespace, saw ','",
         "one value stands here; a number has a point, 0.5, and several stand in brackets, [0, 5]"},
        {"expected a comment or whitespace",
         "one value stands here; several stand in brackets, [1, 2]"},
        {"expected '='", "behind a key stands '='; write key = value"},
        {"expected ']'", "this '[' is never closed; write ']'"},
        {"array: encountered end-of-file", "a list is never closed; end it with ]"},
        {"expected value, saw '#'",
         "the value is missing: '#' begins a comment; a colour stands in quotes, \"#ff0000\""},
        {"expected value", "the value is missing; write it behind '='"},
        {"could not determine value type",
         "this is no value; write 1.5, [1, 2, 3], true, false or a text in quotes"},
        {"parsing boolean", "a switch is true or false, in small letters"},
        {"leading zeroes", "a number begins with no idle 0; write 1 for 01"},
        {"root table: expected keys",
         "here stands a key, such as time = 1, or a table, such as [tweaks]; a comment begins with "
         "#"}};
    constexpr std::string_view kTwice = "cannot redefine existing ";
    if (const std::size_t at = complaint.find(kTwice); at != complaint.npos)
        return fmt::format("{} stands here a second time; keep one",
                           complaint.substr(std::min(complaint.find('\'', at), complaint.size())));
    for (const auto& [theirs, ours] : kSaid)
        if (complaint.find(theirs) != complaint.npos) return std::string(ours);
    return std::string(complaint);
}

}  // namespace glint
