#include "glsl/operands.h"

#include "glsl/parser.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <string_view>

namespace glint {

TokenRange without_parentheses(const Reading& reading, TokenRange range) {
    while (!range.empty() && reading.tokens[range.begin].is("(") &&
           reading.close_of(range.begin) == range.end - 1)
        range = {range.begin + 1, range.end - 1};
    return range;
}

bool closes_head(const Reading& reading, std::uint32_t at) {
    constexpr std::string_view kHeads[] = {"if", "for", "while", "switch"};
    const std::uint32_t open = reading.tokens[at].is(")") ? reading.partner[at] : kNone;
    return open != kNone && open > 0 &&
           std::ranges::find(kHeads, reading.tokens[open - 1].text) != std::end(kHeads);
}

// Of what ends before `end`: `a[i].x`, `(a + b)`, `f(x).y`.
std::uint32_t operand_begin(const Reading& reading, std::uint32_t end, std::uint32_t stop) {
    const auto token = [&](std::uint32_t i) -> const Token& { return reading.tokens[i]; };
    std::uint32_t at = end;
    while (at > stop) {
        const Token& last = token(at - 1);
        if ((last.is(")") || last.is("]")) && reading.partner[at - 1] != kNone) {
            if (closes_head(reading, at - 1)) break;
            at = reading.partner[at - 1];
            if (at > stop &&
                (token(at - 1).is_word() || token(at - 1).is(")") || token(at - 1).is("]")))
                continue;
            break;
        }
        if (last.kind == TokenKind::number) return at - 1;
        if (!last.is_word() || is_keyword(last.text)) break;
        --at;
        if (at <= stop || !token(at - 1).is(".")) break;
        --at;
    }
    return at;
}

std::uint32_t product_begin(const Reading& reading, std::uint32_t end, std::uint32_t stop) {
    const auto is = [&](std::uint32_t at, std::string_view text) {
        return at > stop && reading.tokens[at - 1].is(text);
    };
    const auto multiplies = [&](std::uint32_t at) {
        return is(at, "*") || is(at, "/") || is(at, "%");
    };
    std::uint32_t at = operand_begin(reading, end, stop);
    for (;;) {
        std::uint32_t before = at;
        while (is(before, "-") || is(before, "+")) --before;
        if (!multiplies(before)) return at;
        at = operand_begin(reading, before - 1, stop);
    }
}

// Of a unary expression: signs, a name or number or parentheses, and what follows them.
std::uint32_t operand_end(const Reading& reading, std::uint32_t begin, std::uint32_t stop) {
    const auto token = [&](std::uint32_t i) -> const Token& { return reading.tokens[i]; };
    std::uint32_t at = begin;
    while (at < stop && (token(at).is("-") || token(at).is("+") || token(at).is("!") ||
                         token(at).is("~") || token(at).is("++") || token(at).is("--")))
        ++at;
    if (at < stop && (token(at).is_word() || token(at).kind == TokenKind::number)) ++at;
    while (at < stop) {
        if (const std::uint32_t close = reading.close_of(at);
            close != kNone && !token(at).is("{")) {
            at = close + 1;
        } else if (token(at).is(".") || token(at).is("++") || token(at).is("--")) {
            ++at;
            if (at < stop && token(at - 1).is(".")) ++at;
        } else {
            break;
        }
    }
    return std::min(at, stop);
}

namespace {

// What binds less than `+`, or is none of an expression.
bool ends_sum(const Reading& reading, std::uint32_t at) {
    constexpr std::string_view kEnds[] = {",",  ";",  "?",  ":",  "{",  "}",   "=",  "+=",
                                          "-=", "*=", "/=", "%=", "&=", "|=",  "^=", "<",
                                          ">",  "<=", ">=", "==", "!=", "&&",  "||", "^^",
                                          "&",  "|",  "^",  "<<", ">>", "<<=", ">>="};
    const Token& token = reading.tokens[at];
    return std::ranges::find(kEnds, token.text) != std::end(kEnds) ||
           (token.is_word() && is_keyword(token.text));
}

// The first token of the sum that ends before `end`.
std::uint32_t sum_begin(const Reading& reading, std::uint32_t end, std::uint32_t stop) {
    std::uint32_t at = end;
    while (at > stop) {
        const Token& last = reading.tokens[at - 1];
        if (last.is(")") || last.is("]")) {
            if (reading.partner[at - 1] == kNone) break;
            at = reading.partner[at - 1];
            continue;
        }
        if (last.is("(") || last.is("[") || ends_sum(reading, at - 1)) break;
        --at;
    }
    return at;
}

// Behind the product that begins at `begin`.
std::uint32_t term_end(const Reading& reading, std::uint32_t begin, std::uint32_t stop) {
    std::uint32_t at = begin;
    while (at < stop) {
        const Token& next = reading.tokens[at];
        if (const std::uint32_t close = reading.close_of(at); close != kNone) {
            at = close + 1;
            continue;
        }
        const bool is_sign = next.is("+") || next.is("-");
        const bool is_unary = at == begin || reading.tokens[at - 1].is("*") ||
                              reading.tokens[at - 1].is("/") || reading.tokens[at - 1].is("%") ||
                              reading.tokens[at - 1].is("-") || reading.tokens[at - 1].is("+");
        if (next.is(")") || next.is("]") || ends_sum(reading, at) || (is_sign && !is_unary)) break;
        ++at;
    }
    return std::min(at, stop);
}

}  // namespace

std::vector<TokenRange> sides_of_sum(const Reading& reading, std::uint32_t at, TokenRange room) {
    if (at == room.begin) return {};
    const Token& before = reading.tokens[at - 1];
    const bool is_binary = before.kind == TokenKind::number || before.is(")") || before.is("]") ||
                           (before.is_word() && !is_keyword(before.text));
    if (!is_binary) return {};
    return {{sum_begin(reading, at, room.begin), at},
            {at + 1, term_end(reading, at + 1, room.end)}};
}

int bracket_pairs(const Reading& reading, TokenRange range) {
    int count = 0;
    for (std::uint32_t at = range.begin; at < range.end; ++at)
        if (const std::uint32_t close = reading.close_of(at); close != kNone) ++count, at = close;
    return count;
}

bool is_computed(const Reading& reading, TokenRange range) {
    constexpr std::string_view kComputing[] = {"+", "-", "*", "/", "("};
    for (std::uint32_t at = range.begin; at < range.end; ++at)
        if (std::ranges::find(kComputing, reading.tokens[at].text) != std::end(kComputing))
            return true;
    return false;
}

namespace {

// Whether both are numbers that are spelled out, and the latter is the larger.
bool is_in_order(const Reading& reading, TokenRange low, TokenRange high) {
    const auto number = [&](TokenRange range) -> std::optional<double> {
        const bool is_negative = !range.empty() && reading.tokens[range.begin].is("-");
        if (is_negative) ++range.begin;
        if (range.size() != 1 || reading.tokens[range.begin].kind != TokenKind::number) return {};
        const double value = std::strtod(reading.spelled(range).c_str(), nullptr);
        return is_negative ? -value : value;
    };
    const auto a = number(low), b = number(high);
    return a && b && *a < *b;
}

}  // namespace

bool may_have_no_result(const Reading& reading, const Call& call) {
    constexpr std::string_view kDomains[] = {"sqrt",  "inversesqrt", "log",       "log2",
                                             "pow",   "acos",        "asin",      "acosh",
                                             "atanh", "mod",         "normalize", "inverse"};
    const std::string_view name = reading.word(call.name);
    return is_one_of(name, kDomains) || (name == "atan" && call.arity == 2);
}

bool hands_out(std::string_view function, std::size_t argument) {
    if (function == "modf" || function == "frexp") return argument == 1;
    if (function == "uaddCarry" || function == "usubBorrow") return argument == 2;
    return argument >= 2 && (function == "umulExtended" || function == "imulExtended");
}

bool has_bounds_to_see_to(const Reading& reading, const Call& call) {
    const std::string_view name = reading.word(call.name);
    if ((name != "clamp" && name != "smoothstep") || call.arity != 3) return false;
    const std::vector<TokenRange> arguments = reading.arguments_of(call);
    const std::size_t low = name == "clamp" ? 1 : 0;
    return arguments.size() == 3 && !is_in_order(reading, arguments[low], arguments[low + 1]);
}

// Up to the comma, semicolon, colon or bracket that ends it.
std::uint32_t expression_end(const Reading& reading, std::uint32_t at, std::uint32_t stop) {
    const auto token = [&](std::uint32_t i) -> const Token& { return reading.tokens[i]; };
    int questions = 0;
    for (; at < stop; ++at) {
        if (const std::uint32_t close = reading.close_of(at); close != kNone) {
            at = close;
        } else if (token(at).is("?")) {
            ++questions;
        } else if (token(at).is(":")) {
            if (questions-- == 0) return at;
        } else if (token(at).is(",") && questions > 0) {
            continue;  // `a ? b, c : d`
        } else if (token(at).is(",") || token(at).is(";") || reading.partner[at] != kNone) {
            return at;
        }
    }
    return std::min(at, stop);
}

bool is_assignment(const Token& token) {
    constexpr std::array<std::string_view, 11> kAssigning = {
        "=", "+=", "-=", "*=", "/=", "%=", "&=", "|=", "<<=", ">>=", "^="};
    return is_one_of(token.text, kAssigning);
}

// Tokens as a person would spell them.
std::string close_spelling(const Reading& reading, TokenRange range) {
    std::string text;
    for (std::uint32_t at = range.begin; at < range.end; ++at) {
        const Token& token = reading.tokens[at];
        const bool is_spaced = at > range.begin && token.space_before;
        const bool joins = at > range.begin && token.kind != TokenKind::symbol &&
                           reading.tokens[at - 1].kind != TokenKind::symbol;
        if (is_spaced || joins) text += ' ';
        text += token.text;
    }
    return text;
}

}  // namespace glint
