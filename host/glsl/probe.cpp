#include "glsl/instrumenter.h"
#include "glsl/operands.h"
#include "glsl/parser.h"
#include "glsl/probe_room.h"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace glint {

// Of a new site; "" where none is wanted, or it is left out.
std::string Instrumenter::new_record(TokenRange variable, bool can_be_told) {
    const auto site =
        add_site(SiteKind::assigned, close_spelling(reading_, variable), variable.begin);
    if (!site) return {};
    std::string record = can_be_told ? records_.record_of(*site, variable, function_) : "";
    if (record.empty()) {
        probed_.left_out.push_back(reading_.place(variable.begin).begin);
        probed_.sites.pop_back();
    }
    return record;
}

void Instrumenter::over_function(std::uint32_t index) {
    const Function& function = reading_.functions[index];
    function_ = index;
    const std::uint32_t brace = function.body.begin;
    if (wish_.kind == ProbeKind::cost)
        add_at_head(SiteKind::call, std::string(reading_.word(function.name)), function.name, brace,
                    "glint0_n({},2)");
    if (reading_.is_for_the_host(function, entry_)) over_globals(function);
    for (const std::uint32_t parameter : function.parameters) {
        const Declaration& one = reading_.declarations[parameter];
        if (wish_.kind != ProbeKind::values || one.names.empty() || (one.is_out && !one.is_in))
            continue;
        const std::uint32_t name = one.names.front().name;
        if (reading_.word(one.type).find("sampler") != std::string_view::npos) continue;
        add_record(SiteKind::parameter, {name, name + 1}, name, brace);
    }
    const std::uint32_t end = reading_.statements[function.first_statement].next;
    for (std::uint32_t i = function.first_statement; i < end; ++i) over_statement(i);
    if (wish_.kind == ProbeKind::values) return;
    for (const Call& call : reading_.calls)
        if (call.function == index && !fixed_[call.name]) over_call(call);
    if (wish_.kind == ProbeKind::faults && !marked_.empty()) over_reads_of_unset(function);
}

// What they are from the first, told at the head of the entry; of constants a line that is asked
// for alone, and of faults what may be no number.
void Instrumenter::over_globals(const Function& entry) {
    if (wish_.kind != ProbeKind::values && wish_.kind != ProbeKind::faults) return;
    const bool values = wish_.kind == ProbeKind::values;
    for (const Declaration& declaration : reading_.declarations) {
        if (declaration.scope != Scope::global || declaration.is_uniform) continue;
        if (values && declaration.is_const && wish_.only.empty()) continue;
        const bool is_seen =
            declaration.tokens.end <= entry.tokens.begin &&
            reading_.live_at(reading_.place(declaration.tokens).begin) == Live::yes;
        if (!is_seen) continue;
        for (const Declarator& one : declaration.names) {
            const auto hides = [&](std::uint32_t parameter) {
                const auto& names = reading_.declarations[parameter].names;
                return !names.empty() &&
                       reading_.word(names.front().name) == reading_.word(one.name);
            };
            if (one.initial.empty() || std::ranges::any_of(entry.parameters, hides) ||
                reading_.defines_macro(reading_.word(one.name)))
                continue;
            const TokenRange name = {one.name, one.name + 1};
            if (values || may_be_no_number(one.initial))
                add_record(SiteKind::assigned, name, one.name, entry.body.begin);
        }
    }
}

void Instrumenter::over_statement(std::uint32_t index) {
    const Statement& statement = reading_.statements[index];
    const std::size_t sites = probed_.sites.size();
    const bool values = wish_.kind == ProbeKind::values;
    switch (statement.kind) {
        case StatementKind::block:
        case StatementKind::empty:
        case StatementKind::case_:
        case StatementKind::unknown:
            return;
        case StatementKind::declaration:
            over_declaration(reading_.declarations[statement.declaration]);
            return over_tokens(statement.tokens);
        case StatementKind::expression:
            over_tokens(statement.tokens);
            break;
        case StatementKind::return_:
            if (statement.head.empty()) break;
            if (wish_.kind != ProbeKind::cost && reading_.functions[function_].type_array.empty())
                hand_through(SiteKind::returned,
                             std::string(reading_.word(reading_.functions[function_].name)),
                             statement.tokens.begin, statement.head);
            return over_tokens(statement.head);
        case StatementKind::for_:
        case StatementKind::while_:
        case StatementKind::do_:
            if (statement.declaration != kNone)
                over_declaration(reading_.declarations[statement.declaration]);
            over_condition(statement, statement.condition);
            over_loop(index);
            return over_tokens(statement.head);
        case StatementKind::if_:
        case StatementKind::switch_:
            over_condition(statement, statement.head);
            return over_tokens(statement.head);
        case StatementKind::break_:
        case StatementKind::continue_:
        case StatementKind::discard:
            break;
    }
    if (values && probed_.sites.size() == sites)
        add_statement(SiteKind::reached, close_spelling(reading_, statement.tokens),
                      statement.tokens.begin, statement.tokens, "glint0_r({})");
}

void Instrumenter::over_tokens(TokenRange range) {
    for (std::uint32_t at = range.begin; at < range.end; ++at) {
        if (fixed_[at] || token(at).kind != TokenKind::symbol) continue;
        if (wish_.kind != ProbeKind::cost && is_assignment(token(at))) over_assignment(at, range);
        if (wish_.kind == ProbeKind::values && (token(at).is("++") || token(at).is("--")))
            over_step(at, range);
        if (wish_.kind == ProbeKind::rounding && (token(at).is("+") || token(at).is("-")))
            over_sum(at, range);
        if (wish_.kind != ProbeKind::faults) continue;
        if (token(at).is("/") || token(at).is("%") || token(at).is("/=") || token(at).is("%="))
            over_division(at, range);
        if (token(at).is("<<") || token(at).is(">>") || token(at).is("<<=") || token(at).is(">>="))
            over_shift(at, range);
        if (token(at).is("[")) over_index(at, range);
    }
    if (wish_.kind != ProbeKind::values) return;
    for (const Call& call : reading_.calls)
        if (range.begin <= call.name && call.name < range.end && !fixed_[call.name])
            over_outs(call, call.name == range.begin && call.brackets.end + 1 == range.end &&
                                token(call.brackets.end).is(";"));
}

void Instrumenter::over_assignment(std::uint32_t at, TokenRange room) {
    const TokenRange left = {operand_begin(reading_, at, room.begin), at};
    const TokenRange to = without_parentheses(reading_, left);
    if (to.empty() || !(token(to.begin).is_word() || token(to.begin).is("("))) return;
    const TokenRange whole = {left.begin, expression_end(reading_, at + 1, room.end)};
    if (records_.is_told_behind(to, function_)) return over_whole(to, whole);
    // What is rounded is what the variable gets, not what the assignment is worth.
    const bool is_rounding = wish_.kind == ProbeKind::rounding;
    hand_through(SiteKind::assigned, close_spelling(reading_, to), to.begin,
                 {is_rounding ? at + 1 : whole.begin, whole.end});
}

// `(late = pair(x),…,late)`, of an array or a struct that no function takes.
void Instrumenter::over_whole(TokenRange variable, TokenRange assignment) {
    if (wish_.kind != ProbeKind::values) return;
    const std::string record = new_record(variable, records_.is_variable(variable));
    if (!record.empty() &&
        !wrap(assignment, "(", "," + record + "," + reading_.spelled(variable) + ")"))
        probed_.sites.pop_back();
}

// `i++` and `++i`: of the former, what the variable is afterwards.
void Instrumenter::over_step(std::uint32_t at, TokenRange room) {
    const bool is_prefix = at + 1 < room.end && (token(at + 1).is_word() || token(at + 1).is("("));
    if (is_prefix) {
        const std::uint32_t end = operand_end(reading_, at + 1, room.end);
        const TokenRange what = without_parentheses(reading_, {at + 1, end});
        return hand_through(SiteKind::assigned, close_spelling(reading_, what), what.begin,
                            {at, end});
    }
    const TokenRange left = {operand_begin(reading_, at, room.begin), at};
    const TokenRange what = without_parentheses(reading_, left);
    if (!records_.is_variable(what)) return void(new_record(what, false));
    hand_through(SiteKind::assigned, close_spelling(reading_, what), what.begin,
                 {left.begin, at + 1}, "glint0_w", "," + reading_.spelled(what));
}

void Instrumenter::over_declaration(const Declaration& declaration) {
    if (wish_.kind == ProbeKind::cost) return;
    for (const Declarator& one : declaration.names) {
        if (one.initial.empty()) continue;
        const bool is_behind =
            !one.array.empty() || !declaration.type_array.empty() ||
            records_.bare_struct_of({one.name, one.name + 1}, function_) != kNone;
        if (!declaration.is_const && !is_behind) {
            hand_through(SiteKind::assigned, std::string(reading_.word(one.name)), one.name,
                         one.initial);
            continue;
        }
        const Statement& own = reading_.statements[declaration.statement];
        if (wish_.kind == ProbeKind::values && own.kind == StatementKind::declaration)
            add_record(SiteKind::assigned, {one.name, one.name + 1}, one.name,
                       declaration.tokens.end - 1);
    }
}

// What a call hands to `out` parameters.
std::vector<TokenRange> Instrumenter::outs_of(const Call& call, bool& gives_nothing) const {
    std::vector<TokenRange> outs;
    const std::vector<TokenRange> arguments = reading_.arguments_of(call);
    gives_nothing = true;
    const auto functions = reading_.functions_named(reading_.word(call.name));
    for (std::size_t i = 0; i < arguments.size() && functions.empty(); ++i) {
        gives_nothing = reading_.word(call.name).ends_with("mulExtended");
        if (hands_out(reading_.word(call.name), i)) outs.push_back(arguments[i]);
    }
    for (const std::uint32_t index : functions) {
        const Function& function = reading_.functions[index];
        if (function.parameters.size() != arguments.size()) continue;
        gives_nothing &= reading_.word(function.type) == "void";
        for (std::size_t i = 0; i < arguments.size(); ++i) {
            const bool is_known = std::ranges::find(outs, arguments[i]) != outs.end();
            if (reading_.declarations[function.parameters[i]].is_out && !is_known)
                outs.push_back(arguments[i]);
        }
    }
    return outs;
}

// What a call hands out is noted behind it, and only where it is evaluated.
void Instrumenter::over_outs(const Call& call, bool is_statement) {
    bool gives_nothing = false;
    std::string records;
    const std::size_t sites = probed_.sites.size();
    const std::vector<TokenRange> outs = outs_of(call, gives_nothing);
    for (const TokenRange out : outs) {
        const std::string record =
            new_record(out, records_.is_variable(out) && records_.is_steady(out, outs, function_));
        if (!records.empty() && !record.empty()) records += ",";
        records += record;
    }
    if (records.empty()) return;
    const TokenRange whole = {call.name, call.brackets.end};
    const bool is_there = is_statement
                              ? wrap({whole.begin, whole.end + 1}, "{", " " + records + ";}")
                          : gives_nothing ? wrap(whole, "(", "," + records + ")")
                                          : wrap(whole, "glint0_then(", ",(" + records + ",true))");
    if (!is_there) probed_.sites.resize(sites);
}

void Instrumenter::over_condition(const Statement& statement, TokenRange condition) {
    const bool declares = statement.declaration != kNone && statement.kind != StatementKind::for_;
    if (wish_.kind != ProbeKind::values || condition.empty() || declares) return;
    if (is_declaration(condition))
        return hand_through(SiteKind::assigned, std::string(token(condition.begin + 1).text),
                            condition.begin + 1, {condition.begin + 3, condition.end});
    hand_through(SiteKind::condition, close_spelling(reading_, condition), condition.begin,
                 condition);
}

void Instrumenter::over_loop(std::uint32_t index) {
    if (wish_.kind != ProbeKind::cost || index + 1 >= reading_.statements.size()) return;
    const Statement& loop = reading_.statements[index];
    const Statement& body = reading_.statements[index + 1];
    const std::string name(reading_.word(loop.tokens.begin));
    if (body.parent != index) return;
    if (body.kind == StatementKind::block)
        add_at_head(SiteKind::turn, name, loop.tokens.begin, body.tokens.begin, "glint0_n({},0)");
    else
        add_statement(SiteKind::turn, name, loop.tokens.begin, body.tokens, "glint0_n({},0)");
}

void Instrumenter::place_expression(std::size_t index, std::uint32_t f) {
    const ProbeExpression& asked = wish_.expressions[index];
    const Span whole = reading_.place(reading_.functions[f].tokens);
    if (asked.line.begin >= whole.end || asked.line.end <= whole.begin) return;
    function_ = f;
    probed_.refused[index] = asked.is_assertion ? "" : refusal_of_calls(reading_, asked.text);
    if (!probed_.refused[index].empty()) return;
    const ProbeRoom room = room_at(reading_, asked.line, f, asked.is_note);
    const std::size_t site =
        new_site(asked.is_assertion ? SiteKind::assertion : SiteKind::expression, asked.text,
                 asked.line.begin);
    const std::string call =
        fmt::format("{}({},({}));", wish_.kind == ProbeKind::assertions ? "glint0_a" : "glint0_v",
                    site, with_own_names(with_mended_remainders(asked.text), entry_ == "main"));
    bool is_there = false;
    if (room.brace != kNone) {
        const bool opens = token(room.brace).is("{");
        is_there = opens ? edits_.takes_after(room.brace) : edits_.takes_before(room.brace);
        if (is_there)
            words_.push_back({room.brace,
                              opens ? Words::Where::after : Words::Where::before,
                              {room.brace, room.brace + 1},
                              " " + call + " "});
    } else {
        const Statement& one = reading_.statements[room.statement];
        const bool is_in_block =
            one.parent == kNone || reading_.statements[one.parent].kind == StatementKind::block;
        const char *open = is_in_block ? "" : "{", *close = is_in_block ? "" : "}";
        is_there = room.is_behind ? wrap(one.tokens, open, " " + call + close)
                                  : wrap(one.tokens, open + call + " ", close);
    }
    if (!is_there) probed_.sites.pop_back();
    probed_.refused[index] = is_there ? "" : "a macro keeps that place";
}

void Instrumenter::add_structs() {
    probed_.structs.resize(reading_.structs.size());
    if (wish_.kind == ProbeKind::cost || wish_.kind == ProbeKind::assertions) return;
    for (const Declaration& declaration : reading_.declarations) {
        if (declaration.structure == kNone) continue;
        probed_.structs[declaration.structure] = records_.structs().leaves(declaration.structure);
        if (declaration.scope != Scope::global || declaration.is_block) continue;
        const std::uint32_t last = declaration.tokens.end - 1;
        if (!edits_.takes_after(last) || edits_.is_replaced(reading_.place(declaration.tokens)))
            continue;
        const std::string text = records_.structs().overloads(declaration.structure, wish_.kind);
        if (text.empty()) continue;
        words_.push_back({last, Words::Where::after, {last, last + 1}, " " + text});
    }
}

// From left to right: what stands before a token from the outside in, what stands behind it from
// the inside out.
void Instrumenter::write() {
    std::ranges::stable_sort(words_, {}, [](const Words& one) {
        const bool is_after = one.where == Words::Where::after;
        const auto size = static_cast<std::int64_t>(one.of.size()) * (is_after ? 1 : -1);
        return std::tuple(one.token, one.where, size, one.order);
    });
    for (Words& one : words_) {
        if (one.where == Words::Where::before)
            edits_.before(one.token, std::move(one.words));
        else if (one.where == Words::Where::after)
            edits_.after(one.token, std::move(one.words));
        else
            edits_.replace({one.token, one.token + 1}, std::move(one.words));
    }
}

Probed instrument(const Reading& reading, const ProbeWish& wish, std::string_view entry,
                  Edits& edits, const std::vector<Remainder>& remainders,
                  const std::vector<Unset>& marked) {
    return Instrumenter(reading, wish, edits, marked).run(entry, remainders);
}

}  // namespace glint
