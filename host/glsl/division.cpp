#include "glsl/division.h"

#include "glsl/hidden_zero.h"

#include <fmt/format.h>

#include <ranges>
#include <vector>

namespace glint {
namespace {

using Names = std::unordered_set<std::string_view>;

// `0.`, `.0`, `0.0f`, `0e0`; not the integer 0.
bool is_float_zero(const Token& token) {
    const std::string_view text = token.text;
    if (token.kind != TokenKind::number || text.starts_with("0x")) return false;
    const std::string_view digits = text.substr(0, text.find_first_of("eE"));
    return text.find_first_of(".eE") != text.npos &&
           digits.find_first_of("123456789") == digits.npos;
}

// `const float NOTHING = 0.0;` and uniforms that become such, where they are what a name means.
class ZeroConstants {
public:
    ZeroConstants(const Reading& reading, const Names& zero_uniforms) {
        for (const Declaration& declaration : reading.declarations) {
            if (declaration.scope == Scope::member) continue;  // never named alone
            for (const Declarator& one : declaration.names) {
                const std::string_view name = reading.word(one.name);
                const bool is_const = declaration.is_const && one.initial.size() == 1 &&
                                      is_float_zero(reading.tokens[one.initial.begin]);
                const bool is_zero =
                    is_const || (declaration.is_uniform && zero_uniforms.contains(name));
                named_[name].push_back({{one.name, end_of(reading, declaration)}, is_zero});
            }
        }
    }

    // Whether this token's word means one of them.
    bool contains(const Reading& reading, std::uint32_t token) const {
        const auto named = named_.find(reading.word(token));
        if (named == named_.end()) return false;
        for (const auto& [seen, is_zero] : std::views::reverse(named->second))
            if (seen.begin < token && token < seen.end) return is_zero;
        return false;
    }

private:
    struct Named {
        TokenRange seen;
        bool is_zero;
    };

    static std::uint32_t end_of(const Reading& reading, const Declaration& declaration) {
        if (declaration.scope == Scope::parameter && declaration.owner != kNone)
            return reading.functions[declaration.owner].tokens.end;
        if (declaration.scope != Scope::local || declaration.statement == kNone)
            return static_cast<std::uint32_t>(reading.tokens.size());
        const Statement& own = reading.statements[declaration.statement];
        if (own.kind != StatementKind::declaration) return own.tokens.end;  // a loop's
        return own.parent != kNone ? reading.statements[own.parent].tokens.end
                                   : reading.functions[declaration.owner].tokens.end;
    }

    std::unordered_map<std::string_view, std::vector<Named>> named_;  // in the order of the text
};

// Where the zero stands that a divisor is; kNone where it is another one. `0.`, `(0.)`, `vec2(0.)`,
// `vec2(0)`, and a constant's name.
std::uint32_t zero_in(const Reading& reading, const ZeroConstants& constants, std::uint32_t at) {
    const auto& tokens = reading.tokens;
    const auto is_zero = [&](std::uint32_t token) {
        if (token >= tokens.size()) return false;
        if (is_float_zero(tokens[token])) return true;
        // Not a call's name, and not what is only begun by it.
        const bool goes_on =
            token + 1 < tokens.size() && (tokens[token + 1].is("(") || tokens[token + 1].is("."));
        return constants.contains(reading, token) && !goes_on;
    };
    if (is_zero(at)) return at;
    constexpr std::string_view kMade[] = {"float", "vec2", "vec3", "vec4"};
    const bool is_made = at < tokens.size() && is_one_of(tokens[at].text, kMade);
    if (is_made) ++at;
    const bool is_alone = at + 2 < tokens.size() && tokens[at].is("(") && tokens[at + 2].is(")");
    const bool is_whole = is_made && is_alone && tokens[at + 1].is("0");
    return is_alone && (is_whole || is_zero(at + 1)) ? at + 1 : kNone;
}

// Calls visit(operator, is it `/=`, zero) for every division by a zero.
template <typename Visit>
void each_division(const Reading& reading, const Names& zero_uniforms, Visit visit) {
    const ZeroConstants constants(reading, zero_uniforms);
    for (const std::uint32_t at : reading.places_of({"/", "/="})) {
        const std::uint32_t zero = zero_in(reading, constants, at + 1);
        if (zero != kNone) visit(at, reading.tokens[at].is("/="), zero);
    }
}

}  // namespace

void mend_division_by_zero(const Reading& reading, const Names& zero_uniforms, Edits& edits) {
    each_division(reading, zero_uniforms, [&](std::uint32_t at, bool assigns, std::uint32_t zero) {
        const std::string before = reading.spelled({at + 1, zero});  // `vec3 (`
        edits.replace({at, zero + 1}, (assigns ? "*= " : "* ") + before + "1e39");
    });
}

void hide_named_zeros(const Reading& reading, const Names& zero_uniforms, Edits& edits) {
    each_division(reading, zero_uniforms, [&](std::uint32_t at, bool assigns, std::uint32_t zero) {
        const std::string before = reading.spelled({at + 1, zero});
        if (reading.tokens[zero].is_word())
            edits.after(zero, fmt::format("+{}", kHiddenZero));
        else
            edits.replace({at, zero + 1}, (assigns ? "*= " : "* ") + before + "1e39");
    });
}

void name_divisions(const Reading& reading,
                    const std::unordered_map<std::string_view, std::size_t>& uniforms,
                    Edits& edits) {
    Names names;
    for (const auto& [name, number] : uniforms) names.insert(name);
    each_division(reading, names, [&](std::uint32_t at, bool assigns, std::uint32_t zero) {
        const auto uniform = uniforms.find(reading.tokens[zero].text);
        if (uniform == uniforms.end()) return;
        const std::string number = std::to_string(uniform->second);
        const std::string before = reading.spelled({at + 1, zero});
        edits.replace({at, zero + 1}, (assigns ? " glint_by" : " glint_over") + number + " " +
                                          before + " glint_divisor" + number);
    });
}

}  // namespace glint
