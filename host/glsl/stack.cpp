#include "glsl/stack.h"

#include <algorithm>
#include <array>

namespace glint {

// Every mention is `a[n]`, with one n.
bool Stack::find_counter() {
    for (const std::uint32_t at : mentions_) {
        if (at + 3 >= scope_.end || !reading_.tokens[at + 1].is("[") ||
            !reading_.tokens[at + 2].is_word() || !reading_.tokens[at + 3].is("]"))
            return false;
        if (counter_.empty()) counter_ = reading_.word(at + 2);
        if (reading_.word(at + 2) != counter_) return false;
    }
    return !counter_.empty();
}

// Declared once, in the block of the array.
bool Stack::is_local_from_zero() const {
    const TokenRange block = reading_.statements[block_].tokens;
    int count = 0;
    bool is_good = false;
    for (const Declaration& declaration : reading_.declarations) {
        if (declaration.scope != Scope::local || declaration.statement == kNone ||
            declaration.tokens.begin < block.begin || declaration.tokens.end > block.end)
            continue;
        for (const Declarator& one : declaration.names) {
            if (reading_.word(one.name) != counter_) continue;
            ++count;
            is_good = reading_.word(declaration.type) == "int" && one.array.empty() &&
                      declaration.type_array.empty() && one.initial.size() == 1 &&
                      reading_.tokens[one.initial.begin].is("0") &&
                      reading_.statements[declaration.statement].parent == block_;
        }
    }
    return count == 1 && is_good;
}

std::uint32_t Stack::statement_of(std::uint32_t token) const {
    const auto after = std::ranges::upper_bound(
        reading_.statements, token, {}, [](const Statement& one) { return one.tokens.begin; });
    if (after == reading_.statements.begin()) return kNone;
    auto at = static_cast<std::uint32_t>(after - reading_.statements.begin()) - 1;
    while (at != kNone && reading_.statements[at].tokens.end <= token)
        at = reading_.statements[at].parent;
    return at;
}

// An index, or a side of a comparison.
bool Stack::is_harmless(std::uint32_t mention) const {
    constexpr std::array<std::string_view, 6> kComparisons = {"==", "!=", "<", ">", "<=", ">="};
    constexpr std::array<std::string_view, 7> kBeside = {"(", ")", "&&", "||", "?", ":", ";"};
    const std::string_view before = reading_.word(mention - 1), after = reading_.word(mention + 1);
    if (before == "[" && after == "]") return true;
    const bool compares_before = is_one_of(before, kComparisons);
    const bool compares_after = is_one_of(after, kComparisons);
    return (compares_before && (compares_after || is_one_of(after, kBeside))) ||
           (compares_after && is_one_of(before, kBeside));
}

// What a statement does to the counter, with all that it holds.
Stack::Change Stack::change_of(std::uint32_t index) const {
    const Statement& statement = reading_.statements[index];
    const auto found = std::ranges::lower_bound(changes_, index);
    if (found == changes_.end() || *found >= statement.next) return Change::none;
    if (*found != index) return Change::unclear;
    const std::uint32_t at = statement.tokens.begin;
    return reading_.tokens[at].is("++") || reading_.tokens[at + 1].is("++") ? Change::up
                                                                            : Change::down;
}

// `a[n] = …;`
bool Stack::is_write(std::uint32_t index) const {
    const Statement& statement = reading_.statements[index];
    return statement.kind == StatementKind::expression && statement.tokens.size() > 5 &&
           std::ranges::binary_search(mentions_, statement.tokens.begin) &&
           reading_.tokens[statement.tokens.begin + 4].is("=");
}

bool Stack::is_written_before(std::uint32_t up) const {
    const std::uint32_t parent = reading_.statements[up].parent;
    if (parent == kNone || reading_.statements[parent].kind != StatementKind::block) return false;
    bool is_written = false;
    for (std::uint32_t i = parent + 1; i < up; i = reading_.statements[i].next) {
        if (change_of(i) != Change::none || reading_.statements[i].kind == StatementKind::case_)
            is_written = false;
        is_written |= is_write(i);
    }
    return is_written;
}

// Whether `--n;` was the last that happened to the counter.
bool Stack::is_taken_before(std::uint32_t mention) const {
    for (std::uint32_t at = statement_of(mention); at != kNone;) {
        const std::uint32_t parent = reading_.statements[at].parent;
        if (parent == kNone || parent < block_) return false;
        const StatementKind kind = reading_.statements[parent].kind;
        if (kind != StatementKind::block && kind != StatementKind::if_) return false;
        Change last = Change::none;
        for (std::uint32_t i = parent + 1; kind == StatementKind::block && i < at;
             i = reading_.statements[i].next) {
            if (const Change change = change_of(i); change != Change::none) last = change;
            if (reading_.statements[i].kind == StatementKind::case_) last = Change::unclear;
        }
        if (last != Change::none) return last == Change::down;
        at = parent;
    }
    return false;
}

bool Stack::is_certain() {
    if (!find_counter() || !is_local_from_zero()) return false;
    const TokenRange block = reading_.statements[block_].tokens;
    for (std::uint32_t at = block.begin; at < block.end; ++at) {
        if (!reading_.tokens[at].is(counter_) || reading_.tokens[at - 1].is(".")) continue;
        const std::uint32_t index = statement_of(at);
        const Statement& statement = reading_.statements[index];
        const bool is_declared = statement.kind == StatementKind::declaration &&
                                 statement.parent == block_ && reading_.tokens[at + 1].is("=") &&
                                 !reading_.tokens[at - 1].is("=");
        const bool is_step = statement.kind == StatementKind::expression &&
                             statement.tokens.size() == 3 &&
                             (reading_.tokens[statement.tokens.begin].is("++") ||
                              reading_.tokens[statement.tokens.begin].is("--") ||
                              reading_.tokens[statement.tokens.begin + 1].is("++") ||
                              reading_.tokens[statement.tokens.begin + 1].is("--"));
        if (is_step)
            changes_.push_back(index);
        else if (!is_declared && !is_harmless(at))
            return false;
    }
    return std::ranges::all_of(changes_,
                               [&](std::uint32_t change) {
                                   return change_of(change) == Change::down ||
                                          is_written_before(change);
                               }) &&
           std::ranges::all_of(mentions_, [&](std::uint32_t mention) {
               const std::uint32_t index = statement_of(mention);
               const bool is_written =
                   reading_.statements[index].tokens.begin == mention && is_write(index);
               return is_written || is_taken_before(mention);
           });
}

}  // namespace glint
