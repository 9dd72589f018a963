// Who writes the sites of a probe into a text; glsl/probe.h has what comes of it.
#pragma once

#include "glsl/operands.h"
#include "glsl/probe.h"
#include "glsl/probe_record.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace glint {

class Instrumenter {
public:
    Instrumenter(const Reading& reading, const ProbeWish& wish, Edits& edits,
                 const std::vector<Unset>& marked)
        : reading_(reading), wish_(wish), edits_(edits), marked_(marked), records_(reading) {
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
        for (const Statement& one : reading.statements)
            if (is_declaration(one.condition)) fixed_[one.condition.begin + 2] = true;
    }

    Probed run(std::string_view entry, const std::vector<Remainder>& remainders) {
        if (!reading_.is_balanced) return std::move(probed_);
        entry_ = entry;
        const std::vector<bool> reached = reading_.reached_from({entry});
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

    static constexpr std::int64_t kNearest = std::numeric_limits<std::int32_t>::max();

    // Nearest to what they stand around, for each has a comma of its own.
    void add_remainders(const std::vector<Remainder>& remainders) {
        for (const Remainder& one : remainders) {
            wrap(one.range, one.before, ")", kNearest);
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

    // `bool goes = i < 3`
    bool is_declaration(TokenRange condition) const {
        return condition.size() > 3 && token(condition.begin).is_word() &&
               token(condition.begin + 1).is_word();
    }
    bool may_be_no_number(TokenRange value) const;
    bool is_marked(std::uint32_t name) const;

    void over_globals(const Function& entry);
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
    void over_index(std::uint32_t at, TokenRange room);
    void over_sum(std::uint32_t at, TokenRange room);
    void over_reads_of_unset(const Function& function);
    void over_read_of_unset(std::uint32_t at, const Function& function,
                            const std::vector<TokenRange>& outs, bool marked);
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
    const std::vector<Unset>& marked_;
    std::string_view entry_;
    ProbeRecords records_;
    std::vector<bool> fixed_;  // by token: what must stay a constant, or is no expression
    std::vector<Words> words_;
    std::uint32_t function_ = 0;
    Probed probed_;
};

}  // namespace glint
