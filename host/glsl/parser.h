// How a text's tokens are taken apart; glsl/syntax.h has what comes of it.
#pragma once

#include "glsl/syntax.h"

#include <string_view>

namespace glint {

// Words that no declaration's type and no call's name can be.
bool is_keyword(std::string_view word);

// Fills in the calls, once functions are known.
void find_calls(const std::vector<Token>& tokens, Syntax& syntax);

class Parser {
public:
    explicit Parser(Preprocessed& text) : text_(text), tokens_(text.tokens) {}

    Syntax parse();

private:
    bool is(std::uint32_t at, std::string_view spelling) const {
        return at < count_ && tokens_[at].text == spelling;
    }
    bool is_name(std::uint32_t at) const {
        return at < count_ && tokens_[at].is_word() && !is_keyword(tokens_[at].text);
    }
    std::uint32_t close_of(std::uint32_t at) const {
        return at < count_ ? out_.close_of(at) : kNone;
    }
    // What an attempt that failed has added is taken back.
    struct Mark {
        std::size_t declarations, structs, statements, complaints;
    };
    Mark mark() const {
        return {out_.declarations.size(), out_.structs.size(), out_.statements.size(),
                text_.not_understood.size()};
    }
    void return_to(const Mark& mark) {
        out_.declarations.resize(mark.declarations);
        out_.structs.resize(mark.structs);
        out_.statements.resize(mark.statements);
        text_.not_understood.resize(mark.complaints);
    }

    void complain(TokenRange range, const char* why);
    Span cover(TokenRange range) const;

    void match_brackets();
    std::uint32_t skip_to(std::uint32_t from, std::uint32_t stop, std::string_view ends) const;
    bool skip_array(TokenRange& array);

    void parse_item();
    void pass_over();
    bool parse_function(std::uint32_t begin, const Declaration& head, std::uint32_t name);
    void parse_parameters(std::uint32_t function);
    void parse_qualifiers(Declaration& declaration);
    bool parse_type(std::uint32_t index, std::uint32_t stop);
    bool parse_struct(std::uint32_t index, std::uint32_t name);
    bool parse_names(std::uint32_t index, std::uint32_t stop);
    std::uint32_t add_declaration(Scope scope, std::uint32_t owner);
    std::uint32_t parse_declaration(Scope scope, std::uint32_t owner, std::uint32_t stop);
    bool begins_declaration(std::uint32_t at) const;

    std::uint32_t add_statement(StatementKind kind, std::uint32_t parent);
    void parse_statement(std::uint32_t parent, std::uint32_t stop, int depth);
    void parse_block(std::uint32_t index, int depth);
    void parse_simple(std::uint32_t index, std::uint32_t stop);
    bool parse_compound(std::uint32_t index, std::uint32_t stop, int depth);
    bool parse_head(std::uint32_t index);
    bool parse_do_tail(std::uint32_t index, std::uint32_t stop);
    void give_up(const Mark& before, std::uint32_t index, std::uint32_t stop, const char* why);

    Preprocessed& text_;
    const std::vector<Token>& tokens_;
    Syntax out_;
    std::uint32_t at_ = 0, count_ = 0;
    std::uint32_t function_ = kNone;  // that is being read
};

}  // namespace glint
