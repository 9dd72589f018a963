// The statements of a function's body.
#include "glsl/parser.h"

#include <algorithm>
#include <array>
#include <utility>

namespace glint {
namespace {

// Statements within statements: no person writes more, and the stack holds them.
constexpr int kDeepestStatement = 400;

StatementKind kind_of(std::string_view word) {
    constexpr std::array<std::pair<std::string_view, StatementKind>, 13> kKinds = {
        {{"{", StatementKind::block},
         {";", StatementKind::empty},
         {"if", StatementKind::if_},
         {"for", StatementKind::for_},
         {"while", StatementKind::while_},
         {"do", StatementKind::do_},
         {"switch", StatementKind::switch_},
         {"case", StatementKind::case_},
         {"default", StatementKind::case_},
         {"return", StatementKind::return_},
         {"break", StatementKind::break_},
         {"continue", StatementKind::continue_},
         {"discard", StatementKind::discard}}};
    for (const auto& [spelling, kind] : kKinds)
        if (spelling == word) return kind;
    return StatementKind::expression;
}

}  // namespace

std::uint32_t Parser::add_statement(StatementKind kind, std::uint32_t parent) {
    const auto index = static_cast<std::uint32_t>(out_.statements.size());
    Statement& statement = out_.statements.emplace_back();
    statement.kind = kind;
    statement.tokens = {at_, at_};
    statement.parent = parent;
    statement.function = function_;
    return index;
}

// One statement that ends before `stop`, with all that it holds.
void Parser::parse_statement(std::uint32_t parent, std::uint32_t stop, int depth) {
    const StatementKind kind = kind_of(tokens_[at_].text);
    const std::uint32_t index = add_statement(kind, parent);
    const Mark before = mark();
    switch (kind) {
        case StatementKind::block:
        case StatementKind::if_:
        case StatementKind::for_:
        case StatementKind::while_:
        case StatementKind::do_:
        case StatementKind::switch_:
            if (depth >= kDeepestStatement)
                give_up(before, index, stop, "statements nested this deep are not read");
            else if (!parse_compound(index, stop, depth + 1))
                give_up(before, index, stop, "this statement is not understood");
            break;
        case StatementKind::empty:
            ++at_;
            break;
        case StatementKind::declaration:
        case StatementKind::expression:
        case StatementKind::case_:
        case StatementKind::return_:
        case StatementKind::break_:
        case StatementKind::continue_:
        case StatementKind::discard:
        case StatementKind::unknown:
            parse_simple(index, stop);
            break;
    }
    out_.statements[index].tokens.end = at_;
    out_.statements[index].next = static_cast<std::uint32_t>(out_.statements.size());
}

// Passes over what began at a statement: to a semicolon, or over a whole block.
void Parser::give_up(const Mark& before, std::uint32_t index, std::uint32_t stop, const char* why) {
    return_to(before);
    Statement& statement = out_.statements[index];
    at_ = skip_to(statement.tokens.begin, stop, ";{");
    if (const std::uint32_t close = is(at_, "{") ? close_of(at_) : kNone; close != kNone)
        at_ = close;
    at_ = std::min(at_ + 1, stop);
    Statement passed_over;
    passed_over.tokens = {statement.tokens.begin, at_};
    passed_over.parent = statement.parent;
    passed_over.function = statement.function;
    statement = passed_over;
    complain(statement.tokens, why);
}

void Parser::parse_block(std::uint32_t index, int depth) {
    const std::uint32_t close = close_of(at_);
    for (++at_; at_ < close;) parse_statement(index, close, depth);
    at_ = close + 1;
}

// What ends with a semicolon, and a case's label.
void Parser::parse_simple(std::uint32_t index, std::uint32_t stop) {
    const StatementKind kind = out_.statements[index].kind;
    const std::uint32_t begin = at_;
    if (kind == StatementKind::expression && begins_declaration(at_)) {
        const std::uint32_t declaration = parse_declaration(Scope::local, function_, stop);
        if (declaration != kNone && is(at_ - 1, ";")) {
            out_.declarations[declaration].statement = index;
            out_.statements[index].kind = StatementKind::declaration;
            out_.statements[index].declaration = declaration;
            return;
        }
        at_ = begin;
    }
    const bool is_case = kind == StatementKind::case_;
    const std::uint32_t end = skip_to(at_, stop, is_case ? ":" : ";");
    const bool is_precision = is(begin, "precision");
    at_ = std::min(end + 1, stop);
    if (end == stop ||
        (kind == StatementKind::expression && is_keyword(tokens_[begin].text) && !is_precision)) {
        out_.statements[index].kind = StatementKind::unknown;
        complain({begin, at_}, "this statement is not understood");
    } else if (is_precision) {
        out_.statements[index].kind = StatementKind::empty;
    } else if (is_case || kind == StatementKind::return_) {
        out_.statements[index].head = {begin + 1, end};
    }
}

// False where it is not as GLSL has it.
bool Parser::parse_compound(std::uint32_t index, std::uint32_t stop, int depth) {
    const StatementKind kind = out_.statements[index].kind;
    if (kind == StatementKind::block) {
        const bool is_whole = close_of(at_) != kNone && close_of(at_) < stop;
        if (is_whole) parse_block(index, depth);
        return is_whole;
    }
    if (kind == StatementKind::do_) {
        ++at_;
        if (at_ >= stop) return false;
        parse_statement(index, stop, depth);
        return parse_do_tail(index, stop);
    }
    ++at_;
    if (!parse_head(index) || at_ >= stop) return false;
    parse_statement(index, stop, depth);
    if (kind == StatementKind::if_ && at_ < stop && is(at_, "else")) {
        out_.statements[index].has_else = true;
        if (++at_ >= stop) return false;
        parse_statement(index, stop, depth);
    }
    return true;
}

// What stands in parentheses behind if, for, while and switch.
bool Parser::parse_head(std::uint32_t index) {
    const std::uint32_t close = is(at_, "(") ? close_of(at_) : kNone;
    if (close == kNone) return false;
    const TokenRange head = {at_ + 1, close};
    out_.statements[index].head = head;
    at_ = head.begin;
    const StatementKind kind = out_.statements[index].kind;
    const bool is_for = kind == StatementKind::for_;
    std::uint32_t declaration = kNone;
    if (!head.empty() && begins_declaration(at_))
        declaration = parse_declaration(Scope::local, function_, head.end);
    if (declaration != kNone) {
        out_.declarations[declaration].statement = index;
        out_.statements[index].declaration = declaration;
    }
    if (is_for) {
        const std::uint32_t first =
            declaration != kNone && is(at_ - 1, ";") ? at_ - 1 : skip_to(head.begin, head.end, ";");
        const std::uint32_t second =
            first == head.end ? head.end : skip_to(first + 1, head.end, ";");
        if (second == head.end) return false;
        out_.statements[index].condition = {first + 1, second};
        out_.statements[index].step = {second + 1, head.end};
    } else if (kind == StatementKind::while_) {
        out_.statements[index].condition = head;
    }
    at_ = close + 1;
    return true;
}

// `while (…);` behind the body of a `do`.
bool Parser::parse_do_tail(std::uint32_t index, std::uint32_t stop) {
    const std::uint32_t close = is(at_, "while") ? close_of(at_ + 1) : kNone;
    if (close == kNone || close + 1 >= stop || !is(close + 1, ";")) return false;
    out_.statements[index].head = out_.statements[index].condition = {at_ + 2, close};
    at_ = close + 2;
    return true;
}

}  // namespace glint
