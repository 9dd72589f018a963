#include "glsl/lean.h"

#include <algorithm>
#include <deque>

namespace glint {
namespace {

// Whether the directives within these bytes open and close conditions of their own, and do nothing
// else.
bool stands_for_itself(const Reading& reading, Span span) {
    int depth = 0;
    auto directive = std::ranges::lower_bound(reading.directives, span.begin, {},
                                              [](const Directive& d) { return d.span.begin; });
    for (; directive != reading.directives.end() && directive->span.begin < span.end; ++directive) {
        const std::string_view word = directive->word;
        if (word == "if" || word == "ifdef" || word == "ifndef")
            ++depth;
        else if (word == "endif")
            --depth;
        else if (word != "else" && word != "elif")
            return false;
        if (depth < 0 || (depth == 0 && word != "endif")) return false;
    }
    return depth == 0;
}

}  // namespace

bool can_be_lean(const Reading& reading) {
    return reading.is_balanced && reading.not_understood.empty() && !reading.unclosed_comment &&
           !reading.mentions("__LINE__");
}

void leave_out_functions(const Reading& reading, const std::vector<bool>& reached, Edits& edits) {
    for (std::uint32_t i = 0; i < reading.functions.size(); ++i) {
        const TokenRange tokens = reading.functions[i].tokens;
        if (reached[i] || !reading.stands_alone(tokens)) continue;
        const Span span = reading.place(tokens);
        if (stands_for_itself(reading, span)) edits.replace_bytes(span, "");
    }
}

std::string without_comments(std::string_view text) {
    std::deque<std::string> spellings;
    const ScannedText scanned = scan(text, spellings);
    std::string result;
    auto directive = scanned.directives.begin();
    for (std::uint32_t at = 0; at < scanned.tokens.size(); ++at) {
        const Token& token = scanned.tokens[at];
        if (!result.empty() && token.begins_line)
            result += '\n';
        else if (!result.empty() && token.space_before)
            result += ' ';
        if (directive != scanned.directives.end() && directive->tokens.begin == at) {
            const Span span = directive->span;
            result += text.substr(span.begin, span.end - span.begin);
            at = directive->tokens.end - 1;
            ++directive;
        } else {
            result += token.text;
        }
    }
    return result += '\n';
}

}  // namespace glint
