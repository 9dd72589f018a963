#include "render/read_text.h"

#include "base/words.h"
#include "glsl/finding.h"
#include "glsl/operands.h"
#include "glsl/parser.h"
#include "render/advice.h"
#include "render/around.h"
#include "render/consequences.h"
#include "render/driver_log.h"
#include "render/nvidia_words.h"
#include "render/own_words.h"
#include "scene/builtin.h"
#include "scene/own_main.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace glint {

constexpr std::string_view kSyntaxError = "syntax error", kUndefinedMacro = "undefined macro ";
constexpr const char* kTextEnds = "syntax error, unexpected end of file";

std::size_t at_line(const std::vector<std::size_t>& begins, int line) {
    return begins[static_cast<std::size_t>(std::clamp(line, 1, static_cast<int>(begins.size())) -
                                           1)];
}

// Mesa's preprocessor puts lines that a backslash joins into the first of them, and makes up for it
// with empty ones; lines that a macro's arguments stand on it joins for good. A
// comment's lines are as those of backslashes.
void ReadText::find_lines() {
    const std::string& text = pass_.text;
    line_begins_ = expanded_line_begins_ = {0};
    auto use = read_.uses.begin();
    auto comment = read_.comments.begin();
    std::size_t joined = 0;
    for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 1)) {
        line_begins_.push_back(at + 1);
        while (use != read_.uses.end() && use->span.end <= at) ++use;
        if (use != read_.uses.end() && use->span.begin <= at) continue;
        while (comment != read_.comments.end() && comment->span.end <= at) ++comment;
        const bool is_within = comment != read_.comments.end() && comment->span.begin <= at;
        if (is_within || (at > 0 && text[at - 1] == '\\')) {
            ++joined;
            continue;
        }
        expanded_line_begins_.insert(expanded_line_begins_.end(), joined + 1, at + 1);
        joined = 0;
    }
}

std::size_t ReadText::offset(int line, int column) const {
    const std::string& text = pass_.text;
    std::size_t at = at_line(line_begins_, line);
    for (; column > 1 && at < text.size() && text[at] != '\n'; --column)
        for (++at; at < text.size() && !begins_character(text[at]);) ++at;
    return at;
}

// Of a macro's token in its use.
Spot ReadText::spot_of(std::size_t index) const {
    if (index >= read_.tokens.size()) return {pass_.text.size(), kNone, 0, index};
    const Token& token = read_.tokens[index];
    const Span place = written(token);
    const bool in_text =
        token.use == kNone || (place.begin <= token.begin && token.end <= place.end);
    return in_text ? Spot{token.begin, kNone, 0, index}
                   : Spot{place.begin, token.use, token.begin, index};
}

// Of a line, where something stands that is neither space nor comment.
std::size_t behind_blanks(std::string_view text, std::size_t at) {
    while (at < text.size()) {
        const bool is_comment = text.substr(at, 2) == "/*";
        if (!is_comment && text[at] != ' ' && text[at] != '\t') break;
        at = is_comment ? std::min(text.find("*/", at), text.size() - 2) + 2 : at + 1;
    }
    return at;
}

// Mesa counts bytes of what its preprocessor makes of a line: macros expanded, and one space for a
// run of spaces and comments.
Spot ReadText::expanded_spot(int line, int column) const {
    const std::size_t begin = at_line(expanded_line_begins_, line);
    const std::size_t end = std::max(at_line(expanded_line_begins_, line + 1), begin + 1);
    Spot spot{begin};
    const std::size_t first = behind_blanks(pass_.text, begin);
    int at = first > begin ? 2 : 1;
    bool is_behind = false;  // another token of the line, of which a macro's all stand at its use
    for (const Token& token : read_.tokens) {
        const Span place = written(token);
        if (place.begin < begin) continue;
        if (place.begin >= end) break;
        at += token.space_before && (is_behind || place.begin > first) ? 1 : 0;
        is_behind = true;
        if (!token.begins_line) at += token.spaces_left;  // else they end the line before
        if (at > column) break;
        spot = spot_of(static_cast<std::size_t>(&token - read_.tokens.data()));
        const auto within = static_cast<std::size_t>(column - at);
        if (spot.use == kNone && within < token.text.size()) spot.at += within;
        at += static_cast<int>(token.text.size());
    }
    return spot;
}

// Behind a token means behind the last one that a person wrote.
Place ReadText::place_of(const SyntaxError& error) const {
    std::size_t token = std::min(error.token, read_.tokens.size() - 1);
    if (!error.is_behind) return place(written(read_.tokens[token]).begin);
    while (token > 0 && !pass_.origin(written(read_.tokens[token]).end - 1)) --token;
    Place where = place(written(read_.tokens[token]).end - 1);
    ++where.column;
    return where;
}

Spot ReadText::spot_of(const Said& said) const {
    return said.token         ? spot_of(*said.token)
           : said.is_expanded ? expanded_spot(said.line, said.column)
                              : Spot{offset(said.line, said.column)};
}

std::optional<Said> ReadText::from_nvidia(Said said) const {
    const std::size_t begin = at_line(line_begins_, said.line);
    const std::size_t end = std::max(at_line(line_begins_, said.line + 1), begin + 1);
    const auto first_from = [&](std::size_t at) {
        return static_cast<std::uint32_t>(
            std::ranges::find_if(read_.tokens,
                                 [&](const Token& token) { return written(token).begin >= at; }) -
            read_.tokens.begin());
    };
    auto [words, token] =
        read_nvidia(std::move(said.words), read_.tokens, {first_from(begin), first_from(end)});
    if (words.empty()) return std::nullopt;
    said.words = std::move(words);
    said.token = token;
    return said;
}

std::optional<Diagnostic> ReadText::open_bracket() const {
    const std::vector<Token> tokens = tokens_as_written(read_, pass_);
    const auto error = read_syntax_error(kTextEnds, tokens, tokens.size());
    if (!error || error->is_behind) return std::nullopt;
    return Diagnostic{Severity::error, place_of(*error), error->text};
}

std::optional<Diagnostic> ReadText::open_use() const {
    const auto& tokens = read_.written;
    for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
        const auto is_named = [&](const Macro& macro) {
            return macro.takes_arguments && tokens[i].is(macro.name);
        };
        if (!tokens[i + 1].is("(") || !pass_.origin(tokens[i].begin) ||
            std::ranges::none_of(read_.macros, is_named))
            continue;
        int depth = 0;
        std::size_t end = i + 1;
        for (; end < tokens.size(); ++end) {
            depth += tokens[end].is("(") ? 1 : tokens[end].is(")") ? -1 : 0;
            if (depth == 0) break;
        }
        if (end == tokens.size())
            return Diagnostic{Severity::error, place(tokens[i].begin),
                              fmt::format("the arguments of the macro {} are never closed; write "
                                          "the ')' that is missing",
                                          tokens[i].text)};
    }
    return std::nullopt;
}

// "; iResolution has three numbers: write iResolution.xy", where the statement has it whole.
std::string ReadText::help_with_size(const Spot& spot) const {
    constexpr std::pair<std::string_view, std::string_view> kInputs[] = {
        {"iResolution", "three"}, {"iMouse", "four"}, {"gl_FragCoord", "four"}};
    const auto ends = [](const Token& token) {
        return token.is(";") || token.is("{") || token.is("}");
    };
    for (std::size_t i = spot.token; i + 1 < read_.tokens.size() && !ends(read_.tokens[i]); ++i) {
        if (read_.tokens[i + 1].is(".")) continue;
        for (const auto& [name, count] : kInputs)
            if (read_.tokens[i].is(name))
                return fmt::format("; {0} has {1} numbers: write {0}.xy", name, count);
    }
    return "";
}

const std::vector<std::string>& directives() {
    static const std::vector<std::string> all = {
        "include", "define",  "undef",     "ifdef", "ifndef", "elif", "else",
        "endif",   "version", "extension", "if",    "pragma", "line", "error"};
    return all;
}

// `0.0 < x < 1.0`
bool ReadText::compares_twice(const Spot& spot) const {
    static constexpr std::string_view kEnds[] = {";", ",", "&&", "||", "?", "{", "}"};
    static constexpr std::string_view kCompare[] = {"<", ">", "<=", ">="};
    int depth = 0, count = 0;
    for (std::size_t i = spot.token; i < read_.tokens.size() && depth >= 0; ++i) {
        const std::string_view text = read_.tokens[i].text;
        if (depth == 0 && is_one_of(text, kEnds)) break;
        depth += text == "(" || text == "[" ? 1 : text == ")" || text == "]" ? -1 : 0;
        count += depth == 0 && is_one_of(text, kCompare);
    }
    return count > 1;
}

// What is said of "non-lvalue in assignment".
std::string ReadText::no_variable(const Spot& spot) const {
    for (std::size_t i = spot.token; i + 1 < read_.tokens.size(); ++i) {
        const Token &token = read_.tokens[i], &next = read_.tokens[i + 1];
        if (is_assignment(token) || token.is(";")) break;
        const bool is_mask = token.is(".") && next.text.size() <= 4 &&
                             next.text.find_first_not_of("xyzwrgbastpq") == next.text.npos;
        const std::set<char> letters(next.text.begin(), next.text.end());
        if (is_mask && letters.size() < next.text.size())
            return fmt::format("'{}' names a component twice, and cannot be given a value",
                               next.text);
    }
    return "what stands left of this '=' is no variable";
}

// Mesa tells it of the whole function.
Spot ReadText::second_parameter(const Spot& spot, std::string_view name) const {
    int depth = 0, seen = 0;
    for (std::size_t i = spot.token; i < read_.tokens.size(); ++i) {
        const Token& token = read_.tokens[i];
        depth += token.is("(") ? 1 : token.is(")") ? -1 : 0;
        if (token.is(")") && depth == 0) break;
        if (depth == 1 && token.is(name) && ++seen == 2) return spot_of(i);
    }
    return spot;
}

// Of `float a` in the block of another one, or of a parameter.
std::string ReadText::declared_before(std::string_view name, std::size_t at) const {
    for (std::size_t i = std::min(at, read_.tokens.size()); i-- > 1;)
        if (read_.tokens[i].is(name) && may_be_type(read_.tokens[i - 1]) &&
            pass_.origin(written(read_.tokens[i]).begin))
            return fmt::format(
                "; line {} declares it: give this one another name, or leave out "
                "its type",
                place(written(read_.tokens[i]).begin).line);
    return "";
}

// Of "QUALITY in expression (illegal in GLES)".
std::string ReadText::help_with_condition(std::string_view words) const {
    const std::string_view name = words.substr(0, words.find(' '));
    if (is_declared(name, false))
        return "; a preprocessor knows macros alone: of a variable or a uniform write if (\u2026)";
    std::vector<std::string> known;
    for (const Macro& macro : read_.macros)
        if (macro.definition.end > 0 && pass_.origin(macro.definition.begin))
            known.emplace_back(macro.name);
    const std::string meant = did_you_mean(name, known);
    return meant.empty() ? fmt::format("; write #define {0} 0 above, or #if defined({0})", name)
                         : meant;
}

// `#define PI 3,14`
std::string comma_for_point(const Macro& macro) {
    const auto is_whole = [](const Token& token) {
        return token.text.find_first_not_of("0123456789") == token.text.npos;
    };
    const auto& body = macro.body;
    if (body.size() != 3 || !body[1].is(",") || !is_whole(body[0]) || !is_whole(body[2])) return "";
    return fmt::format("; numbers have a point: write {}.{}", body[0].text, body[2].text);
}

// "; == compares, = gives a value", "; did you mean 'include'?", or "".
std::string ReadText::help_at(std::string_view words, const Spot& spot) const {
    if (words.ends_with("condition must be scalar boolean")) {
        int depth = 0;
        for (std::size_t i = spot.token; i < read_.tokens.size() && depth >= 0; ++i) {
            const Token& token = read_.tokens[i];
            if (token.is("=")) return "; == compares, = gives a value";
            depth += token.is("(") ? 1 : token.is(")") || token.is(";") ? -1 : 0;
        }
        return "; compare, such as x > 0.0";
    }
    if (words.starts_with("vector size mismatch")) return help_with_size(spot);
    if (words == "operands to relational operators must be scalar and numeric")
        return compares_twice(spot) ? "; two are compared at a time: write a < b && b < c"
                                    : "; of vectors compare one component, or write "
                                      "all(lessThan(a, b)) and its like";
    if (words.ends_with("' redeclared") && words.starts_with("`") &&
        find_builtin(words.substr(1, words.find('\'') - 1)))
        return "; it is the host's, and there already: take this out, or give yours another name";
    if (words.ends_with("' redeclared") && words.starts_with("`"))
        return declared_before(words.substr(1, words.find('\'') - 1), spot.token);
    if (words.starts_with(kUndefinedMacro))
        return help_with_condition(words.substr(kUndefinedMacro.size()));
    if (words.starts_with("Illegal non-directive after #")) {
        std::string_view word = std::string_view(pass_.text).substr(spot.at);
        word.remove_prefix(std::min(word.find_first_not_of("# \t"), word.size()));
        word = word.substr(0, word.find_first_of(" \t\n\"(<"));
        if (word.size() == 9 && word.starts_with("iChannel"))
            return "; there are four channels, iChannel0 to iChannel3";
        std::vector<std::string> known = directives();
        known.insert(known.end(), {"iUniform", "iKeyboard"});
        const std::string help = did_you_mean(word, known);
        if (!help.empty()) return help;
        return word == "import" || word == "use" || word == "require"
                   ? "; a file is taken in by #include \"FILE\""
                   : "; a comment begins with //";
    }
    return "";
}

// `#define PI 3.14;`: the semicolon before what is not understood is a macro's last token.
std::optional<Diagnostic> ReadText::end_in_macro(std::size_t token) const {
    if (token == 0 || token >= read_.tokens.size()) return std::nullopt;
    const Token &end = read_.tokens[token - 1], &behind = read_.tokens[token];
    if (end.use == kNone || end.use == behind.use || !end.is(";") || !pass_.origin(end.begin))
        return std::nullopt;
    return Diagnostic{Severity::error, place(end.begin),
                      fmt::format("this ';' goes wherever the macro {} is used; take it out",
                                  read_.macros[read_.uses[end.use].macro].name)};
}

// `u.x` with `#define x 3.0`: the grammar's words are about what the macro stands for.
std::string ReadText::beside_macro(std::size_t token) const {
    for (std::size_t i = token; i < std::min(token + 3, read_.tokens.size()); ++i) {
        if (read_.tokens[i].use == kNone) continue;
        const Macro& macro = read_.macros[read_.uses[read_.tokens[i].use].macro];
        if (!pass_.origin(macro.definition.begin)) continue;
        return fmt::format(
            "what the macro {} stands for does not fit here; give the macro a name "
            "that nothing else has",
            macro.name);
    }
    return "this is not expected here";
}

// `#ifdeff A`, of which Mesa says that `#ifdef` has too much behind it.
std::optional<Diagnostic> ReadText::mistyped_directive(const Spot& spot) const {
    const std::size_t at = pass_.text.rfind('#', spot.at);
    if (at == std::string::npos || pass_.text.find('\n', at) < spot.at) return std::nullopt;
    const std::size_t begin = pass_.text.find_first_not_of(" \t", at + 1);
    if (begin == std::string::npos) return std::nullopt;
    const std::size_t end = pass_.text.find_first_of(" \t\n(", begin);
    const std::string word = pass_.text.substr(begin, end - begin);
    const std::string meant = nearest(word, directives());
    if (meant.empty() || meant == word) return std::nullopt;
    return Diagnostic{Severity::error, place(at),
                      fmt::format("'#{}' is no directive; did you mean '#{}'?", word, meant)};
}

// The first `#elsif` or `#ifdeff` behind this place: in a part that is left out Mesa takes either
// for what it begins with, and then misses an end.
std::optional<Diagnostic> ReadText::mistyped_behind(std::size_t at) const {
    for (; at < pass_.user_end; at = pass_.text.find('\n', at) + 1) {
        const std::size_t begin = pass_.text.find_first_not_of(" \t", at);
        if (begin != std::string::npos && pass_.text[begin] == '#')
            if (auto mistyped = mistyped_directive(Spot{begin})) return mistyped;
        if (pass_.text.find('\n', at) == std::string::npos) break;
    }
    return std::nullopt;
}

// `#define sq (x) ((x) * (x))`, and then `sq(2.0)`: the macro takes no arguments.
std::optional<Diagnostic> ReadText::spaced_macro(const Spot& spot) const {
    if (spot.use == kNone || spot.token >= read_.tokens.size()) return std::nullopt;
    const Macro& macro = read_.macros[read_.uses[spot.use].macro];
    const auto& body = macro.body;
    const bool has_list = body.size() > 3 && body[0].is("(") && body[1].is_word() &&
                          (body[2].is(")") || body[2].is(","));
    const std::size_t behind = read_.uses[spot.use].span.end;
    if (macro.takes_arguments || !has_list || !pass_.origin(body[0].begin) ||
        behind >= pass_.text.size() || pass_.text[behind] != '(')
        return std::nullopt;
    const Place defined = place(body[0].begin);
    return Diagnostic{Severity::error, place(spot.at),
                      fmt::format("this is no function: the macro {0} takes no arguments, for in "
                                  "its #define a space stands before the '('; take it out "
                                  "({1}:{2}:{3})",
                                  macro.name, defined.file, defined.line, defined.column)};
}

// Where on its line the macro stands that an #if asks for, of which Mesa names the line's end.
std::size_t ReadText::named_on_line(std::size_t at, std::string_view words) const {
    words.remove_prefix(kUndefinedMacro.size());
    const std::string_view name = words.substr(0, words.find(' '));
    const std::size_t begin = pass_.text.rfind('\n', at == 0 ? 0 : at - 1) + 1;  // of the first: 0
    const std::size_t found = find_whole_word(pass_.text, name, begin);
    return found < pass_.text.find('\n', at) ? found : at;
}

// Where a condition goes wrong, of which a driver names the line's end.
std::size_t ReadText::wrong_on_line(std::size_t at) const {
    for (const Directive& line : read_.directives) {
        if (at < line.span.begin || line.span.end < at) continue;
        const auto condition = std::span(read_.written).subspan(line.rest.begin, line.rest.size());
        const Token* wrong = wrong_in_condition(condition, read_.macros);
        if (wrong) return wrong->begin;
    }
    return at;
}

// A macro's operator behind one of its arguments, of which a driver names the first operand's
// place.
Spot ReadText::with_macro_of_operator(Spot spot) const {
    const std::size_t next = spot.token + 1;
    if (next >= read_.tokens.size() || read_.tokens[spot.token].use == kNone) return spot;
    const Spot behind = spot_of(next);
    const bool is_operator = !read_.tokens[next].is_word() && !read_.tokens[next].is(")") &&
                             !read_.tokens[next].is(";") && !read_.tokens[next].is(",");
    return is_operator && behind.use == read_.tokens[spot.token].use
               ? Spot{spot.at, behind.use, behind.defined, spot.token}
               : spot;
}

Diagnostic ReadText::complaint(Said said) const {
    const auto& [severity, line, column, is_expanded, said_words, token] = said;
    Spot spot = spot_of(said);
    constexpr std::string_view kParameter = "parameter `", kTwice = "' redeclared";
    if (said_words.starts_with(kParameter) && said_words.ends_with(kTwice))
        spot = second_parameter(
            spot,
            std::string_view(said_words)
                .substr(kParameter.size(), said_words.size() - kParameter.size() - kTwice.size()));
    if (said_words.starts_with(kUndefinedMacro)) spot.at = named_on_line(spot.at, said_words);
    if (said_words == kNoCondition) spot.at = wrong_on_line(spot.at);
    Place where = place(spot.at);
    if (spot.at >= pass_.user_end) {
        const auto user = pass_.text.begin() + static_cast<long>(pass_.user_begin);
        const auto host_lines = std::count(pass_.text.begin(), user, '\n');
        where = scene_.place(line - static_cast<int>(host_lines), column);
    }
    if (column == 0 && !token) where.column = 0;
    std::string words = said_words == "non-lvalue in assignment" ? no_variable(spot) : said_words;
    if (spot.at >= pass_.user_end && words.starts_with(kSyntaxError)) {
        // Of what stands behind a text with a main() of its own.
        words = kTextEnds;
        spot.token = tokens_as_written(read_, pass_).size();
    }
    const std::size_t hash = pass_.text.rfind('#', spot.at);
    if (words.ends_with(kConditionBehind) && hash != std::string::npos &&
        pass_.text.compare(hash, 6, "#undef") == 0 && pass_.text.find('\n', hash) >= spot.at)
        words.erase(words.size() - kConditionBehind.size());
    if (said_words == "Unterminated #if")
        if (auto mistyped = mistyped_behind(spot.at)) return *mistyped;
    if (auto spaced = spaced_macro(spot)) return *spaced;
    if (words == "extra tokens at end of directive")
        if (auto mistyped = mistyped_directive(spot)) return *mistyped;
    if (spot.at >= pass_.user_end || words.starts_with("this is not expected here"))
        if (auto open = open_use()) return *open;
    std::optional<SyntaxError> syntax;
    if (is_expanded || token)
        syntax = read_syntax_error(words, tokens_as_written(read_, pass_), spot.token);
    if (auto end = syntax ? end_in_macro(syntax->token) : std::nullopt) return *end;
    if (!syntax && words.starts_with(kSyntaxError)) words = beside_macro(spot.token);
    words = syntax ? syntax->text : said_better(std::move(words)) + help_at(words, spot);
    if (syntax && (syntax->is_behind || syntax->token != spot.token)) {
        where = place_of(*syntax);
        spot.use = kNone;
    }
    if (spot.use == kNone && !syntax) spot = with_macro_of_operator(spot);
    if (spot.use != kNone && pass_.origin(spot.defined)) {
        const Place defined = place(spot.defined);
        const std::string what = fmt::format("{}{} stands for, {}:{}:{})", kInMacro,
                                             read_.macros[read_.uses[spot.use].macro].name,
                                             defined.file, defined.line, defined.column);
        words.insert(
            words.ends_with(kCandidates) ? words.size() - kCandidates.size() : words.size(),
            what + comma_for_point(read_.macros[read_.uses[spot.use].macro]));
    }
    return {severity, where, std::move(words)};
}

Place ReadText::first(std::string_view name) const {
    for (const Token& token : read_.tokens)
        if (token.is(name) && pass_.origin(written(token).begin))
            return place(written(token).begin);
    return Place{scene_.files.front().string()};
}

std::ptrdiff_t ReadText::block_of(const Said& said) const {
    const Spot spot = spot_of(said);
    int depth = 0;
    std::ptrdiff_t ended = 0;
    for (const Token& token : read_.tokens) {
        if (written(token).begin >= spot.at) break;
        depth += token.is("{") ? 1 : token.is("}") ? -1 : 0;
        ended += depth == 0 && token.is("}") ? 1 : 0;
    }
    return ended;
}

}  // namespace glint
