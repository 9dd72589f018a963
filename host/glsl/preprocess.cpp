#include "glsl/preprocess.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace glint {
namespace {

std::string_view word_of(const std::vector<Token>& tokens, TokenRange line) {
    return line.size() > 1 && tokens[line.begin + 1].is_word() ? tokens[line.begin + 1].text
                                                               : std::string_view();
}

// The text as the expander wants it: token by token, directives obeyed, dead branches left out.
class TextSource : public TokenSource {
public:
    TextSource(ScannedText& scanned, Macros& macros, Preprocessed& result)
        : scanned_(scanned), macros_(macros), result_(result) {}

    const Token* peek() override {
        while (at_ < scanned_.tokens.size()) {
            if (at_ == next_begin()) {
                take_directive();
            } else if (conditions_.live() == Live::no) {
                at_ = next_begin();
            } else {
                return &scanned_.tokens[at_];
            }
        }
        return nullptr;
    }
    void take() override { ++at_; }

    // What `#if` has no end.
    void finish() {
        for (const std::uint32_t open : open_)
            result_.not_understood.push_back(
                {result_.directives[open].span, "this #if is never ended"});
        if (!open_.empty()) result_.open_condition = result_.directives[open_.front()].span.begin;
    }
    int line_of(std::size_t offset);

private:
    std::size_t next_begin() const {
        return next_ < scanned_.directives.size() ? scanned_.directives[next_].tokens.begin
                                                  : scanned_.tokens.size();
    }
    void take_directive();
    void obey(const DirectiveLine& line, std::string_view word);
    void note_branch(std::string_view word);
    void set_line(const DirectiveLine& line);
    void complain(Span span, const char* why) { result_.not_understood.push_back({span, why}); }

    ScannedText& scanned_;
    Macros& macros_;
    Preprocessed& result_;
    Conditions conditions_;
    std::size_t at_ = 0, next_ = 0;
    std::vector<std::uint32_t> open_;    // directives that began the innermost branches
    std::vector<std::uint32_t> groups_;  // of these
    std::uint32_t group_count_ = 0;
    std::vector<std::size_t> line_ends_;              // of the text, once somebody asks for lines
    std::vector<std::pair<std::size_t, int>> moved_;  // by #line: from here on, by so many
};

void TextSource::take_directive() {
    const DirectiveLine& line = scanned_.directives[next_++];
    const std::string_view word = word_of(scanned_.tokens, line.tokens);
    const Live live = conditions_.live();
    result_.directives.push_back(
        {.span = line.span,
         .word = word,
         .rest = {std::min(line.tokens.begin + 2, line.tokens.end), line.tokens.end},
         .live = live,
         .after = live});
    at_ = line.tokens.end;
    if (conditions_.take(macros_, scanned_.tokens, line.tokens))
        note_branch(word);
    else if (live != Live::no)
        obey(line, word);
    result_.directives.back().after = conditions_.live();
}

void TextSource::note_branch(std::string_view word) {
    const auto here = static_cast<std::uint32_t>(result_.directives.size()) - 1;
    if (word.starts_with("if")) {
        groups_.push_back(group_count_++);
    } else {
        result_.branches.push_back(
            {open_.back(), here, groups_.back(), result_.directives[open_.back()].after});
        open_.pop_back();
        // Whether an #else counts is what its #if would have said.
        result_.directives[here].live = result_.directives[result_.branches.back().begins].live;
    }
    if (word == "endif")
        groups_.pop_back();
    else
        open_.push_back(here);
}

void TextSource::obey(const DirectiveLine& line, std::string_view word) {
    const auto& tokens = scanned_.tokens;
    if (word == "define") {
        const std::size_t end = tokens[line.tokens.end - 1].end;
        const std::string_view behind = result_.text.substr(end, line.span.end - end);
        const bool ends_in_space =
            behind.starts_with(' ') || behind.starts_with('\t') || behind.starts_with("/*");
        if (!macros_.define(tokens, line.tokens, line.span, ends_in_space))
            complain(line.span, "this definition is not understood");
    } else if (word == "undef" && line.tokens.size() > 2) {
        macros_.undefine(tokens[line.tokens.begin + 2].text);
    } else if (word == "line") {
        set_line(line);
    } else if (word == "else" || word == "elif" || word == "endif") {
        complain(line.span, "there is no #if to this");
    }
}

// `#line 20` says what the next line is called.
void TextSource::set_line(const DirectiveLine& line) {
    if (line.tokens.size() < 3) return;
    const std::string_view digits = scanned_.tokens[line.tokens.begin + 2].text;
    int wanted = 0;
    for (const char c : digits) {
        if (c < '0' || c > '9' || wanted > 100'000'000) return complain(line.span, "no number");
        wanted = wanted * 10 + (c - '0');
    }
    const int moved = moved_.empty() ? 0 : moved_.back().second;
    moved_.emplace_back(line.span.end, moved + wanted - line_of(line.span.end) - 1);
}

int TextSource::line_of(std::size_t offset) {
    if (line_ends_.empty()) {
        const std::string_view text = result_.text;
        for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 1))
            line_ends_.push_back(at);
    }
    const auto line = std::ranges::lower_bound(line_ends_, offset) - line_ends_.begin() + 1;
    const auto after =
        std::ranges::upper_bound(moved_, offset, {}, &std::pair<std::size_t, int>::first);
    return static_cast<int>(line) + (after == moved_.begin() ? 0 : std::prev(after)->second);
}

// Puts the tokens of one use together.
void add_token(Preprocessed& result, const Token& token) {
    const auto at = static_cast<std::uint32_t>(result.tokens.size());
    result.tokens.push_back(token);
    if (token.use == kNone) return;
    TokenRange& range = result.uses[token.use].tokens;
    if (range.empty()) range.begin = at;
    range.end = at + 1;
}

}  // namespace

Live Preprocessed::live_at(std::size_t offset) const {
    const auto after = std::ranges::upper_bound(
        directives, offset, {}, [](const Directive& directive) { return directive.span.end; });
    const std::size_t before = static_cast<std::size_t>(after - directives.begin());
    if (before < directives.size() && directives[before].span.begin <= offset)
        return directives[before].live;
    return before == 0 ? Live::yes : directives[before - 1].after;
}

Span Preprocessed::inside(const Branch& branch) const {
    return {directives[branch.begins].span.end, directives[branch.ends].span.begin};
}

Preprocessed preprocess(std::string_view text, const Known& known) {
    Preprocessed result;
    result.text = text;
    ScannedText scanned = scan(text, result.spellings);
    Macros macros(known, result.spellings);
    TextSource source(scanned, macros, result);
    Expander expander(macros, source, result.uses, result.spellings,
                      [&source](std::size_t offset) { return source.line_of(offset); });
    result.tokens.reserve(scanned.tokens.size());
    for (Token token; expander.next(token);) add_token(result, token);
    source.finish();
    if (expander.is_exhausted()) {
        const std::size_t at = expander.exhausted_at();
        result.not_understood.push_back(
            {{at, at}, "macros nested this deep, or grown this large, are not expanded"});
    }
    for (const Token& token : result.tokens)  // of a macro that nobody uses it is no error
        if (token.is("##"))
            result.not_understood.push_back({token.span(), "GLSL ES puts no names together"});
    result.macros = macros.take();
    result.written = std::move(scanned.tokens);
    for (const Token& token : result.written)
        if (token.is_word() && result.live_at(token.begin) != Live::no)
            result.live_words.insert(token.text);
    result.comments = std::move(scanned.comments);
    result.unclosed_comment = scanned.unclosed;
    return result;
}

Known known_of_driver() {
    return {.macros = {{"GL_ES", "1"}, {"GL_FRAGMENT_PRECISION_HIGH", "1"}, {"__VERSION__", "300"}},
            .open = {"GL_"}};
}

}  // namespace glint
