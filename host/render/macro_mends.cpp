#include "render/macro_mends.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <unordered_set>

namespace glint {
namespace {

// Not one that the host or the driver defines.
bool is_of_the_text(const Macro& macro) {
    return macro.definition.begin != macro.definition.end;
}

bool names(const Macro& macro, std::string_view name) {
    return std::ranges::any_of(macro.body, [&](const Token& token) { return token.is(name); });
}

// By number: those that the text uses, or that one of these names, and so on.
std::vector<bool> used_macros(const Reading& reading) {
    std::vector<bool> used(reading.macros.size());
    std::vector<std::size_t> next;
    const auto use = [&](std::size_t index) {
        if (!used[index]) next.push_back(index);
        used[index] = true;
    };
    for (const auto& one : reading.uses) use(one.macro);
    while (!next.empty()) {
        const Macro& macro = reading.macros[next.back()];
        next.pop_back();
        for (std::size_t i = 0; i < reading.macros.size(); ++i)
            if (!used[i] && names(macro, reading.macros[i].name)) use(i);
    }
    return used;
}

// GLSL has no `#a` and no `a##b`. Mesa refuses a macro that has them where it is defined, the site
// where it is used; so that nothing is left of the body of one that nobody uses.
void empty_idle_macros(const Reading& reading, Edits& edits) {
    std::vector<bool> used;
    for (std::uint32_t i = 0; i < reading.macros.size(); ++i) {
        const Macro& macro = reading.macros[i];
        if (!is_of_the_text(macro) || macro.body.empty() ||
            (!names(macro, "#") && !names(macro, "##")))
            continue;
        if (used.empty()) used = used_macros(reading);
        if (used[i]) continue;
        const Span body{macro.body.front().begin, macro.definition.end};
        const auto lines =
            std::ranges::count(reading.text.substr(body.begin, body.end - body.begin), '\n');
        edits.replace_bytes(body, std::string(static_cast<std::size_t>(lines), '\n'));
    }
}

bool is_sign(const Token& token) {
    return token.is("-") || token.is("+");
}

// Mesa prints what comes of a macro and reads it once more: `-x` of an argument that begins with a
// sign would be a decrement.
void part_signs_in_bodies(const Reading& reading, Edits& edits) {
    for (const Macro& macro : reading.macros) {
        if (!is_of_the_text(macro)) continue;
        for (std::size_t i = 1; i < macro.body.size(); ++i) {
            const Token &sign = macro.body[i - 1], &next = macro.body[i];
            if (is_sign(sign) && next.is_word() && !next.space_before)
                edits.replace_bytes({sign.end, sign.end}, " ");
        }
    }
}

// Whether the two, printed side by side, would be read as one operator.
bool make_an_operator(const Token& a, const Token& b) {
    constexpr std::string_view kOperators = "+-<>&|^=!*/%";
    if (a.kind != TokenKind::symbol || b.kind != TokenKind::symbol) return false;
    const char last = a.text.back(), first = b.text.front();
    return kOperators.find(last) != kOperators.npos &&
           (first == '=' || (first == last && last != '*'));
}

// The same where an operator ends or begins what comes of a use.
void part_operators_at_uses(const Reading& reading, Edits& edits) {
    for (const MacroUse& use : reading.uses) {
        if (use.tokens.empty()) continue;
        const std::uint32_t begin = use.tokens.begin, end = use.tokens.end;
        if (end < reading.tokens.size() &&
            make_an_operator(reading.tokens[end - 1], reading.tokens[end])) {
            edits.write_out(use);
            edits.after(end - 1, " ");
        }
        if (begin > 0 && make_an_operator(reading.tokens[begin - 1], reading.tokens[begin]))
            edits.before(begin, " ");
    }
}

bool has_a_line_end(const Reading& reading, Span span) {
    return std::ranges::count(reading.text.substr(span.begin, span.end - span.begin), '\n') > 0;
}

// Mesa takes the arguments of a name that only becomes a macro with arguments from its own line
// alone, and directives among arguments from nowhere.
void write_out_broken_calls(const Reading& reading, Edits& edits) {
    for (const MacroUse& use : reading.uses) {
        if (!has_a_line_end(reading, use.span)) continue;
        const bool has_directive =
            std::ranges::any_of(reading.directives, [&](const Directive& line) {
                return line.span.begin >= use.span.begin && line.span.end <= use.span.end;
            });
        if (has_directive || !reading.macros[use.macro].takes_arguments) edits.write_out(use);
    }
}

// A name that is a macro's only before `(`, with `)` behind it, makes Mesa take all lines up to the
// next `(` for one.
bool part_bare_names(const Reading& reading, Edits& edits) {
    std::unordered_set<std::string_view> names;
    for (const Macro& macro : reading.macros)
        if (macro.takes_arguments) names.insert(macro.name);
    if (names.empty()) return false;
    bool parted = false;
    const auto look = [&](const Token& word, const Token& next) {
        if (!word.is_word() || !next.is(")") || !names.contains(word.text)) return;
        edits.replace_bytes({word.end, word.end}, " glint_gap ");
        parted = true;
    };
    for (const Macro& macro : reading.macros)
        for (std::size_t i = 1; is_of_the_text(macro) && i < macro.body.size(); ++i)
            look(macro.body[i - 1], macro.body[i]);
    std::size_t line = 0;
    for (std::size_t i = 1; i < reading.written.size(); ++i) {
        const Token& word = reading.written[i - 1];
        while (line < reading.directives.size() && reading.directives[line].span.end <= word.begin)
            ++line;
        const bool is_code =
            line == reading.directives.size() || word.begin < reading.directives[line].span.begin;
        if (is_code) look(word, reading.written[i]);
    }
    return parted;
}

}  // namespace

bool mend_macros(const Reading& reading, Edits& edits) {
    empty_idle_macros(reading, edits);
    part_signs_in_bodies(reading, edits);
    part_operators_at_uses(reading, edits);
    write_out_broken_calls(reading, edits);
    return part_bare_names(reading, edits);
}

// The site's compiler defines none of the macros by which extensions tell that they are there.
void hide_extensions(const Reading& reading, Edits& edits) {
    constexpr std::string_view kBegin = "GL_", kAsks[] = {"if", "ifdef", "ifndef", "elif"};
    for (const Directive& line : reading.directives) {
        if (!is_one_of(line.word, kAsks)) continue;
        for (std::uint32_t i = line.rest.begin; i < line.rest.end; ++i) {
            const Token& token = reading.written[i];
            const std::size_t vendor = token.text.find('_', kBegin.size());
            if (token.text.starts_with(kBegin) && vendor != token.text.npos &&
                token.text != "GL_FRAGMENT_PRECISION_HIGH")
                edits.replace_bytes(token.span(), fmt::format("glint{}", token.text.substr(2)));
        }
    }
}

}  // namespace glint
