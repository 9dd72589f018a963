#include "glsl/edits.h"

#include <algorithm>
#include <utility>

namespace glint {
namespace {

// Whether two tokens would be read as one, or as others, without a space.
bool would_join(const Token& a, const Token& b) {
    if (a.kind == TokenKind::symbol || b.kind == TokenKind::symbol)
        return a.kind == b.kind || a.is(".") || b.is(".");
    return true;
}

std::string line_ends_in(std::string_view text) {
    return std::string(static_cast<std::size_t>(std::ranges::count(text, '\n')), '\n');
}

}  // namespace

std::size_t EditMap::origin(std::size_t at) const {
    const auto after = std::ranges::upper_bound(pieces, at, {}, &Piece::at);
    if (after == pieces.begin()) return at;
    const Piece& piece = *std::prev(after);
    return piece.is_own ? piece.from : piece.from + (at - piece.at);
}

bool Edits::takes_before(std::uint32_t token) const {
    const std::uint32_t use = reading_.tokens[token].use;
    return use == kNone || reading_.uses[use].tokens.begin == token ||
           may_write_out(reading_.uses[use]);
}

bool Edits::takes_after(std::uint32_t token) const {
    const std::uint32_t use = reading_.tokens[token].use;
    return use == kNone || reading_.uses[use].tokens.end == token + 1 ||
           may_write_out(reading_.uses[use]);
}

bool Edits::takes_replacement(std::uint32_t token) const {
    return reading_.stands_alone({token, token + 1}) ||
           may_write_out(reading_.uses[reading_.tokens[token].use]);
}

bool Edits::is_replaced(Span span) const {
    return std::ranges::any_of(changes_, [&](const Change& change) {
        return change.span.begin < change.span.end && change.span.begin < span.end &&
               span.begin < change.span.end;
    });
}

bool Edits::before(std::uint32_t token, std::string words) {
    const std::uint32_t use = reading_.tokens[token].use;
    if (use != kNone && reading_.uses[use].tokens.begin != token)
        return add_within({token, Within::Where::before, std::move(words)});
    const std::size_t at = reading_.place(token).begin;
    changes_.push_back({{at, at}, std::move(words)});
    return true;
}

bool Edits::after(std::uint32_t token, std::string words) {
    const std::uint32_t use = reading_.tokens[token].use;
    if (use != kNone && reading_.uses[use].tokens.end != token + 1)
        return add_within({token, Within::Where::after, std::move(words)});
    const std::size_t at = reading_.place(token).end;
    changes_.push_back({{at, at}, std::move(words)});
    return true;
}

bool Edits::replace(TokenRange range, std::string words) {
    if (reading_.stands_alone(range)) {
        replace_bytes(reading_.place(range), std::move(words));
        return true;
    }
    const std::uint32_t use = range.empty() ? kNone : reading_.tokens[range.begin].use;
    if (use == kNone || reading_.tokens[range.end - 1].use != use ||
        !may_write_out(reading_.uses[use]))
        return false;
    for (std::uint32_t token = range.begin; token < range.end; ++token)
        add_within({token, Within::Where::instead, token == range.begin ? words : ""});
    return true;
}

void Edits::write_out(const MacroUse& use) {
    if (use.tokens.empty()) return;
    if (!add_within({use.tokens.begin, Within::Where::before, ""}))
        replace_bytes(use.span, reading_.spelled(use.tokens));
}

void Edits::replace_bytes(Span span, std::string words) {
    changes_.push_back(
        {span, words + line_ends_in(reading_.text.substr(span.begin, span.end - span.begin))});
}

// Written out, the words of an expansion are read once more; none may be a macro's name.
bool Edits::may_write_out(const MacroUse& use) const {
    if (!use.is_certain) return false;
    for (std::uint32_t at = use.tokens.begin; at < use.tokens.end; ++at) {
        const Token& token = reading_.tokens[at];
        if (token.is_word() &&
            std::ranges::find(reading_.macros, token.text, &Macro::name) != reading_.macros.end())
            return false;
    }
    return true;
}

bool Edits::add_within(Within change) {
    if (!may_write_out(reading_.uses[reading_.tokens[change.token].use])) return false;
    within_.push_back(std::move(change));
    return true;
}

// Takes the changes that belong to the use, in the order of their tokens.
std::string Edits::written_out(const MacroUse& use, const Within*& next, const Within* end) const {
    std::string text;
    for (std::uint32_t at = use.tokens.begin; at < use.tokens.end; ++at) {
        const Token& token = reading_.tokens[at];
        const bool joins = at > use.tokens.begin && would_join(reading_.tokens[at - 1], token);
        if (at > use.tokens.begin && (token.space_before || joins)) text += ' ';
        bool is_replaced = false;
        std::string behind;
        for (; next != end && next->token == at; ++next) {
            is_replaced |= next->where == Within::Where::instead;
            (next->where == Within::Where::after ? behind : text) += next->words;
        }
        if (!is_replaced) text += token.text;
        text += behind;
    }
    return text;
}

EditedText Edits::apply() const {
    std::vector<Change> changes = changes_;
    std::vector<Within> within = within_;
    std::ranges::stable_sort(within, {}, &Within::token);
    const Within* const end = within.data() + within.size();
    for (const Within* next = within.data(); next != end;) {
        const MacroUse& use = reading_.uses[reading_.tokens[next->token].use];
        const std::string_view text =
            reading_.text.substr(use.span.begin, use.span.end - use.span.begin);
        changes.push_back({use.span, written_out(use, next, end) + line_ends_in(text)});
    }
    std::ranges::stable_sort(changes, {}, [](const Change& change) {
        return std::pair(change.span.begin, change.span.end);
    });
    EditedText result;
    std::size_t done = 0;
    const auto add = [&](std::string_view words, std::size_t from, bool is_own) {
        if (words.empty()) return;
        result.map.pieces.push_back({result.text.size(), from, is_own});
        result.text += words;
    };
    for (const auto& [span, words] : changes) {
        if (span.begin < done) continue;
        add(reading_.text.substr(done, span.begin - done), done, false);
        add(words, span.begin, true);
        done = span.end;
    }
    add(reading_.text.substr(done), done, false);
    return result;
}

}  // namespace glint
