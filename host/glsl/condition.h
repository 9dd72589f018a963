// `#if` and what belongs to it: which branches are compiled, and what constants come to.
#pragma once

#include "glsl/macro.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace glint {

// What the tokens of an `#if` come to, those of [first, line.end): `maybe` also where they are not
// understood. Computes in 64 bits, as deep as brackets are nested in any text.
Live condition_holds(const Macros& macros, const std::vector<Token>& tokens, TokenRange line,
                     std::uint32_t first);

// What a constant expression of whole numbers comes to, where it is understood; `value_of` says
// what a name stands for.
std::optional<std::int64_t> whole_number(
    const std::vector<Token>& tokens,
    const std::function<std::optional<std::int64_t>(std::string_view)>& value_of);

// Follows the conditions of a text, line by line.
class Conditions {
public:
    // Takes a directive, from its '#'. False where it is none of #if, #else and so on, or stands
    // where it cannot: an #else without #if.
    bool take(Macros& macros, const std::vector<Token>& tokens, TokenRange line);

    // Whether what follows is compiled.
    Live live() const { return groups_.empty() ? Live::yes : groups_.back().live; }
    bool is_within() const { return !groups_.empty(); }
    // The branches around, of which nobody knows whether they are compiled, from the outermost on:
    // each has a number of its own.
    std::vector<std::uint32_t> open_branches() const;

private:
    struct Group {
        Live outer = Live::yes, live = Live::yes;
        Live done = Live::no;  // whether a branch before was compiled
        bool has_else = false;
        std::uint32_t branch = 0;  // of a live one that may be compiled
    };
    void enter(Macros& macros, Live condition);
    void leave(Macros& macros);

    std::vector<Group> groups_;
    std::uint32_t branches_ = 0;
};

}  // namespace glint
