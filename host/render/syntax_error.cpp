#include "render/syntax_error.h"

#include "base/diagnostic.h"
#include "glsl/finding.h"
#include "glsl/parser.h"
#include "render/advice.h"
#include "render/around.h"
#include "scene/builtin.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <regex>
#include <utility>
#include <vector>

namespace glint {
namespace {

constexpr std::string_view kBegin = "syntax error, unexpected ";
constexpr std::string_view kExpecting = ", expecting ";
constexpr std::string_view kEnd = "end of file";

struct Complaint {
    std::string_view unexpected;
    std::vector<std::string> expected;  // in a person's words, the likeliest first

    bool expects(std::string_view what) const {
        return std::ranges::find(expected, what) != expected.end();
    }
};

std::string in_words(std::string_view token) {
    if (token.ends_with("IDENTIFIER")) return "a name";
    if (token == "FIELD_SELECTION") return "a component, such as x,";
    if (token == "INTCONSTANT" || token.starts_with("INTEGER")) return "a whole number";
    if (token == "NEWLINE") return "the line's end";
    if (token == "DEFINED") return "'defined'";
    if (token == "CASE") return "'case'";
    if (token == "DEFAULT") return "'default'";
    if (token == "LOWP" || token == "MEDIUMP" || token == "HIGHP")
        return "'highp'";  // the others are of no use here
    return std::string(token);
}

std::optional<Complaint> parse(std::string_view words) {
    if (!words.starts_with(kBegin)) return std::nullopt;
    words.remove_prefix(kBegin.size());
    const std::size_t comma = std::min(words.find(kExpecting), words.size());
    Complaint complaint{words.substr(0, comma), {}};
    words.remove_prefix(std::min(comma + kExpecting.size(), words.size()));
    while (!words.empty()) {
        const std::size_t end = std::min(words.find(" or "), words.size());
        std::string what = in_words(words.substr(0, end));
        if (!complaint.expects(what)) complaint.expected.push_back(std::move(what));
        words.remove_prefix(std::min(end + 4, words.size()));
    }
    // A list goes on with a comma nearly everywhere; something else is meant more often.
    std::ranges::stable_partition(complaint.expected,
                                  [](const std::string& what) { return what != "','"; });
    return complaint;
}

// Whether a type stands before it somewhere.
bool is_declared(std::span<const Token> tokens, std::string_view name) {
    for (std::size_t i = 1; i < tokens.size(); ++i)
        if (tokens[i].is(name) && tokens[i - 1].is_word() && !is_keyword(tokens[i - 1].text))
            return true;
    return false;
}

// "floa x", "const floa x", "floa f(float x)"; and `texture(wood u)`.
std::optional<SyntaxError> unknown_type(const Complaint& complaint, const Around& around,
                                        std::span<const Token> tokens) {
    if (!complaint.unexpected.ends_with("IDENTIFIER")) return std::nullopt;
    const bool is_before = around.is_name(-1) && around.begins(-1) && !complaint.expects("'('");
    const bool is_here = complaint.unexpected == "NEW_IDENTIFIER" && around.is_name(1);
    if (!is_before && !is_here) return std::nullopt;
    const std::ptrdiff_t away = is_before ? -1 : 0;
    const std::string_view name = around.word(away);
    if (is_one_of(name, built_in_functions()))
        return SyntaxError{fmt::format("'(' is missing behind {}", in_quotes(name)),
                           around.index(away)};
    const bool is_argument = around.is_in_function() && around.is_in_brackets() &&
                             (is_declared(tokens, name) || find_builtin(name));
    if (is_argument)
        return SyntaxError{
            fmt::format("')' or ',' is missing before {}", in_quotes(around.word(away + 1))),
            around.index(away + 1)};
    std::vector<std::string> known(types_of_glsl().begin(), types_of_glsl().end());
    known.insert(known.end(), {"return", "const", "uniform", "precision", "struct", "else"});
    for (std::size_t i = 1; i < tokens.size(); ++i) {
        if (!tokens[i - 1].is("struct")) continue;
        if (tokens[i].is(name))
            return SyntaxError{
                fmt::format("{} is no type yet: {}", in_quotes(name),
                            i < around.index(away)
                                ? "a struct cannot hold itself"
                                : "it stands below, and GLSL reads in order: move it up"),
                around.index(away)};
        known.emplace_back(tokens[i].text);
    }
    std::string help = did_you_mean(name, known);
    if (name == "then" && around.is(away - 1, ")"))
        help = "; the statement follows right behind the ')'";
    if (std::string ours = advice_on_foreign_type(name); !ours.empty()) help = std::move(ours);
    if (name == "and" || name == "or")
        return SyntaxError{fmt::format("{} is no operator here; write {}", in_quotes(name),
                                       name == "and" ? "&&" : "||"),
                           around.index(away)};
    return SyntaxError{fmt::format("{} is no type{}", in_quotes(name), help), around.index(away)};
}

// "whlie (i < 3) i++", "fro (int i = 0; …", "cosnt float k = 1.0;".
std::optional<SyntaxError> mistyped_keyword(const Complaint& complaint, const Around& around,
                                            std::span<const Token> tokens) {
    static const std::vector<std::string> statements = {"if", "for", "while", "switch"};
    static const std::vector<std::string> heads = {"const", "uniform", "varying",  "in",
                                                   "out",   "struct",  "precision"};
    const auto said = [&](std::size_t at, const std::vector<std::string>& known) {
        // A function's name may be near one, such as f.
        const bool is_word =
            at < tokens.size() && tokens[at].is_word() && !is_declared(tokens, tokens[at].text);
        static constexpr std::array<std::string_view, 4> kElseIfs = {"elif", "elseif", "elsif",
                                                                     "elseIf"};
        if (is_word && is_one_of(tokens[at].text, kElseIfs))
            return std::optional(SyntaxError{
                fmt::format("{} is no word of GLSL; write else if", in_quotes(tokens[at].text)),
                at});
        const bool begins = is_word && may_declare_behind(at > 0 ? tokens[at - 1].text : "");
        const std::string meant = begins ? nearest(tokens[at].text, known) : "";
        return meant.empty() || meant == tokens[at].text
                   ? std::nullopt
                   : std::optional(
                         SyntaxError{fmt::format("{} is no word of GLSL{}",
                                                 in_quotes(tokens[at].text), did_you_mean(meant)),
                                     at});
    };
    if (around.is_name(-1) && around.is_known_type(0))
        if (auto error = said(around.index(-1), {"return", "const"})) return error;
    if (around.is_known_type(-1) && around.is(-2, "("))
        if (auto error = said(around.index(-3), statements)) return error;
    if (const auto open = around.opened_before())
        if (auto error = said(*open - 1, statements)) return error;
    const bool is_outside = complaint.expects(std::string(kEnd)) && !around.is_in_function();
    return is_outside ? said(around.index(0), heads) : std::nullopt;
}

std::optional<SyntaxError> inner_function(const Around& around) {
    const auto head = around.head();
    if (!around.is(0, "{") || !around.is_in_function() || !head) return std::nullopt;
    return SyntaxError{std::string(kInnerFunction), *head};
}

std::optional<SyntaxError> unmatched_bracket(const Complaint& complaint, const Around& around,
                                             std::span<const Token> tokens) {
    if (complaint.unexpected == kEnd) {
        if (!around.open()) return std::nullopt;
        const std::string_view bracket = tokens[*around.open()].text;
        const char closing = bracket == "(" ? ')' : bracket == "[" ? ']' : '}';
        return SyntaxError{fmt::format("this '{}' is never closed; write '{}'", bracket, closing),
                           *around.open()};
    }
    const std::string_view text = around.word(0);
    const std::string_view opening = text == ")" ? "(" : text == "]" ? "[" : "{";
    if (text != ")" && text != "]" && text != "}") return std::nullopt;
    const bool is_alone = !around.open() || (text != "}" && tokens[*around.open()].text != opening);
    if (!is_alone) return std::nullopt;
    if (around.is_within(opening))
        return SyntaxError{fmt::format("'{}' is missing before '{}'",
                                       tokens[*around.open()].is("(") ? ")" : "]", text),
                           around.index(0)};
    return SyntaxError{fmt::format("no '{}' is open that this '{}' closes; take it out, or write "
                                   "the '{}' that is missing",
                                   opening, text, opening),
                       around.index(0)};
}

// An `else` without an `if`, and a condition without one.
std::optional<SyntaxError> misplaced_else(const Around& around, std::span<const Token> tokens) {
    const std::size_t condition = around.opened_before().value_or(0);
    if (condition > 0 && tokens[condition - 1].is("else"))
        return SyntaxError{"an 'else' has no condition; write else if (\u2026)", condition};
    const bool is_behind_statement = around.is(-1, ";") || around.is(-1, "}") || around.is(-1, "{");
    if (!around.is(0, "else") || !is_behind_statement) return std::nullopt;
    const std::size_t block = around.block_before().value_or(0);
    if (block > 1 && tokens[block - 1].is(";") && tokens[block - 2].is(")"))
        return SyntaxError{"this ';' ends the 'if' before its block; take it out", block - 1};
    const std::size_t open = around.open().value_or(0);
    const Around before(tokens, open);
    const std::size_t head =
        open > 0 && tokens[open].is("{") ? before.opened_before().value_or(0) : 0;
    if (around.is(-1, ";") && head > 0 && tokens[head - 1].is("if"))
        return SyntaxError{"'}' is missing before 'else'", around.index(0)};
    return SyntaxError{
        "no 'if' stands before this 'else'; several statements of an 'if' stand in { }",
        around.index(0)};
}

// `struct P { float m = 1.0; float get() { … } };`
std::optional<std::string> no_member(const Around& around) {
    if (!around.is_in_struct()) return std::nullopt;
    if (around.is(0, "="))
        return "no member has a value of its own here; give it where a variable is made";
    if (around.is(0, "(") && around.is_name(-1))
        return fmt::format(
            "GLSL's structs hold no functions; write {} outside, and give it the "
            "struct as an argument",
            in_quotes(around.word(-1)));
    return std::nullopt;
}

// What has a name of its own.
std::optional<std::string> known_mistake(const Complaint& complaint, const Around& around) {
    const std::string_view text = around.word(0);
    if (text == "case" || text == "default")
        return fmt::format("{} stands right within the braces of a switch, and here is none",
                           in_quotes(text));
    if (text == "=" && complaint.expects("';'"))
        return "what stands left of this '=' is no variable; == compares";
    if (around.is(-1, "-") && text == ">")
        return fmt::format("a member stands behind a '.': write {}.{}", around.word(-2),
                           around.word(1));
    if (around.is(-1, "=") && (text == ">" || text == "<"))
        return fmt::format("'={0}' is no operator; did you mean '{0}='?", text);
    if (text == ":" && around.is(1, ":"))
        return "GLSL has no '::'; write what stands behind it alone";
    if (around.is(-1, "new") && (around.is_name(0) || around.is_known_type(0)))
        return "GLSL has no 'new'; leave it out";
    const bool is_keyword_as_name = around.is_known_type(-1) || complaint.expects("a name");
    if (is_keyword_as_name && around.is_reserved(0) && !around.is_on_a_later_line())
        return fmt::format("'{}' is a word of GLSL, and a name is expected", text);
    const auto is_whole = [](std::string_view word) {
        return !word.empty() && word.find_first_not_of("0123456789") == word.npos;
    };
    if (complaint.expects("a name") && around.is(-1, ",") && is_whole(text) &&
        is_whole(around.word(-2)))
        return fmt::format("numbers have a point: write {}.{}", around.word(-2), text);
    const bool is_outside = complaint.expects(std::string(kEnd)) && !around.is_in_function();
    if (is_outside && around.is_name(0))
        return "outside of functions only declarations stand; move this into one, or write its "
               "type before it";
    if (is_outside && complaint.unexpected != kEnd)
        return "outside of functions only declarations stand; take this out, or move it into one";
    if (text == ";" && around.is(-2, "&") && !advice_on_foreign_name(around.word(-1)).empty())
        return fmt::format("'&{};' is an escape of web pages; write what it stands for",
                           around.word(-1));
    return std::nullopt;
}

// `void mainImage(…);` and its body.
std::optional<SyntaxError> ended_head(const Around& around) {
    if (!around.is(0, "{") || !around.is(-1, ";") || !around.is(-2, ")") || around.is_in_function())
        return std::nullopt;
    return SyntaxError{"this ';' ends the function before its body; take it out", around.index(-1)};
}

// `(float)3`
std::optional<SyntaxError> cast(const Around& around) {
    if (!around.is(0, ")") || !around.is_known_type(-1) || !around.is(-2, "(")) return std::nullopt;
    return SyntaxError{
        fmt::format("types are changed by a call here: write {}(\u2026)", around.word(-1)),
        around.index(-2)};
}

// What C++ has and GLSL has not: `vec3 v(1.0, 2.0, 3.0)`, `float f(float a = 1.0)`, `float& a`.
std::optional<SyntaxError> of_cpp(const Around& around) {
    const bool is_value = around.is(-1, "(") && !around.is_name(1);  // else a parameter
    const bool is_call = around.is(-2, "(") && around.is_known_type(-1) && around.is(0, "(");
    const std::ptrdiff_t bracket = is_value ? -1 : -2, type = bracket - 2;
    if ((is_value || is_call) && around.is_in_function() && around.is_name(bracket - 1) &&
        around.is_known_type(type) && around.begins(type))
        return SyntaxError{
            fmt::format("a first value stands behind '=': write {0} {1} = {0}(\u2026)",
                        around.word(type), around.word(bracket - 1)),
            around.index(bracket)};
    if (around.is(0, "=") && around.is_name(-1) && around.is_known_type(-2) && around.open() &&
        !around.is_in_function())
        return SyntaxError{
            "no parameter has a value of its own here; write a second function of this name, "
            "without it",
            around.index(0)};
    if (around.is_known_type(-1) && around.begins(-1) && (around.is(0, "&") || around.is(0, "*")))
        return SyntaxError{
            fmt::format("GLSL has no {}; a parameter that is to change is inout {}",
                        around.is(0, "&") ? "references" : "pointers", around.word(-1)),
            around.index(0)};
    return std::nullopt;
}

// `for (int i = 0, i < 4, i++)`, `for (float x : list)`
std::optional<std::string> wrong_for(const Around& around, std::span<const Token> tokens) {
    const std::optional<std::size_t> open = around.open();
    if (!open || *open == 0 || !tokens[*open - 1].is("for") || !around.is_name(-1))
        return std::nullopt;
    static constexpr std::array<std::string_view, 8> kOperators = {
        "<", ">", "<=", ">=", "!=", "==", "++", "--"};
    if (around.is(-2, ",") && is_one_of(around.word(0), kOperators))
        return "the parts of a for stand between ';': for (int i = 0; i < 4; ++i)";
    if (around.is(0, ":") && around.is_known_type(-2))
        return "GLSL counts: write for (int i = 0; i < list.length(); ++i), and list[i]";
    return std::nullopt;
}

// `uniform u_time;`, `const k = 3.0;`
std::optional<SyntaxError> without_type(const Around& around) {
    static constexpr std::array<std::string_view, 5> kHeads = {"uniform", "in", "out", "varying",
                                                               "attribute"};
    const bool is_constant = around.is(-1, "const") && around.is_name(0) && around.is(1, "=");
    const std::ptrdiff_t name = is_constant ? 0 : -1;
    const bool is_input =
        around.is(0, ";") && around.is_name(-1) && is_one_of(around.word(-2), kHeads);
    if (!is_constant && !is_input) return std::nullopt;
    return SyntaxError{
        fmt::format("{} has no type; write it, such as {} float {}", in_quotes(around.word(name)),
                    around.word(name - 1), around.word(name)),
        around.index(name)};
}

// `precision mediump float` without its end, before the next declaration.
std::optional<SyntaxError> missing_end(const Around& around) {
    if (!around.is_known_type(-1) || !around.is_reserved(0) || !around.is_on_a_later_line())
        return std::nullopt;
    return SyntaxError{"';' is missing here", around.index(-1), true};
}

// The least that can be said of it.
SyntaxError missing(const Complaint& complaint, const Around& around) {
    std::vector<std::string> expected = complaint.expected;
    const std::string here =
        complaint.unexpected == kEnd ? "the text's end" : in_quotes(around.word(0));
    if (complaint.unexpected == kEnd && expected.empty() && !around.word(-1).empty())
        return {"the text ends here, and something is missing", around.index(-1), true};
    if (expected.empty()) {
        const std::string before = around.word(-1).empty() ? "" : in_quotes(around.word(-1));
        return {before.empty() ? fmt::format("{} is not expected here", here)
                               : fmt::format("{} is not expected behind {}", here, before),
                around.index(0)};
    }
    const bool is_behind = around.is_on_a_later_line();
    const bool has_comma = expected.size() > 1 && expected.back() == "','";
    // The next argument follows, or the next statement.
    if (is_behind && has_comma && around.goes_on_in_brackets())
        std::ranges::rotate(expected, expected.end() - 1);
    else if (is_behind && has_comma)
        expected.pop_back();
    const std::string what = fmt::format("{}", fmt::join(expected, " or "));
    if (is_behind) return {what + " is missing here", around.index(-1), true};
    return {fmt::format("{} is missing before {}", what, here), around.index(0)};
}

// Whether the token there is of the kind that the complaint names.
bool is_told_of(const Complaint& complaint, const Token& token) {
    const std::string_view kind = complaint.unexpected;
    if (kind.starts_with('\'')) return kind.substr(1, kind.size() - 2) == token.text;
    if (kind.ends_with("IDENTIFIER")) return token.is_word();
    if (kind.ends_with("CONSTANT")) return token.kind == TokenKind::number || token.is_word();
    return kind != kEnd;
}

constexpr std::size_t kLongestNumber = 1000;

// `1.0h`, `0b101`: a number, and a word right behind it.
std::optional<SyntaxError> number_and_word(std::span<const Token> tokens, std::size_t at) {
    const auto stands_at = [&](std::size_t i) {
        return i > 0 && i < tokens.size() && tokens[i].is_word() &&
               tokens[i - 1].kind == TokenKind::number && tokens[i - 1].end == tokens[i].begin;
    };
    if (stands_at(at + 1)) ++at;
    if (!stands_at(at)) return std::nullopt;
    const Token &number = tokens[at - 1], &word = tokens[at];
    static const std::regex suffix("[hHlLdD]|lf|LF"), binary("b[01]{1,31}");
    const std::string text(word.text.substr(0, kLongestNumber));
    std::string help;
    if (std::regex_match(text, suffix)) help = fmt::format("; write {}", number.text);
    if (number.is("0") && std::regex_match(text, binary))
        help = fmt::format("; write {}", std::stoul(text.substr(1), nullptr, 2));
    return SyntaxError{
        fmt::format("{} is no number of GLSL{}", in_quotes(std::string(number.text) + text), help),
        at - 1};
}

// A number as other languages write it, where the complaint is or right before it.
std::optional<SyntaxError> bad_number(std::span<const Token> tokens, std::size_t at) {
    static const std::regex good(R"((0[0-7]*|[1-9]\d*|0[xX][\da-fA-F]+)[uU]?|)"
                                 R"((\d+\.\d*|\.\d+)([eE][+-]?\d+)?[fF]?|\d+[eE][+-]?\d+[fF]?)");
    static const std::regex whole(R"((\d+)[a-zA-Z]+)"), octal(R"(0+(\d+))");
    for (const std::size_t i : {at, at - 1}) {
        if (i >= tokens.size() || tokens[i].kind != TokenKind::number) continue;
        // Matching takes stack for every character.
        const std::string text(tokens[i].text.substr(0, kLongestNumber));
        if (std::regex_match(text, good)) continue;
        std::smatch m;
        std::string help;
        if (std::regex_match(text, m, octal))
            help = fmt::format("; a leading 0 means octal: write {}", m.str(1));
        else if (std::regex_match(text, m, whole) && text.ends_with("f"))
            help = fmt::format("; write {}.0", m.str(1));
        return SyntaxError{fmt::format("{} is no number of GLSL{}", in_quotes(text), help), i};
    }
    return std::nullopt;
}

}  // namespace

std::optional<SyntaxError> read_syntax_error(std::string_view words, std::span<const Token> tokens,
                                             std::size_t at) {
    const std::optional<Complaint> complaint = parse(words);
    if (!complaint) return std::nullopt;
    if (complaint->unexpected == kEnd) at = tokens.size();
    if (at > tokens.size()) return std::nullopt;
    if (auto error = bad_number(tokens, at)) return error;
    if (auto error = number_and_word(tokens, at)) return error;
    if (at < tokens.size() && !is_told_of(*complaint, tokens[at])) return std::nullopt;
    const Around around(tokens, at);
    if (auto error = unmatched_bracket(*complaint, around, tokens)) return error;
    if (at < tokens.size()) {
        if (auto error = of_cpp(around)) return error;
        if (auto error = unknown_type(*complaint, around, tokens)) return error;
        if (auto error = mistyped_keyword(*complaint, around, tokens)) return error;
        if (auto error = inner_function(around)) return error;
        if (auto error = ended_head(around)) return error;
        if (auto error = cast(around)) return error;
        if (auto error = missing_end(around)) return error;
        if (auto error = without_type(around)) return error;
        if (auto error = misplaced_else(around, tokens)) return error;
        if (auto text = no_member(around)) return SyntaxError{std::move(*text), at};
        if (auto text = wrong_for(around, tokens)) return SyntaxError{std::move(*text), at};
        if (auto text = known_mistake(*complaint, around)) return SyntaxError{std::move(*text), at};
    }
    return missing(*complaint, around);
}

std::string read_preprocessor_error(std::string words) {
    const std::optional<Complaint> complaint = parse(words);
    if (!complaint) return words;
    if (complaint->unexpected == "HASH_TOKEN")
        return complaint->expected.empty()
                   ? "'#' stands at the beginning of a line alone"
                   : "'#' stands at the beginning of a line alone: no macro of GLSL ES makes text "
                     "of its arguments";
    if (complaint->unexpected == "NEWLINE")
        return complaint->expected.empty() ? "the line ends too soon"
                                           : fmt::format("the line ends too soon: {} is missing",
                                                         fmt::join(complaint->expected, " or "));
    if (complaint->expected.empty()) return std::string(kNoCondition);
    const bool ends = complaint->expected == std::vector<std::string>{"the line's end"};
    return fmt::format("{} is expected here{}", fmt::join(complaint->expected, " or "),
                       ends ? kConditionBehind : "");
}

namespace {

// `12`, `0x1Fu`.
bool is_whole_number(std::string_view number) {
    static const std::regex whole("(0[xX][0-9a-fA-F]+|[0-9]+)[uU]?");
    return std::regex_match(number.begin(), number.end(), whole);
}

// The bracket that closes this one; the last token where none does.
std::size_t end_of_brackets(std::span<const Token> tokens, std::size_t at) {
    int open = 0;
    for (; at + 1 < tokens.size(); ++at) {
        open += tokens[at].is("(") ? 1 : tokens[at].is(")") ? -1 : 0;
        if (open == 0) break;
    }
    return at;
}

}  // namespace

const Token* wrong_in_condition(std::span<const Token> condition, std::span<const Macro> macros) {
    constexpr std::string_view kBetween[] = {"||", "&&", "|",  "^",  "&", "==", "!=", "<", ">",
                                             "<=", ">=", "<<", ">>", "*", "/",  "%",  "+", "-"};
    bool awaits_operand = true;
    for (std::size_t i = 0; i < condition.size(); ++i) {
        const Token& token = condition[i];
        const bool is_whole = token.kind == TokenKind::number && is_whole_number(token.text);
        const bool is_sign = token.is("+") || token.is("-");
        bool fits = false, ends_operand = false;
        if (token.is_word() || is_whole || token.is("(") || token.is("!") || token.is("~")) {
            fits = awaits_operand;
            ends_operand = token.is_word() || is_whole;
        } else if (token.is(")")) {
            fits = ends_operand = !awaits_operand;
        } else {
            fits = is_sign || (!awaits_operand && is_one_of(token.text, kBetween));
        }
        if (!fits) return &token;
        awaits_operand = !ends_operand;
        // What stands in the brackets of these is no part of the expression.
        const bool is_bracketed = i + 1 < condition.size() && condition[i + 1].is("(");
        const bool takes_any = token.is("defined") ||
                               std::ranges::find(macros, token.text, &Macro::name) != macros.end();
        if (is_bracketed && takes_any)
            i = end_of_brackets(condition, i + 1);
        else if (token.is("defined"))
            ++i;
    }
    return nullptr;
}

}  // namespace glint
