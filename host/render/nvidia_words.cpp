#include "render/nvidia_words.h"

#include "glsl/parser.h"
#include "render/advice.h"
#include "render/around.h"
#include "render/syntax_error.h"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <functional>
#include <regex>
#include <string_view>
#include <utility>
#include <vector>

namespace glint {
namespace {

using IsMeant = std::function<bool(std::size_t token)>;

// The tokens of a line, and what stands round them.
class Line {
public:
    Line(std::span<const Token> tokens, TokenRange range) : tokens_(tokens), range_(range) {}

    std::string_view text(std::size_t token) const {
        return token < tokens_.size() ? tokens_[token].text : "";
    }
    std::optional<std::size_t> first(const IsMeant& is_meant) const {
        for (std::size_t i = range_.begin; i < range_.end; ++i)
            if (is_meant(i)) return i;
        return std::nullopt;
    }
    std::optional<std::size_t> first(std::string_view spelling) const {
        return first([&](std::size_t i) { return text(i) == spelling; });
    }
    // Where it stands once.
    std::optional<std::size_t> only(const IsMeant& is_meant) const {
        const auto one = first(is_meant);
        const auto other = first([&](std::size_t i) { return one && i > *one && is_meant(i); });
        return other ? std::nullopt : one;
    }

    bool is_number(std::size_t i) const {
        return i < tokens_.size() && tokens_[i].kind == TokenKind::number;
    }
    bool is_float(std::size_t i) const {
        const std::string_view number = text(i);
        const bool is_hex = number.starts_with("0x") || number.starts_with("0X");
        return is_number(i) && !is_hex && number.find_first_of(".eEfF") != number.npos;
    }
    bool is_name(std::size_t i) const {
        return i < tokens_.size() && tokens_[i].is_word() && !is_keyword(text(i)) &&
               !is_type_of_glsl(text(i)) && !is_qualifier_of_glsl(text(i));
    }
    // Whether a value ends there.
    bool ends_value(std::size_t i) const {
        return is_number(i) || is_name(i) || text(i) == ")" || text(i) == "]";
    }
    // The bracket that is open before a token, and the word before that; "" where there is none.
    std::pair<std::string_view, std::string_view> open_before(std::size_t token) const {
        std::vector<std::size_t> open;
        for (std::size_t i = 0; i < token && i < tokens_.size(); ++i) {
            const std::string_view one = text(i);
            if (one == "(" || one == "[" || one == "{") open.push_back(i);
            if ((one == ")" || one == "]" || one == "}") && !open.empty()) open.pop_back();
        }
        if (open.empty()) return {};
        return {text(open.back()), text(open.back() - 1)};
    }
    std::size_t end_of_text() const { return tokens_.size(); }

private:
    std::span<const Token> tokens_;
    TokenRange range_;
};

// ---- "syntax error, unexpected X, expecting Y or Z at token "T"" --------------------------------

// A kind of token as Mesa's grammar names it; "" for what tells a person nothing.
std::string kind_in_mesa(std::string_view kind) {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 9> kKinds = {{
        {"identifier", "IDENTIFIER"},
        {"type identifier", "IDENTIFIER"},
        {"template identifier", ""},
        {"integer constant", "INTCONSTANT"},
        {"unsigned integer constant", "UINTCONSTANT"},
        {"floating point constant", "FLOATCONSTANT"},
        {"\"::\"", ""},
        {"$end", "end of file"},
        {"<EOF>", "end of file"},
    }};
    for (const auto& [nvidia, mesa] : kKinds)
        if (kind == nvidia) return std::string(mesa);
    static const std::regex reserved("reserved word \"(.*)\"");
    std::cmatch m;
    if (std::regex_match(kind.begin(), kind.end(), m, reserved)) return "'" + m.str(1) + "'";
    return std::string(kind);
}

std::string expected_in_mesa(std::string_view list) {
    std::string said;
    while (!list.empty()) {
        const std::size_t end = std::min(list.find(" or "), list.size());
        const std::string kind = kind_in_mesa(list.substr(0, end));
        if (!kind.empty()) said += (said.empty() ? ", expecting " : " or ") + kind;
        list.remove_prefix(std::min(end + 4, list.size()));
    }
    return said;
}

// To NVIDIA a name that is no type is a value: it complains of what stands behind the next name.
std::optional<std::size_t> name_behind_unknown_type(const Line& line, std::size_t at) {
    for (const std::size_t name : {at, at + 1, at - 1})
        if (line.is_name(name) && line.is_name(name - 1) && may_declare_behind(line.text(name - 2)))
            return name;
    return std::nullopt;
}

// Of the tokens on the line that are so spelled, or of such a kind, the one that is out of place.
std::optional<std::size_t> out_of_place(const Line& line, const std::string& kind,
                                        std::string_view spelling) {
    const auto fits = [&](std::size_t i) {
        if (!spelling.starts_with('<') || spelling.size() < 3) return line.text(i) == spelling;
        if (kind == "FLOATCONSTANT") return line.is_float(i);
        return kind.ends_with("CONSTANT") && line.is_number(i) && !line.is_float(i);
    };
    const auto is_wrong = [&](std::size_t i) {
        const std::string_view one = line.text(i);
        if (one == ")" || one == "]" || one == "}") {
            return line.open_before(i).first != (one == ")" ? "(" : one == "]" ? "[" : "{");
        }
        const auto [open, opened_by] = line.open_before(i);
        if (one == ";" && open == "(" && opened_by != "for") return true;
        const std::string_view before = line.text(i - 1);
        if (line.is_number(i) || line.is_name(i))
            return line.ends_value(i - 1) || before == "if" || before == "while";
        return name_behind_unknown_type(line, i) || !(line.ends_value(i - 1) || before == "}");
    };
    if (const auto one = line.first([&](std::size_t i) { return fits(i) && is_wrong(i); }))
        return one;
    return line.first(fits);
}

std::optional<NvidiaComplaint> read_syntax(const std::string& words, const Line& line) {
    static const std::regex said(
        R"re(^syntax error, unexpected (.*?)(?:, expecting (.*?))?(?: at token "(.*)")?$)re");
    std::smatch m;
    if (!std::regex_match(words, m, said)) return std::nullopt;
    const std::string kind = kind_in_mesa(m.str(1)), spelling = m.str(3);
    const std::string expected = expected_in_mesa(m.str(2));
    if (kind == "end of file" || spelling == "<EOF>")
        return NvidiaComplaint{"syntax error, unexpected end of file" + expected,
                               line.end_of_text()};
    const auto at = out_of_place(line, kind, spelling);
    if (!at) return NvidiaComplaint{words, std::nullopt};
    if (const auto name = name_behind_unknown_type(line, *at))
        return NvidiaComplaint{"syntax error, unexpected IDENTIFIER", name};
    const std::string unexpected =
        kind.ends_with("IDENTIFIER") || kind.ends_with("CONSTANT") ? kind : "'" + spelling + "'";
    return NvidiaComplaint{"syntax error, unexpected " + unexpected + expected, at};
}

// ---- Others -------------------------------------------------------------------------------------

NvidiaComplaint of_unknown(const std::string& name, const Line& line) {
    const auto at = line.first(name);
    if (at && line.text(*at + 1) == "(")
        return {fmt::format("no function with name '{}'", name), at};
    return {fmt::format("`{}' undeclared", name), at};
}

NvidiaComplaint of_call(const std::string& name, std::string types, const Line& line) {
    types = std::regex_replace(types, std::regex("\\b(?:lowp|mediump|highp) "), "");
    return {
        fmt::format("no matching function for call to `{}({})'", name, types),
        line.first([&](std::size_t i) { return line.text(i) == name && line.text(i + 1) == "("; })};
}

NvidiaComplaint of_types(const std::string& given, const std::string& wanted, const Line& line) {
    const auto is_given = [&](std::size_t i) {
        return line.is_number(i) && line.is_float(i) == (given == "float");
    };
    return {fmt::format(kTypeForAnother, given, wanted), line.only(is_given)};
}

struct Form {
    std::regex said;
    std::function<NvidiaComplaint(const std::smatch& m, const Line& line)> read;
};

// Of a number as other languages write it; read_syntax_error says which.
NvidiaComplaint of_number(const char* kind, const Line& line) {
    const auto is_strange = [&](std::size_t i) {
        const std::string_view text = line.text(i);
        const bool is_octal = text.size() > 1 && text[0] == '0' &&
                              std::isdigit(static_cast<unsigned char>(text[1])) != 0;
        const bool is_bare = text.find('.') == text.npos && line.is_float(i);
        return line.is_number(i) && (is_octal || is_bare);
    };
    return {std::string("syntax error, unexpected ") + kind, line.first(is_strange)};
}

NvidiaComplaint of_function_within(const std::string& function, const Line& line) {
    const auto name = line.first(function);
    return {std::string(kInnerFunction), name && *name > 0 ? std::optional(*name - 1) : name};
}

NvidiaComplaint of_word_as_name(const Line& line) {
    const auto word = line.first([&](std::size_t i) {
        return is_qualifier_of_glsl(line.text(i)) && is_type_of_glsl(line.text(i - 1));
    });
    const std::string name(word ? line.text(*word) : "it");
    return {fmt::format("'{}' is a word of GLSL, and a name is expected", name), word};
}

const std::vector<Form>& forms() {
    using Match = const std::smatch&;
    static const std::vector<Form> list = {
        {std::regex(
             R"re((?:undefined variable "|OpenGL does not define the global function )(\w+)"?)re"),
         [](Match m, const Line& line) { return of_unknown(m[1], line); }},
        {std::regex(R"re(OpenGL does not define the global type (\w+))re"),
         [](Match m, const Line& line) {
             return NvidiaComplaint{
                 fmt::format("'{}' is no type{}", m.str(1), advice_on_foreign_type(m.str(1))),
                 line.first(m.str(1))};
         }},
        {std::regex(R"re(unable to find compatible overloaded function "(\w+)\((.*)\)")re"),
         [](Match m, const Line& line) { return of_call(m[1], m[2], line); }},
        {std::regex(R"re(implicit cast from "(\w+)" to "(\w+)")re"),
         [](Match m, const Line& line) { return of_types(m[1], m[2], line); }},
        {std::regex(R"re(swizzle mask element not present in operand "(\w+)")re"),
         [](Match m, const Line& line) {
             return NvidiaComplaint{fmt::format("invalid swizzle / mask `{}'", m.str(1)),
                                    line.first(m.str(1))};
         }},
        {std::regex(R"re(operands to "(\S+)" must be integral)re"),
         [](Match m, const Line& line) {
             return NvidiaComplaint{
                 fmt::format("each operand of operator {} must be an integer", m.str(1)),
                 line.first(m.str(1))};
         }},
        {std::regex("invalid digit .* in octal constant"),
         [](Match, const Line& line) { return of_number("INTCONSTANT", line); }},
        {std::regex("floating point constant must have exponent when no .*"),
         [](Match, const Line& line) { return of_number("FLOATCONSTANT", line); }},
        {std::regex(R"re((\w+): function declaration in non global scope not allowed)re"),
         [](Match m, const Line& line) { return of_function_within(m[1], line); }},
        {std::regex(R"re(OpenGL does not allow '\w+' after a type specifier)re"),
         [](Match, const Line& line) { return of_word_as_name(line); }},
        {std::regex("expression type incompatible with function return type"),
         [](Match m, const Line& line) {
             return NvidiaComplaint{m.str(0), line.first("return")};
         }},
        {std::regex("not unrolling loop that .*"),  // a hint to who writes compilers
         [](Match, const Line&) { return NvidiaComplaint{}; }},
    };
    return list;
}

}  // namespace

NvidiaComplaint read_nvidia(std::string words, std::span<const Token> tokens, TokenRange range) {
    const Line line(tokens, range);
    if (auto syntax = read_syntax(words, line)) return std::move(*syntax);
    for (const Form& form : forms()) {
        std::smatch m;
        if (std::regex_match(words, m, form.said)) return form.read(m, line);
    }
    return {std::move(words), std::nullopt};
}

}  // namespace glint
