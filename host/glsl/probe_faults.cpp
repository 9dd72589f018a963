// The sites of operations: what is outside of a domain, how often something is read, what rounds.
#include "glsl/instrumenter.h"
#include "glsl/operand_type.h"
#include "glsl/operands.h"
#include "glsl/probe_types.h"

#include <fmt/format.h>

#include <array>
#include <string_view>

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

}  // namespace

void Instrumenter::over_division(std::uint32_t at, TokenRange room) {
    const bool assigns = token(at).text.size() == 2;
    const std::uint32_t end = assigns ? expression_end(reading_, at + 1, room.end)
                                      : operand_end(reading_, at + 1, room.end);
    const TokenRange divisor = {at + 1, end};
    if (divisor.empty()) return;
    const bool is_number = divisor.size() == 1 && token(at + 1).kind == TokenKind::number;
    const std::uint32_t begin = operand_begin(reading_, at, room.begin);
    const std::uint32_t first = product_begin(reading_, at, room.begin);
    const std::string spelling = close_spelling(reading_, {assigns ? begin : first, end});
    if (token(at).text[0] == '%') {
        if (!is_number) hand_through(SiteKind::remainder, spelling, begin, divisor, "glint0_by");
        if (!assigns)
            return hand_through(SiteKind::remainder, spelling, begin, {first, at}, "glint0_rest");
        // Before `n %= by` the variable itself is given what it should be.
        const TokenRange left = {begin, at};
        const auto site = records_.is_variable(left)
                              ? add_site(SiteKind::remainder, spelling, begin)
                              : std::nullopt;
        const std::string name = reading_.spelled(left);
        if (site &&
            !wrap({begin, end}, fmt::format("({0}=glint0_rest({1},{0}),", name, *site), ")"))
            probed_.sites.pop_back();
        return;
    }
    if (is_number) return;
    const std::size_t site = probed_.sites.size();
    hand_through(SiteKind::division, spelling, begin, divisor, "glint0_d");
    // 1/0 is infinite, 0/0 nothing: what comes of it tells.
    if (probed_.sites.size() == site) return;
    const TokenRange left = {begin, at};
    if (!assigns)
        wrap({first, end}, fmt::format("glint0_q({},", site), ")", kNearest);
    else if (records_.is_variable(left))
        wrap({begin, end}, "(",
             fmt::format(",{0}=glint0_q({1},{0}))", reading_.spelled(left), site));
}

bool Instrumenter::may_be_no_number(TokenRange value) const {
    for (std::uint32_t at = value.begin; at + 1 < value.end; ++at)
        if (token(at).is("/") && token(at + 1).kind != TokenKind::number) return true;
    return std::ranges::any_of(reading_.calls, [&](const Call& call) {
        return value.begin <= call.name && call.name < value.end &&
               may_have_no_result(reading_, call);
    });
}

bool Instrumenter::is_marked(std::uint32_t name) const {
    const std::size_t at = reading_.place(name).begin;
    return std::ranges::any_of(marked_, [&](const Unset& one) { return one.at == at; });
}

// Each read of what is unset, or call of what may give nothing back, is a site, so that it is named
// itself and not what becomes of it.
void Instrumenter::over_reads_of_unset(const Function& function) {
    std::vector<TokenRange> outs;
    bool gives_nothing = false;
    for (const Call& call : reading_.calls) {
        if (call.function != function_) continue;
        const std::vector<TokenRange> its = outs_of(call, gives_nothing);
        outs.insert(outs.end(), its.begin(), its.end());
        for (const std::uint32_t index : reading_.functions_named(reading_.word(call.name)))
            if (is_marked(reading_.functions[index].name) && !fixed_[call.name])
                over_read_of_unset(call.name, function, outs, true);
    }
    for (std::uint32_t at = function.body.begin + 1; at + 1 < function.body.end; ++at) {
        if (fixed_[at] || !token(at).is_word() || token(at - 1).is(".")) continue;
        const auto found = records_.variables().find(at, function_);
        if (found.declaration && found.name->name != at)
            over_read_of_unset(at, function, outs, is_marked(found.name->name));
    }
}

// Of what is not `marked` itself whole numbers alone, to which a mark may have come from elsewhere:
// of floats it is a NaN, which is told of anyway.
void Instrumenter::over_read_of_unset(std::uint32_t at, const Function& function,
                                      const std::vector<TokenRange>& outs, bool marked) {
    const TokenRange what = {at, operand_end(reading_, at, function.body.end)};
    TokenRange around = what;  // `(v).x`
    while (token(around.begin - 1).is("(") && reading_.close_of(around.begin - 1) == around.end &&
           !token(around.begin - 2).is_word())
        around = {around.begin - 1, operand_end(reading_, around.begin - 1, function.body.end)};
    const Token &next = token(around.end), &last = token(around.end - 1),
                &before = token(around.begin - 1);
    const auto steps = [](const Token& one) { return one.is("++") || one.is("--"); };
    if (next.is("=")) return;
    const auto is_handed_out = [&](TokenRange out) { return out == what || out == around; };
    if (std::ranges::any_of(outs, is_handed_out)) return;
    const TokenRange variable = {what.begin, steps(last) ? what.end - 1 : what.end};
    const auto type = type_of_operand(reading_, records_.variables(), variable, function_);
    if (!type || type->lengths > 0 || type->structure != kNone || type->name.starts_with("b") ||
        (probe_type_of(type->name) < 0 && matrix_columns(type->name) == 0))
        return;
    const bool is_whole = type->name.starts_with("i") || type->name.starts_with("u");
    if (!marked && !is_whole) return;
    const std::string name = close_spelling(reading_, variable);
    const bool assigns = is_assignment(next);
    if (!assigns && !steps(next) && !steps(last) && !steps(before))
        return hand_through(SiteKind::unset, name, at, what, "glint0_m");
    if (!records_.is_variable(variable)) return;  // which is read twice below
    TokenRange all = around;
    if (assigns) all.end = expression_end(reading_, around.end + 1, function.body.end);
    if (!assigns && steps(next)) ++all.end;
    if (steps(before)) --all.begin;
    const auto site = add_site(SiteKind::unset, name, at);
    if (!site) return;
    const std::string read = fmt::format("(glint0_m({},{}),", *site, reading_.spelled(variable));
    if (!wrap(all, read, ")")) probed_.sites.pop_back();
}

void Instrumenter::over_sum(std::uint32_t at, TokenRange room) {
    for (const TokenRange side : sides_of_sum(reading_, at, room))
        hand_through(SiteKind::sum, close_spelling(reading_, side), side.begin, side);
}

void Instrumenter::over_index(std::uint32_t at, TokenRange room) {
    const std::uint32_t close = reading_.close_of(at);
    if (close == kNone || close - at < 2) return;
    if (close - at == 2 && token(at + 1).kind == TokenKind::number) return;
    const TokenRange what = {operand_begin(reading_, at, room.begin), at};
    const auto type = type_of_operand(reading_, records_.variables(), what, function_);
    if (!type) return;
    std::string length = reading_.spelled(what) + ".length()";
    if (type->lengths == 0) {
        const std::size_t digit = type->name.find_first_of("234");
        if (digit == type->name.npos || type->structure != kNone) return;
        length = type->name[digit];  // of a matrix, how many columns
    } else if (!records_.is_variable(what)) {
        return;
    }
    hand_through(SiteKind::index, close_spelling(reading_, {what.begin, close + 1}), what.begin,
                 {at + 1, close}, "glint0_i", "," + length);
}

void Instrumenter::over_call(const Call& call) {
    const TokenRange whole = {call.name, call.brackets.end};
    const std::string_view name = reading_.word(call.name);
    if (wish_.kind == ProbeKind::cost && is_one_of(name, kReads))
        return hand_through(SiteKind::read, std::string(name), call.name, whole, "glint0_n");
    if (wish_.kind != ProbeKind::faults) return;
    if (name == "texelFetch" || name == "texelFetchOffset") return over_fetch(call);
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

// `texelFetch(buffer, at, 0)` of a sampler that has a name, and a level that may be asked once
// more. An offset, which is constant, is added to the place meanwhile.
void Instrumenter::over_fetch(const Call& call) {
    const std::uint32_t first = call.brackets.begin + 1;
    const std::vector<TokenRange> arguments = reading_.arguments_of(call);
    const bool has_offset = reading_.word(call.name) != "texelFetch";
    if (call.arity != (has_offset ? 4 : 3) || !token(first).is_word() || !token(first + 1).is(","))
        return;
    const TokenRange place = arguments[1], last = arguments[2];
    const bool is_number = last.size() == 1 && token(last.begin).kind == TokenKind::number;
    if (last.empty() || (!is_number && !records_.is_variable(last))) return;
    const std::string level = reading_.spelled(last);
    const std::string size = fmt::format("max(textureSize({},0)>>{},1)", token(first).text, level);
    const std::string offset = has_offset ? reading_.spelled(arguments[3]) : "";
    hand_through(SiteKind::index, close_spelling(reading_, {call.name, call.brackets.end}),
                 call.name, place, "glint0_t",
                 has_offset ? fmt::format(",{},{}", size, offset) : "," + size);
    if (level == "0") return;
    // Of a level that there is not, drivers tell a size of 0.
    hand_through(SiteKind::index, fmt::format("level {} of {}", level, token(first).text),
                 call.name, last, "glint0_i",
                 fmt::format(",textureSize({0},1).x>0?1+int(log2(float(max(textureSize({0},0).x,"
                             "textureSize({0},0).y)))+3e-5):1",
                             token(first).text));
}

}  // namespace glint
