#include "scene/scene_text.h"

#include "base/words.h"
#include "scene/other_language.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace glint {
Known known_of_scene() {
    Known known = known_of_driver();
    known.macros.push_back({"HW_PERFORMANCE", "1"});
    known.open.emplace_back(kPassPrefix);
    return known;
}

Known known_of_pass(std::span<const std::string> outputs) {
    Known known = known_of_driver();
    known.macros.push_back({"HW_PERFORMANCE", "1"});
    for (const std::string& output : outputs)
        known.macros.push_back({fmt::format("{}{}", kPassPrefix, output), "1"});
    return known;
}

std::string definitions_of_pass(std::span<const std::string> outputs) {
    std::string text = "#define HW_PERFORMANCE 1\n";
    for (const std::string& output : outputs)
        text += fmt::format("#define {}{} 1\n", kPassPrefix, output);
    return text;
}

std::vector<Tab> find_tabs(const Reading& reading) {
    std::vector<Tab> tabs;
    for (const Branch& branch : reading.branches) {
        const Directive& directive = reading.directives[branch.begins];
        if (directive.word != "ifdef" && directive.word != "if") continue;
        TokenRange rest = directive.rest;
        while (!rest.empty() &&
               (reading.written[rest.begin].is("defined") || reading.written[rest.begin].is("(")))
            ++rest.begin;
        const std::string_view name = rest.empty() ? "" : reading.written[rest.begin].text;
        if (name.starts_with(kPassPrefix))
            tabs.push_back({reading.inside(branch), name.substr(kPassPrefix.size())});
    }
    return tabs;
}

namespace {

UniformName name_of(const Reading& reading, const Declaration& declaration, const Declarator& one) {
    // `float[4] name` makes each name an array.
    const TokenRange array = one.array.empty() ? declaration.type_array : one.array;
    UniformName name;
    name.name = reading.word(one.name);
    name.is_array = !array.empty();
    if (name.is_array) name.array = reading.spelled({array.begin + 1, array.end - 1});
    name.has_initial = !one.initial.empty();
    name.span = {reading.place(one.name).begin, reading.place(one.tokens.end).begin};
    return name;
}

Uniform uniform_of(const Reading& reading, const Declaration& declaration) {
    Uniform uniform;
    uniform.span = reading.place(declaration.tokens);
    uniform.is_plain = reading.is_plain(declaration.tokens);
    uniform.is_block = declaration.structure != kNone;
    uniform.is_broken = !reading.stands_alone(declaration.tokens);
    uniform.type = reading.word(declaration.type);
    uniform.type_at =
        declaration.type == kNone ? uniform.span.begin : reading.place(declaration.type).begin;
    for (const Declarator& one : declaration.names)
        uniform.names.push_back(name_of(reading, declaration, one));
    return uniform;
}

}  // namespace

// Behind `uniform float a`, where a line ends so.
static std::optional<std::size_t> missing_semicolon(const Reading& reading, TokenRange range) {
    constexpr std::uint32_t kLeast = 3;  // words
    std::uint32_t at = range.begin;
    while (at < range.end && reading.tokens[at].is_word()) {
        const std::size_t end = reading.place(at++).end;
        const std::size_t next =
            at < reading.tokens.size() ? std::max(reading.place(at).begin, end) : end;
        const bool ends_line = reading.text.substr(end, next - end).find('\n') != std::string::npos;
        if (ends_line && at - range.begin >= kLeast) return end;
        if (ends_line) break;
    }
    return std::nullopt;
}

std::vector<Uniform> find_uniforms(const Reading& reading) {
    std::vector<Uniform> uniforms;
    for (const Item& item : reading.items) {
        if (item.kind == Item::Kind::declaration) {
            const Declaration& declaration = reading.declarations[item.index];
            if (declaration.is_uniform) uniforms.push_back(uniform_of(reading, declaration));
            continue;
        }
        for (std::uint32_t at = item.tokens.begin;
             item.kind == Item::Kind::unknown && at < item.tokens.end; ++at) {
            if (!reading.tokens[at].is("uniform")) continue;
            Uniform broken;
            broken.span = reading.place({at, item.tokens.end});
            broken.type_at = broken.span.begin;
            broken.is_broken = true;
            broken.no_semicolon = missing_semicolon(reading, {at, item.tokens.end});
            uniforms.push_back(broken);
            break;
        }
    }
    return uniforms;
}

std::vector<Span> find_notes(const Reading& reading) {
    std::vector<Span> notes;
    for (const Comment& comment : reading.comments) {
        const auto [begin, end] = comment.span;
        if (!comment.is_line || reading.live_at(begin) == Live::no) continue;
        const std::string_view words = reading.text.substr(begin, end - begin);
        const std::size_t allow = std::min(words.find("//@ allow"), words.size());
        if (allow > 0 && words.starts_with("//@")) notes.push_back({begin + 3, begin + allow});
        if (allow < words.size()) notes.push_back({begin + allow + 3, end});
    }
    return notes;
}

std::optional<std::vector<std::string_view>> parse_allow(std::string_view note) {
    std::vector<std::string_view> words;
    constexpr std::string_view kBetween = " \t,";
    for (std::size_t at = note.find_first_not_of(kBetween); at < note.size();) {
        const std::size_t end = std::min(note.find_first_of(kBetween, at), note.size());
        words.push_back(note.substr(at, end - at));
        at = note.find_first_not_of(kBetween, end);
    }
    if (words.empty() || words.front() != "allow") return std::nullopt;
    words.erase(words.begin());
    return words;
}

std::vector<std::string> find_pass_functions(const Reading& reading) {
    std::vector<std::string> names;
    for (const Function& function : reading.functions) {
        if (reading.word(function.type) != "void" || function.parameters.empty()) continue;
        const Declaration& first = reading.declarations[function.parameters.front()];
        const std::string name(reading.word(function.name));
        if (first.is_out && reading.word(first.type) == "vec4" &&
            std::ranges::find(names, name) == names.end())
            names.push_back(name);
    }
    return names;
}

namespace {

// False only where the type is another one of the language's own.
bool may_be(std::string_view type, std::string_view wanted) {
    constexpr std::string_view kOthers[] = {"void",  "float", "int",  "uint",  "bool",
                                            "vec2",  "vec3",  "vec4", "ivec2", "ivec3",
                                            "ivec4", "mat2",  "mat3", "mat4"};
    return type == wanted || std::ranges::find(kOthers, type) == std::end(kOthers);
}

bool can_be_called(const Reading& reading, const Function& function, const PassCall& call) {
    if (!may_be(reading.word(function.type), "void")) return false;
    if (function.parameters.size() != call.outputs.size() + (call.cube ? 3 : 1)) return false;
    for (std::size_t i = 0; i < function.parameters.size(); ++i) {
        const Declaration& parameter = reading.declarations[function.parameters[i]];
        const bool is_output = i < call.outputs.size();
        const char* type = is_output ? "vec4" : i == call.outputs.size() ? "vec2" : "vec3";
        if (parameter.is_out != is_output || !may_be(reading.word(parameter.type), type))
            return false;
    }
    return true;
}

}  // namespace

std::string signature(const PassCall& call) {
    std::string out;
    for (const std::string& name : call.outputs) out += fmt::format("out vec4 {}, ", name);
    return fmt::format("void {}({}in vec2 coord{})", call.entry, out,
                       call.cube ? ", in vec3 rayOri, in vec3 rayDir" : "");
}

std::optional<Span> find_uncallable(const Reading& reading, const PassCall& call) {
    std::optional<Span> first;
    for (const Function& function : reading.functions) {
        if (!function.is_defined() || reading.word(function.name) != call.entry) continue;
        if (can_be_called(reading, function, call)) return std::nullopt;
        if (!first) first = reading.place(function.name);
    }
    return first;
}

bool has_sound(const Reading& reading, const std::unordered_set<std::string_view>& words) {
    const auto is_named_so = [&](const Declaration& declaration) {
        return std::ranges::any_of(declaration.names, [&](const Declarator& one) {
            return reading.word(one.name) == "mainSound";
        });
    };
    if (!reading.functions_named("mainSound").empty()) return true;
    const bool is_understood = reading.is_balanced && reading.not_understood.empty();
    return !is_understood && words.contains("mainSound") &&
           std::ranges::none_of(reading.declarations, is_named_so);
}

std::optional<Span> find_wrong_sound(const Reading& reading) {
    std::optional<Span> first;
    for (const std::uint32_t at : reading.functions_named("mainSound")) {
        const Function& function = reading.functions[at];
        std::vector<std::string_view> types;
        bool gives_back = false;
        for (const std::uint32_t parameter : function.parameters) {
            gives_back |= reading.declarations[parameter].is_out;
            types.push_back(reading.word(reading.declarations[parameter].type));
        }
        const bool is_right = types.size() == 1 ? may_be(types[0], "float")
                              : types.size() == 2
                                  ? may_be(types[0], "int") && may_be(types[1], "float")
                                  : false;
        if (is_right && !gives_back && may_be(reading.word(function.type), "vec2"))
            return std::nullopt;
        if (!first) first = reading.place(function.name);
    }
    return first;
}

std::optional<Token> find_strange(const Reading& reading) {
    const auto found = std::ranges::find(reading.tokens, TokenKind::strange, &Token::kind);
    return found == reading.tokens.end() ? std::nullopt : std::optional(*found);
}

std::string about_strange(const Reading& reading, const Token& token) {
    if (token.text == "@" || token.text == "\"")
        if (auto other = other_language(reading)) return std::move(other->text);
    if (token.text == "\"") return "GLSL has no words in quotation marks; take them out";
    if (token.text == "`")
        return "GLSL has no `; take out what a text had round it where it was copied";
    const auto lead = static_cast<unsigned char>(token.text.front());
    if (lead < 0x20) return fmt::format("GLSL has no control character {}; take it out", lead);
    if (token.text == "\\") {
        const std::size_t next = reading.text.find_first_not_of(" \t\r", token.end);
        if (next < reading.text.size() && reading.text[next] == '\n')
            return "a line goes on behind a '\\' at its very end alone: take out the spaces behind "
                   "it";
    }
    if (lead < 0x80) return fmt::format("GLSL has no {}; take it out", in_quotes(token.text));
    char32_t code = lead & (0x7F >> token.text.size());
    for (const char c : token.text.substr(1)) code = code << 6 | (c & 0x3F);
    constexpr std::pair<char32_t, std::string_view> kAlike[] = {
        {U'\u037E', ";"}, {U'\u0430', "a"},  {U'\u0435', "e"},  {U'\u043E', "o"},
        {U'\u0440', "p"}, {U'\u0441', "c"},  {U'\u0443', "y"},  {U'\u0445', "x"},
        {U'\u0456', "i"}, {U'\uFB01', "fi"}, {U'\uFB02', "fl"}, {U'\u2010', "-"},
        {U'\u2011', "-"}, {U'\u2013', "-"},  {U'\u2014', "-"},  {U'\u2212', "-"},
        {U'\u00D7', "*"}, {U'\u00B7', "*"},  {U'\u22C5', "*"},  {U'\u00F7', "/"},
        {U'\u2044', "/"}, {U'\u2264', "<="}, {U'\u2265', ">="}, {U'\u2260', "!="}};
    std::string meant;
    for (const auto& [other, sign] : kAlike)
        if (code == other) meant = sign;
    if (code > U'\uFF00' && code < U'\uFF5F')  // as wide as the signs of Chinese and Japanese
        meant = static_cast<char>(code - 0xFEE0);
    if (!meant.empty())
        return fmt::format("GLSL has no {} (U+{:04X}) but in comments; write {}",
                           in_quotes(token.text), static_cast<std::uint32_t>(code), meant);
    if (code == U'\uFFFD') return "this byte is not UTF-8; save the file as UTF-8";
    return fmt::format(
        "GLSL has no {} (U+{:04X}) but in comments; write a plain space, a plain "
        "letter, or nothing here",
        in_quotes(token.text), static_cast<std::uint32_t>(code));
}

std::pair<std::size_t, std::string> about_open_condition(const Reading& reading) {
    const std::vector<std::string> kEnd = {"endif"};
    for (const Directive& one : reading.directives)
        if (one.word != "endif" && (one.word == "end" || !did_you_mean(one.word, kEnd).empty()))
            return {one.span.begin, "this was to be #endif, which ends an #if"};
    return {*reading.open_condition, "this #if is never ended; write #endif behind its part"};
}

std::string no_pass_function(const Reading& reading, const Pass& pass) {
    constexpr std::size_t kMostNames = 12;
    const std::vector<std::string> functions = find_pass_functions(reading);
    const std::size_t named = std::min(functions.size(), kMostNames);
    std::string names;
    for (std::size_t i = 0; i < named; ++i) names += (i > 0 ? ", " : "") + functions[i];
    const std::string here =
        functions.empty()
            ? fmt::format("; write {} {{ … }}", signature({pass.entry, {"color"}, pass.cube}))
            : fmt::format(" among {}{}{}", names, functions.size() > named ? ", …" : "",
                          did_you_mean(pass.entry, functions));
    return fmt::format("there is no function {}{} (a tab, within #ifdef PASS_{}, has mainImage)",
                       in_quotes(pass.entry), here, pass.name);
}

std::unordered_set<std::string_view> find_words(const Reading& reading) {
    std::unordered_set<std::string_view> words;
    for (const Token& token : reading.written)
        if (token.is_word() && reading.live_at(token.begin) != Live::no) words.insert(token.text);
    return words;
}

std::string what_fills(std::string_view type, bool is_array) {
    if (type == "samplerCube") return "say what fills it, such as //@ cube sky.hdr";
    if (type == "sampler3D") return "say what fills it, such as //@ volume clouds.bin";
    if (type.find("sampler") != type.npos)
        return "say what fills it, such as //@ pass mainWaves or //@ image wood.png";
    constexpr std::pair<std::string_view, const char*> kExamples[] = {
        {"float", "0.5 [0, 1]"}, {"int", "3 [0, 10]"},      {"bool", "on"},
        {"vec2", "0.5, 0.5"},    {"vec3", "0.5, 0.5, 0.5"}, {"vec4", "0.5, 0.5, 0.5, 1"}};
    const auto example =
        std::ranges::find(kExamples, type, &std::pair<std::string_view, const char*>::first);
    if (is_array || example == std::end(kExamples))
        return "nothing fills one of its type here: take 'uniform' out, and give it its values";
    return fmt::format("say what fills it, such as //@ {} \"what it does\"", example->second);
}

Place Scene::place(int line, int column) const {
    if (files.empty()) return {};
    if (line < 1 || origins.empty()) return {files.front().string()};
    const std::size_t index = std::min(static_cast<std::size_t>(line), origins.size()) - 1;
    return {files[origins[index].file].string(), origins[index].line, column};
}

Place Scene::place_at(std::size_t offset) const {
    const std::string_view before = std::string_view(text).substr(0, offset);
    const auto line = std::ranges::count(before, '\n');
    const std::string_view head = before.substr(before.rfind('\n') + 1);
    const auto column = std::ranges::count_if(head, begins_character);
    return place(static_cast<int>(line) + 1, static_cast<int>(column) + 1);
}

}  // namespace glint
