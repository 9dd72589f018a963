// What a text declares and does: declarations, functions, the statements in them, calls.
//
// Everything is told in numbers of tokens, those that a compiler sees; whoever changes the text
// asks where these stand (glsl/edits.h). Expressions are not taken apart.
#pragma once

#include "glsl/preprocess.h"

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace glint {

// One name of a declaration: `b[3] = f(1)` of `float a, b[3] = f(1);`.
struct Declarator {
    std::uint32_t name = kNone;  // token
    TokenRange array;            // with its brackets: `[3][2]`; empty for none
    TokenRange initial;          // what stands behind the `=`; empty for none
    TokenRange tokens;           // from the name up to the comma or what ends the declaration
};

enum class Scope : std::uint8_t { global, local, member, parameter };

// `const highp float a = 1.0, b[3];`, also a parameter, a member of a struct or block, and what a
// `for`, an `if` or a `while` declares in its head.
struct Declaration {
    TokenRange tokens;                // with the semicolon, where it ends with one
    TokenRange qualifiers;            // `layout(location = 0) const highp`
    std::uint32_t type = kNone;       // token; of `struct S { … } s;` the S
    TokenRange type_array;            // `float[3] a`
    std::uint32_t structure = kNone;  // into structs, where it defines that; also of blocks
    std::vector<Declarator> names;
    Scope scope = Scope::global;
    // Into functions of a local, a parameter; into structs of a member; kNone of a global.
    std::uint32_t owner = kNone;
    std::uint32_t statement = kNone;  // into statements, of a local

    bool is_const = false, is_uniform = false, is_in = false, is_out = false;
    bool is_block = false;  // `uniform Name { … } name;`
};

// `struct S { … }`, or an interface block.
struct Struct {
    std::uint32_t name = kNone;          // token; kNone where it has none
    TokenRange tokens;                   // through the closing brace
    TokenRange body;                     // with its braces
    std::vector<std::uint32_t> members;  // into declarations
    std::uint32_t function = kNone;      // in whose body it stands
};

enum class StatementKind : std::uint8_t {
    block,
    declaration,
    expression,
    if_,
    for_,
    while_,
    do_,
    switch_,
    case_,  // `case 1:` or `default:`, up to the colon
    return_,
    break_,
    continue_,
    discard,
    empty,
    unknown
};
constexpr bool is_loop(StatementKind kind) {
    return kind == StatementKind::for_ || kind == StatementKind::while_ ||
           kind == StatementKind::do_;
}

// In the order of the text: what a statement holds follows it, up to `next`.
struct Statement {
    StatementKind kind = StatementKind::unknown;
    TokenRange tokens;               // with its semicolon or closing brace
    std::uint32_t parent = kNone;    // into statements; kNone of a function's body
    std::uint32_t function = kNone;  // into functions
    std::uint32_t next = kNone;      // the first statement that does not stand within this one
    TokenRange head;       // of an if, for, while, do, switch: what stands in its parentheses; the
                           // value of a return; the label of a case
    TokenRange condition;  // of a for, while, do: what keeps it going; empty for none
    TokenRange step;       // of a for
    std::uint32_t declaration = kNone;  // its own, or that of its head; into declarations
    bool has_else = false;              // of an if, which then holds two statements
};

struct Call {
    std::uint32_t name = kNone;  // token, of a function or of a type
    TokenRange brackets;         // with its parentheses
    std::uint32_t arity = 0;
    std::uint32_t function = kNone;  // from which it is called; kNone: from a global's value
};

struct Function {
    std::uint32_t name = kNone;  // token
    std::uint32_t type = kNone;  // token, of what it returns
    TokenRange type_array;
    TokenRange tokens;  // from its type through the closing brace, or the semicolon
    TokenRange parentheses;
    TokenRange body;                        // with its braces; empty for a prototype
    std::vector<std::uint32_t> parameters;  // into declarations, those without a name too
    std::uint32_t first_statement = kNone;  // its body's block, into statements
    bool is_defined() const { return !body.empty(); }
};

// Something that stands outside of all functions. In the order of the text, side by side.
struct Item {
    enum class Kind : std::uint8_t { function, declaration, other, unknown };
    Kind kind = Kind::unknown;
    TokenRange tokens;
    std::uint32_t index = kNone;  // into functions or declarations
};

struct Syntax {
    std::vector<Item> items;
    std::vector<Declaration> declarations;  // all, wherever they stand, in the order of the text
    std::vector<Struct> structs;
    std::vector<Function> functions;  // prototypes too
    std::vector<Statement> statements;
    std::vector<Call> calls;
    std::vector<std::uint32_t> partner;  // of each bracket; kNone of other tokens, or where lost
    bool is_balanced = true;             // every bracket has its partner

    // The token that closes a bracket; kNone where nothing does, or it is none.
    std::uint32_t close_of(std::uint32_t at) const {
        return partner[at] != kNone && partner[at] > at ? partner[at] : kNone;
    }
};

// Adds to what is not understood.
Syntax parse(Preprocessed& text);

}  // namespace glint
