#include "glsl/reachable.h"

#include "glsl/lean.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace glint {
namespace {

// Something that stands outside all braces, or a preprocessor line, with what is before it:
// comments and branches that are not compiled.
struct Piece {
    Span span;
    bool is_wanted = false, is_uniform = false;
    std::vector<std::string_view> names;  // that it declares
};

class Cutter {
public:
    Cutter(const Reading& reading, std::string_view decided) : reading_(reading) {
        find_decided(decided);
        find_pieces();
    }

    EditedText cut(std::string_view entry);

private:
    void find_decided(std::string_view decided);
    void find_pieces();
    void add(Piece piece, Span span);
    void add_wanted(Span span) {
        Piece piece;
        piece.is_wanted = true;
        add(std::move(piece), span);
    }
    Piece piece_of(const Item& item) const;
    std::vector<std::string_view> words_of(const Piece& piece) const;
    std::size_t line_end(std::size_t at, std::size_t stop) const;
    std::size_t line_end(const Directive& directive) const {
        return line_end(directive.span.end, reading_.text.size());
    }
    // The first of what is dropped that ends behind a byte.
    std::vector<Span>::const_iterator dropped_behind(std::size_t at) const {
        return std::ranges::upper_bound(dropped_, at, {}, &Span::end);
    }
    bool is_dropped(std::size_t at) const {
        const auto span = dropped_behind(at);
        return span != dropped_.end() && span->begin <= at;
    }
    void append(Span span, EditedText& result) const;
    void leave_out(Span span, EditedText& result) const;

    const Reading& reading_;
    std::vector<Span> dropped_;  // apart from each other, in order
    std::vector<Piece> pieces_;
    std::size_t done_ = 0;
};

// Behind the newline of a place outside comments, or `stop` where there is none before; lines that
// a backslash joins are one, and a comment may hold any number.
std::size_t Cutter::line_end(std::size_t at, std::size_t stop) const {
    const std::string_view text = reading_.text;
    bool is_comment = false;
    while (at < stop) {
        const std::string_view rest = text.substr(at);
        if (rest.starts_with("\\\n")) {
            at += 2;
        } else if (rest.starts_with('\n')) {
            return at + 1;
        } else if (!is_comment && rest.starts_with("/*")) {
            const std::size_t close = text.find("*/", at + 2);
            at = close == text.npos ? text.size() : close + 2;
        } else {
            is_comment |= rest.starts_with("//");
            ++at;
        }
    }
    return std::min(at, text.size());
}

// The directives of groups that ask for what is decided, and the branches of these that are dead.
void Cutter::find_decided(std::string_view decided) {
    std::unordered_map<std::uint32_t, bool> asks, is_open;  // by group
    for (const Branch& branch : reading_.branches) {
        const Directive& begins = reading_.directives[branch.begins];
        for (std::uint32_t at = begins.rest.begin; at < begins.rest.end; ++at)
            asks[branch.group] |= reading_.written[at].text.starts_with(decided);
        is_open[branch.group] |= branch.live == Live::maybe;
    }
    for (const Branch& branch : reading_.branches) {
        if (!asks[branch.group] || is_open[branch.group]) continue;
        const Directive& begins = reading_.directives[branch.begins];
        const Directive& ends = reading_.directives[branch.ends];
        dropped_.push_back({begins.span.begin, line_end(begins)});
        dropped_.push_back({ends.span.begin, line_end(ends)});
        if (branch.live == Live::no) dropped_.push_back({begins.span.begin, ends.span.begin});
    }
    std::ranges::sort(dropped_, {}, &Span::begin);
    std::vector<Span> apart;
    for (const Span span : dropped_) {
        if (apart.empty() || apart.back().end < span.begin)
            apart.push_back(span);
        else
            apart.back().end = std::max(apart.back().end, span.end);
    }
    dropped_ = std::move(apart);
}

Piece Cutter::piece_of(const Item& item) const {
    Piece piece;
    if (item.kind == Item::Kind::function) {
        piece.names.push_back(reading_.word(reading_.functions[item.index].name));
    } else if (item.kind == Item::Kind::declaration) {
        const Declaration& declaration = reading_.declarations[item.index];
        piece.is_uniform = declaration.is_uniform;
        if (declaration.structure != kNone)
            piece.names.push_back(reading_.word(reading_.structs[declaration.structure].name));
        for (const Declarator& one : declaration.names)
            piece.names.push_back(reading_.word(one.name));
        piece.is_wanted = declaration.names.empty() && declaration.structure == kNone;
    } else {
        piece.is_wanted = true;
    }
    return piece;
}

// The rest of the line belongs to it: a comment behind it.
void Cutter::add(Piece piece, Span span) {
    const auto next = std::ranges::lower_bound(reading_.written, span.end, {},
                                               [](const Token& token) { return token.begin; });
    const bool any = next != reading_.written.end();
    const std::size_t end = line_end(span.end, any ? next->begin : reading_.text.size());
    const bool ends_line = !any || reading_.text[end - 1] == '\n';
    piece.span = {done_, ends_line ? end : span.end};
    done_ = piece.span.end;
    pieces_.push_back(std::move(piece));
}

void Cutter::find_pieces() {
    auto directive = reading_.directives.begin();
    const auto add_directives = [&](std::size_t up_to) {
        for (; directive != reading_.directives.end() && directive->span.begin < up_to; ++directive)
            if (directive->span.begin >= done_) add_wanted(directive->span);
    };
    for (const Item& item : reading_.items) {
        const Span span = reading_.place(item.tokens);
        Piece piece = piece_of(item);
        piece.is_wanted |= !stands_for_itself(reading_, span);
        if (span.begin < done_) {  // of the same macro as the one before
            Piece& before = pieces_.back();
            before.names.insert(before.names.end(), piece.names.begin(), piece.names.end());
            before.is_wanted |= piece.is_wanted;
            if (span.end > before.span.end) before.span.end = done_ = span.end;
            continue;
        }
        add_directives(span.begin);
        add(std::move(piece), span);
    }
    add_directives(reading_.text.size());
    if (done_ < reading_.text.size()) add_wanted({done_, reading_.text.size()});
}

std::vector<std::string_view> Cutter::words_of(const Piece& piece) const {
    std::vector<std::string_view> words;
    auto token = std::ranges::lower_bound(reading_.written, piece.span.begin, {},
                                          [](const Token& one) { return one.begin; });
    for (; token != reading_.written.end() && token->begin < piece.span.end; ++token)
        if (token->is_word() && !is_dropped(token->begin)) words.push_back(token->text);
    return words;
}

void Cutter::append(Span span, EditedText& result) const {
    const auto add = [&](std::size_t begin, std::size_t end) {
        if (begin >= end) return;
        result.map.pieces.push_back({.at = result.text.size(), .from = begin});
        result.text += reading_.text.substr(begin, end - begin);
    };
    std::size_t at = span.begin;
    for (auto next = dropped_behind(at); next != dropped_.end() && next->begin < span.end; ++next) {
        add(at, next->begin);
        at = std::min(next->end, span.end);
    }
    add(at, span.end);
}

// What stands before it on its line keeps the line's end.
void Cutter::leave_out(Span span, EditedText& result) const {
    const bool ends_line = span.begin < span.end && reading_.text[span.end - 1] == '\n';
    if (ends_line && !result.text.empty() && result.text.back() != '\n')
        append({span.end - 1, span.end}, result);
}

EditedText Cutter::cut(std::string_view entry) {
    const bool keeps_all = !reading_.is_balanced || !reading_.not_understood.empty();
    std::unordered_multimap<std::string_view, std::size_t> named;
    std::vector<std::size_t> fresh;
    const auto want = [&](std::size_t piece) {
        if (!pieces_[piece].is_wanted && !pieces_[piece].is_uniform) fresh.push_back(piece);
        pieces_[piece].is_wanted = !pieces_[piece].is_uniform;
    };
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
        for (const std::string_view name : pieces_[i].names) named.emplace(name, i);
        if (pieces_[i].is_wanted) fresh.push_back(i);
        if (keeps_all) want(i);
    }
    std::unordered_set<std::string_view> seen;
    const auto want_named = [&](std::string_view name) {
        if (!seen.insert(name).second) return;
        const auto [begin, end] = named.equal_range(name);
        for (auto i = begin; i != end; ++i) want(i->second);
    };
    want_named(entry);
    while (!fresh.empty()) {
        const std::size_t piece = fresh.back();
        fresh.pop_back();
        for (const std::string_view word : words_of(pieces_[piece])) want_named(word);
    }
    EditedText result;
    for (const Piece& piece : pieces_) {
        if (piece.is_wanted)
            append(piece.span, result);
        else
            leave_out(piece.span, result);
    }
    return result;
}

}  // namespace

EditedText reachable_text(const Reading& reading, std::string_view entry,
                          std::string_view decided) {
    return Cutter(reading, decided).cut(entry);
}

}  // namespace glint
