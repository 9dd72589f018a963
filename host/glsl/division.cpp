#include "glsl/division.h"

namespace glint {
namespace {

// `0.`, `.0`, `0.0f`, `0e0`; not the integer 0.
bool is_float_zero(const Token& token) {
    const std::string_view text = token.text;
    if (token.kind != TokenKind::number || text.starts_with("0x")) return false;
    const std::string_view digits = text.substr(0, text.find_first_of("eE"));
    return text.find_first_of(".eE") != text.npos &&
           digits.find_first_of("123456789") == digits.npos;
}

// Where the zero stands that a divisor is; kNone where it is another one. `0.`, `(0.)`, `vec2(0.)`.
std::uint32_t zero_in(const Reading& reading, std::uint32_t at) {
    const auto& tokens = reading.tokens;
    if (at < tokens.size() && tokens[at].is_word() && tokens[at].text.starts_with("vec")) ++at;
    if (at < tokens.size() && tokens[at].is("(")) {
        const bool closes = at + 2 < tokens.size() && tokens[at + 2].is(")");
        return closes && is_float_zero(tokens[at + 1]) ? at + 1 : kNone;
    }
    return at < tokens.size() && is_float_zero(tokens[at]) ? at : kNone;
}

}  // namespace

void mend_division_by_zero(const Reading& reading, Edits& edits) {
    for (std::uint32_t at = 0; at < reading.tokens.size(); ++at) {
        const bool assigns = reading.tokens[at].is("/=");
        if (!assigns && !reading.tokens[at].is("/")) continue;
        const std::uint32_t zero = zero_in(reading, at + 1);
        if (zero == kNone) continue;
        const std::string before = reading.spelled({at + 1, zero});  // `vec3 (`
        edits.replace({at, zero + 1}, (assigns ? "*= " : "* ") + before + "1e39");
    }
}

}  // namespace glint
