#include "glsl/hidden_zero.h"

#include "glsl/operands.h"
#include "glsl/variables.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace glint {
namespace {

enum class NumberKind : std::uint8_t { other, whole, floating };

NumberKind kind_of(std::string_view type) {
    if (type == "float" || type == "vec2" || type == "vec3" || type == "vec4")
        return NumberKind::floating;
    return type == "int" ? NumberKind::whole : NumberKind::other;
}

constexpr std::uint32_t kLongest = 64;  // tokens of a divisor or a zero that are looked at

class ZeroHider {
public:
    ZeroHider(const Reading& reading, const std::unordered_set<std::string_view>& zero_uniforms,
              Edits& edits)
        : reading_(reading), zeros_(zero_uniforms), edits_(edits) {
        for (const Declaration& declaration : reading.declarations)
            for (const Declarator& one : declaration.names)
                if (declaration.is_const && declaration.scope == Scope::global &&
                    kind_of(reading.word(declaration.type)) == NumberKind::floating &&
                    is_zero(one.initial))
                    zeros_.insert(reading.word(one.name));
        find_divisors();
    }

    void hide(const std::vector<Unset>& unset) {
        if (divisors_.empty()) return;
        for (const Unset& one : unset)
            if (one.why_not.empty() && !one.is_result) unset_.insert(one.at);
        for (const Declaration& declaration : reading_.declarations)
            if (declaration.scope == Scope::local && !declaration.is_const) hide_in(declaration);
        each_in_functions({"="}, [&](std::uint32_t index, std::uint32_t at) {
            if (divisors_.contains(index)) hide_assigned(index, at);
        });
        for (const Call& call : reading_.calls) hide_arguments(call);
        for (const std::uint32_t at : hidden_) hide_uniform(at);
    }

private:
    bool is_name(std::uint32_t at) const {
        const auto& tokens = reading_.tokens;
        return tokens[at].kind == TokenKind::word && !(at > 0 && tokens[at - 1].is(".")) &&
               !(at + 1 < tokens.size() && tokens[at + 1].is("("));
    }

    // Calls visit(function, token) for these signs in the bodies of functions.
    template <typename Visit>
    void each_in_functions(std::initializer_list<std::string_view> signs, Visit visit) {
        std::uint32_t index = 0;
        for (const std::uint32_t at : reading_.places_of(signs)) {
            while (index < reading_.functions.size() && reading_.functions[index].body.end <= at)
                ++index;
            if (index == reading_.functions.size()) return;
            if (reading_.functions[index].body.begin < at) visit(index, at);
        }
    }

    // By function and name, with the kind of all variables that are called so in it.
    void find_divisors() {
        each_in_functions({"/", "/="}, [&](std::uint32_t index, std::uint32_t at) {
            const std::uint32_t end = reading_.functions[index].body.end;
            const std::uint32_t stop = std::min(end, at + 1 + kLongest);
            const bool assigns = reading_.tokens[at].is("/=");
            add_divisors(index, {at + 1, assigns ? expression_end(reading_, at + 1, stop)
                                                 : operand_end(reading_, at + 1, stop)});
        });
        std::unordered_set<const NumberKind*> seen;
        for (const Declaration& declaration : reading_.declarations) {
            if (declaration.scope != Scope::local && declaration.scope != Scope::parameter)
                continue;
            for (const Declarator& one : declaration.names) {
                NumberKind* kind = find(declaration.owner, one.name);
                if (!kind) continue;
                const bool is_array = !one.array.empty() || !declaration.type_array.empty();
                const NumberKind its =
                    is_array ? NumberKind::other : kind_of(reading_.word(declaration.type));
                *kind = seen.insert(kind).second || *kind == its ? its : NumberKind::other;
            }
        }
    }

    // What is added to is no zero for long.
    bool is_sum(TokenRange range) const { return has(range, {"+", "-"}); }

    // What hangs on a condition is left to the compiler, which may take one of both out.
    bool is_chosen(TokenRange range) const {
        return has(range, {"?", "<", ">", "<=", ">=", "==", "!=", "&&", "||"});
    }

    bool has(TokenRange range, std::initializer_list<std::string_view> signs) const {
        for (std::uint32_t at = range.begin; at < range.end; ++at)
            if (std::ranges::find(signs, reading_.tokens[at].text) != signs.end()) return true;
        return false;
    }

    void add_divisors(std::uint32_t function, TokenRange divisor) {
        if (is_sum(divisor)) return;
        for (std::uint32_t at = divisor.begin; at < divisor.end; ++at)
            if (is_name(at))
                divisors_[function].emplace(reading_.tokens[at].text, NumberKind::other);
        if (!is_mended(divisor)) find_uniforms(function, divisor);
    }

    // `w / softness`, of a float, and `w / vec2(softness)`.
    bool is_mended(TokenRange divisor) const {
        const bool is_made = divisor.size() > 1 && reading_.tokens[divisor.begin + 1].is("(") &&
                             kind_of(reading_.word(divisor.begin)) == NumberKind::floating;
        if (is_made) ++divisor.begin;
        const TokenRange alone = without_parentheses(reading_, divisor);
        const Declaration* global =
            alone.size() == 1 ? reading_.find_global(reading_.word(alone.begin)) : nullptr;
        return global && reading_.word(global->type) == "float";
    }

    // Of a value that divides: the uniforms in it, and what its variables are made of.
    void find_uniforms(std::uint32_t function, TokenRange value, int depth = 0) {
        constexpr int kLongestChain = 64;
        if (zeros_.empty() || depth > kLongestChain || is_sum(value) || is_chosen(value)) return;
        if (depth > 0 && is_zero(value)) return;  // it is hidden where it is given away
        for (std::uint32_t at = value.begin; at < value.end; ++at) {
            if (!is_name(at) || !hidden_.insert(at).second) continue;
            if (const TokenRange initial = initial_of(function, at); !initial.empty())
                find_uniforms(function, initial, depth + 1);
        }
    }

    // Of the local that this name means.
    TokenRange initial_of(std::uint32_t function, std::uint32_t name) {
        if (!variables_) variables_.emplace(reading_);
        const auto found = variables_->find(name, function);
        const bool is_local = found.declaration && found.declaration->scope == Scope::local;
        return is_local && !found.declaration->is_const ? found.name->initial : TokenRange{};
    }

    void hide_uniform(std::uint32_t at) {
        const std::string_view name = reading_.word(at);
        if (!zeros_.contains(name)) return;
        if (!variables_) variables_.emplace(reading_);
        const auto& functions = reading_.functions;
        const auto function = std::ranges::find_if(functions, [&](const Function& one) {
            return one.body.begin < at && at < one.body.end;
        });
        if (function == functions.end()) return;  // a constant's value knows no uniform
        const auto index = static_cast<std::uint32_t>(function - functions.begin());
        const auto found = variables_->find(at, index);
        const bool is_ours = found.declaration && found.declaration->scope == Scope::global &&
                             (found.declaration->is_uniform || found.declaration->is_const);
        if (!is_ours || edits_.is_replaced(reading_.place(at)) || !edits_.takes_before(at) ||
            !edits_.takes_after(at))
            return;
        edits_.before(at, "(");
        edits_.after(at, fmt::format("+{})", kHiddenZero));
    }

    NumberKind* find(std::uint32_t function, std::uint32_t name) {
        const auto names = divisors_.find(function);
        if (names == divisors_.end()) return nullptr;
        const auto found = names->second.find(reading_.word(name));
        return found == names->second.end() ? nullptr : &found->second;
    }

    NumberKind divisor(std::uint32_t function, std::uint32_t name) {
        const NumberKind* kind = find(function, name);
        return kind ? *kind : NumberKind::other;
    }

    // `0.0`, `0` for whole numbers, `vec3(0)`, `vec2(0.0, 0)`, and the name of such a constant.
    bool is_zero(TokenRange range) const {
        bool any = false;
        for (std::uint32_t at = range.begin; at < range.end; ++at) {
            const Token& token = reading_.tokens[at];
            if (token.kind == TokenKind::number) {
                if (token.text.find_first_not_of("0.fF") != std::string_view::npos) return false;
                any = true;
            } else if (is_constant(at)) {
                any = true;
            } else if (!token.is("(") && !token.is(")") && !token.is(",") &&
                       kind_of(token.text) == NumberKind::other) {
                return false;
            }
        }
        return any;
    }

    // Of the text's own, of zero.
    bool is_constant(std::uint32_t at) const {
        const Declaration* global =
            zeros_.contains(reading_.word(at)) ? reading_.find_global(reading_.word(at)) : nullptr;
        return global && global->is_const &&
               (at + 1 == reading_.tokens.size() || !reading_.tokens[at + 1].is("."));
    }

    void add_behind(std::uint32_t token, NumberKind kind) {
        edits_.after(token,
                     fmt::format(" + {}{}", kHiddenZero, kind == NumberKind::whole ? "_i" : ""));
    }

    void hide_in(const Declaration& declaration) {
        for (const Declarator& one : declaration.names) {
            const NumberKind kind = divisor(declaration.owner, one.name);
            if (kind == NumberKind::other) continue;
            // Several names of one macro stand at one place.
            const bool is_ours = one.initial.empty() && reading_.tokens[one.name].use == kNone &&
                                 unset_.contains(reading_.place(one.name).begin);
            if (is_ours)
                add_behind(one.tokens.end - 1, kind);
            else if (is_zero(one.initial))
                add_behind(one.initial.end - 1, kind);
            else
                find_uniforms(declaration.owner, one.initial);
        }
    }

    void hide_assigned(std::uint32_t function, std::uint32_t at) {
        if (!is_name(at - 1) || is_declared(at - 1)) return;
        const NumberKind kind = divisor(function, at - 1);
        if (kind == NumberKind::other) return;
        const auto count = static_cast<std::uint32_t>(reading_.tokens.size());
        const std::uint32_t stop = std::min(count, at + 1 + kLongest);
        const TokenRange value = {at + 1, expression_end(reading_, at + 1, stop)};
        if (value.end >= stop) return;
        if (is_zero(value))
            add_behind(value.end - 1, kind);
        else
            find_uniforms(function, value);
    }

    bool is_declared(std::uint32_t name) {
        if (declared_.empty())
            for (const Declaration& declaration : reading_.declarations)
                for (const Declarator& one : declaration.names) declared_.insert(one.name);
        return declared_.contains(name);
    }

    void hide_arguments(const Call& call) {
        if (call.function == kNone) return;  // a constant's value knows no uniform
        const std::vector<TokenRange> arguments = reading_.arguments_of(call);
        for (std::size_t i = 0; i < arguments.size(); ++i) {
            const bool is_written = is_zero(arguments[i]);
            if (!is_written && zeros_.empty()) continue;
            const NumberKind kind = parameter_kind(call, i);
            if (kind == NumberKind::other) continue;
            if (is_written)
                add_behind(arguments[i].end - 1, kind);
            else
                find_uniforms(call.function, arguments[i]);
        }
    }

    // Of the parameter that a function of this name has there, where it divides.
    NumberKind parameter_kind(const Call& call, std::size_t number) {
        NumberKind kind = NumberKind::other;
        bool is_first = true;
        for (const std::uint32_t index : reading_.functions_named(reading_.word(call.name))) {
            const Function& function = reading_.functions[index];
            if (function.parameters.size() != call.arity) continue;
            const Declaration& one = reading_.declarations[function.parameters[number]];
            if (one.names.empty()) continue;  // a prototype
            const NumberKind its =
                one.is_const ? NumberKind::other : divisor(index, one.names.front().name);
            kind = is_first || kind == its ? its : NumberKind::other;
            is_first = false;
        }
        return kind;
    }

    const Reading& reading_;
    std::unordered_set<std::string_view> zeros_;  // uniforms, and constants of the text
    Edits& edits_;
    std::optional<Variables> variables_;  // where anything asks for them
    std::set<std::uint32_t> hidden_;      // names in what divides
    std::unordered_map<std::uint32_t, std::unordered_map<std::string_view, NumberKind>> divisors_;
    std::unordered_set<std::size_t> unset_;
    std::unordered_set<std::uint32_t> declared_;
};

}  // namespace

void hide_zeros(const Reading& reading, const std::vector<Unset>& unset,
                const std::unordered_set<std::string_view>& zero_uniforms, Edits& edits) {
    if (reading.is_balanced) ZeroHider(reading, zero_uniforms, edits).hide(unset);
}

}  // namespace glint
