#include "scene/own_main.h"

#include "base/diagnostic.h"
#include "scene/other_language.h"
#include "scene/scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <span>
#include <utility>

namespace glint {
namespace {

bool is_at_another_location(const Reading& reading, TokenRange qualifiers) {
    for (std::uint32_t at = qualifiers.begin; at + 2 < qualifiers.end; ++at)
        if (reading.tokens[at].is("location") && reading.tokens[at + 1].is("="))
            return reading.tokens[at + 2].kind == TokenKind::number &&
                   std::strtol(reading.tokens[at + 2].text.data(), nullptr, 0) != 0;
    return false;
}

bool writes_plain_colour(const Reading& reading) {
    return reading.mentions("gl_FragColor") || reading.mentions("gl_FragData");
}

// Behind what a person forgot it, outside of functions: a declaration that goes on with the head of
// the next, on another line.
std::optional<std::size_t> missing_semicolon(const Reading& reading) {
    constexpr std::string_view kHeads[] = {"in",     "out",       "uniform",   "varying",
                                           "layout", "precision", "attribute", "const"};
    constexpr std::string_view kNext[] = {"in",     "out",       "uniform", "varying", "void",
                                          "layout", "precision", "const",   "struct",  "float",
                                          "vec2",   "vec3",      "vec4",    "#"};
    constexpr std::string_view kPrecisions[] = {"highp", "mediump", "lowp"};
    const auto is_one_of = [](const Token& token, std::span<const std::string_view> words) {
        return std::ranges::find(words, token.text) != words.end();
    };
    int depth = 0;
    bool is_head = false;  // of a declaration that has not ended
    for (std::size_t i = 0; i < reading.tokens.size(); ++i) {
        const Token& token = reading.tokens[i];
        const bool is_behind = i > 0 &&
                               (reading.tokens[i - 1].is_word() || reading.tokens[i - 1].is("]")) &&
                               !is_one_of(reading.tokens[i - 1], kHeads) &&
                               !is_one_of(reading.tokens[i - 1], kPrecisions);
        if (depth == 0 && is_head && is_behind && token.begins_line && is_one_of(token, kNext))
            return reading.place(static_cast<std::uint32_t>(i - 1)).end;
        const bool begins =
            i == 0 || reading.tokens[i - 1].is(";") || reading.tokens[i - 1].is("}");
        if (depth == 0 && begins) is_head = is_one_of(token, kHeads);
        depth += token.is("{") || token.is("(") ? 1 : token.is("}") || token.is(")") ? -1 : 0;
    }
    return std::nullopt;
}

NoPicture no_semicolon(std::size_t at) {
    return {at, "';' is missing here"};
}

// Of which a driver says more.
bool is_misread(const Reading& reading) {
    return !reading.is_balanced || !reading.not_understood.empty();
}

// `out vec colour;`, of which a driver says that there is no such type.
bool has_unknown_output(const Reading& reading) {
    constexpr std::string_view kOthers[] = {"float", "int",   "uint",  "vec2",  "ivec2",
                                            "ivec3", "ivec4", "uvec2", "uvec3", "uvec4"};
    return std::ranges::any_of(reading.declarations, [&](const Declaration& one) {
        return one.scope == Scope::global && one.is_out && one.structure == kNone &&
               !reading.word(one.type).starts_with("vec3") &&
               !reading.word(one.type).starts_with("vec4") &&
               std::ranges::find(kOthers, reading.word(one.type)) == std::end(kOthers);
    });
}

// `layout(location 0)`, `layout(locatoin = 0)`: of an output, whose layout no driver sees.
std::optional<std::size_t> bad_layout(const Reading& reading) {
    const std::string known[] = {"location"};
    for (const Declaration& one : reading.declarations) {
        const TokenRange words = one.qualifiers;
        if (one.scope != Scope::global || !one.is_out || words.empty() ||
            !reading.tokens[words.begin].is("layout"))
            continue;
        for (std::uint32_t at = words.begin; at + 2 < words.end; ++at) {
            const Token &token = reading.tokens[at], &next = reading.tokens[at + 1],
                        &value = reading.tokens[at + 2];
            const bool is_mistyped =
                token.is_word() && !token.is("location") && !nearest(token.text, known).empty();
            const bool has_no_value = token.is("location") && (!next.is("=") || value.is(")"));
            if (is_mistyped || has_no_value) return token.span().begin;
        }
    }
    return std::nullopt;
}

// `void main(vec2 p)`, where nothing else may be meant.
std::optional<std::size_t> main_with_parameters(const Reading& reading) {
    for (const std::uint32_t index : reading.functions_named("main"))
        if (reading.functions[index].is_defined())
            return reading.functions[index].parameters.empty()
                       ? std::nullopt
                       : std::optional(reading.place(reading.functions[index].name).begin);
    return std::nullopt;
}

// Of a main() that writes no colour.
std::optional<NoPicture> why_no_colour(const Reading& reading) {
    if (const auto at = bad_layout(reading))
        return NoPicture{*at, "this layout is not understood; write layout(location = 0)"};
    const auto mains = reading.functions_named("main");
    if (const auto at = main_with_parameters(reading))
        return NoPicture{*at,
                         "main() takes nothing; gl_FragCoord.xy is where a pixel stands, or write "
                         "void mainImage(out vec4 fragColor, in vec2 fragCoord)"};
    const bool is_plain = writes_plain_colour(reading) || colour_output(reading);
    if (is_plain ? is_misread(reading) : !mains.empty())
        if (const auto end = missing_semicolon(reading)) return no_semicolon(*end);
    if (is_plain || mains.empty()) return std::nullopt;
    if (is_misread(reading) || has_unknown_output(reading)) return std::nullopt;
    for (const Token& token : reading.tokens)
        if ((token.text.starts_with("gl_F") || token.text.starts_with("gl_f")) &&
            !token.is("gl_FragCoord") && !token.is("gl_FrontFacing") && !token.is("gl_FragDepth"))
            return NoPicture{token.span().begin,
                             fmt::format("no {} is known; did you mean gl_FragColor?", token.text)};
    const std::string_view other =
        reading.mentions("gl_Position")             ? "this main() is of a vertex shader"
        : reading.mentions("gl_GlobalInvocationID") ? "this main() is of a compute shader"
                                                    : "this main() writes no colour";
    return NoPicture{reading.place(reading.functions[mains.front()].name).begin,
                     std::string(other) +
                         "; a picture is drawn by one that writes gl_FragColor, or a variable that "
                         "is declared by out vec4 before it"};
}

}  // namespace

bool has_own_main(const Reading& reading) {
    const auto mains = reading.functions_named("main");
    if (!reading.mentions("mainImage"))
        return writes_plain_colour(reading) || !mains.empty() ||
               (is_misread(reading) && reading.mentions("main"));
    return !mains.empty() && reading.functions[mains.front()].is_defined() &&
           (writes_plain_colour(reading) || colour_output(reading));
}

bool is_of_gl(const Reading& reading, const Declaration& declaration) {
    return declaration.scope == Scope::global && declaration.names.size() == 1 &&
           (declaration.is_out || is_input(reading, declaration)) &&
           reading.word(declaration.names.front().name).starts_with("gl_Frag");
}

bool is_of_older_glsl(const Reading& reading) {
    return writes_plain_colour(reading) && !colour_output(reading);
}

const Declaration* colour_output(const Reading& reading) {
    for (const Declaration& declaration : reading.declarations) {
        const std::string_view type = reading.word(declaration.type);
        const bool is_colour = type == "vec4" || type == "vec3";
        if (declaration.scope == Scope::global && declaration.is_out && is_colour &&
            declaration.names.size() == 1 && !is_of_gl(reading, declaration) &&
            declaration.names.front().array.empty() &&
            !is_at_another_location(reading, declaration.qualifiers))
            return &declaration;
    }
    return nullptr;
}

bool is_coordinate_name(std::string_view name) {
    std::string letters;
    for (const char c : name)
        if (c != '_') letters += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    constexpr std::string_view kWords[] = {"uv", "texcoord", "texturecoord", "fragnormcoord"};
    return std::ranges::any_of(
        kWords, [&](std::string_view word) { return letters.find(word) != std::string::npos; });
}

static bool is_place_type(std::string_view type) {
    return type == "vec2" || type == "vec3" || type == "vec4";
}

std::ptrdiff_t times_named(const Reading& reading, std::string_view word) {
    return std::ranges::count_if(reading.tokens, [&](const Token& t) { return t.is(word); });
}

bool is_input(const Reading& reading, const Declaration& declaration) {
    if (declaration.scope != Scope::global) return false;
    const TokenRange words = declaration.qualifiers;
    for (std::uint32_t at = words.begin; at < words.end; ++at)
        if (reading.tokens[at].is("varying") || reading.tokens[at].is("in")) return true;
    return false;
}

std::optional<std::vector<std::uint32_t>> fed_input(const Reading& reading,
                                                    const Declaration& declaration) {
    if (!is_input(reading, declaration) || declaration.is_block) return std::nullopt;
    const Declaration* size = reading.find_global("iResolution");
    const bool is_place_known = !size || is_place_type(reading.word(size->type));
    std::vector<std::uint32_t> fed;
    for (const Declarator& one : declaration.names) {
        const std::string_view name = reading.word(one.name);
        const bool is_place = is_place_known && is_place_type(reading.word(declaration.type)) &&
                              one.array.empty() && declaration.type_array.empty() &&
                              is_coordinate_name(name);
        const bool is_read = times_named(reading, name) > 1;
        if (is_place)
            fed.push_back(one.name);
        else if (is_read)
            return std::nullopt;
    }
    return fed;
}

OwnMain own_main_for(const Reading& all, std::span<const std::string> outputs) {
    const auto of = [](const Reading& reading) {
        return has_own_main(reading) ? OwnMain{true, why_no_colour(reading)} : OwnMain();
    };
    const bool has_parts = all.text.find(kPassPrefix) != all.text.npos;
    if (!has_parts || !all.mentions("main")) return of(all);
    return of(read_glsl(all.text, known_of_pass(outputs)));
}

NoPicture why_no_picture(const Reading& reading) {
    if (auto other = other_language(reading)) return {other->at, std::move(other->text)};
    if (const auto end = missing_semicolon(reading)) return no_semicolon(*end);
    const bool is_plain = writes_plain_colour(reading) || colour_output(reading);
    const std::string own[] = {is_plain ? "main" : "mainImage"};
    constexpr std::string_view kElsewhere[] = {"main", "Main", "fragment", "frag"};
    for (const Function& function : reading.functions) {
        const std::string_view name = reading.word(function.name);
        if (!nearest(name, own).empty() ||
            std::ranges::find(kElsewhere, name) != std::end(kElsewhere))
            return {reading.place(function.name).begin,
                    fmt::format("there is no {} here; did you mean this one?", own[0])};
    }
    if (is_plain) {
        const auto at =
            std::ranges::find_if(reading.tokens, [](const Token& t) { return t.is("main"); });
        if (at != reading.tokens.end())
            return {at->begin, "this main is no function; write void main() { \u2026 }"};
        return {std::nullopt, "there is no main() here, which would draw the picture; write one"};
    }
    for (const Comment& comment : reading.comments)
        if (const std::string_view words =
                reading.text.substr(comment.span.begin, comment.span.end - comment.span.begin);
            comment.is_line && words.find('\n') != words.npos && words.find("main") != words.npos)
            return {
                comment.span.begin,
                "there is no mainImage here: the '\\' at the end of this comment makes the next "
                "line one, too; put something behind it"};
    return {std::nullopt,
            fmt::format("{}; write void mainImage(out vec4 fragColor, in vec2 fragCoord) {{ "
                        "fragColor = vec4(fragCoord / iResolution.xy, 0.0, 1.0); }}",
                        reading.written.empty() ? "this file holds no shader"
                                                : "there is no mainImage here")};
}

}  // namespace glint
