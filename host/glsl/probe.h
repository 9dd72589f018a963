// A text that tells what happens in it: values, turns of loops, the first fault.
//
// Each place of interest, a site, has a number. An expression is handed through a function that
// notes it and gives it back, `glint0_v(7, h = map(p))`, so that nothing is evaluated that was not,
// nor in another order, and GLSL's own overloading finds the types. What a fragment keeps of the
// many values that come by is told by uniforms (probe_declarations); so one program, drawn once,
// answers for as many sites, hits or pixels as are asked.
#pragma once

#include "glsl/edits.h"
#include "glsl/remainder.h"
#include "glsl/zeros.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

enum class ProbeKind : std::uint8_t {
    values,      // what variables are given, what functions get and give back, what conditions say
    cost,        // turns of loops, reads of textures, calls
    faults,      // what is outside of an operation's domain, or born not finite
    assertions,  // which expressions do not hold, of at most kMostAssertions
    rounding,    // what results that are rounded the other way come to
};

enum class SiteKind : std::uint8_t {
    assigned,    // `a += b`, `i++`, `float a = b`, and what a call hands to an `out` parameter
    parameter,   // on entry
    returned,    // of a `return`
    condition,   // of an if, a loop, a switch
    reached,     // a statement without any of these
    expression,  // that a person asked for
    assertion,   // the same, of `//@ assert`
    turn,        // of a loop
    read,        // of a texture
    call,        // of a function
    sum,         // what is added or subtracted
    operand,     // of clamp, max, …: what comes of it hides what it is
    division,
    remainder,  // of whole numbers
    domain,     // of sqrt, log, …
    bounds,     // of clamp and smoothstep
    whole,      // a float that becomes a whole number, or by how many bits one is shifted
    index,
    unset,  // what is read and has no value
};

struct ProbeSite {
    SiteKind kind = SiteKind::assigned;
    std::string name;      // as it is spelled: `p.xz`, `map`, `a > b`
    std::string function;  // in which it stands
    std::size_t at = 0;    // byte of the text
};

// An expression to be evaluated at a line.
struct ProbeExpression {
    std::string text;
    Span line;  // bytes of the text: of the line, or of what the expression stands before
    bool is_assertion = false;
    // Of the text's own: a pass may not reach it; then there is no such site, and no complaint.
    bool is_note = false;
};

struct ProbeWish {
    ProbeKind kind = ProbeKind::values;
    // Sites that begin in these bytes alone; empty: all.
    std::vector<Span> only{};
    // Nothing but these, where there are any.
    std::vector<ProbeExpression> expressions{};
    // Bytes at which the driver did not take a site.
    std::vector<std::size_t> without{};
};

// What a struct's value is recorded as: `.nor`, `.p[2]`.
using ProbeLeaves = std::vector<std::string>;

struct Probed {
    std::vector<ProbeSite> sites;       // by number
    std::vector<ProbeLeaves> structs;   // by number; none: cannot be recorded
    std::vector<std::size_t> left_out;  // bytes of sites that could not be written
    std::vector<std::string> refused;   // of the expressions: why; "" for those that are there
};

// Of the functions alone that the entry reaches. The remainders are mended with it, since their
// words stand among these. `marked`: what is unset and has a mark, whose reads are sites of faults.
Probed instrument(const Reading& reading, const ProbeWish& wish, std::string_view entry,
                  Edits& edits, const std::vector<Remainder>& remainders = {},
                  const std::vector<Unset>& marked = {});

// Why this is no expression that may be evaluated beside a text; "" where it is one.
std::string refusal_of_expression(std::string_view text);

inline constexpr std::size_t kMostAssertions = 128;  // of one program

// Bits of what is recorded: by probe_type() of a told tag. Matrices, structs, arrays are told in
// leaves, each a site of its own: number + (leaf << kProbeLeafShift).
inline constexpr int kProbeLeafShift = 16, kProbeContainerShift = 5, kProbeReached = 31,
                     kProbeFirstStruct = 10;
// By the tag's lowest bits: "float", "vec2" … "bvec4".
const char* probe_type(std::uint32_t tag);
// Of a matrix, struct or array: what its leaves are called; one empty name otherwise.
ProbeLeaves leaves_of(std::uint32_t tag, const Probed& probed);

// What stands before the text: the functions that its sites call. The host's own main() is called
// `glint0_draw`, and probe_main() behind it calls that. Two more outputs follow those of the pass:
//
//     values  glint0_kept: the bits of the value; glint0_told: hits, order among all, tag, 1
//     cost    glint0_kept: turns, reads, calls, 0; glint0_told: hits of the wanted site, 0, 0, 1
//     faults  glint0_kept: up to two operands of the first, how far the watched site has kept off
//             what is undefined (a float), an operand of the worst; glint0_told: faults, site of
//             the first + 1, of the first that is undefined + 1, 1
//     assertions  glint0_kept: a bit for each that did not hold; glint0_told: 0, 0, 0, 1
//
// `uniform ivec4 glint0_ask`: the site and hit that the first cell wants, and what each further
// cell adds to both; of more hits than there are, the last. `uniform ivec4 glint0_place`: cells,
// each of 2x2 fragments, that evaluate the quad at .xy, .z of them in a row; .z = 0: each fragment
// is its own pixel. `glint0_coord` stands for gl_FragCoord. Of faults, `glint0_place.w` is the
// number of sites, of which each fragment watches another, and `glint0_ask.y` whether what is
// undefined gets a result all the same.
std::string probe_declarations(ProbeKind kind);
std::string probe_main(ProbeKind kind, std::size_t outputs);

}  // namespace glint
