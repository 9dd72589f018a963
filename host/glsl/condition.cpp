#include "glsl/condition.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace glint {
namespace {

using Number = std::optional<std::int64_t>;  // nothing: not known

struct Operator {
    std::string_view text;
    int binds = 0;
};
constexpr std::array<Operator, 18> kOperators = {{{"||", 1},
                                                  {"&&", 2},
                                                  {"|", 3},
                                                  {"^", 4},
                                                  {"&", 5},
                                                  {"==", 6},
                                                  {"!=", 6},
                                                  {"<", 7},
                                                  {">", 7},
                                                  {"<=", 7},
                                                  {">=", 7},
                                                  {"<<", 8},
                                                  {">>", 8},
                                                  {"+", 9},
                                                  {"-", 9},
                                                  {"*", 10},
                                                  {"/", 10},
                                                  {"%", 10}}};

int binding_of(std::string_view text) {
    const auto found = std::ranges::find(kOperators, text, &Operator::text);
    return found == kOperators.end() ? 0 : found->binds;
}

Number parse_integer(std::string_view text) {
    while (!text.empty() && (text.back() == 'u' || text.back() == 'U')) text.remove_suffix(1);
    const bool is_hex = text.starts_with("0x") || text.starts_with("0X");
    const int base = is_hex ? 16 : text.starts_with("0") ? 8 : 10;
    if (is_hex) text.remove_prefix(2);
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
    if (error != std::errc() || end != text.data() + text.size()) return {};
    return static_cast<std::int64_t>(value);
}

// What wraps around is no harm; the driver sees it anyway.
Number computed(std::string_view op, std::int64_t a, std::int64_t b) {
    const auto ua = static_cast<std::uint64_t>(a), ub = static_cast<std::uint64_t>(b);
    const auto wrapped = [](std::uint64_t value) { return static_cast<std::int64_t>(value); };
    if (op == "|") return a | b;
    if (op == "^") return a ^ b;
    if (op == "&") return a & b;
    if (op == "==") return a == b;
    if (op == "!=") return a != b;
    if (op == "<") return a < b;
    if (op == ">") return a > b;
    if (op == "<=") return a <= b;
    if (op == ">=") return a >= b;
    if (op == "+") return wrapped(ua + ub);
    if (op == "-") return wrapped(ua - ub);
    if (op == "*") return wrapped(ua * ub);
    if ((op == "<<" || op == ">>") && (b < 0 || b > 62)) return {};
    if (op == "<<") return wrapped(ua << ub);
    if (op == ">>") return a >> b;
    if (b == 0 || (b == -1 && a == INT64_MIN)) return {};
    return op == "/" ? a / b : a % b;
}

class Evaluator {
public:
    using ValueOf = std::function<Number(std::string_view)>;

    explicit Evaluator(const std::vector<Token>& tokens, ValueOf value_of = nullptr)
        : tokens_(tokens), value_of_(std::move(value_of)) {}

    // Nothing where it is not known, or not understood.
    Number value() {
        const Number result = binary(1, 0);
        return is_broken_ || at_ != tokens_.size() ? Number() : result;
    }

private:
    static constexpr int kDeepest = 200;

    std::string_view peek() const { return at_ < tokens_.size() ? tokens_[at_].text : ""; }

    Number binary(int weakest, int depth) {
        Number left = unary(depth);
        for (int binds = binding_of(peek()); binds >= weakest && !is_broken_;
             binds = binding_of(peek())) {
            const std::string_view op = tokens_[at_++].text;
            left = joined(op, left, binary(binds + 1, depth + 1));
        }
        return left;
    }

    static Number joined(std::string_view op, Number a, Number b) {
        if (op == "&&") {
            if ((a && *a == 0) || (b && *b == 0)) return 0;
            return a && b ? Number(1) : Number();
        }
        if (op == "||") {
            if ((a && *a != 0) || (b && *b != 0)) return 1;
            return a && b ? Number(0) : Number();
        }
        return a && b ? computed(op, *a, *b) : Number();
    }

    Number unary(int depth) {
        std::vector<std::string_view> signs;
        while (peek() == "!" || peek() == "-" || peek() == "+" || peek() == "~")
            signs.push_back(tokens_[at_++].text);
        Number value = primary(depth);
        for (auto sign = signs.rbegin(); sign != signs.rend() && value; ++sign) {
            if (*sign == "!") value = *value == 0;
            if (*sign == "-") value = computed("-", 0, *value);
            if (*sign == "~") value = ~*value;
        }
        return value;
    }

    Number primary(int depth) {
        if (at_ == tokens_.size() || depth > kDeepest) {
            is_broken_ = true;
            return {};
        }
        const Token& token = tokens_[at_++];
        if (token.kind == TokenKind::number) return parse_integer(token.text);
        if (token.is("(")) {
            const Number value = binary(1, depth + 1);
            if (peek() != ")")
                is_broken_ = true;
            else
                ++at_;
            return value;
        }
        is_broken_ |= !token.is_word();
        return token.is_word() && value_of_ ? value_of_(token.text) : Number();
    }

    const std::vector<Token>& tokens_;
    ValueOf value_of_;
    std::size_t at_ = 0;
    bool is_broken_ = false;
};

// The tokens of a list, one after the other.
class ListSource : public TokenSource {
public:
    explicit ListSource(std::vector<Token> tokens) : tokens_(std::move(tokens)) {}
    const Token* peek() override { return at_ < tokens_.size() ? &tokens_[at_] : nullptr; }
    void take() override { ++at_; }

private:
    std::vector<Token> tokens_;
    std::size_t at_ = 0;
};

Token made(const Token& like, std::string_view text, TokenKind kind) {
    Token token = like;
    token.text = text;
    token.kind = kind;
    token.is_final = true;
    return token;
}

// `defined X` and `defined(X)` become numbers, or a name that nobody knows the value of. That goes
// before names are expanded.
std::vector<Token> without_defined(const Macros& macros, const std::vector<Token>& tokens,
                                   TokenRange range) {
    std::vector<Token> result;
    for (std::uint32_t at = range.begin; at < range.end; ++at) {
        const std::uint32_t brackets = at + 1 < range.end && tokens[at + 1].is("(") ? 1 : 0;
        const std::uint32_t name = at + 1 + brackets;
        if (!tokens[at].is("defined") || name >= range.end || !tokens[name].is_word()) {
            result.push_back(tokens[at]);
            continue;
        }
        const Live is_defined = macros.find(tokens[name].text).is_defined;
        result.push_back(
            is_defined == Live::maybe
                ? made(tokens[at], "maybe", TokenKind::word)
                : made(tokens[at], is_defined == Live::yes ? "1" : "0", TokenKind::number));
        at = name;
        if (brackets && at + 1 < range.end && tokens[at + 1].is(")")) ++at;
    }
    return result;
}

Live opposite(Live live) {
    return live == Live::yes ? Live::no : live == Live::no ? Live::yes : Live::maybe;
}

}  // namespace

Number whole_number(const std::vector<Token>& tokens,
                    const std::function<Number(std::string_view)>& value_of) {
    return Evaluator(tokens, value_of).value();
}

Live condition_holds(const Macros& macros, const std::vector<Token>& tokens, TokenRange line,
                     std::uint32_t first) {
    ListSource source(without_defined(macros, tokens, {std::min(first, line.end), line.end}));
    std::vector<MacroUse> uses;
    std::deque<std::string> spellings;
    Expander expander(macros, source, uses, spellings, nullptr);
    std::vector<Token> expanded;
    for (Token token; expander.next(token);) expanded.push_back(token);
    const bool is_certain =
        !expander.is_exhausted() && std::ranges::all_of(uses, &MacroUse::is_certain);
    const Number value = Evaluator(expanded).value();
    if (!value || !is_certain) return Live::maybe;
    return *value != 0 ? Live::yes : Live::no;
}

bool Conditions::take(Macros& macros, const std::vector<Token>& tokens, TokenRange line) {
    if (line.size() < 2) return false;
    const std::string_view word = tokens[line.begin + 1].text;
    const bool is_if = word == "if", is_named = word == "ifdef" || word == "ifndef";
    if (is_if || is_named) {
        Group group;
        group.outer = group.live = live();
        groups_.push_back(group);
        if (group.outer == Live::no) return true;
        if (is_if) {
            enter(macros, condition_holds(macros, tokens, line, line.begin + 2));
        } else {
            const Live is_defined =
                line.size() < 3 ? Live::maybe : macros.find(tokens[line.begin + 2].text).is_defined;
            enter(macros, word == "ifdef" ? is_defined : opposite(is_defined));
        }
        return true;
    }
    if (word != "else" && word != "elif" && word != "endif") return false;
    if (groups_.empty() || (word != "endif" && groups_.back().has_else)) return false;
    leave(macros);
    if (word == "endif") {
        groups_.pop_back();
        return true;
    }
    Group& group = groups_.back();
    group.has_else = word == "else";
    const bool is_asked = group.outer != Live::no && group.done != Live::yes && word == "elif";
    enter(macros, is_asked ? condition_holds(macros, tokens, line, line.begin + 2) : Live::yes);
    return true;
}

void Conditions::enter(Macros& macros, Live condition) {
    Group& group = groups_.back();
    if (group.outer == Live::no || group.done == Live::yes || condition == Live::no)
        group.live = Live::no;
    else if (group.outer == Live::maybe || group.done == Live::maybe || condition == Live::maybe)
        group.live = Live::maybe;
    else
        group.live = Live::yes;
    if (condition == Live::yes)
        group.done = Live::yes;
    else if (condition == Live::maybe && group.done == Live::no)
        group.done = Live::maybe;
    group.branch = ++branches_;
    if (group.live == Live::maybe) macros.open_branch();
}

std::vector<std::uint32_t> Conditions::open_branches() const {
    std::vector<std::uint32_t> list;
    for (const Group& group : groups_)
        if (group.live == Live::maybe) list.push_back(group.branch);
    return list;
}

void Conditions::leave(Macros& macros) {
    if (groups_.back().live == Live::maybe) macros.close_branch();
}

}  // namespace glint
