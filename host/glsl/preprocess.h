// A text's preprocessor: the tokens that a compiler sees, and where each of them stands.
//
// The text itself is not changed. A token of it keeps its bytes; one that came from a macro has the
// bytes where it is spelled (in the definition, or in an argument of the use) and the number of the
// use, which has bytes of its own.
#pragma once

#include "glsl/condition.h"
#include "glsl/macro.h"
#include "glsl/token.h"

#include <deque>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace glint {

// A line that begins with '#'.
struct Directive {
    Span span;               // from the '#' to the line's end
    std::string_view word;   // "if", "define", "iChannel0", …; empty for a lone '#'
    TokenRange rest;         // what follows the word, in `written`
    Live live = Live::yes;   // whether the line counts
    Live after = Live::yes;  // whether what follows it does
};

// What stands between `#if`, `#elif` or `#else` and the directive that ends it.
struct Branch {
    std::uint32_t begins = 0, ends = 0;  // into directives
    std::uint32_t group = 0;             // the same for all branches of one #if … #endif
    Live live = Live::yes;
};

// What the reader passes over untouched.
struct NotUnderstood {
    Span span;
    std::string why;
};

struct Preprocessed {
    Preprocessed() = default;
    Preprocessed(Preprocessed&&) = default;
    Preprocessed& operator=(Preprocessed&&) = default;

    std::string_view text;
    std::vector<Token> tokens;   // what a compiler sees: of live branches, macros expanded
    std::vector<Token> written;  // what stands in the text, dead branches and directives too
    std::vector<Macro> macros;   // every definition that counts, in order
    std::vector<MacroUse> uses;  // in order
    std::vector<Directive> directives;
    std::vector<Branch> branches;  // in the order of their ends
    std::vector<Comment> comments;
    std::optional<std::size_t> unclosed_comment;
    std::optional<std::size_t> open_condition;  // the first #if that has no end
    std::vector<NotUnderstood> not_understood;
    std::deque<std::string> spellings;
    std::unordered_set<std::string_view> live_words;  // outside of comments and of dead branches

    // Whether a byte's place is compiled.
    Live live_at(std::size_t offset) const;
    // The text between an #if or #else and what ends it.
    Span inside(const Branch& branch) const;
    // Whether a word stands in the text, outside of comments and of dead branches.
    bool mentions(std::string_view word) const { return live_words.contains(word); }
};

// `text` must outlive the result, which views into it. Any bytes will do.
Preprocessed preprocess(std::string_view text, const Known& known);

// What GLSL ES 3.00 itself defines.
Known known_of_driver();

}  // namespace glint
