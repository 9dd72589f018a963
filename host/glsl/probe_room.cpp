#include "glsl/probe_room.h"

#include "glsl/operands.h"
#include "glsl/parser.h"
#include "glsl/probe.h"
#include "glsl/variables.h"

#include <fmt/format.h>

#include <string_view>
#include <vector>

namespace glint {

namespace {

// `if (t < 0.0) return c;`: behind it stands what did not leave.
bool leaves(const Reading& reading, std::uint32_t index) {
    const Statement& one = reading.statements[index];
    if (one.kind != StatementKind::if_ || one.has_else) return false;
    for (std::uint32_t i = index + 1; i < one.next; ++i) {
        const StatementKind kind = reading.statements[i].kind;
        if (kind == StatementKind::return_ || kind == StatementKind::discard ||
            kind == StatementKind::break_ || kind == StatementKind::continue_)
            return true;
    }
    return false;
}

// Of one that the line holds as a whole, whether its end is the place.
bool is_behind_whole(const Reading& reading, std::uint32_t index, bool is_note) {
    const StatementKind kind = reading.statements[index].kind;
    if (is_loop(kind)) return is_note;
    if (kind == StatementKind::if_) return is_note || !leaves(reading, index);
    return kind == StatementKind::switch_ || kind == StatementKind::declaration ||
           kind == StatementKind::expression || kind == StatementKind::empty;
}

// The outermost statement of a block that ends in the line, behind which none begins there: of
// `} while (t < 1.0);` the loop, of `{ … }` the block. Not what leaves the place.
std::uint32_t last_that_ends(const Reading& reading, Span line, const Function& function) {
    const auto& statements = reading.statements;
    const std::uint32_t end = statements[function.first_statement].next;
    const auto ends_here = [&](std::uint32_t i) {
        const Span place = reading.place(statements[i].tokens);
        return line.begin < place.end && place.end <= line.end;
    };
    std::uint32_t last = kNone;
    for (std::uint32_t i = function.first_statement + 1; i < end; ++i) {
        const Statement& one = statements[i];
        const Span place = reading.place(one.tokens);
        const bool begins_here = line.begin <= place.begin && place.begin < line.end;
        const bool is_in_block = statements[one.parent].kind == StatementKind::block;
        if (last != kNone && statements[last].next > i) continue;  // within it
        if (ends_here(i) && is_in_block && one.kind != StatementKind::case_)
            last = i;
        else if (begins_here)
            last = kNone;
    }
    if (last == kNone || ends_here(function.first_statement)) return kNone;
    const StatementKind kind = statements[last].kind;
    const bool is_left = kind == StatementKind::return_ || kind == StatementKind::discard ||
                         kind == StatementKind::break_ || kind == StatementKind::continue_;
    return is_left ? kNone : last;
}

}  // namespace

ProbeRoom room_at(const Reading& reading, Span line, std::uint32_t f, bool is_note) {
    const Function& function = reading.functions[f];
    const auto& statements = reading.statements;
    const std::uint32_t end = statements[function.first_statement].next;
    if (const std::uint32_t last = is_note ? last_that_ends(reading, line, function) : kNone;
        last != kNone)
        return {kNone, last, true};
    std::uint32_t chosen = kNone, around = function.first_statement, next = kNone, opened = kNone;
    for (std::uint32_t i = function.first_statement + 1; i < end; ++i) {
        const Statement& one = statements[i];
        const Span place = reading.place(one.tokens);
        const bool is_there = line.begin <= place.begin && place.begin < line.end;
        const bool is_one = one.kind != StatementKind::block && one.kind != StatementKind::case_;
        if (is_there && is_one && (chosen == kNone || statements[chosen].next <= i)) chosen = i;
        if (place.begin < line.begin && line.begin < place.end) around = i;
        if (next == kNone && place.begin >= line.end) next = i;
        const bool is_block = one.kind == StatementKind::block &&
                              statements[one.parent].kind != StatementKind::switch_;
        if (is_there && is_block && place.end > line.end) opened = i;
    }
    if (chosen == kNone && opened != kNone) return {statements[opened].tokens.begin, kNone};
    if (chosen == kNone && statements[around].kind != StatementKind::block) chosen = around;
    if (chosen == kNone) {  // an empty line: before what follows in the same block, or at its end
        if (reading.place(function.body).begin >= line.begin) return {function.body.begin, kNone};
        if (next != kNone && statements[next].parent == around) return {kNone, next, false};
        return {statements[around].tokens.end - 1, kNone};
    }
    const StatementKind kind = statements[chosen].kind;
    if (reading.place(statements[chosen].tokens).end <= line.end &&
        is_behind_whole(reading, chosen, is_note))
        return {kNone, chosen, true};
    if (is_loop(kind) && statements[chosen + 1].kind == StatementKind::block) {
        const TokenRange body = statements[chosen + 1].tokens;
        // In the line of a do's `while`.
        const bool is_at_end = reading.place(body).end <= line.begin;
        return {is_at_end ? body.end - 1 : body.begin, kNone};
    }
    if (is_loop(kind)) return {kNone, chosen + 1};
    return {kNone, chosen,
            kind == StatementKind::declaration || kind == StatementKind::expression ||
                kind == StatementKind::empty};
}

std::string refusal_of_expression(std::string_view text) {
    const Reading reading = read_glsl(text, {});
    if (reading.tokens.empty()) return "it is empty";
    if (!reading.directives.empty() || !reading.comments.empty())
        return "it is to be an expression alone";
    for (const Token& token : reading.tokens) {
        if (token.is(";") || token.is("{") || token.is("}") || token.kind == TokenKind::strange ||
            token.kind == TokenKind::quoted || (token.is_word() && is_keyword(token.text)))
            return "it is to be an expression alone";
        if (token.is("++") || token.is("--") || is_assignment(token))
            return "it would change a variable";
    }
    return reading.is_balanced ? "" : "its brackets do not balance";
}

namespace {

// `s += x`, `++s.y`: the first token of what is changed.
std::uint32_t changed_by(const Reading& reading, std::uint32_t at, TokenRange body) {
    const std::uint32_t before = operand_begin(reading, at, body.begin);
    return before < at ? before : at + 1;
}

bool changes_globals(const Reading& reading, const Variables& variables, std::uint32_t function) {
    const TokenRange body = reading.functions[function].body;
    for (std::uint32_t at = body.begin; at < body.end; ++at) {
        const Token& token = reading.tokens[at];
        if (!is_assignment(token) && !token.is("++") && !token.is("--")) continue;
        const auto found = variables.find(changed_by(reading, at, body), function);
        if (found.declaration && found.declaration->scope == Scope::global) return true;
    }
    return false;
}

}  // namespace

std::string refusal_of_calls(const Reading& text, const std::string& expression) {
    const Reading words = read_glsl(expression, {});
    std::vector<std::string_view> called;
    for (std::size_t i = 0; i + 1 < words.tokens.size(); ++i)
        if (words.tokens[i].is_word() && words.tokens[i + 1].is("("))
            called.push_back(words.tokens[i].text);
    for (const std::string_view name : called)
        for (const std::uint32_t function : text.functions_named(name))
            for (const std::uint32_t parameter : text.functions[function].parameters)
                if (text.declarations[parameter].is_out)
                    return fmt::format("{} would change a variable that is handed to it", name);
    const Variables variables(text);
    const std::vector<bool> reached = text.reached_from(called, false);
    for (std::uint32_t f = 0; f < text.functions.size(); ++f)
        if (reached[f] && text.functions[f].is_defined() && changes_globals(text, variables, f))
            return fmt::format("{} would change a variable of the text's",
                               text.word(text.functions[f].name));
    return "";
}

std::string with_own_names(const std::string& expression, bool is_in_main) {
    const Reading reading = read_glsl(expression, {});
    std::string words;
    std::size_t done = 0;
    for (const Token& token : reading.written) {
        const bool is_place = token.is("gl_FragCoord"), is_colour = token.is("gl_FragColor");
        if (!is_place && !(is_colour && is_in_main)) continue;
        words += expression.substr(done, token.span().begin - done);
        words += is_colour ? "glFragColor_" : is_in_main ? "glFragCoord_" : "glint0_coord";
        done = token.span().end;
    }
    return words + expression.substr(done);
}

}  // namespace glint
