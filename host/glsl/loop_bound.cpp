#include "glsl/loop_bound.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace glint {
namespace {

constexpr std::array<std::string_view, 1> kComma = {","};

// `i`, or `p.x` of a vector.
struct Variable {
    std::string_view name, member;
};

// How a turn changes a variable. One that `jumps`, `i = 8`, counts where it is moved as well.
struct Movement {
    enum class Kind : std::uint8_t { none, by_number, jumps, counts, other };
    Kind kind = Kind::none;
    double by = 0.0;
};

class Bounds {
public:
    Bounds(const Reading& reading, const Constants& constants, std::uint32_t loop)
        : reading_(reading), constants_(constants), index_(loop), loop_(reading.statements[loop]) {}

    LoopBound find() const {
        LoopBound best = of_condition(loop_.condition, "&&", false);
        for (std::uint32_t at = first_in_body(); at < body_end(); at = reading_.statements[at].next)
            if (const Statement& one = reading_.statements[at]; leaves(at))
                best = smaller(best, of_condition(one.head, "||", true));
        return best;
    }

private:
    static LoopBound smaller(const LoopBound& a, const LoopBound& b) {
        if (a.kind != b.kind) return a.kind < b.kind ? a : b;
        return a.turns < b.turns ? a : b;
    }

    std::uint32_t first_in_body() const {
        const std::uint32_t child = index_ + 1;
        const bool is_block = child < loop_.next && kind(child) == StatementKind::block;
        return is_block ? child + 1 : child;
    }
    std::uint32_t body_end() const {
        return index_ + 1 < loop_.next ? reading_.statements[index_ + 1].next : loop_.next;
    }
    StatementKind kind(std::uint32_t at) const { return reading_.statements[at].kind; }

    // `if (…) break;`
    bool leaves(std::uint32_t at) const {
        if (kind(at) != StatementKind::if_) return false;
        std::uint32_t then = at + 1;
        while (then < loop_.next && kind(then) == StatementKind::block) ++then;
        return then < reading_.statements[at].next &&
               (kind(then) == StatementKind::break_ || kind(then) == StatementKind::return_);
    }

    std::string_view word(std::uint32_t at) const { return reading_.word(at); }

    // The next of these words outside of brackets, or the range's end.
    template <class Words>
    std::uint32_t find_word(TokenRange range, const Words& words) const {
        for (std::uint32_t at = range.begin; at < range.end; ++at) {
            if (std::ranges::find(words, word(at)) != std::end(words)) return at;
            if (const std::uint32_t close = reading_.close_of(at); close != kNone) at = close;
        }
        return range.end;
    }

    TokenRange without_brackets(TokenRange range) const {
        while (range.size() > 1 && word(range.begin) == "(" &&
               reading_.close_of(range.begin) == range.end - 1)
            ++range.begin, --range.end;
        return range;
    }

    // Of its parts, which the words join, each may end the loop; `ends`: where it holds.
    LoopBound of_condition(TokenRange range, std::string_view joins, bool ends) const {
        range = without_brackets(range);
        for (std::uint32_t at = find_word(range, kComma); at < range.end;
             at = find_word(range, kComma))
            range.begin = at + 1;
        LoopBound best;
        while (!range.empty()) {
            const std::uint32_t end = find_word(range, std::array{joins});
            best = smaller(best, of_part(without_brackets({range.begin, end}), ends));
            range.begin = std::min(end + 1, range.end);
        }
        return best;
    }

    LoopBound of_part(TokenRange range, bool ends) const {
        if (range.size() > 1 && word(range.begin) == "!")
            return of_condition({range.begin + 1, range.end}, ends ? "&&" : "||", !ends);
        if (range.size() == 1 && (word(range.begin) == "false" || word(range.begin) == "0"))
            return ends ? LoopBound() : LoopBound{LoopBound::Kind::number, 1.0};
        constexpr std::array<std::string_view, 9> kSplitting = {
            "<", ">", "<=", ">=", "!=", "==", "&&", "||", "?"};
        const std::uint32_t at = find_word(range, kSplitting);
        if (at == range.end) return {};
        constexpr std::array<std::array<std::string_view, 3>, 6> kTurned = {{{"<", ">", ">="},
                                                                             {">", "<", "<="},
                                                                             {"<=", ">=", ">"},
                                                                             {">=", "<=", "<"},
                                                                             {"!=", "!=", "=="},
                                                                             {"==", "==", "!="}}};
        const auto op = std::ranges::find(kTurned, word(at), [](const auto& o) { return o[0]; });
        if (op == kTurned.end() || find_word({at + 1, range.end}, kSplitting) != range.end)
            return {};
        const TokenRange left = {range.begin, at}, right = {at + 1, range.end};
        const std::string_view goes_on = ends ? (*op)[2] : (*op)[0];
        const auto turned = std::ranges::find(kTurned, goes_on, [](const auto& o) { return o[0]; });
        return smaller(of_comparison(left, goes_on, right),
                       of_comparison(right, (*turned)[1], left));
    }

    // While `side op limit` the loop goes on.
    LoopBound of_comparison(TokenRange side, std::string_view op, TokenRange limit) const {
        side = without_brackets(side);
        LoopBound best;
        for (std::uint32_t at = side.begin; at < side.end; ++at) {
            if (!reading_.tokens[at].is_word() || (at > side.begin && word(at - 1) == "."))
                continue;
            const Variable variable = variable_at(at);
            const Movement movement = movement_of(variable);
            if (movement.kind != Movement::Kind::by_number &&
                movement.kind != Movement::Kind::counts)
                continue;
            best = smaller(best, {LoopBound::Kind::some});
            if (movement.kind == Movement::Kind::by_number && is_alone(variable, side))
                best = smaller(best, counted(variable, movement.by, op, limit));
        }
        return best;
    }

    // Less than half a step of a float that is added to one; whole numbers may be ints.
    static bool is_lost(double start, double by) {
        const auto from = static_cast<float>(start);
        return by != std::floor(by) && from + static_cast<float>(by) == from;
    }

    // In floats, as a shader compares.
    static bool holds(double side, std::string_view op, double limit) {
        const auto a = static_cast<float>(side), b = static_cast<float>(limit);
        return (op.starts_with('<') && a < b) || (op.starts_with('>') && a > b) ||
               (op.ends_with('=') && op != "!=" && a == b) || (op == "!=" && a != b);
    }

    LoopBound counted(const Variable& variable, double by, std::string_view op,
                      TokenRange limit) const {
        const LoopBound some{LoopBound::Kind::some};
        const auto end = constants_.value(limit);
        const bool rises = op == "<" || op == "<=", falls = op == ">" || op == ">=";
        if (!end || by == 0.0 || op == "==" || (rises && by < 0.0) || (falls && by > 0.0))
            return some;
        const double start = start_of(variable);
        if (is_lost(start, by) && holds(start, op, *end))
            return {LoopBound::Kind::number, kEndless};
        const double turns = std::ceil((*end - start) / by);
        if (op == "!=" && turns < 0.0) return some;
        return {LoopBound::Kind::number, std::max(turns, 0.0) + (op.size() == 2 ? 1.0 : 0.0)};
    }

    Variable variable_at(std::uint32_t at) const {
        const bool has_member = at + 2 < reading_.tokens.size() && word(at + 1) == "." &&
                                reading_.tokens[at + 2].is_word();
        return {word(at), has_member ? word(at + 2) : ""};
    }
    bool is_at(const Variable& variable, std::uint32_t at) const {
        if (word(at) != variable.name || (at > 0 && word(at - 1) == ".")) return false;
        return variable_at(at).member == variable.member;
    }
    std::uint32_t behind(const Variable& variable, std::uint32_t at) const {
        return at + (variable.member.empty() ? 1 : 3);
    }

    // `i`, `i++`, `--i`, `(i += 2)`
    bool is_alone(const Variable& variable, TokenRange side) const {
        if (word(side.begin) == "++" || word(side.begin) == "--") ++side.begin;
        if (side.empty() || !is_at(variable, side.begin)) return false;
        side.begin = behind(variable, side.begin);
        return side.empty() || word(side.begin) == "++" || word(side.begin) == "--" ||
               word(side.begin) == "+=" || word(side.begin) == "-=";
    }

    static Movement joined(const Movement& a, const Movement& b) {
        using Kind = Movement::Kind;
        if (a.kind == Movement::Kind::none) return b;
        const Kind most = std::max(a.kind, b.kind);
        if (a.kind != b.kind) return {most == Kind::jumps ? Kind::counts : most};
        if (a.kind == Movement::Kind::by_number && (a.by < 0.0) != (b.by < 0.0))
            return {Movement::Kind::other};
        return std::abs(a.by) < std::abs(b.by) ? a : b;
    }

    Movement movement_of(const Variable& variable) const {
        const Variable whole = {variable.name, ""};
        Movement all;
        for (std::uint32_t at = loop_.tokens.begin; at < loop_.tokens.end; ++at) {
            const Variable& moved = is_at(whole, at) ? whole : variable;
            if (!is_at(moved, at)) continue;
            if (const Movement one = movement_at(moved, at); one.kind != Movement::Kind::none)
                all = joined(all, one);
        }
        return all;
    }

    // The value that is assigned behind an operator.
    TokenRange assigned(std::uint32_t at) const {
        constexpr std::array<std::string_view, 5> kEnds = {",", ";", ")", "<", ">"};
        return {at + 1, find_word({at + 1, loop_.tokens.end}, kEnds)};
    }

    Movement movement_at(const Variable& variable, std::uint32_t at) const {
        using Kind = Movement::Kind;
        const std::uint32_t next = behind(variable, at);
        const std::string_view before = at > 0 ? word(at - 1) : "";
        const std::string_view after = next < loop_.tokens.end ? word(next) : "";
        if (before == "++" || after == "++") return {Kind::by_number, 1.0};
        if (before == "--" || after == "--") return {Kind::by_number, -1.0};
        const bool in_step = loop_.step.begin <= at && at < loop_.step.end;
        // Bits run out, and so does what floats can hold.
        constexpr std::array<std::string_view, 5> kShrink = {"*=", "/=", "<<=", ">>=", "&="};
        if (std::ranges::find(kShrink, after) != kShrink.end()) return {Kind::counts};
        if (after == "+=" || after == "-=") {
            const auto by = least(assigned(next));
            if (!by) return {in_step ? Kind::counts : Kind::other};
            return {Kind::by_number, after == "+=" ? *by : -*by};
        }
        const bool is_declared =
            at > 0 && reading_.tokens[at - 1].is_word();  // another of its name
        if (after != "=" || is_declared) return {};
        if (loop_.kind == StatementKind::for_ && at < loop_.condition.begin) return {};
        return assignment(variable, assigned(next), in_step);
    }

    // `i = i + 2`
    Movement assignment(const Variable& variable, TokenRange value, bool in_step) const {
        using Kind = Movement::Kind;
        std::uint32_t op = value.begin;
        bool has_itself = false, has_others = false;
        for (std::uint32_t at = value.begin; at < value.end; ++at) {
            const bool is_itself = is_at(variable, at);
            has_itself |= is_itself;
            has_others |=
                !is_itself && reading_.tokens[at].is_word() && !constants_.value({at, at + 1});
        }
        if (op < value.end && is_at(variable, op)) op = behind(variable, op);
        if (op > value.begin && op < value.end && (word(op) == "+" || word(op) == "-"))
            if (const auto by = least({op + 1, value.end}))
                return {Kind::by_number, word(op) == "+" ? *by : -*by};
        if (!in_step && constants_.value(value)) return {Kind::jumps};
        // `i = 2 * i + 1`
        return {in_step || (has_itself && !has_others) ? Kind::counts : Kind::other};
    }

    // A value; of max(x, 0.1) and clamp(x, 0.1, y) what it is at least.
    std::optional<double> least(TokenRange range) const {
        if (const auto value = constants_.value(range)) return value;
        if (range.size() < 3 || reading_.close_of(range.begin + 1) != range.end - 1) return {};
        const TokenRange within = {range.begin + 2, range.end - 1};
        const std::uint32_t comma = find_word(within, kComma);
        const TokenRange first = {within.begin, comma};
        const TokenRange rest = {std::min(comma + 1, within.end), within.end};
        const auto second = constants_.value({rest.begin, find_word(rest, kComma)});
        const auto positive = [](const std::optional<double>& value) {
            return value && *value > 0.0 ? value : std::nullopt;
        };
        if (word(range.begin) == "clamp") return positive(second);
        if (word(range.begin) != "max") return {};
        return positive(constants_.value(first) ? constants_.value(first) : second);
    }

    double start_of(const Variable& variable) const {
        if (loop_.declaration != kNone)
            for (const Declarator& one : reading_.declarations[loop_.declaration].names)
                if (word(one.name) == variable.name && variable.member.empty())
                    return constants_.value(one.initial).value_or(0.0);
        const std::uint32_t end = std::max(loop_.condition.begin, loop_.head.begin);
        for (std::uint32_t at = loop_.head.begin; at < end; ++at)
            if (is_at(variable, at) && word(behind(variable, at)) == "=")
                return constants_.value(assigned(behind(variable, at))).value_or(0.0);
        return 0.0;
    }

    const Reading& reading_;
    const Constants& constants_;
    std::uint32_t index_;
    const Statement& loop_;
};

}  // namespace

LoopBound loop_bound(const Reading& reading, const Constants& constants, std::uint32_t loop) {
    return Bounds(reading, constants, loop).find();
}

}  // namespace glint
