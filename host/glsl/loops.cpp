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

}  // namespace

std::string test_loops_at_end(std::string_view text) {
    const Reading reading = read_glsl(text, known_of_driver());
    Edits edits(reading);
    if (reading.is_balanced && reading.not_understood.empty())
        // What stands within others comes first; not by views::reverse, which clang 14 does not
        // take.
        for (std::size_t i = reading.statements.size(); i-- > 0;)
            if (reading.statements[i].kind == StatementKind::for_)
                test_at_end(reading, reading.statements[i], edits);
    return edits.apply().text;
}

}  // namespace glint
