#include "render/around.h"

#include "glsl/finding.h"
#include "glsl/parser.h"

#include <algorithm>
#include <array>
#include <cctype>

namespace glint {
namespace {

constexpr std::array<std::string_view, 34> kTypesOfGlsl = {
    "void",   "float",     "int",       "uint",        "bool",       "vec2",      "vec3",
    "vec4",   "ivec2",     "ivec3",     "ivec4",       "uvec2",      "uvec3",     "uvec4",
    "bvec2",  "bvec3",     "bvec4",     "mat2",        "mat3",       "mat4",      "mat2x3",
    "mat2x4", "mat3x2",    "mat3x4",    "mat4x2",      "mat4x3",     "mat2x2",    "mat3x3",
    "mat4x4", "sampler2D", "sampler3D", "samplerCube", "isampler2D", "usampler2D"};
constexpr std::array<std::string_view, 10> kQualifiersOfGlsl = {
    "const", "in", "out", "inout", "uniform", "flat", "highp", "mediump", "lowp", "invariant"};

}  // namespace

std::span<const std::string_view> types_of_glsl() {
    return kTypesOfGlsl;
}

bool is_type_of_glsl(std::string_view word) {
    return is_one_of(word, kTypesOfGlsl);
}

bool is_qualifier_of_glsl(std::string_view word) {
    return is_one_of(word, kQualifiersOfGlsl);
}

bool may_declare_behind(std::string_view token) {
    static constexpr std::array<std::string_view, 8> kBefore = {"",  "{", "}", ";",
                                                                "(", ")", ",", "else"};
    return is_one_of(token, kBefore) || is_one_of(token, kQualifiersOfGlsl);
}

bool may_be_type(const Token& token) {
    static constexpr std::string_view kOthers[] = {"return", "else", "case", "struct"};
    return token.is_word() && std::ranges::find(kOthers, token.text) == std::end(kOthers);
}

Around::Around(std::span<const Token> tokens, std::size_t at) : tokens_(tokens), at_(at) {
    for (std::size_t i = 0; i < std::min(at, tokens.size()); ++i) follow_brackets(i);
}

bool Around::is_known_type(std::ptrdiff_t away) const {
    if (is_one_of(word(away), kTypesOfGlsl)) return true;
    for (std::size_t i = 1; i < std::min(at_, tokens_.size()); ++i)
        if (tokens_[i].text == word(away) && tokens_[i - 1].is("struct")) return true;
    return false;
}

bool Around::is_reserved(std::ptrdiff_t away) const {
    return is_keyword(word(away)) || is_one_of(word(away), kTypesOfGlsl) ||
           is_one_of(word(away), kQualifiersOfGlsl);
}

bool Around::is_name(std::ptrdiff_t away) const {
    const std::size_t i = index(away);
    return i < tokens_.size() && tokens_[i].is_word() && !is_reserved(away) && !is_known_type(away);
}

bool Around::is_within(std::string_view bracket) const {
    for (std::size_t i = open_.size(); i-- > 0 && !tokens_[open_[i]].is("{");)
        if (tokens_[open_[i]].is(bracket)) return true;
    return false;
}

bool Around::goes_on_in_brackets() const {
    const bool is_call = is_known_type(0) && is(1, "(");
    const bool begins_statement = is(1, "=") || (is_reserved(0) && !is_call);
    return is_in_brackets() && !begins_statement && !word(0).empty() &&
           (std::isalnum(static_cast<unsigned char>(word(0)[0])) != 0 || word(0)[0] == '.');
}

bool Around::is_in_struct() const {
    const std::size_t brace = open().value_or(0);
    return brace > 0 && tokens_[brace].is("{") &&
           (tokens_[brace - 1].is("struct") || (brace > 1 && tokens_[brace - 2].is("struct")));
}

std::optional<std::size_t> Around::head() const {
    const std::size_t i = opened_before().value_or(0);
    const bool is_head = i >= 2 && tokens_[i - 1].is_word() && tokens_[i - 2].is_word();
    return is_head ? std::optional(i - 2) : std::nullopt;
}

std::optional<std::size_t> Around::partner_before(std::string_view open,
                                                  std::string_view close) const {
    std::size_t i = index(-1);
    if (!is(-1, close)) return std::nullopt;
    for (int depth = 0; i < tokens_.size(); --i) {
        depth += tokens_[i].is(close) ? 1 : tokens_[i].is(open) ? -1 : 0;
        if (depth == 0) return i;
    }
    return std::nullopt;
}

void Around::follow_brackets(std::size_t i) {
    const std::string_view text = tokens_[i].text;
    if (text == "(" || text == "[" || text == "{") open_.push_back(i);
    if ((text == ")" || text == "]" || text == "}") && !open_.empty()) open_.pop_back();
}

}  // namespace glint
