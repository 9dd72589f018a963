#include "render/own_main_text.h"

#include "render/pass_text.h"
#include "scene/own_main.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace glint {
namespace {

// Declared here, before names and macros of the text.
std::string texture_coordinates(const Reading& reading) {
    std::string variables, values;
    for (const Declaration& declaration : reading.declarations) {
        if (!is_texture_coordinate(reading, declaration)) continue;
        const std::string_view name = reading.word(declaration.names.front().name);
        variables += fmt::format("vec2 {} = vec2(0.0);\n", name);
        values += fmt::format(" {} = p / iResolution.xy;", name);
    }
    if (variables.empty()) return {};
    return fmt::format("{}void glint_place(vec2 p) {{{} }}\n", variables, values);
}

}  // namespace

void put_in_place_of_data(const Reading& reading, Edits& edits) {
    const auto& tokens = reading.written;
    for (std::size_t i = 0; i + 3 < tokens.size(); ++i) {
        if (!tokens[i].is("gl_FragData") || !tokens[i + 1].is("[") || !tokens[i + 2].is("0") ||
            !tokens[i + 3].is("]"))
            continue;
        const Span all{tokens[i].span().begin, tokens[i + 3].span().end};
        std::string name(kPlainColour);
        name.resize(std::max(name.size(), all.end - all.begin), ' ');  // so that no column moves
        edits.replace_bytes(all, name);
    }
}

// Names of GLSL itself cannot be macros; others stand for them. Of GLSL ES 3.00 a text of the older
// one may define functions itself, and use its words.
std::string before_own_main(const Reading& reading, bool plain_main) {
    constexpr std::array<std::string_view, 16> kNewerFunctions = {
        "round",        "roundEven", "trunc",     "sinh",       "cosh",  "tanh",
        "asinh",        "acosh",     "atanh",     "isnan",      "isinf", "modf",
        "outerProduct", "inverse",   "transpose", "determinant"};
    constexpr std::string_view kNewerWords[] = {
        "sample",   "filter",   "common",    "partition",  "active",
        "resource", "patch",    "smooth",    "subroutine", "coherent",
        "restrict", "readonly", "writeonly", "centroid",   "noperspective"};
    constexpr std::array<std::array<std::string_view, 3>, 2> kOlderTextures = {
        {{"texture2D", "sampler2D", "vec2"}, {"textureCube", "samplerCube", "vec3"}}};
    std::string text = fmt::format("vec4 {} = vec4(0.0);\n", kPlainColour);
    for (const auto& [name, sampler, place] : kOlderTextures) {
        if (means_its_own(reading, name)) continue;
        if (!declares(reading, "texture")) {
            text += fmt::format("#define {} texture\n", name);
            continue;
        }
        // A name of the text's hides the function behind it.
        text += fmt::format(
            "vec4 glint_{0}({1} s, {2} p) {{ return texture(s, p); }}\n"
            "vec4 glint_{0}({1} s, {2} p, float bias) {{ return texture(s, p, bias); }}\n"
            "#define {0} glint_{0}\n",
            name, sampler, place);
    }
    for (const std::string_view name : kNewerFunctions)
        if (!reading.functions_named(name).empty())
            text += fmt::format("#define {0} glint_{0}\n", name);
    for (const std::string_view word : kNewerWords)
        if (plain_main && is_of_older_glsl(reading) && reading.mentions(word) &&
            !reading.defines_macro(word))
            text += fmt::format("#define {0} glint_{0}\n", word);
    if (plain_main && reading.mentions("mainImage")) text += "#define mainImage glint_mainImage\n";
    return text + "#define main glint_main\n";
}

std::string before_plain_main(const Reading& reading) {
    return "#undef glFragCoord_\nvec4 glFragCoord_ = vec4(0.0);\n" + texture_coordinates(reading);
}

std::string behind_plain_main(const Reading& reading, const Declaration* output) {
    const std::string_view colour =
        output ? reading.word(output->names.front().name) : kPlainColour;
    const bool is_opaque = output && reading.word(output->type) == "vec3";
    return fmt::format(
        "#undef mainImage\nvoid mainImage(inout vec4 glint_color, in vec2 glint_coord) {{\n"
        "    {0} = glint_color{1};\n"
        "    glFragCoord_ = vec4(glint_coord, gl_FragCoord.zw);\n{3}"
        "    main();\n    glint_color = {2};\n}}\n",
        colour, is_opaque ? ".rgb" : "",
        is_opaque ? fmt::format("vec4({}, 1.0)", colour) : std::string(colour),
        texture_coordinates(reading).empty() ? "" : "    glint_place(glint_coord);\n");
}

void make_ends_variables(const Reading& reading, Edits& edits) {
    for (const Declaration& declaration : reading.declarations) {
        if (is_texture_coordinate(reading, declaration))  // texture_coordinates() declares it
            edits.replace(declaration.tokens, "");
        if (declaration.scope != Scope::global || !declaration.is_out) continue;
        const TokenRange words = declaration.qualifiers;
        for (std::uint32_t at = words.begin; at < words.end; ++at)
            if (!reading.tokens[at].text.ends_with('p')) edits.replace({at, at + 1}, "");
    }
}

}  // namespace glint
