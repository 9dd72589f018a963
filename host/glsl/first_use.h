// Which variables a text may read before it has given them a value as a whole.
//
// Goes over statements as they would run (definite assignment, as in the Java Language
// Specification, chapter 16), and is careful: what it does not see through counts as read. A value
// is given by `x = …` outside of conditions, or by a call that hands x to an `out` parameter; an
// array has values where it is a stack (glsl/stack.h). In a
// text so large that this would take seconds, the rest counts as read.
#pragma once

#include "glsl/reading.h"

#include <span>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace glint {

class FirstUses {
public:
    // `reading` must outlive this.
    explicit FirstUses(const Reading& reading);

    // Of a local without a first value.
    bool local_is_read(const Declaration& declaration, const Declarator& one);
    // Of an `out` parameter: the end of its function reads it, too.
    bool out_is_read(std::uint32_t function, std::string_view name);
    // Whether the name stands anywhere but where it is declared.
    bool is_mentioned_again(std::string_view name);
    // Whether the end of a function's body can be reached, though some `return` stands in it.
    bool lacks_return(const Function& function) const;

private:
    // What has become of the variable behind something: it has no value yet; it has one, or nothing
    // comes here; it may have been read without.
    enum class Flow : std::uint8_t { open, given, read };
    using Places = std::vector<std::uint32_t>;  // tokens, rising

    const Places& mentions_of(std::string_view name);  // as a variable, not as a member
    bool any(const Places& places, TokenRange range) const;
    std::uint32_t next_mention(TokenRange range) const;  // kNone for none
    bool is_event(TokenRange range) const;
    bool is_conditional(TokenRange range) const;
    bool is_given_by_call(std::uint32_t mention, TokenRange range) const;
    std::uint32_t close_before(std::uint32_t from, std::uint32_t end) const;

    Flow over_expression(TokenRange range) const;
    Flow over_statement(std::uint32_t statement) const;
    Flow over_statements(std::uint32_t first, std::uint32_t end) const;
    Flow over_if(const Statement& statement, std::uint32_t index) const;
    Flow over_for(const Statement& statement, std::uint32_t index) const;
    Flow over_do(const Statement& statement, std::uint32_t index) const;
    Flow over_switch(const Statement& statement, std::uint32_t index) const;

    bool ends(std::uint32_t statement) const;
    bool ends_loop(std::uint32_t statement) const;

    const Reading& reading_;
    std::unordered_map<std::string_view, Places> mentions_of_, locals_;
    std::unordered_map<std::string_view, std::vector<std::uint32_t>> functions_;
    std::unordered_map<std::uint32_t, std::uint32_t> call_at_;  // by its opening parenthesis
    Places jumps_, leaps_;  // return, break, continue; of these the last two
    Places conditions_;     // `?`, `&&`, `||`
    bool has_maybe_ = false;
    // Of the question that is being answered.
    const Places* mentions_ = nullptr;
    bool is_out_ = false;
    // Statements looked at, in all questions.
    mutable std::size_t steps_ = 0;
};

}  // namespace glint
