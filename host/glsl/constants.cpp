#include "glsl/constants.h"

#include <algorithm>
#include <charconv>

namespace glint {
namespace {

constexpr int kDeepest = 32;  // brackets and names within each other

std::optional<double> number(std::string_view text) {
    if (text.starts_with("0x") || text.starts_with("0X")) {
        unsigned long value = 0;
        std::from_chars(text.data() + 2, text.data() + text.size(), value, 16);
        return static_cast<double>(value);
    }
    double value = 0.0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    if (read.ec != std::errc()) return std::nullopt;
    return value;
}

}  // namespace

Constants::Constants(const Reading& reading,
                     const std::unordered_map<std::string_view, double>& known)
    : reading_(reading), known_(known) {
    for (const Declaration& declaration : reading.declarations) {
        if (declaration.scope == Scope::member) continue;
        for (const Declarator& one : declaration.names) {
            const std::string_view name = reading.word(one.name);
            const bool is_value = declaration.is_const && one.array.empty() &&
                                  declaration.type_array.empty() && !one.initial.empty();
            const auto [entry, is_new] =
                written_.emplace(name, is_value ? one.initial : TokenRange());
            if (is_new) continue;
            entry->second = {};
            known_.erase(name);
        }
    }
}

std::optional<double> Constants::value(TokenRange range) const {
    return whole(range, 0);
}

std::optional<double> Constants::whole(TokenRange range, int depth) const {
    if (range.empty() || depth > kDeepest) return std::nullopt;
    Cursor cursor{range.begin, range.end, depth};
    const auto result = sum(cursor);
    return cursor.at == range.end ? result : choice(range, depth);
}

std::uint32_t Constants::find(std::string_view word, TokenRange range) const {
    while (range.begin < range.end && !reading_.tokens[range.begin].is(word)) {
        const std::uint32_t inner = reading_.close_of(range.begin);
        range.begin = (inner == kNone ? range.begin : inner) + 1;
    }
    return std::min(range.begin, range.end);
}

std::optional<double> Constants::choice(TokenRange range, int depth) const {
    const std::uint32_t asks = find("?", range);
    const std::uint32_t colon = find(":", {std::min(asks + 1, range.end), range.end});
    if (colon == range.end || find("?", {asks + 1, colon}) != colon) return std::nullopt;
    const auto first = whole({asks + 1, colon}, depth + 1);
    const auto second = whole({colon + 1, range.end}, depth + 1);
    if (!first || !second) return std::nullopt;
    return std::max(*first, *second);
}

std::optional<double> Constants::sum(Cursor& cursor) const {
    auto result = product(cursor);
    while (result && cursor.at < cursor.end &&
           (reading_.word(cursor.at) == "+" || reading_.word(cursor.at) == "-")) {
        const bool adds = reading_.word(cursor.at++) == "+";
        const auto next = product(cursor);
        if (!next) return std::nullopt;
        *result += adds ? *next : -*next;
    }
    return result;
}

std::optional<double> Constants::product(Cursor& cursor) const {
    auto result = factor(cursor);
    while (result && cursor.at < cursor.end &&
           (reading_.word(cursor.at) == "*" || reading_.word(cursor.at) == "/")) {
        const bool multiplies = reading_.word(cursor.at++) == "*";
        const auto next = factor(cursor);
        if (!next || (!multiplies && *next == 0.0)) return std::nullopt;
        *result = multiplies ? *result * *next : *result / *next;
    }
    return result;
}

std::optional<double> Constants::factor(Cursor& cursor) const {
    double sign = 1.0;
    for (; cursor.at < cursor.end &&
           (reading_.word(cursor.at) == "-" || reading_.word(cursor.at) == "+");
         ++cursor.at)
        if (reading_.word(cursor.at) == "-") sign = -sign;
    if (cursor.at >= cursor.end) return std::nullopt;
    const Token& token = reading_.tokens[cursor.at];
    std::optional<double> result;
    if (token.kind == TokenKind::number) {
        ++cursor.at;
        result = number(token.text);
    } else if (const std::uint32_t close = reading_.close_of(cursor.at);
               token.is("(") && close < cursor.end) {
        result = whole({cursor.at + 1, close}, cursor.depth + 1);
        cursor.at = close + 1;
    } else if (token.is_word()) {
        result = name(cursor);
    }
    if (result) *result *= sign;
    return result;
}

std::optional<double> Constants::name(Cursor& cursor) const {
    const std::string_view word = reading_.word(cursor.at++);
    if (cursor.at < cursor.end && reading_.word(cursor.at) == "(") return call(cursor, word);
    if (const auto found = known_.find(word); found != known_.end()) return found->second;
    const auto found = written_.find(word);
    return found == written_.end() ? std::nullopt : whole(found->second, cursor.depth + 1);
}

std::optional<double> Constants::call(Cursor& cursor, std::string_view name) const {
    const std::uint32_t open = cursor.at, close = reading_.close_of(open);
    if (close >= cursor.end) return std::nullopt;
    cursor.at = close + 1;
    if (name == "int" || name == "uint" || name == "float")
        return whole({open + 1, close}, cursor.depth + 1);
    if (name != "min" && name != "max") return std::nullopt;
    const std::uint32_t comma = find(",", {open + 1, close});
    if (comma >= close) return std::nullopt;
    const auto first = whole({open + 1, comma}, cursor.depth + 1);
    const auto second = whole({comma + 1, close}, cursor.depth + 1);
    if (first && second)
        return name == "min" ? std::min(*first, *second) : std::max(*first, *second);
    if (name == "max") return std::nullopt;
    return first ? first : second;
}

}  // namespace glint
