// The tokens round one that a driver complains of.
#pragma once

#include "glsl/token.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace glint {

std::span<const std::string_view> types_of_glsl();
bool is_type_of_glsl(std::string_view word);       // such as vec3
bool is_qualifier_of_glsl(std::string_view word);  // such as const
// Whether a declaration may begin behind this token; "" is the text's start.
bool may_declare_behind(std::string_view token);
// Whether a name may stand behind it that it declares.
bool may_be_type(const Token& token);

// Of which `at` is the number of the one in the middle, the count of all for the text's end; `away`
// counts from it.
class Around {
public:
    Around(std::span<const Token> tokens, std::size_t at);

    bool is(std::ptrdiff_t away, std::string_view text) const { return word(away) == text; }
    std::string_view word(std::ptrdiff_t away) const {
        const std::size_t i = index(away);
        return i < tokens_.size() ? tokens_[i].text : "";
    }
    std::size_t index(std::ptrdiff_t away) const {
        return at_ + static_cast<std::size_t>(away);  // before the first: beyond the last
    }
    bool is_known_type(std::ptrdiff_t away) const;  // of GLSL, or a struct
    bool is_reserved(std::ptrdiff_t away) const;
    bool is_name(std::ptrdiff_t away) const;
    // Whether a declaration may begin there.
    bool begins(std::ptrdiff_t away) const { return may_declare_behind(word(away - 1)); }
    // The innermost bracket that is open there.
    std::optional<std::size_t> open() const {
        return open_.empty() ? std::nullopt : std::optional(open_.back());
    }
    // Whether such a one is open there, further out or not, within the same braces.
    bool is_within(std::string_view bracket) const;
    // Whether an expression stands there that brackets may hold, and no statement begins.
    bool goes_on_in_brackets() const;
    bool is_in_brackets() const { return !open_.empty() && !tokens_[open_.back()].is("{"); }
    bool is_in_function() const { return !open_.empty() && tokens_[open_.front()].is("{"); }
    // Right within a struct's braces.
    bool is_in_struct() const;
    // Whether something stands before it, on another line.
    bool is_on_a_later_line() const {
        return index(-1) < tokens_.size() && (at_ >= tokens_.size() || tokens_[at_].begins_line);
    }
    // The '(' of the ')' before the token, and the '{' of the '}'.
    std::optional<std::size_t> opened_before() const { return partner_before("(", ")"); }
    std::optional<std::size_t> block_before() const { return partner_before("{", "}"); }
    // Where a function's head begins that ends before the token, with its type.
    std::optional<std::size_t> head() const;

private:
    std::optional<std::size_t> partner_before(std::string_view open, std::string_view close) const;
    void follow_brackets(std::size_t i);

    std::span<const Token> tokens_;
    std::size_t at_;
    std::vector<std::size_t> open_;
};

}  // namespace glint
