#include "glsl/token.h"

#include <algorithm>
#include <array>
#include <utility>

namespace glint {
namespace {

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}
bool is_word(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || is_digit(c) || c == '_';
}
bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\v' || c == '\f' || c == '\r';
}

// What GLSL itself writes behind '#'. In other directives, and in #include, quotes hold a name.
bool is_own_directive(std::string_view word) {
    constexpr std::array<std::string_view, 12> kOwn = {"define", "undef",     "if",      "ifdef",
                                                       "ifndef", "else",      "elif",    "endif",
                                                       "pragma", "extension", "version", "line"};
    return word == "error" || std::ranges::find(kOwn, word) != kOwn.end();
}

// The length of the operator that a text begins with; 0 for none.
std::size_t symbol_length(std::string_view text) {
    constexpr std::array<std::string_view, 21> kLong = {
        "<<=", ">>=", "++", "--", "<<", ">>", "<=", ">=", "==", "!=", "&&",
        "||",  "^^",  "+=", "-=", "*=", "/=", "%=", "&=", "^=", "|="};
    if (std::string_view(".,;:?()[]{}+-*/%<>=!~&|^#").find(text[0]) == text.npos) return 0;
    if (text.size() < 2 || std::string_view("<>=+-&|^#").find(text[1]) == text.npos) return 1;
    for (const std::string_view symbol : kLong)
        if (text.starts_with(symbol)) return symbol.size();
    return text.starts_with("##") ? 2 : 1;
}

std::size_t digits_end(std::string_view text, std::size_t at) {
    while (at < text.size() && is_digit(text[at])) ++at;
    return at;
}

// A number as GLSL's grammar has it. A letter that is none of its suffixes begins a word.
std::size_t number_end(std::string_view text, std::size_t begin) {
    const auto at = [&](std::size_t i) { return i < text.size() ? text[i] : ' '; };
    std::size_t end = begin;
    if (at(begin) == '0' && (at(begin + 1) == 'x' || at(begin + 1) == 'X')) {
        end = begin + 2;
        while (end < text.size() &&
               std::string_view("0123456789abcdefABCDEF").find(text[end]) != text.npos)
            ++end;
        return end + (at(end) == 'u' || at(end) == 'U' ? 1 : 0);
    }
    end = digits_end(text, begin);
    if (at(end) == '.') end = digits_end(text, end + 1);
    if (at(end) == 'e' || at(end) == 'E') {
        const std::size_t sign = end + (at(end + 1) == '+' || at(end + 1) == '-' ? 2 : 1);
        if (is_digit(at(sign))) end = digits_end(text, sign);
    }
    return end + (std::string_view("fFuU").find(at(end)) != std::string_view::npos ? 1 : 0);
}

// A text with joined lines put together, and where each of its bytes stood.
struct Joined {
    struct Seam {
        std::size_t at = 0, moved = 0;  // from `at` on, bytes stood so many later
    };
    std::string text;
    std::vector<Seam> seams;
};

Joined join_lines(std::string_view text) {
    Joined joined;
    joined.text.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '\\' && i + 1 < text.size() && text[i + 1] == '\n') {
            ++i;
            joined.seams.push_back({joined.text.size(), i + 1 - joined.text.size()});
        } else {
            joined.text += text[i];
        }
    }
    return joined;
}

class Scanner {
public:
    Scanner(std::string_view text, std::vector<Joined::Seam> seams)
        : text_(text), seams_(std::move(seams)) {}

    ScannedText scan();

private:
    bool skip_space();
    void skip_comment(bool is_line);
    void end_line();
    void add(std::size_t end, TokenKind kind);
    void take_token();
    std::size_t quoted_end() const;
    // Where a byte stood. Asked in rising order, but for the last byte of the token before.
    std::size_t place(std::size_t at) {
        while (next_seam_ < seams_.size() && seams_[next_seam_].at <= at)
            moved_ = seams_[next_seam_++].moved;
        return at + moved_;
    }

    std::string_view text_;
    std::vector<Joined::Seam> seams_;
    std::size_t next_seam_ = 0, moved_ = 0;
    std::size_t at_ = 0;
    bool begins_line_ = true, space_before_ = false;
    bool in_directive_ = false, takes_quotes_ = false;
    ScannedText result_;
};

void Scanner::end_line() {
    begins_line_ = true;
    if (!in_directive_) return;
    DirectiveLine& line = result_.directives.back();
    line.span.end = place(at_);
    line.tokens.end = static_cast<std::uint32_t>(result_.tokens.size());
    in_directive_ = takes_quotes_ = false;
}

void Scanner::skip_comment(bool is_line) {
    const std::size_t begin = place(at_);
    std::size_t end = is_line ? text_.find('\n', at_) : text_.find("*/", at_ + 2);
    if (end == text_.npos) {
        if (!is_line) result_.unclosed = begin;
        end = text_.size();
    } else if (!is_line) {
        end += 2;
    }
    at_ = end;
    result_.comments.push_back({{begin, place(end - 1) + 1}, is_line});
}

// Up to the next token; false at the end of the text.
bool Scanner::skip_space() {
    space_before_ = false;
    for (; at_ < text_.size(); space_before_ = true) {
        if (text_[at_] == '\n') {
            end_line();
            ++at_;
        } else if (is_space(text_[at_])) {
            ++at_;
        } else if (text_[at_] == '/' && at_ + 1 < text_.size() &&
                   (text_[at_ + 1] == '/' || text_[at_ + 1] == '*')) {
            skip_comment(text_[at_ + 1] == '/');
        } else {
            return true;
        }
    }
    end_line();
    return false;
}

void Scanner::add(std::size_t end, TokenKind kind) {
    Token token;
    token.text = text_.substr(at_, end - at_);
    token.begin = static_cast<std::uint32_t>(place(at_));
    token.end = static_cast<std::uint32_t>(place(end - 1) + 1);
    token.kind = kind;
    token.space_before = space_before_;
    token.begins_line = begins_line_;
    result_.tokens.push_back(token);
    begins_line_ = false;
    at_ = end;
}

// Behind the closing quote, or npos where it is not on this line.
std::size_t Scanner::quoted_end() const {
    const char close = text_[at_] == '<' ? '>' : text_[at_];
    for (std::size_t end = at_ + 1; end < text_.size() && text_[end] != '\n'; ++end)
        if (text_[end] == close) return end + 1;
    return text_.npos;
}

void Scanner::take_token() {
    const char c = text_[at_];
    if (takes_quotes_ && (c == '"' || c == '\'' || c == '<')) {
        if (const std::size_t end = quoted_end(); end != text_.npos)
            return add(end, TokenKind::quoted);
    }
    if (is_digit(c) || (c == '.' && at_ + 1 < text_.size() && is_digit(text_[at_ + 1])))
        return add(number_end(text_, at_), TokenKind::number);
    if (is_word(c)) {
        std::size_t end = at_;
        while (end < text_.size() && is_word(text_[end])) ++end;
        add(end, TokenKind::word);
        const auto& directives = result_.directives;
        if (in_directive_ && result_.tokens.size() == directives.back().tokens.begin + 2)
            takes_quotes_ = !is_own_directive(result_.tokens.back().text);
        return;
    }
    if (const std::size_t length = symbol_length(text_.substr(at_, 3)); length > 0) {
        if (c == '#' && begins_line_) {
            in_directive_ = true;
            const auto first = static_cast<std::uint32_t>(result_.tokens.size());
            result_.directives.push_back({{place(at_), 0}, {first, 0}});
            return add(at_ + 1, TokenKind::symbol);
        }
        return add(at_ + length, TokenKind::symbol);
    }
    std::size_t end = at_ + 1;  // the bytes of one character stay together
    while (end < text_.size() && (text_[end] & '\xC0') == '\x80') ++end;
    add(end, TokenKind::strange);
}

ScannedText Scanner::scan() {
    result_.tokens.reserve(text_.size() / 4);
    while (skip_space()) take_token();
    return std::move(result_);
}

}  // namespace

ScannedText scan(std::string_view text, std::deque<std::string>& spellings) {
    if (text.find("\\\n") == text.npos) return Scanner(text, {}).scan();
    Joined joined = join_lines(text);
    spellings.push_back(std::move(joined.text));
    return Scanner(spellings.back(), std::move(joined.seams)).scan();
}

}  // namespace glint
