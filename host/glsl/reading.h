// A GLSL text, read once: its tokens, what it declares and does, and questions about both.
//
//     const Reading reading = read_glsl(text, known);
//     for (const Function& function : reading.functions) … reading.word(function.name) …
//
// Read for one pass, with its PASS_x among `known.macros`, or for all at once, with "PASS_" among
// `known.open`: then branches that hang on it may be live, and both sides of an #else are read.
// Whoever changes a text does so through glsl/edits.h, which knows what stands within macros. What
// the reader does not understand stands in `not_understood`, and no list has anything of it.
#pragma once

#include "glsl/syntax.h"

#include <initializer_list>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace glint {

struct Reading : Preprocessed, Syntax {
    std::string_view word(std::uint32_t token) const {
        return token == kNone ? std::string_view() : tokens[token].text;
    }
    // The bytes that a token stands for: of what came from a macro, those of its use.
    Span place(std::uint32_t token) const {
        const Token& one = tokens[token];
        return one.use == kNone ? one.span() : uses[one.use].span;
    }
    Span place(TokenRange range) const {
        if (range.empty()) return {};
        return {place(range.begin).begin, place(range.end - 1).end};
    }
    // Whether all of it stands in the text itself.
    bool is_plain(TokenRange range) const;
    // Whether no macro's use reaches beyond its ends, so that place() is its own.
    bool stands_alone(TokenRange range) const;
    // As it is spelled, tokens and one space between them.
    std::string spelled(TokenRange range) const;

    // The tokens that are one of these words or signs, rising. All tokens are looked at for the
    // first question; those that follow are cheap. Not for two threads at once.
    std::vector<std::uint32_t> places_of(std::initializer_list<std::string_view> words) const;
    // The functions of this name, prototypes too, in the order of the text.
    std::vector<std::uint32_t> functions_named(std::string_view name) const;
    // Whether it has this name and nobody but the host calls it.
    bool is_for_the_host(const Function& function, std::string_view entry) const;
    // Whether the text itself has a macro of this name, at any place.
    bool defines_macro(std::string_view name) const;
    // The declaration of a global of this name.
    const Declaration* find_global(std::string_view name) const;
    // By function: whether these names, and what they call, lead to it. Calls go to all overloads
    // that take as many arguments; those in the values of globals count, unless they are not to.
    std::vector<bool> reached_from(const std::vector<std::string_view>& names,
                                   bool with_globals = true) const;
    // The arguments of a call.
    std::vector<TokenRange> arguments_of(const Call& call) const;

private:
    mutable std::unordered_map<std::string_view, std::vector<std::uint32_t>> places_;
};

// `text` must outlive the result. Any bytes will do; nothing that a text holds makes it throw, fill
// the memory or the stack.
Reading read_glsl(std::string_view text, const Known& known);

}  // namespace glint
