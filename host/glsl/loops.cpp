#include "glsl/loops.h"

#include "glsl/edits.h"

#include <algorithm>
#include <optional>

namespace glint {
namespace {

// Words that can be written once more at another place of the same line.
std::optional<std::string> copy_of(const Reading& reading, TokenRange range) {
    if (range.empty()) return "";
    if (!reading.stands_alone(range)) return {};
    const Span span = reading.place(range);
    const std::string_view words = reading.text.substr(span.begin, span.end - span.begin);
    if (words.find('\n') == words.npos) return std::string(words);
    if (!reading.is_plain(range)) return {};
    return reading.spelled(range);
}

// A test that declares a variable has no second place, and one that calls a function would have the
// driver make a copy of that.
bool may_stand_twice(const Reading& reading, TokenRange test) {
    if (test.empty()) return false;
    for (std::uint32_t at = test.begin; at < test.end; ++at) {
        if (reading.tokens[at].is("=")) return false;
        if (at + 1 < test.end && reading.tokens[at + 1].is("(") &&
            !reading.functions_named(reading.word(at)).empty())
            return false;
    }
    return true;
}

void test_at_end(const Reading& reading, const Statement& loop, Edits& edits) {
    const std::uint32_t first = loop.condition.begin - 1, last = loop.tokens.end - 1;
    for (const std::uint32_t token :
         {loop.tokens.begin, loop.head.begin - 1, first, loop.condition.end, loop.head.end, last})
        if (reading.tokens[token].use != kNone) return;
    const auto test = copy_of(reading, loop.condition), step = copy_of(reading, loop.step);
    if (!test || !step || !may_stand_twice(reading, loop.condition)) return;
    edits.replace({loop.tokens.begin, loop.head.begin}, "{");
    edits.after(first, " bool glint_go = (");
    edits.replace({loop.condition.end, loop.head.end + 1}, "); do { if (glint_go) {");
    const std::string again = step->empty() ? *test : "(" + *step + "), (" + *test + ")";
    edits.after(last, " } } while (glint_go && (" + again + ")); }");
}

bool is_loop(const Statement& one) {
    return one.kind == StatementKind::for_ || one.kind == StatementKind::while_ ||
           one.kind == StatementKind::do_;
}

// Out of a loop around it.
bool leads_out(const Reading& reading, std::uint32_t loop, const Statement& one) {
    if (one.kind != StatementKind::break_)
        return one.kind == StatementKind::return_ || one.kind == StatementKind::discard;
    std::uint32_t from = one.parent;
    while (from != loop && !is_loop(reading.statements[from]) &&
           reading.statements[from].kind != StatementKind::switch_)
        from = reading.statements[from].parent;
    return from == loop;
}

bool is_endless(const Reading& reading, std::uint32_t loop) {
    const Statement& one = reading.statements[loop];
    const bool is_true =
        one.condition.size() == 1 && reading.tokens[one.condition.begin].is("true");
    if (!is_true && !(one.kind == StatementKind::for_ && one.condition.empty())) return false;
    for (std::uint32_t i = loop + 1; i < std::min<std::size_t>(one.next, reading.statements.size());
         ++i)
        if (leads_out(reading, loop, reading.statements[i])) return false;
    return true;
}

// By a uniform that is never so low.
void give_test(const Statement& loop, Edits& edits) {
    constexpr const char* kAlways = "iSampleRate > -1.0";
    if (loop.condition.empty())
        edits.before(loop.condition.begin, kAlways);
    else
        edits.replace(loop.condition, kAlways);
}

}  // namespace

std::string test_loops_at_end(std::string_view text) {
    const Reading reading = read_glsl(text, known_of_driver());
    Edits edits(reading);
    const bool has_uniform = text.find("uniform float iSampleRate;") != text.npos;
    if (!reading.is_balanced || !reading.not_understood.empty()) return std::string(text);
    for (const char* word : {"bool", "do", "if", "while"})
        if (reading.defines_macro(word)) return std::string(text);
    // What stands within others comes first; not by views::reverse, which clang 14 does not take.
    for (std::size_t i = reading.statements.size(); i-- > 0;) {
        const Statement& one = reading.statements[i];
        if (has_uniform && is_loop(one) && is_endless(reading, static_cast<std::uint32_t>(i)))
            give_test(one, edits);
        else if (one.kind == StatementKind::for_)
            test_at_end(reading, one, edits);
    }
    return edits.apply().text;
}

}  // namespace glint
