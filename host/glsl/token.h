// GLSL as tokens, each with its bytes of the text; and the lines that begin with '#'.
#pragma once

#include "glsl/raw_text.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

// A number for what is not there, where lists are indexed.
inline constexpr std::uint32_t kNone = 0xFFFFFFFFu;

// Tokens [begin, end) of a list.
struct TokenRange {
    std::uint32_t begin = 0, end = 0;
    bool empty() const { return begin == end; }
    std::uint32_t size() const { return end - begin; }
    bool operator==(const TokenRange&) const = default;
};

enum class TokenKind : std::uint8_t {
    word,    // a name or keyword
    number,  // `1`, `.5e-3`, `0x1Fu`
    symbol,  // an operator or bracket of GLSL: `+=`, `(`, `#`
    quoted,  // "a file", 'a file' or <a file>, in directives that are not GLSL's own alone
    strange  // bytes that no GLSL has
};

inline bool is_one_of(std::string_view word, std::span<const std::string_view> words) {
    return std::ranges::find(words, word) != words.end();
}

struct Token {
    std::string_view text;             // its spelling, without backslashes that join lines
    std::uint32_t begin = 0, end = 0;  // bytes of the text where this spelling stands
    std::uint32_t use = kNone;         // of a macro, whose expansion it came from (MacroUse)
    TokenKind kind = TokenKind::strange;
    bool space_before : 1 = false;  // white space or a comment
    bool begins_line : 1 = false;   // of joined lines the first
    bool is_final : 1 = false;      // a macro's name that is not to be expanded any more
    // Spaces more that Mesa's preprocessor leaves before it: of macros that end in one, or hold
    // nothing.
    std::uint8_t spaces_left = 0;

    Span span() const { return {begin, end}; }
    bool is(std::string_view spelling) const { return text == spelling; }
    bool is_word() const { return kind == TokenKind::word; }
};

struct Comment {
    Span span;  // without the line's end
    bool is_line = false;
};

// A line that begins with '#', with those that backslashes join to it.
struct DirectiveLine {
    Span span;          // from the '#' to the line's end
    TokenRange tokens;  // from the '#'
};

struct ScannedText {
    std::vector<Token> tokens;  // those of directives too
    std::vector<DirectiveLine> directives;
    std::vector<Comment> comments;
    std::optional<std::size_t> unclosed;  // where a block comment begins that never ends
};

// Any bytes will do, up to 4 GiB. Tokens view into `text`, which must outlive them, and, where
// backslashes join lines, into `spellings`, to which a copy is added.
ScannedText scan(std::string_view text, std::deque<std::string>& spellings);

}  // namespace glint
