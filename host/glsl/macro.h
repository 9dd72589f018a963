// Macros: what is defined where, and what a use becomes.
#pragma once

#include "glsl/token.h"

#include <deque>
#include <functional>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace glint {

// Whether a branch of `#if` is compiled. `maybe`: it hangs on what is not known here, such as which
// pass the text is compiled for, or the driver's extensions.
enum class Live : std::uint8_t { no, maybe, yes };

struct Macro {
    std::string_view name;
    bool takes_arguments = false;
    bool ends_in_space = false;  // or in a comment between stars
    std::vector<std::string_view> parameters;
    std::vector<Token> body;
    Span definition;  // the directive that says so; empty for what the host or the driver defines
};

// One use of a macro in the text itself, not within another use.
struct MacroUse {
    Span span;                // from the name through the closing parenthesis, if it has one
    std::uint32_t macro = 0;  // into the list of macros
    TokenRange tokens;        // what came of it
    bool is_certain = true;   // not where a branch that may be live defines it otherwise
};

// What a text's conditions and macros may count on.
struct Known {
    struct Name {
        std::string name, value;  // `#define name value`
    };
    std::vector<Name> macros;
    // How names begin of which it is not known here whether they are defined: "PASS_".
    std::vector<std::string> open = {"GL_"};
};

// The names that are defined at a place of the text.
class Macros {
public:
    // `spellings` must outlive what is taken from here.
    Macros(const Known& known, std::deque<std::string>& spellings);

    struct Found {
        std::uint32_t macro = kNone;  // kNone: not a macro
        Live is_defined = Live::no;
    };
    Found find(std::string_view name) const;
    // `# define …` and `# undef …`: from the '#'. False where it is not understood.
    bool define(const std::vector<Token>& tokens, TokenRange line, Span span,
                bool ends_in_space = false);
    void undefine(std::string_view name);

    const Macro& at(std::uint32_t macro) const { return list_[macro]; }
    std::vector<Macro> take() { return std::move(list_); }

    // What is defined within a branch that may be live holds for certain until it ends.
    void open_branch();
    void close_branch();

private:
    struct Entry {
        std::uint32_t macro = kNone;
        bool is_defined = false;
        std::uint32_t branch = 0;  // in which that was said; 0: in what is live for certain
    };
    bool is_open(std::uint32_t branch) const;
    Live unknown(std::string_view name) const;

    std::vector<Macro> list_;
    std::unordered_map<std::string_view, Entry> entries_;
    std::vector<std::string> open_names_;
    std::vector<std::uint32_t> branches_;  // that are open, in rising order
    std::uint32_t branch_count_ = 0;
};

// Where an expander takes its tokens from.
class TokenSource {
public:
    virtual ~TokenSource() = default;
    virtual const Token* peek() = 0;  // null at the end
    virtual void take() = 0;
};

// Turns tokens as they are written into those that a compiler sees. Uses may be nested as deep and
// grow as large as any text has them; beyond that names stay as they are, and is_exhausted() says
// so.
class Expander {
public:
    // `uses` and `spellings` are added to. `line_of` a byte is what __LINE__ stands for.
    Expander(const Macros& macros, TokenSource& source, std::vector<MacroUse>& uses,
             std::deque<std::string>& spellings, std::function<int(std::size_t)> line_of);

    bool next(Token& token);
    bool is_exhausted() const { return exhausted_at_ != kNone; }
    std::uint32_t exhausted_at() const { return exhausted_at_; }  // a byte of the text

private:
    struct Context {
        std::vector<Token> tokens;
        std::size_t next = 0;
        std::uint32_t macro = kNone;  // which is not expanded within its own expansion
    };
    struct Use {
        std::uint32_t macro = kNone, use = kNone;
        Token name;
    };
    const Token* peek();
    Token take();
    void push(std::vector<Token> tokens, std::uint32_t macro);
    void leave();
    bool may_grow(std::size_t tokens, std::uint32_t at);
    bool expand(Token& token);
    bool collect(const Token& name, std::vector<std::vector<Token>>& arguments);
    std::pair<std::vector<Token>, int> expanded(std::vector<Token> tokens);
    void leave_spaces(int count);
    std::vector<Token> substituted(const Use& use, std::vector<std::vector<Token>> arguments);
    std::uint32_t use_of(const Token& name, std::uint32_t macro, bool is_certain);
    void number(Token& token, int value);

    const Macros& macros_;
    TokenSource& source_;
    std::vector<MacroUse>& uses_;
    std::deque<std::string>& spellings_;
    std::function<int(std::size_t)> line_of_;
    std::vector<Context> contexts_;
    std::size_t floor_ = 0;              // contexts below belong to what an argument stands in
    std::uint32_t argument_of_ = kNone;  // the use in whose argument this is
    std::vector<bool> active_;
    std::size_t grown_ = 0;
    int depth_ = 0;
    std::uint8_t spaces_left_ = 0;  // before the next token
    std::uint32_t exhausted_at_ = kNone;
};

}  // namespace glint
