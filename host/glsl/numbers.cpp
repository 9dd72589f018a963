#include "glsl/numbers.h"

#include "glsl/lean.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <utility>

namespace glint {
namespace {

std::optional<float> parsed(std::string_view text) {
    float value = 0.0f;
    const char* end = text.data() + text.size();
    const auto [read, error] = std::from_chars(text.data(), end, value);
    if (error != std::errc() || read != end) return std::nullopt;
    return value;
}

// The value of `0.25`, `1e-3`, `.5f`; nothing for integers and what is none.
std::optional<float> float_of(const Token& token) {
    std::string_view text = token.text;
    if (token.kind != TokenKind::number || text.starts_with("0x") || text.starts_with("0X"))
        return std::nullopt;
    if (text.find_first_of(".eE") == text.npos) return std::nullopt;
    if (text.ends_with('f') || text.ends_with('F')) text.remove_suffix(1);
    return parsed(text);
}

// The value of `12`, which a float holds as it is; nothing for `012`, `12u` and larger ones.
std::optional<float> whole_of(const Token& token) {
    constexpr std::size_t kMostDigits = 7;
    const bool is_octal = token.text.starts_with('0') && token.text.size() > 1;
    if (token.kind != TokenKind::number || is_octal || token.text.size() > kMostDigits ||
        token.text.find_first_not_of("0123456789") != token.text.npos)
        return std::nullopt;
    return parsed(token.text);
}

bool makes_floats(std::string_view type) {
    if (type == "float" || (type.starts_with("vec") && type.size() == 4)) return true;
    return type.starts_with("mat") && (type.size() == 4 || (type.size() == 6 && type[4] == 'x'));
}

// `2.5` or `-2.5`: the token of the number.
std::uint32_t number_alone(const Reading& reading, TokenRange range) {
    const bool is_negative = range.size() == 2 && reading.tokens[range.begin].is("-");
    return range.size() == (is_negative ? 2u : 1u) ? range.end - 1 : kNone;
}

// By token: its value, where something else may stand in its place.
class Numbers {
public:
    explicit Numbers(const Reading& reading) : values_(reading.tokens.size()) {
        for (std::uint32_t at = 0; at < values_.size(); ++at)
            values_[at] = float_of(reading.tokens[at]);
        for (const Call& call : reading.calls) {
            const std::string_view name = reading.word(call.name);
            if (name != "pow" && !makes_floats(name)) continue;
            const std::vector<TokenRange> arguments = reading.arguments_of(call);
            for (const TokenRange argument : arguments) {
                const std::uint32_t number = number_alone(reading, argument);
                if (makes_floats(name) && number != kNone && !values_[number])
                    values_[number] = whole_of(reading.tokens[number]);
            }
            if (name == "pow" && arguments.size() == 2) keep_exponent(reading, arguments[1]);
        }
        for (const Declaration& declaration : reading.declarations) {
            if (declaration.is_const) keep(declaration.tokens);
            keep(declaration.type_array);
            for (const Declarator& one : declaration.names) keep(one.array);
        }
        for (std::optional<float>& value : values_)
            if (value == 0.0f || value == 1.0f) value.reset();
    }

    const std::optional<float>& at(std::uint32_t token) const { return values_[token]; }
    // A constant is wanted here, or does more good.
    bool is_kept(std::uint32_t token) const { return kept_.contains(token); }

private:
    void keep(TokenRange range) {
        for (std::uint32_t at = range.begin; at < range.end; ++at) {
            values_[at].reset();
            kept_.insert(at);
        }
    }
    void keep_exponent(const Reading& reading, TokenRange exponent) {
        const std::uint32_t number = number_alone(reading, exponent);
        const std::optional<float> value = number == kNone ? std::nullopt : values_[number];
        if (!value || *value == std::floor(*value) || *value == 0.5f) keep(exponent);
    }
    std::vector<std::optional<float>> values_;
    std::unordered_set<std::uint32_t> kept_;
};

class Feeder {
public:
    Feeder(const Reading& reading, const std::vector<bool>& functions, std::string_view array,
           Edits& edits)
        : reading_(reading), functions_(functions), array_(array), edits_(edits) {}

    void feed_constants();
    void feed_functions();
    std::vector<float> numbers;

private:
    struct Constant {
        std::uint32_t declaration = kNone;
        std::vector<std::uint32_t> uses;
        bool may_go = true;
    };
    using Constants = std::map<std::uint32_t, Constant>;  // by the token of the name

    Constants find_constants() const;
    bool is_of_literals(TokenRange value) const;
    void find_uses(Constants& constants) const;
    std::string element(float value);
    std::string value_text(TokenRange value);

    const Reading& reading_;
    const std::vector<bool>& functions_;
    std::string_view array_;
    Edits& edits_;
    Numbers found_{reading_};
};

std::string Feeder::element(float value) {
    const std::size_t index = numbers.size();
    numbers.push_back(value);
    return std::string(array_) + '[' + std::to_string(index / 4) + "]." + "xyzw"[index % 4];
}

// A number, or a vector of numbers, at least one of which is worth it.
bool Feeder::is_of_literals(TokenRange value) const {
    bool is_worth_it = false;
    for (std::uint32_t at = value.begin; at < value.end; ++at) {
        const Token& token = reading_.tokens[at];
        const bool is_type = token.is_word() && token.text.starts_with("vec");
        const bool is_number = token.kind == TokenKind::number;
        if (!is_number && !is_type && !token.is("(") && !token.is(")") && !token.is(",") &&
            !token.is("-"))
            return false;
        const std::optional<float> number = float_of(token);
        is_worth_it |= number && *number != 0.0f && *number != 1.0f;
    }
    return is_worth_it;
}

Feeder::Constants Feeder::find_constants() const {
    Constants constants;
    for (std::uint32_t i = 0; i < reading_.declarations.size(); ++i) {
        const Declaration& declaration = reading_.declarations[i];
        const std::string_view type = reading_.word(declaration.type);
        if (!declaration.is_const || declaration.scope != Scope::global ||
            declaration.names.size() != 1 || !declaration.type_array.empty() ||
            (type != "float" && !type.starts_with("vec")))
            continue;
        const Declarator& one = declaration.names.front();
        if (one.array.empty() && is_of_literals(one.initial) &&
            may_be_left_out(reading_, declaration.tokens))
            constants[one.name] = {.declaration = i, .uses = {}};
    }
    return constants;
}

// Where each is used; one that must stay a constant, or whose name means something else, too, may
// not go.
void Feeder::find_uses(Constants& constants) const {
    std::unordered_map<std::string_view, Constant*> named;
    for (auto& [name, constant] : constants) {
        Constant*& known = named[reading_.word(name)];
        if (known) known->may_go = constant.may_go = false;
        known = &constant;
    }
    std::vector<std::uint32_t> owner(reading_.tokens.size(), kNone);
    for (std::uint32_t i = 0; i < reading_.functions.size(); ++i) {
        const Function& function = reading_.functions[i];
        if (functions_[i] || !may_be_left_out(reading_, function.tokens))
            std::fill(owner.begin() + function.tokens.begin, owner.begin() + function.tokens.end,
                      i);
        else  // goes, and what it uses with it
            std::fill(owner.begin() + function.tokens.begin, owner.begin() + function.tokens.end,
                      kNone - 1);
    }
    for (std::uint32_t at = 0; at < reading_.tokens.size(); ++at) {
        const Token& token = reading_.tokens[at];
        const auto known = token.is_word() ? named.find(token.text) : named.end();
        if (known == named.end() || constants.contains(at) || owner[at] == kNone - 1) continue;
        Constant& constant = *known->second;
        const bool is_in_body = owner[at] != kNone && functions_[owner[at]] &&
                                at >= reading_.functions[owner[at]].body.begin;
        constant.may_go &= is_in_body && !found_.is_kept(at) && !reading_.tokens[at - 1].is(".") &&
                           edits_.takes_replacement(at);
        constant.uses.push_back(at);
    }
    for (const Declaration& declaration : reading_.declarations)
        for (const Declarator& one : declaration.names) {
            const auto known = named.find(reading_.word(one.name));
            if (known != named.end() && !constants.contains(one.name))
                known->second->may_go = false;
        }
}

// In brackets: `-k` of a negative one is no `--`.
std::string Feeder::value_text(TokenRange value) {
    std::string text = "(";
    for (std::uint32_t at = value.begin; at < value.end; ++at) {
        const Token& token = reading_.tokens[at];
        const std::optional<float> number = float_of(token);
        const bool is_fed = number && *number != 0.0f && *number != 1.0f;
        text += is_fed ? element(*number) : std::string(token.text);
        if (token.is(",")) text += ' ';
    }
    return text + ')';
}

void Feeder::feed_constants() {
    Constants constants = find_constants();
    find_uses(constants);
    for (const auto& [name, constant] : constants) {
        const Declaration& declaration = reading_.declarations[constant.declaration];
        if (!constant.may_go || constant.uses.empty()) continue;
        const std::string text = value_text(declaration.names.front().initial);
        for (const std::uint32_t use : constant.uses) edits_.replace({use, use + 1}, text);
        edits_.replace_bytes(reading_.place(declaration.tokens), "");
    }
}

void Feeder::feed_functions() {
    for (std::uint32_t i = 0; i < reading_.functions.size(); ++i) {
        if (!functions_[i]) continue;
        const TokenRange body = reading_.functions[i].body;
        for (std::uint32_t at = body.begin; at < body.end; ++at) {
            const std::optional<float>& value = found_.at(at);
            if (!value || !edits_.takes_replacement(at)) continue;
            edits_.replace({at, at + 1}, element(*value));
        }
    }
}

}  // namespace

std::vector<float> feed_numbers(const Reading& reading, const std::vector<bool>& functions,
                                std::string_view array, bool constants, Edits& edits) {
    Feeder feeder(reading, functions, array, edits);
    if (constants) feeder.feed_constants();
    feeder.feed_functions();
    return std::move(feeder.numbers);
}

}  // namespace glint
