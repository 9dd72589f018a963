#include "render/declared_names.h"

#include "glsl/declaration.h"

#include <algorithm>
#include <array>

namespace glint {
namespace {

constexpr std::string_view kSpace = " \t\n";

std::string_view words_in(std::string_view text, Span span) {
    return text.substr(span.begin, span.end - span.begin);
}

// The word that ends before `at`, but for white space; an empty one where something else stands
// there.
Span word_before(std::string_view text, std::size_t at) {
    const std::size_t end = text.substr(0, at).find_last_not_of(kSpace) + 1;
    std::size_t begin = end;
    while (begin > 0 && is_word(text[begin - 1])) --begin;
    return {begin, end};
}

// Whether this character is the last one before `at`, but for white space; and where it is.
bool stands_before(std::string_view text, std::size_t at, char c, std::size_t& where) {
    where = text.substr(0, at).find_last_not_of(kSpace);
    return where != text.npos && text[where] == c;
}

// Whether one of the places at which a word stands is as wanted.
template <class Test>
bool any_place_of(std::string_view text, std::string_view word, Test is_wanted) {
    std::size_t at = find_word(text, word);
    while (at != text.npos && !is_wanted(at)) at = find_word(text, word, at + 1);
    return at != text.npos;
}

// Whether a uniform or a macro speaks of the name, on the same line and before a semicolon.
bool is_in_uniform_or_macro(std::string_view text, std::string_view name) {
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find_first_of(";\n", begin), text.size());
        const std::string_view piece = text.substr(begin, end - begin);
        const std::size_t hash = piece.find('#');
        const std::size_t word =
            hash == piece.npos ? hash : piece.find_first_not_of(" \t", hash + 1);
        const bool is_macro = word != piece.npos && piece.substr(word).starts_with("define");
        const std::size_t from = std::min(piece.find("uniform"), is_macro ? word : piece.npos);
        if (from != piece.npos && find_word(piece, name, from) != piece.npos) return true;
        begin = end + 1;
    }
    return false;
}

}  // namespace

bool declares(std::string_view text, std::string_view type, std::string_view name) {
    const auto begins_line = [&](std::size_t at) { return at == 0 || text[at - 1] == '\n'; };
    const auto is_declared = [&](std::size_t at) {
        const Span before = word_before(text, at);
        if (words_in(text, before) != type) return false;
        if (begins_line(before.begin)) return true;
        const Span constant = word_before(text, before.begin);
        return words_in(text, constant) == "const" && begins_line(constant.begin);
    };
    return is_in_uniform_or_macro(text, name) || any_place_of(text, name, is_declared);
}

bool defines_function(std::string_view text, std::string_view name) {
    constexpr std::array<std::string_view, 12> kTypes = {"float", "vec2",  "vec3",  "vec4",
                                                         "int",   "ivec2", "ivec3", "ivec4",
                                                         "uint",  "uvec2", "uvec3", "uvec4"};
    return any_place_of(text, name, [&](std::size_t at) {
        const std::size_t next = text.find_first_not_of(kSpace, at + name.size());
        return next != text.npos && text[next] == '(' &&
               std::ranges::find(kTypes, words_in(text, word_before(text, at))) != kTypes.end();
    });
}

bool defines_macro(std::string_view text, std::string_view name) {
    return any_place_of(text, name, [&](std::size_t at) {
        const Span define = word_before(text, at);
        std::size_t hash = 0;
        return words_in(text, define) == "define" && stands_before(text, define.begin, '#', hash);
    });
}

bool takes_float_first(std::string_view text, std::string_view function) {
    return any_place_of(text, "float", [&](std::size_t at) {
        const Span in = word_before(text, at);
        std::size_t open = 0;
        return stands_before(text, words_in(text, in) == "in" ? in.begin : at, '(', open) &&
               words_in(text, word_before(text, open)) == function;
    });
}

}  // namespace glint
