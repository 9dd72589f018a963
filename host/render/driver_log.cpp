#include "render/driver_log.h"

#include "base/words.h"
#include "glsl/finding.h"
#include "glsl/parser.h"
#include "glsl/preprocess.h"
#include "render/advice.h"
#include "render/consequences.h"
#include "render/nvidia_words.h"
#include "render/own_words.h"
#include "render/syntax_error.h"
#include "scene/builtin.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <regex>
#include <set>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace glint {
namespace {

// Where a complaint stands in the text that the driver read.
struct Spot {
    std::size_t at = 0;  // of what a person wrote: where a macro is used, not where it is defined
    std::uint32_t use = kNone;  // the macro's use that the complaint is of
    std::size_t defined = 0;    // and the place in its definition
    std::size_t token = 0;      // of those that a compiler sees
};

// What a driver says of a place in its text.
struct Said {
    Severity severity = Severity::error;
    int line = 0, column = 0;  // in characters from 1
    bool is_expanded = false;  // it counts behind its preprocessor
    std::string words = {};
    std::optional<std::size_t> token = {};  // that it is about, where that is known instead
};

// The text as the driver read it, taken apart.
class ReadText {
public:
    ReadText(const Scene& scene, const PassText& pass)
        : scene_(scene), pass_(pass), read_(preprocess(pass.text, known_of_driver())) {
        find_lines();
    }

    Diagnostic complaint(Said said) const;
    // The same of what NVIDIA says of a line; nothing where a person has nothing to mend.
    std::optional<Said> from_nvidia(Said said) const;
    // A bracket that nobody closes, if there is one.
    std::optional<Diagnostic> open_bracket() const;
    // The use of a macro whose arguments go on to the text's end, if there is one.
    std::optional<Diagnostic> open_use() const;

    // Where a name stands first; the file alone where it does not.
    Place first(std::string_view name) const;

    // "; did you mean 'density'?" of a name that is not declared, or "". Nor are the `unknown`
    // ones.
    std::string help_with(std::string_view name, bool is_called,
                          const std::set<std::string, std::less<>>& unknown) const;
    // Which of the blocks outside of all others that is in; another for each function.
    std::ptrdiff_t block_of(const Said& said) const;

private:
    std::string help_at(std::string_view words, const Spot& spot) const;
    bool is_declared_below(std::string_view name) const;
    bool is_function(std::string_view name) const;
    std::string meant_by(std::string_view mistyped, bool is_called,
                         const std::set<std::string, std::less<>>& unknown) const;
    void find_lines();
    std::size_t offset(int line, int column) const;
    Spot spot_of(std::size_t token) const;
    Spot spot_of(const Said& said) const;
    Spot expanded_spot(int line, int column) const;
    std::optional<Diagnostic> end_in_macro(std::size_t token) const;
    Place place_of(const SyntaxError& error) const;
    // Where a token stands: those of a macro where it is used.
    Span written(const Token& token) const {
        return token.use == kNone ? token.span() : read_.uses[token.use].span;
    }
    Place place(std::size_t at) const {
        const auto origin = pass_.origin(at);
        return origin ? scene_.place_at(*origin) : Place{scene_.files.front().string()};
    }

    const Scene& scene_;
    const PassText& pass_;
    Preprocessed read_;
    std::vector<std::size_t> line_begins_;           // by the line's number - 1
    std::vector<std::size_t> expanded_line_begins_;  // the same, as Mesa counts
};

std::size_t at_line(const std::vector<std::size_t>& begins, int line) {
    return begins[static_cast<std::size_t>(std::clamp(line, 1, static_cast<int>(begins.size())) -
                                           1)];
}

// Mesa's preprocessor puts lines that a backslash joins into the first of them, and makes up for it
// with empty ones; lines that a macro's arguments stand on it joins for good.
void ReadText::find_lines() {
    const std::string& text = pass_.text;
    line_begins_ = expanded_line_begins_ = {0};
    auto use = read_.uses.begin();
    std::size_t joined = 0;
    for (std::size_t at = text.find('\n'); at != text.npos; at = text.find('\n', at + 1)) {
        line_begins_.push_back(at + 1);
        while (use != read_.uses.end() && use->span.end <= at) ++use;
        if (use != read_.uses.end() && use->span.begin <= at) continue;
        if (at > 0 && text[at - 1] == '\\') {
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

// Mesa counts bytes of what its preprocessor makes of a line: macros expanded, and one space for a
// run of spaces and comments.
Spot ReadText::expanded_spot(int line, int column) const {
    const std::size_t begin = at_line(expanded_line_begins_, line);
    const std::size_t end = std::max(at_line(expanded_line_begins_, line + 1), begin + 1);
    Spot spot{begin};
    int at = 1;
    bool is_first = true;
    for (const Token& token : read_.tokens) {
        const Span place = written(token);
        if (place.begin < begin) continue;
        if (place.begin >= end) break;
        at += (is_first ? place.begin > begin : token.space_before) ? 1 : 0;
        is_first = false;
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
    const std::string words = "syntax error, unexpected end of file";
    const std::vector<Token> tokens = tokens_as_written(read_, pass_);
    const auto error = read_syntax_error(words, tokens, tokens.size());
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

// "; == compares, = gives a value", "; did you mean 'include'?", or "".
std::string ReadText::help_at(std::string_view words, const Spot& spot) const {
    if (words.ends_with("condition must be scalar boolean")) {
        int depth = 0;
        for (std::size_t i = spot.token; i < read_.tokens.size() && depth >= 0; ++i) {
            const Token& token = read_.tokens[i];
            if (token.is("=")) return "; == compares, = gives a value";
            depth += token.is("(") ? 1 : token.is(")") || token.is(";") ? -1 : 0;
        }
    }
    if (words.starts_with("Illegal non-directive after #")) {
        static const std::vector<std::string> kDirectives = {"include", "define", "undef", "ifdef",
                                                             "ifndef",  "elif",   "else",  "endif"};
        std::string_view word = std::string_view(pass_.text).substr(spot.at);
        word.remove_prefix(std::min(word.find_first_not_of("# \t"), word.size()));
        return did_you_mean(word.substr(0, word.find_first_of(" \t\n\"(")), kDirectives);
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

Diagnostic ReadText::complaint(Said said) const {
    const auto& [severity, line, column, is_expanded, said_words, token] = said;
    Spot spot = spot_of(said);
    Place where = place(spot.at);
    if (spot.at >= pass_.user_end) {
        const auto user = pass_.text.begin() + static_cast<long>(pass_.user_begin);
        const auto host_lines = std::count(pass_.text.begin(), user, '\n');
        where = scene_.place(line - static_cast<int>(host_lines), column);
    }
    if (column == 0 && !token) where.column = 0;
    std::string words = said_words;
    if (words.starts_with("this is not expected here"))
        if (auto open = open_use()) return *open;
    std::optional<SyntaxError> syntax;
    if (is_expanded || token)
        syntax = read_syntax_error(words, tokens_as_written(read_, pass_), spot.token);
    if (auto end = syntax ? end_in_macro(syntax->token) : std::nullopt) return *end;
    words = syntax ? syntax->text : said_better(std::move(words)) + help_at(words, spot);
    if (syntax && (syntax->is_behind || syntax->token != spot.token)) {
        where = place_of(*syntax);
        spot.use = kNone;
    }
    if (spot.use != kNone && pass_.origin(spot.defined)) {
        const Place defined = place(spot.defined);
        const std::string what = fmt::format("{}{} stands for, {}:{}:{})", kInMacro,
                                             read_.macros[read_.uses[spot.use].macro].name,
                                             defined.file, defined.line, defined.column);
        words.insert(
            words.ends_with(kCandidates) ? words.size() - kCandidates.size() : words.size(), what);
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

bool may_be_type(const Token& token) {
    return token.is_word() && !token.is("return") && !token.is("else") && !token.is("case");
}

// Declared above: what is used as a value has no parentheses.
bool ReadText::is_function(std::string_view name) const {
    for (std::size_t i = 1; i + 1 < read_.tokens.size(); ++i)
        if (read_.tokens[i].is(name) && may_be_type(read_.tokens[i - 1]) &&
            read_.tokens[i + 1].is("("))
            return true;
    return false;
}

std::string ReadText::help_with(std::string_view name, bool is_called,
                                const std::set<std::string, std::less<>>& unknown) const {
    if (is_declared_below(name)) return "; it stands below, and GLSL reads in order: move it up";
    const auto is_named = [&](const Macro& macro) {
        return macro.name == name && macro.takes_arguments;
    };
    if (std::ranges::any_of(read_.macros, is_named))
        return fmt::format("; it is a macro that takes arguments: write {}(\u2026)", name);
    if (is_function(name))
        return is_called ? "; a variable of that name hides the function here; give it another"
                         : fmt::format("; it is a function: call it, {}(\u2026)", name);
    const std::string foreign = advice_on_foreign_name(name);
    return foreign.empty() ? meant_by(name, is_called, unknown) : foreign;
}

std::string ReadText::meant_by(std::string_view mistyped, bool is_called,
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
    // Of the host's part, what a scene may use; of its own what may be a declaration.
    for (std::size_t i = 1; i < read_.tokens.size(); ++i) {
        const Token &token = read_.tokens[i], &before = read_.tokens[i - 1];
        if (!is_called && token.text == kPlainColour) add("gl_FragColor");
        const bool may_declare =
            token.is_word() && (may_be_type(before) || before.is(",") || before.is("]"));
        if (pass_.origin(token.begin) ? may_declare && is_of_kind(i)
                                      : !is_called && find_builtin(token.text))
            add(token.text);
    }
    for (const Macro& macro : read_.macros)
        if (macro.definition.end > 0 && pass_.origin(macro.definition.begin) &&
            macro.takes_arguments == is_called)
            add(macro.name);
    if (is_called)
        std::ranges::for_each(built_in_functions(), add);
    else
        for (const char* name : {"gl_FragCoord", "gl_FrontFacing", "gl_PointCoord"}) add(name);
    return did_you_mean(mistyped, std::vector<std::string>(names.begin(), names.end()));
}

// A number of a log, however many digits it has.
int parse_count(const std::string& digits) {
    int count = 0;
    const char* end = digits.data() + digits.size();
    const bool fits = std::from_chars(digits.data(), end, count).ec == std::errc();
    return fits ? count : std::numeric_limits<int>::max();
}

constexpr int kLastLine = 1 << 30;  // no text has as many

constexpr std::size_t kLongestComplaint = 200;  // that names something

// The name that a complaint does not know, or "".
std::string unknown_name(const std::string& complaint) {
    static const std::regex mesa(R"(^(?:`(\w+)' undeclared|no function with name '(\w+)')$)");
    std::smatch m;
    if (complaint.size() > kLongestComplaint || !std::regex_match(complaint, m, mesa)) return {};
    return m[1].matched ? m[1] : m[2];
}

// All that a log does not know: of two mistyped names one does not mean the other.
std::set<std::string, std::less<>> unknown_names(const std::string& log) {
    static const std::regex said(
        R"re(`(\w+)' undeclared|no function with name '(\w+)'|undefined variable "(\w+)")re");
    std::set<std::string, std::less<>> names;
    for (const std::string& line : lines_of(log)) {
        std::smatch m;
        if (line.size() > kLongestComplaint || !std::regex_search(line, m, said)) continue;
        names.insert(m.str(1) + m.str(2) + m.str(3));  // one of them
    }
    return names;
}

// The f of "function `float f(float)' has static recursion", which Mesa says of line 0, and of
// NVIDIA's "recursive call to function "float f(float){", which goes on with its body.
std::string recursive_name(const std::string& complaint) {
    static const std::regex said(
        R"re(^(?:function `|recursive call to function ")(?:\w+ )?(\w+)\(.*)re");
    std::smatch m;
    const bool is_told =
        complaint.starts_with("recursive call") || complaint.ends_with("' has static recursion");
    return is_told && std::regex_match(complaint, m, said) ? std::string(m[1]) : "";
}

// The function that a linker finds nowhere; "" where it complains of something else.
std::string bodiless_function(const std::string& words) {
    static const std::regex said(
        R"re(unresolved reference to function `(\w+)'|call to undefined function "(?:\w+ )?(\w+)\()re");
    std::smatch m;
    return std::regex_search(words, m, said) ? m.str(1) + m.str(2) : std::string();
}

// "Too many fragment shader texture samplers", of which Mesa tells no line.
bool has_too_many_samplers(const std::string& words) {
    return words.starts_with("Too many ") && words.ends_with(" samplers");
}

// The v of "fragment shader input `v' has no matching output in the previous stage", of which Mesa
// tells no line.
std::string unfed_input(const std::string& complaint) {
    static const std::regex mesa(
        R"(^fragment shader input [`'](\w+)'.* has no matching output.*$)");
    std::smatch m;
    return std::regex_match(complaint, m, mesa) ? std::string(m[1]) : "";
}

// A log, line by line.
class LogReader {
public:
    LogReader(const Scene& scene, const std::string& log, const PassText& text)
        : scene_(scene), text_(text), unknown_(unknown_names(log)) {}

    void read(const std::string& line) {
        static const std::regex mesa(
            R"(^\d+:(\d+)\((\d+)\):\s*(preprocessor )?(error|warning):\s*(.*)$)");
        static const std::regex nvidia(R"(^\d*\((\d+)\) ?: (error|warning) (?:C\d+: )?(.*)$)");
        static const std::regex angle(R"(^(ERROR|WARNING): \d+:(\d+): (.*)$)");
        static const std::regex unplaced(R"(^(?:error|ERROR):\s*(.*)$)");
        static const std::regex total(R"(^ERROR: .*\d+ compilation errors?\..*$)");
        std::smatch m;
        if (std::regex_match(line, m, mesa)) {
            const bool is_expanded = !m[3].matched;
            add({severity(m[4] == "error"), at(m[1]), parse_count(m[2]), is_expanded,
                 is_expanded ? m.str(5) : read_preprocessor_error(m[5])});
        } else if (std::regex_match(line, m, nvidia)) {
            if (!bodiless_function(m[3]).empty()) return add_of_link(m[3]);
            auto told = taken_apart().from_nvidia(
                {.severity = severity(m[2] == "error"), .line = at(m[1]), .words = m[3]});
            if (told) add(std::move(*told));
        } else if (std::regex_match(line, m, angle)) {
            add({.severity = severity(m[1] == "ERROR"), .line = at(m[2]), .words = m[3]});
        } else if (!std::regex_match(line, total) && std::regex_match(line, m, unplaced)) {
            add_of_link(m[1]);
        }
    }

    Diagnostics list;

private:
    static Severity severity(bool is_error) {
        return is_error ? Severity::error : Severity::warning;
    }
    static int at(const std::string& line) { return std::min(parse_count(line), kLastLine); }
    // Most texts compile.
    const ReadText& taken_apart() { return apart_ ? *apart_ : apart_.emplace(scene_, text_); }
    void add(Said said);
    void add_of_link(const std::string& words);

    const Scene& scene_;
    const PassText& text_;
    std::set<std::string, std::less<>> unknown_;
    std::set<std::pair<std::string, std::ptrdiff_t>> told_;  // of these, and in which block
    bool is_recursion_told_ = false;
    std::optional<ReadText> apart_;
};

void LogReader::add(Said said) {
    if (said.words.starts_with("Error: ")) said.words.erase(0, 7);  // which it is anyway
    auto words = said_of_remainder(std::move(said.words));
    if (!words) return;
    said.words = std::move(*words);
    said.words += advice_on_types(said.words);
    if (const std::string name = unknown_name(said.words); !name.empty()) {
        const bool is_called = said.words.starts_with("no function");
        said.words += taken_apart().help_with(name, is_called, unknown_);
        // Of a name that a function does not know it is told once.
        if (!told_.emplace(name, taken_apart().block_of(said)).second) said.words += kAgain;
    }
    if (const std::string name = recursive_name(said.words); !name.empty()) {
        if (!std::exchange(is_recursion_told_, true))  // all functions of one circle follow
            list.push_back({Severity::error, taken_apart().first(name),
                            name + " calls itself, at once or by way of others; GLSL has no "
                                   "recursion, write a loop"});
        return;
    }
    list.push_back(taken_apart().complaint(std::move(said)));
}

void LogReader::add_of_link(const std::string& words) {
    list.push_back(link_diagnostic(scene_, text_.pass, words));
    Diagnostic& told = list.back();
    if (has_too_many_samplers(words) && !scene_.samplers.empty()) {
        told.place = taken_apart().first(scene_.samplers.back().name);
        told.text += " for this driver; put what several of them hold into one";
    }
    const std::string input = unfed_input(words), bare = bodiless_function(words);
    if (!input.empty()) {
        told.place = taken_apart().first(input);
        told.text = "nothing feeds " + input +
                    ": no vertices stand before a picture; write a value of its own, such as "
                    "fragCoord / iResolution.xy";
    } else if (!bare.empty() && bare != entry_of(scene_, text_.pass)) {
        told.place = taken_apart().first(bare);
        told.text = bare + " is declared and called, but has no body; write one";
    }
}

}  // namespace

std::vector<std::string> lines_of(const std::string& log) {
    constexpr std::size_t kLongestLine = 2000;
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin < log.size();) {
        const std::size_t end = std::min(log.find('\n', begin), log.size());
        std::string line = log.substr(begin, end - begin);
        if (line.size() > kLongestLine) line.replace(kLongestLine, line.npos, "...");
        line.erase(line.find_last_not_of(std::string_view(" \t\r\0", 4)) + 1);
        lines.push_back(std::move(line));
        begin = end + 1;
    }
    return lines;
}

Diagnostic link_diagnostic(const Scene& scene, std::size_t pass, std::string text) {
    const bool is_image = pass == kImagePass;
    const std::string entry = entry_of(scene, pass);
    Place place{scene.files.front().string(), 0, 0};
    if (bodiless_function(text) == entry) {
        if (!is_image) place = scene.passes[pass].place;
        text = fmt::format(
            "there is no `void {}(out vec4 fragColor, in vec2 fragCoord)`{}; write "
            "one, it draws the {}",
            entry, is_image ? "" : " for " + scene.passes[pass].name,
            is_image ? "picture" : "buffer");
    }
    return {Severity::error, std::move(place), std::move(text)};
}

Diagnostics read_driver_log(const Scene& scene, const std::string& log, const PassText& text) {
    LogReader reader(scene, log, text);
    for (const std::string& line : lines_of(log)) reader.read(line);
    for (Diagnostic& one : reader.list) one.text = in_own_words(one.text);
    return without_consequences(with_candidates_joined(std::move(reader.list)));
}

Diagnostic refusal_without_words(const Scene& scene, const PassText& text) {
    if (auto open = ReadText(scene, text).open_bracket()) return std::move(*open);
    return link_diagnostic(scene, text.pass, "the driver refused the shader without a word");
}

}  // namespace glint
