#include "base/words.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace glint {
namespace {

std::optional<double> parse_decimal(std::string_view text) {
    if (text.starts_with('+')) text.remove_prefix(1);
    if (text.starts_with('+')) return std::nullopt;
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
        return std::nullopt;
    return value;
}

}  // namespace

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kSpace = " \t\v\f\r\n";
    const std::size_t begin = text.find_first_not_of(kSpace);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

namespace {

// Bytes of a character of UTF-8 here that a terminal obeys, or that turns what is read; 0: none.
std::size_t obeyed_length(std::string_view rest) {
    const auto byte = [&](std::size_t i) {
        return i < rest.size() ? static_cast<unsigned char>(rest[i]) : 0u;
    };
    if (byte(0) < 0x20 || byte(0) == 0x7F) return 1;
    if (byte(0) == 0xC2 && byte(1) >= 0x80 && byte(1) <= 0x9F) return 2;  // C1
    if (byte(0) == 0xD8 && byte(1) == 0x9C) return 2;                     // U+061C
    const bool is_mark = byte(1) == 0x80 && (byte(2) == 0x8E || byte(2) == 0x8F ||
                                             (byte(2) >= 0xAA && byte(2) <= 0xAE));
    const bool is_isolate = byte(1) == 0x81 && byte(2) >= 0xA6 && byte(2) <= 0xA9;
    return byte(0) == 0xE2 && (is_mark || is_isolate) ? 3 : 0;
}

}  // namespace

std::string harmless(std::string_view text, char instead, std::string_view kept) {
    std::string result;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = obeyed_length(text.substr(i));
        const bool stays = length == 0 || kept.find(text[i]) != kept.npos;
        result += stays ? text[i] : instead;
        i += stays ? 1 : length;
    }
    return result;
}

std::string quoted(std::string_view text, char mark, std::string_view inner) {
    std::string result(1, mark);
    for (const char c : text) result += c == mark ? inner : std::string_view(&c, 1);
    return result + mark;
}

std::optional<double> parse_number(std::string_view text) {
    const std::size_t slash = text.find('/');
    if (slash == std::string_view::npos) return parse_decimal(text);
    const auto above = parse_decimal(trimmed(text.substr(0, slash)));
    const auto below = parse_decimal(trimmed(text.substr(slash + 1)));
    if (!above || !below || *below == 0.0) return std::nullopt;
    const double value = *above / *below;
    if (!std::isfinite(value)) return std::nullopt;
    return value;
}

std::string format_number(double value) {
    char buffer[32];
    const auto result = std::to_chars(buffer, buffer + sizeof buffer, value);
    return {buffer, result.ptr};
}

std::optional<bool> parse_switch(std::string_view text) {
    if (text == "on" || text == "true") return true;
    if (text == "off" || text == "false") return false;
    return std::nullopt;
}

std::string shell_word(const std::string& word) {
    const bool plain = !word.empty() && std::ranges::all_of(word, [](unsigned char c) {
        return std::isalnum(c) != 0 ||
               std::string_view("_-+=./,:%@").find(static_cast<char>(c)) != std::string_view::npos;
    });
    return plain ? word : quoted(word, '\'', "'\\''");
}

std::string shell_file(const std::string& name) {
    return shell_word(name.starts_with('-') ? "./" + name : name);
}

std::string in_small_letters(std::string_view text) {
    std::string small(text);
    for (char& c : small)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return small;
}

std::size_t find_whole_word(std::string_view text, std::string_view word, std::size_t from) {
    const auto is_letter = [&](std::size_t at) {
        return at < text.size() &&
               (text[at] == '_' || std::isalnum(static_cast<unsigned char>(text[at])) != 0);
    };
    for (std::size_t at = from; (at = text.find(word, at)) != text.npos; ++at)
        if (!(at > 0 && is_letter(at - 1)) && !is_letter(at + word.size())) return at;
    return text.npos;
}

void replace_all(std::string& text, std::string_view what, std::string_view by) {
    for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
}

}  // namespace glint
