// Of names that nothing declares: what a person may have meant.
#include "glsl/finding.h"
#include "glsl/parser.h"
#include "render/advice.h"
#include "render/around.h"
#include "render/own_words.h"
#include "render/read_text.h"
#include "scene/builtin.h"
#include "scene/own_main.h"

#include <fmt/format.h>

#include <algorithm>

namespace glint {

// Outside of functions, and nowhere used before: a function that stands above is used as a value.
bool ReadText::is_declared_below(std::string_view name) const {
    int depth = 0;
    bool is_used = false;
    for (std::size_t i = 1; i < read_.tokens.size(); ++i) {
        const std::string_view text = read_.tokens[i].text;
        depth += text == "{" || text == "(" ? 1 : text == "}" || text == ")" ? -1 : 0;
        if (text != name) continue;
        if (depth == 0 && read_.tokens[i - 1].is_word()) return is_used;
        is_used = true;
    }
    return false;
}

// Above: what is used as a value has no parentheses.
bool ReadText::is_declared(std::string_view name, bool as_function) const {
    for (std::size_t i = 1; i + 1 < read_.tokens.size(); ++i)
        if (read_.tokens[i].is(name) && may_be_type(read_.tokens[i - 1]) &&
            read_.tokens[i + 1].is("(") == as_function)
            return true;
    return false;
}

// Whether what is declared at a token is known at a later one: its block, the statement behind the
// parentheses that it stands in, or the function whose parameter it is goes on until there.
bool reaches(std::span<const Token> tokens, std::size_t declared, std::size_t at) {
    int round = 0, curly = 0;
    bool is_behind = false;  // those parentheses
    for (std::size_t i = declared + 1; i < at; ++i) {
        const Token& token = tokens[i];
        if (token.is("(")) ++round;
        if (token.is(")") && --round < 0) {
            is_behind = true;
            round = 0;
        }
        if (token.is("{")) ++curly;
        if (token.is("}") && --curly < 0) return false;
        const bool ends_statement = token.is("}") || (token.is(";") && round == 0);
        if (is_behind && curly == 0 && ends_statement) return false;
    }
    return true;
}

// Whether a function ends from one token to another.
bool ends_function(std::span<const Token> tokens, std::size_t from, std::size_t to) {
    int depth = 0;
    bool ends = false;
    for (std::size_t i = 0; i < to; ++i) {
        depth += tokens[i].is("{") ? 1 : tokens[i].is("}") ? -1 : 0;
        ends = ends || (i > from && depth == 0 && tokens[i].is("}"));
    }
    return ends;
}

std::size_t ReadText::token_of(const Said& said) const {
    const std::size_t at = spot_of(said).at;
    return static_cast<std::size_t>(
        std::ranges::find_if(read_.tokens,
                             [&](const Token& token) { return written(token).begin >= at; }) -
        read_.tokens.begin());
}

// Of a variable that is gone with its block by then, the last one.
std::string ReadText::ended_before(std::string_view name, std::size_t at) const {
    if (read_.tokens.empty()) return {};
    for (std::size_t i = std::min(at, read_.tokens.size() - 1); i-- > 1;) {
        const Token& before = read_.tokens[i - 1];
        const bool is_first = may_be_type(before) && !read_.tokens[i + 1].is("(");
        const bool is_next = before.is(",") && read_.tokens[i + 1].is("=");
        if (!read_.tokens[i].is(name) || !(is_first || is_next)) continue;
        const std::size_t begin = written(read_.tokens[i]).begin;
        if (!pass_.origin(begin) || reaches(read_.tokens, i, at)) return {};
        const char* const help = ends_function(read_.tokens, i, at)
                                     ? "is another function's: hand it over as an argument"
                                     : "ends with its block: declare it before, outside";
        return fmt::format("; that of line {} {}", place(begin).line, help);
    }
    return {};
}

std::string ReadText::help_with(const Said& said, std::string_view name, bool is_called,
                                const std::set<std::string, std::less<>>& unknown) const {
    if (is_declared_below(name)) return "; it stands below, and GLSL reads in order: move it up";
    const std::size_t at = token_of(said);
    if (std::string ended = is_called ? "" : ended_before(name, at); !ended.empty()) return ended;
    const auto is_named = [&](const Macro& macro) {
        return macro.name == name && macro.takes_arguments;
    };
    if (std::ranges::any_of(read_.macros, is_named))
        return fmt::format("; it is a macro that takes arguments: write {}(\u2026)", name);
    const bool is_known =
        std::ranges::find(built_in_functions(), name) != built_in_functions().end();
    if (is_declared(name, true) || (is_known && !is_called))
        return is_called ? "; a variable of that name hides the function here; give it another"
                         : fmt::format("; it is a function: call it, {}(\u2026)", name);
    if (is_called && is_declared(name, false))
        return "; it is a variable: write an operator, such as *, before the '('";
    const std::string foreign = advice_on_foreign_name(name);
    return foreign.empty() ? meant_by(name, at, is_called, unknown) : foreign;
}

std::string ReadText::meant_by(std::string_view mistyped, std::size_t at, bool is_called,
                               const std::set<std::string, std::less<>>& unknown) const {
    if (mistyped.size() < 2) return {};  // any other letter is as near
    const std::size_t most_letters_apart = (mistyped.size() + 2) / 3;
    const auto is_of_kind = [&](std::size_t i) {
        return (i + 1 < read_.tokens.size() && read_.tokens[i + 1].is("(")) == is_called;
    };
    std::set<std::string, std::less<>> names;
    const auto add = [&](std::string_view name) {
        const std::size_t longer = std::max(name.size(), mistyped.size());
        const bool is_near = longer - std::min(name.size(), mistyped.size()) <= most_letters_apart;
        const bool is_name = !is_keyword(name) && name != "highp" && name != "precision";
        if (is_near && is_name && !unknown.contains(name)) names.emplace(name);
    };
    // Of the host's part, what a scene may use; of its own what may be a declaration, and is known
    // at that place or would be if it stood above.
    int depth = 0;
    for (std::size_t i = 1; i < read_.tokens.size(); ++i) {
        const Token &token = read_.tokens[i], &before = read_.tokens[i - 1];
        depth += before.is("{") || before.is("(") ? 1 : before.is("}") || before.is(")") ? -1 : 0;
        if (!is_called && token.text == kPlainColour) add("gl_FragColor");
        const bool may_declare =
            token.is_word() && (may_be_type(before) || before.is(",") || before.is("]"));
        if (!pass_.origin(token.begin)) {
            if (!is_called && (find_builtin(token.text) || is_coordinate_name(token.text)))
                add(token.text);
        } else if (may_declare && is_of_kind(i) &&
                   (depth == 0 || (i < at && reaches(read_.tokens, i, at)))) {
            add(token.text);
        }
    }
    for (const Macro& macro : read_.macros)
        if (macro.definition.end > 0 && pass_.origin(macro.definition.begin) &&
            macro.takes_arguments == is_called)
            add(macro.name);
    const bool is_statement = at > 0 && at + 1 < read_.tokens.size() &&
                              read_.tokens[at + 1].is(";") &&
                              may_declare_behind(read_.tokens[at - 1].text);
    if (is_statement) names.insert({"break", "continue", "discard", "return"});
    if (is_called) {
        std::ranges::for_each(built_in_functions(), add);
        for (const char* type : {"float", "int", "uint", "bool", "vec2", "vec3", "vec4", "ivec2",
                                 "ivec3", "ivec4", "mat2", "mat3", "mat4"})
            add(type);
    } else {
        for (const char* name : {"gl_FragCoord", "gl_FrontFacing", "gl_PointCoord"}) add(name);
    }
    return did_you_mean(mistyped, std::vector<std::string>(names.begin(), names.end()));
}

}  // namespace glint
