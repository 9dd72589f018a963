#include "render/own_main_text.h"

#include "glsl/first_use.h"
#include "glsl/zero_value.h"
#include "render/own_overloads.h"
#include "render/pass_text.h"
#include "scene/builtin.h"
#include "scene/own_main.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace glint {
namespace {

// Declared here, before names and macros of the text; of the size that it declares itself
// glint_place() cannot know.
std::string texture_coordinates(const Reading& reading) {
    const char* const place = reading.find_global("iResolution") ? "p" : "p / iResolution.xy";
    std::string variables, values;
    for (const Declaration& declaration : reading.declarations) {
        const auto fed = fed_input(reading, declaration);
        for (const std::uint32_t token : fed.value_or(std::vector<std::uint32_t>())) {
            const std::string_view type = reading.word(declaration.type),
                                   name = reading.word(token);
            variables += fmt::format("{0} {1} = {0}(0.0);\n", type, name);
            values += fmt::format(" {}{} = {};", name, type == "vec2" ? "" : ".xy", place);
            if (type == "vec4") values += fmt::format(" {}.w = 1.0;", name);
        }
    }
    if (variables.empty()) return {};
    return fmt::format("{}void glint_place(vec2 p) {{{} }}\n", variables, values);
}

// What a member of an input block is over a picture that faces the eye; "" where nothing is known.
std::string value_of_member(const Reading& reading, const Declaration& member,
                            const Declarator& one) {
    const std::string_view type = reading.word(member.type), name = reading.word(one.name);
    if (!one.array.empty() || !member.type_array.empty()) return "";
    if (type == "vec2" && is_coordinate_name(name)) return "glint_coord / iResolution.xy";
    if (type == "vec4" && name.ends_with("position"))
        return "vec4(2.0 * glint_coord / iResolution.xy - 1.0, 0.0, 1.0)";
    if (type == "vec3" && name.ends_with("normal")) return "vec3(0.0, 0.0, 1.0)";
    return "";
}

// `in VertexData { vec4 v_position; vec2 v_texcoord; } inData;`, with its one name, of which
// nothing is read that nothing feeds.
bool is_input_block(const Reading& reading, const Declaration& declaration) {
    if (!declaration.is_block || declaration.structure == kNone || declaration.names.size() != 1 ||
        !is_input(reading, declaration))
        return false;
    const auto& members = reading.structs[declaration.structure].members;
    return std::ranges::all_of(members, [&](std::uint32_t index) {
        const Declaration& member = reading.declarations[index];
        return std::ranges::all_of(member.names, [&](const Declarator& one) {
            return !value_of_member(reading, member, one).empty() ||
                   times_named(reading, reading.word(one.name)) == 1;
        });
    });
}

std::string values_of_block(const Reading& reading, const Declaration& block) {
    std::string values;
    const std::string_view name = reading.word(block.names.front().name);
    for (const std::uint32_t index : reading.structs[block.structure].members) {
        const Declaration& member = reading.declarations[index];
        for (const Declarator& one : member.names)
            if (const std::string value = value_of_member(reading, member, one); !value.empty())
                values += fmt::format("    {}.{} = {};\n", name, reading.word(one.name), value);
    }
    return values;
}

// Whether no constant expression is: GLSL ES 1.00 of the web and desktop GLSL allow that of a
// global's first value.
bool hangs_on_more(const Reading& reading, TokenRange value) {
    for (std::uint32_t at = value.begin; at < value.end; ++at) {
        const Token& token = reading.tokens[at];
        if (!token.is_word() || (at > 0 && reading.tokens[at - 1].is("."))) continue;
        const Declaration* global = reading.find_global(token.text);
        const bool is_of_gl = token.text.starts_with("gl_") && !token.text.starts_with("gl_M");
        if ((global && !global->is_const) || is_of_gl ||  // gl_MaxDrawBuffers and gl_MinProgram…
            !reading.functions_named(token.text).empty() || (!global && find_builtin(token.text)))
            return true;
    }
    return false;
}

bool is_put_off(const Reading& reading, const Declaration& declaration, const Declarator& one) {
    const auto has_no_length = [&](TokenRange array) {  // which its first value gives it
        for (std::uint32_t at = array.begin; at + 1 < array.end; ++at)
            if (reading.tokens[at].is("[") && reading.tokens[at + 1].is("]")) return true;
        return false;
    };
    return declaration.scope == Scope::global && !declaration.is_const && !declaration.is_uniform &&
           declaration.structure == kNone && !has_no_length(one.array) &&
           !has_no_length(declaration.type_array) && hangs_on_more(reading, one.initial) &&
           reading.live_at(reading.place(declaration.tokens).begin) == Live::yes;
}

// Functions that set them have names of their own.
std::string setter_of(const Declarator& one) {
    return fmt::format("glint_set{}", one.name);
}

// `struct VertexData { … } inData=VertexData(…);`, of whose members precisions are left.
void make_block_a_variable(const Reading& reading, const Declaration& block, Edits& edits) {
    edits.replace(block.qualifiers, "struct");
    for (const std::uint32_t index : reading.structs[block.structure].members) {
        const TokenRange words = reading.declarations[index].qualifiers;
        for (std::uint32_t at = words.begin; at < words.end; ++at)
            if (!reading.tokens[at].text.ends_with('p')) edits.replace({at, at + 1}, "");
    }
    const auto zero = ZeroValues(reading).value(
        {.type = block.type, .structure = block.structure, .array = {}, .type_array = {}},
        FirstValue::zero);
    const std::uint32_t name = block.names.front().name;
    if (zero && block.names.front().array.empty()) edits.after(name, "=" + *zero);
}

// `layout(binding = 1)`, which desktop GLSL has: what fills a uniform is said elsewhere.
void leave_out_layout(const Reading& reading, TokenRange words, Edits& edits) {
    for (std::uint32_t at = words.begin; at + 1 < words.end; ++at)
        if (const std::uint32_t close = reading.close_of(at + 1);
            reading.tokens[at].is("layout") && close != kNone)
            edits.replace({at, close + 1}, "");
}

// `varying` is `in` today, and has no layout.
void name_newer(const Reading& reading, const Declaration& declaration, Edits& edits) {
    leave_out_layout(reading, declaration.qualifiers, edits);
    for (std::uint32_t at = declaration.qualifiers.begin; at < declaration.qualifiers.end; ++at)
        if (reading.tokens[at].is("varying")) edits.replace({at, at + 1}, "in");
}

// Words of GLSL ES 3.00 that are names in an older one; those that qualify something are in use.
constexpr std::string_view kQualifiersToday[] = {"smooth", "centroid", "noperspective"};
constexpr std::string_view kNewerWords[] = {"sample",     "filter",   "common",       "partition",
                                            "active",     "resource", "patch",        "smooth",
                                            "subroutine", "coherent", "restrict",     "readonly",
                                            "writeonly",  "centroid", "noperspective"};

// GLSL's beside functions of the text's own that take something else; `glint_NAME` are both.
std::string beside_its_own(const Reading& reading, std::string_view name, std::string_view sampler,
                           std::string_view place) {
    const Types two = {std::string(sampler), std::string(place)}, three = {two[0], two[1], "float"};
    const auto is_own = [&](const Types& types) {
        return std::ranges::any_of(reading.functions_named(name), [&](std::uint32_t index) {
            return types_of(reading, reading.functions[index]) == types;
        });
    };
    std::string text;
    if (!is_own(two))
        text += fmt::format("vec4 glint_{}({} s, {} p) {{ return texture(s, p); }}\n", name,
                            sampler, place);
    if (!is_own(three))
        text +=
            fmt::format("vec4 glint_{}({} s, {} p, float bias) {{ return texture(s, p, bias); }}\n",
                        name, sampler, place);
    return text;
}

// Whether somewhere in the text a variable of that name stands before a function.
bool hides(const Reading& reading, std::string_view name) {
    return declares(reading, name) ||
           std::ranges::any_of(reading.declarations, [&](const Declaration& declaration) {
               return declaration.scope != Scope::member &&
                      std::ranges::any_of(declaration.names, [&](const Declarator& one) {
                          return reading.word(one.name) == name;
                      });
           });
}

// texture2D and textureCube, by which the older language reads, beside what else may be called so.
std::string older_textures(const Reading& reading) {
    constexpr std::array<std::array<std::string_view, 3>, 2> kOlderTextures = {
        {{"texture2D", "sampler2D", "vec2"}, {"textureCube", "samplerCube", "vec3"}}};
    std::string text;
    for (const auto& [name, sampler, place] : kOlderTextures) {
        if (!reading.functions_named(name).empty() && is_of_older_glsl(reading))
            text += beside_its_own(reading, name, sampler, place);
        if (means_its_own(reading, name) || !hides(reading, "texture")) continue;
        // A name of the text's hides the function behind it.
        text += beside_its_own(reading, name, sampler, place) +
                fmt::format("#define {0} glint_{0}\n", name);
    }
    return text + older_names(reading);
}

// Other names for those of the text that GLSL ES 3.00, or the host, has for itself.
std::string freed_names(const Reading& reading, bool plain_main) {
    std::string text;
    const auto free = [&](std::string_view name) {
        text += fmt::format("#define {0} glint_{0}\n", name);
    };
    // Not where the driver may leave them out.
    const auto is_own = [&](std::string_view name) {
        const auto all = reading.functions_named(name);
        return !all.empty() && std::ranges::all_of(all, [&](std::uint32_t index) {
            const Function& one = reading.functions[index];
            return reading.live_at(reading.place(one.name).begin) == Live::yes;
        });
    };
    const bool is_older = is_of_older_glsl(reading);
    for (const std::string_view word : kNewerWords)
        if ((is_older || !is_one_of(word, kQualifiersToday)) && reading.mentions(word) &&
            !reading.defines_macro(word))
            free(word);
    if (!plain_main) return text;
    for (const std::string_view name : builtin_names())
        if (is_own(name)) free(name);
    if (reading.mentions("mainImage") && !reading.defines_macro("mainImage")) free("mainImage");
    return text;
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

std::string older_names(const Reading& reading) {
    constexpr std::pair<std::string_view, std::string_view> kOlder[] = {
        {"texture2D", "texture"},
        {"textureCube", "texture"},
        {"texture3D", "texture"},
        {"texture2DProj", "textureProj"},
        {"texture3DProj", "textureProj"},
        {"texture2DLod", "textureLod"},
        {"texture3DLod", "textureLod"},
        {"textureCubeLod", "textureLod"},
        {"texture2DProjLod", "textureProjLod"},
        {"texture3DProjLod", "textureProjLod"},
        {"texture2DLodEXT", "textureLod"},
        {"texture2DProjLodEXT", "textureProjLod"},
        {"textureCubeLodEXT", "textureLod"},
        {"texture2DGradEXT", "textureGrad"},
        {"texture2DProjGradEXT", "textureProjGrad"},
        {"textureCubeGradEXT", "textureGrad"},
        {"gl_FragDepthEXT", "gl_FragDepth"}};
    std::string text;
    for (const auto& [name, today] : kOlder) {
        const bool is_free = !means_its_own(reading, name) && !reading.defines_macro(name);
        if (is_free && reading.mentions(name) && !hides(reading, today))
            text += fmt::format("#define {} {}\n", name, today);
    }
    return text;
}

std::string before_own_main(const Reading& reading, bool plain_main) {
    return fmt::format("vec4 {} = vec4(0.0);\n", kPlainColour) + older_textures(reading) +
           freed_names(reading, plain_main) + "#define main glint_main\n";
}

std::string before_plain_main(const Reading& reading) {
    // Of a bracket that is left open the driver tells, unless it stops at an older word.
    const bool reads_on = reading.is_balanced || reading.defines_macro("varying");
    return std::string(reads_on ? "" : "#define varying in\n") +
           "#undef glFragCoord_\nvec4 glFragCoord_ = vec4(0.0);\n" + texture_coordinates(reading);
}

std::optional<Unset> unset_colour(const Reading& reading, const Declaration* output) {
    const std::string_view name =
        output ? reading.word(output->names.front().name) : "gl_FragColor";
    const auto mains = reading.functions_named("main");
    const auto first =
        std::ranges::find_if(reading.tokens, [&](const Token& token) { return token.is(name); });
    if (first == reading.tokens.end() || std::ranges::none_of(mains, [&](std::uint32_t index) {
            return reading.functions[index].first_statement != kNone &&
                   FirstUses(reading).out_is_read(index, name);
        }))
        return std::nullopt;
    return Unset{.name = std::string(name), .at = first->span().begin, .is_output = true};
}

std::string behind_plain_main(const Reading& reading, const Declaration* output,
                              std::optional<FirstValue> mark) {
    const std::string_view colour =
        output ? reading.word(output->names.front().name) : kPlainColour;
    const bool is_opaque = output && reading.word(output->type) == "vec3";
    const std::string first = mark
                                  ? basic_value(output ? reading.word(output->type) : "vec4", *mark)
                                  : fmt::format("glint_color{}", is_opaque ? ".rgb" : "");
    std::string before;  // globals that begin with gl_FragCoord see it as the text wants it
    if (reading.mentions("origin_upper_left"))
        before += "    glFragCoord_.y = iResolution.y - glint_coord.y;\n";
    if (reading.mentions("pixel_center_integer")) before += "    glFragCoord_.xy -= 0.5;\n";
    if (!texture_coordinates(reading).empty())
        before += reading.find_global("iResolution")
                      ? "    glint_place(glint_coord / iResolution.xy);\n"
                      : "    glint_place(glint_coord);\n";
    for (const Declaration& declaration : reading.declarations) {
        if (is_input_block(reading, declaration)) before += values_of_block(reading, declaration);
        for (const Declarator& one : declaration.names)
            if (is_put_off(reading, declaration, one))
                before += fmt::format("    {}();\n", setter_of(one));
    }
    return fmt::format(
        "#undef mainImage\nvoid mainImage(inout vec4 glint_color, in vec2 glint_coord) {{\n"
        "    {0} = {1};\n"
        "    glFragCoord_ = vec4(glint_coord, gl_FragCoord.zw);\n{3}"
        "    main();\n    glint_color = {2};\n}}\n",
        colour, first, is_opaque ? fmt::format("vec4({}, 1.0)", colour) : std::string(colour),
        before);
}

void make_ends_variables(const Reading& reading, Edits& edits) {
    for (const Declaration& declaration : reading.declarations) {
        if (is_of_gl(reading, declaration)) {
            edits.replace(declaration.tokens, "");
            continue;
        }
        if (fed_input(reading, declaration))  // texture_coordinates() declares what is read
            edits.replace(declaration.tokens, "");
        else if (is_input_block(reading, declaration))
            make_block_a_variable(reading, declaration, edits);
        else if (is_input(reading, declaration))  // which the driver then tells of
            name_newer(reading, declaration, edits);
        const TokenRange words = declaration.qualifiers;
        if (declaration.is_uniform) leave_out_layout(reading, words, edits);
        if (declaration.scope != Scope::global || !declaration.is_out) continue;
        for (std::uint32_t at = words.begin; at < words.end; ++at)
            if (!reading.tokens[at].text.ends_with('p')) edits.replace({at, at + 1}, "");
    }
}

// `float t = 0.5 * time, u;` becomes `float t;void glint_set7(){t= 0.5 * time;} float u;`.
void put_off_values(const Reading& reading, Edits& edits) {
    for (const Declaration& declaration : reading.declarations) {
        const bool any = std::ranges::any_of(declaration.names, [&](const Declarator& one) {
            return is_put_off(reading, declaration, one);
        });
        const TokenRange head = {declaration.tokens.begin, declaration.names.empty()
                                                               ? declaration.tokens.begin
                                                               : declaration.names.front().name};
        for (std::size_t i = 0; any && i < declaration.names.size(); ++i) {
            const Declarator& one = declaration.names[i];
            const bool is_off = is_put_off(reading, declaration, one);
            const std::string_view name = reading.word(one.name);
            if (is_off)
                edits.replace({one.initial.begin - 1, one.initial.begin},
                              fmt::format(";void {}(){{{}=", setter_of(one), name));
            const std::uint32_t end = one.tokens.end;  // its comma or semicolon
            if (i + 1 < declaration.names.size())
                edits.replace({end, end + 1},
                              fmt::format(";{} {} ", is_off ? "}" : "", reading.spelled(head)));
            else if (is_off)
                edits.after(end, "}");
        }
    }
}

}  // namespace glint
