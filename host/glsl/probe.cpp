#include "glsl/probe.h"

#include "glsl/operands.h"
#include "glsl/parser.h"
#include "glsl/probe_record.h"
#include "glsl/probe_room.h"
#include "glsl/probe_types.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

namespace glint {
namespace {

constexpr std::array<std::string_view, 11> kReads = {
    "texture",     "textureLod",      "texelFetch",     "textureGrad",
    "textureProj", "textureOffset",   "textureProjLod", "textureLodOffset",
    "texture2D",   "texture2DLodEXT", "textureCube"};
constexpr std::array<std::string_view, 8> kWhole = {"int",  "ivec2", "ivec3", "ivec4",
                                                    "uint", "uvec2", "uvec3", "uvec4"};
// Of no number they make one.
constexpr std::string_view kHiding[] = {"clamp", "max", "min", "mix", "step", "smoothstep"};

class Instrumenter {
public:
    Instrumenter(const Reading& reading, const ProbeWish& wish, Edits& edits)
        : reading_(reading), wish_(wish), edits_(edits), records_(reading) {
        fixed_.resize(reading.tokens.size());
        for (const Declaration& declaration : reading.declarations) {
            const auto mark = [&](TokenRange range) {
                std::fill(fixed_.begin() + range.begin, fixed_.begin() + range.end, true);
            };
            if (declaration.is_const && declaration.scope != Scope::parameter)
                mark(declaration.tokens);
            for (const Declarator& one : declaration.names) {
                mark(one.array);
                if (!one.initial.empty()) fixed_[one.initial.begin - 1] = true;  // its `=`
            }
        }
    }

    Probed run(const std::vector<bool>& reached, const std::vector<Remainder>& remainders) {
        if (!reading_.is_balanced) return std::move(probed_);
        add_remainders(remainders);
        for (std::uint32_t i = 0; i < reading_.functions.size(); ++i)
            if (reached[i] && reading_.functions[i].is_defined()) over_function(i);
        probed_.refused.assign(wish_.expressions.size(), "it stands in no function that is run");
        for (std::size_t i = 0; i < wish_.expressions.size(); ++i) {
            for (std::uint32_t f = 0; f < reading_.functions.size(); ++f)
                if (reached[f] && reading_.functions[f].is_defined()) place_expression(i, f);
        }
        add_structs();
        write();
        return std::move(probed_);
    }

private:
    struct Words {
        std::uint32_t token;
        enum class Where : std::uint8_t { before, instead, after } where;
        TokenRange of;  // what they belong to: of two at one place the inner one is nearer to it
        std::string words;
        // Of two around the same: the former goes around the latter.
        std::int64_t order = 0;
    };
    const Token& token(std::uint32_t at) const { return reading_.tokens[at]; }

    // The number of a new site; nothing where none is wanted.
    std::optional<std::size_t> add_site(SiteKind kind, std::string name, std::uint32_t at) {
        const std::size_t place = reading_.place(at).begin;
        const auto holds = [&](Span span) { return span.begin <= place && place < span.end; };
        if (!wish_.only.empty() && std::ranges::none_of(wish_.only, holds)) return {};
        if (std::ranges::find(wish_.without, place) != wish_.without.end()) return {};
        if (!wish_.expressions.empty()) return {};
        return new_site(kind, std::move(name), place);
    }
    std::size_t new_site(SiteKind kind, std::string name, std::size_t place) {
        probed_.sites.push_back({kind, std::move(name),
                                 std::string(reading_.word(reading_.functions[function_].name)),
                                 place});
        return probed_.sites.size() - 1;
    }

    // Words on both sides of a range, or none.
    bool wrap(TokenRange range, std::string before, std::string after, std::int64_t order = -1) {
        if (range.empty()) return false;
        if (!edits_.takes_before(range.begin) || !edits_.takes_after(range.end - 1))
            return probed_.left_out.push_back(reading_.place(range.begin).begin), false;
        if (order < 0) order = static_cast<std::int64_t>(words_.size());
        if (!before.empty())
            words_.push_back({range.begin, Words::Where::before, range, std::move(before), order});
        if (!after.empty())
            words_.push_back({range.end - 1, Words::Where::after, range, std::move(after), -order});
        return true;
    }

    // Nearest to what they stand around, for each has a comma of its own.
    void add_remainders(const std::vector<Remainder>& remainders) {
        for (const Remainder& one : remainders) {
            wrap(one.range, one.before, ")", std::numeric_limits<std::int32_t>::max());
            words_.push_back({one.sign, Words::Where::instead, {}, one.instead});
        }
    }

    // `a, b`, which is not to be taken for two arguments.
    bool has_comma(TokenRange range) const {
        return expression_end(reading_, range.begin, range.end) != range.end;
    }

    // Hands an expression through `glint0_v(7, …)`.
    void hand_through(SiteKind kind, std::string name, std::uint32_t at, TokenRange range,
                      const char* function = "glint0_v", const std::string& more = "") {
        if (wish_.kind == ProbeKind::rounding && !is_computed(reading_, range)) return;
        const auto site = add_site(kind, std::move(name), at);
        if (!site) return;
        const char *open = has_comma(range) ? "(" : "", *close = has_comma(range) ? ")" : "";
        if (!wrap(range, fmt::format("{}({},{}", function, *site, open), close + more + ")"))
            probed_.sites.pop_back();
    }

    void add_statement(SiteKind kind, std::string name, std::uint32_t at, TokenRange statement,
                       const char* call) {
        const auto site = add_site(kind, std::move(name), at);
        if (!site) return;
        if (!wrap(statement, fmt::format("{{{}; ", fmt::format(fmt::runtime(call), *site)), "}"))
            probed_.sites.pop_back();
    }

    // Of a variable, behind a brace or a statement.
    void add_record(SiteKind kind, TokenRange variable, std::uint32_t at, std::uint32_t behind) {
        const auto site = add_site(kind, close_spelling(reading_, variable), at);
        if (!site) return;
        const std::string record = records_.record_of(*site, variable, function_);
        if (record.empty() || !edits_.takes_after(behind)) {
            probed_.left_out.push_back(reading_.place(variable.begin).begin);
            return probed_.sites.pop_back();
        }
        words_.push_back({behind, Words::Where::after, {behind, behind + 1}, " " + record + ";"});
    }

    // Behind the brace of a body.
    void add_at_head(SiteKind kind, const std::string& name, std::uint32_t at, std::uint32_t brace,
                     const std::string& call) {
        const auto site = add_site(kind, name, at);
        if (!site) return;
        if (!edits_.takes_after(brace)) return probed_.sites.pop_back();
        words_.push_back({brace,
                          Words::Where::after,
                          {brace, brace + 1},
                          " " + fmt::format(fmt::runtime(call), *site) + ";"});
    }

    std::string new_record(TokenRange variable, bool can_be_told);

    void over_function(std::uint32_t index);
    void over_statement(std::uint32_t index);
    void over_tokens(TokenRange range);
    void over_assignment(std::uint32_t at, TokenRange room);
    void over_whole(TokenRange variable, TokenRange assignment);
    void over_step(std::uint32_t at, TokenRange room);
    void over_declaration(const Declaration& declaration);
    void over_condition(const Statement& statement, TokenRange condition);
    void over_division(std::uint32_t at, TokenRange room);
    void over_fetch(const Call& call);
    void over_index(std::uint32_t at);
    void over_sum(std::uint32_t at, TokenRange room);
    void over_call(const Call& call);
    void over_conversion(const Call& call);
    void over_shift(std::uint32_t at, TokenRange room);
    void over_loop(std::uint32_t index);
    std::vector<TokenRange> outs_of(const Call& call, bool& gives_nothing) const;
    void over_outs(const Call& call, bool is_statement);
    void place_expression(std::size_t index, std::uint32_t function);
    void add_structs();
    void write();

    const Reading& reading_;
    const ProbeWish& wish_;
    Edits& edits_;
    ProbeRecords records_;
    std::vector<bool> fixed_;  // by token: what must stay a constant, or is no expression
    std::vector<Words> words_;
    std::uint32_t function_ = 0;
    Probed probed_;
};

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
        if (token(at).is("[")) over_index(at);
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
    for (const std::uint32_t index : reading_.functions_named(reading_.word(call.name))) {
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

void Instrumenter::over_division(std::uint32_t at, TokenRange room) {
    const bool assigns = token(at).text.size() == 2;
    const std::uint32_t end = assigns ? expression_end(reading_, at + 1, room.end)
                                      : operand_end(reading_, at + 1, room.end);
    const TokenRange divisor = {at + 1, end};
    if (divisor.empty()) return;
    const bool is_number = divisor.size() == 1 && token(at + 1).kind == TokenKind::number;
    const std::uint32_t begin = operand_begin(reading_, at, room.begin);
    const std::uint32_t first = product_begin(reading_, at, room.begin);
    const std::string spelling = close_spelling(reading_, {begin, end});
    if (token(at).text[0] == '%') {
        if (!is_number) hand_through(SiteKind::remainder, spelling, begin, divisor, "glint0_by");
        if (!assigns)
            hand_through(SiteKind::remainder, spelling, begin, {first, at}, "glint0_rest");
        return;
    }
    if (is_number) return;
    const std::size_t site = probed_.sites.size();
    hand_through(SiteKind::division, spelling, begin, divisor, "glint0_d");
    // 1/0 is infinite, 0/0 nothing: what comes of it tells.
    if (assigns || probed_.sites.size() == site) return;
    wrap({first, end}, fmt::format("glint0_q({},", site), ")");
}

void Instrumenter::over_sum(std::uint32_t at, TokenRange room) {
    for (const TokenRange side : sides_of_sum(reading_, at, room))
        hand_through(SiteKind::sum, close_spelling(reading_, side), side.begin, side);
}

void Instrumenter::over_index(std::uint32_t at) {
    const std::uint32_t close = reading_.close_of(at);
    if (close == kNone || at == 0 || !token(at - 1).is_word() || close - at < 2) return;
    if (at >= 2 && token(at - 2).is(".")) return;
    if (close - at == 2 && token(at + 1).kind == TokenKind::number) return;
    const auto found = records_.variables().find(at - 1, function_);
    if (!found.declaration) return;
    const std::string_view type = reading_.word(found.declaration->type);
    std::string length = fmt::format("{}.length()", token(at - 1).text);
    if (found.name->array.empty() && found.declaration->type_array.empty()) {
        const std::size_t digit = type.find_first_of("234");
        if (digit == type.npos) return;
        length = type[digit];
    }
    hand_through(SiteKind::index, close_spelling(reading_, {at - 1, close + 1}), at - 1,
                 {at + 1, close}, "glint0_i", "," + length);
}

void Instrumenter::over_call(const Call& call) {
    const TokenRange whole = {call.name, call.brackets.end};
    const std::string_view name = reading_.word(call.name);
    if (wish_.kind == ProbeKind::cost && is_one_of(name, kReads))
        return hand_through(SiteKind::read, std::string(name), call.name, whole, "glint0_n");
    if (wish_.kind != ProbeKind::faults) return;
    if (name == "texelFetch") return over_fetch(call);
    if (is_one_of(name, kWhole)) return over_conversion(call);
    if (is_one_of(name, kHiding))
        for (const TokenRange one : reading_.arguments_of(call))
            if (is_computed(reading_, one))
                hand_through(SiteKind::operand, close_spelling(reading_, one), one.begin, one);
    const bool has_bounds = has_bounds_to_see_to(reading_, call);
    if (!has_bounds && !may_have_no_result(reading_, call)) return;
    const SiteKind kind = has_bounds ? SiteKind::bounds : SiteKind::domain;
    if (!edits_.takes_replacement(call.name) || !edits_.takes_after(call.brackets.begin)) return;
    const auto site = add_site(kind, close_spelling(reading_, whole), call.name);
    if (!site) return;
    words_.push_back({call.name,
                      Words::Where::instead,
                      {call.name, call.name + 1},
                      fmt::format("glint0_{}", name)});
    words_.push_back({call.brackets.begin, Words::Where::after, whole, fmt::format("{},", *site)});
}

// `uint(x)`: of what a whole number cannot hold, it is what a driver likes.
void Instrumenter::over_conversion(const Call& call) {
    const bool is_unsigned = reading_.word(call.name).starts_with("u");
    for (const TokenRange what : reading_.arguments_of(call)) {
        if (what.empty()) continue;
        if (what.size() == 1 && token(what.begin).kind == TokenKind::number) continue;
        hand_through(SiteKind::whole, close_spelling(reading_, {call.name, call.brackets.end}),
                     call.name, what, is_unsigned ? "glint0_to_uint" : "glint0_to_int");
    }
}

// `1 << n`, where nothing binds `n` more closely.
void Instrumenter::over_shift(std::uint32_t at, TokenRange room) {
    const bool assigns = token(at).text.size() == 3;
    const std::uint32_t end = assigns ? expression_end(reading_, at + 1, room.end)
                                      : operand_end(reading_, at + 1, room.end);
    const TokenRange by = {at + 1, end};
    if (by.empty() || (by.size() == 1 && token(at + 1).kind == TokenKind::number)) return;
    const std::string_view next = end < room.end ? token(end).text : ";";
    if (!assigns && next.size() == 1 &&
        std::string_view("+-*/%").find(next[0]) != std::string_view::npos)
        return;
    const std::uint32_t begin = operand_begin(reading_, at, room.begin);
    hand_through(SiteKind::whole, close_spelling(reading_, {begin, end}), begin, by, "glint0_s");
}

// `texelFetch(buffer, at, 0)` of a sampler that has a name, and a level that is a number.
void Instrumenter::over_fetch(const Call& call) {
    const std::uint32_t first = call.brackets.begin + 1, last = call.brackets.end - 2;
    if (call.arity != 3 || !token(first).is_word() || !token(first + 1).is(",")) return;
    if (token(last).kind != TokenKind::number || !token(last - 1).is(",")) return;
    const TokenRange whole = {call.name, call.brackets.end};
    hand_through(SiteKind::index, close_spelling(reading_, whole), call.name, {first + 2, last - 1},
                 "glint0_t",
                 fmt::format(",max(textureSize({},0)>>{},1)", token(first).text, token(last).text));
    if (token(last).text == "0") return;
    // Of a level that there is not, drivers tell a size of 0.
    hand_through(SiteKind::index,
                 fmt::format("level {} of {}", token(last).text, token(first).text), call.name,
                 {last, last + 1}, "glint0_i",
                 fmt::format(",textureSize({},{}).x>0?{}+1:1", token(first).text, token(last).text,
                             token(last).text));
}

void Instrumenter::place_expression(std::size_t index, std::uint32_t f) {
    const ProbeExpression& asked = wish_.expressions[index];
    const Span whole = reading_.place(reading_.functions[f].tokens);
    if (asked.line.begin >= whole.end || asked.line.end <= whole.begin) return;
    function_ = f;
    probed_.refused[index] = asked.is_assertion ? "" : refusal_of_calls(reading_, asked.text);
    if (!probed_.refused[index].empty()) return;
    const ProbeRoom room = room_at(reading_, asked.line, f);
    const std::size_t site =
        new_site(asked.is_assertion ? SiteKind::assertion : SiteKind::expression, asked.text,
                 asked.line.begin);
    const std::string call =
        fmt::format("{}({},({}));", wish_.kind == ProbeKind::assertions ? "glint0_a" : "glint0_v",
                    site, with_true_place(with_mended_remainders(asked.text)));
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
        if (declaration.scope != Scope::global) continue;
        const std::uint32_t last = declaration.tokens.end - 1;
        if (!edits_.takes_after(last)) continue;
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

}  // namespace

Probed instrument(const Reading& reading, const ProbeWish& wish, const std::vector<bool>& reached,
                  Edits& edits, const std::vector<Remainder>& remainders) {
    return Instrumenter(reading, wish, edits).run(reached, remainders);
}

}  // namespace glint
