#include "render/pass_text.h"

#include "base/words.h"
#include "glsl/division.h"
#include "glsl/hidden_zero.h"
#include "glsl/lean.h"
#include "glsl/numbers.h"
#include "glsl/remainder.h"
#include "glsl/stored_index.h"
#include "render/macro_mends.h"
#include "render/own_main_text.h"
#include "render/own_overloads.h"
#include "scene/own_main.h"
#include "scene/scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <memory>
#include <string_view>
#include <unordered_set>

namespace glint {
namespace {

struct HostName {
    std::string_view type, name, array = "";
};
constexpr HostName kOfPictures[] = {
    {"vec3", "iResolution"}, {"float", "iTime"}, {"vec4", "iMouse"}};
constexpr HostName kOfAll[] = {{"float", "iTimeDelta"},
                               {"float", "iFrameRate"},
                               {"int", "iFrame"},
                               {"vec4", "iDate"},
                               {"float", "iSampleRate"},
                               {"float", "iChannelTime", "[4]"},
                               {"vec3", "iChannelResolution", "[4]"}};

// The site lets a shader colour its pixel by a failed assertion: red, green, blue or yellow.
constexpr std::string_view kAssert = R"(int glint_failed = -1;
void st_assert(bool condition, int colour) { if (!condition) glint_failed = clamp(colour, 0, 3); }
void st_assert(bool condition) { if (!condition) glint_failed = 0; }
vec4 glint_asserted(vec4 colour) {
    if (glint_failed < 0) return colour;
    return vec4(glint_failed == 0 || glint_failed == 3, glint_failed == 1 || glint_failed == 3, glint_failed == 2, 1);
}
)";

constexpr std::string_view kJitter = "uniform vec2 glint_jitter;\n";

// sRGB (IEC 61966-2-1) to linear light, mirrored for negative values, so that averages do not clip.
constexpr std::string_view kDecode = R"(vec3 glint_decode(vec3 c) {
    vec3 a = abs(c);
    return sign(c) * mix(a / 12.92, pow((a + 0.055) / 1.055, vec3(2.4)), greaterThan(a, vec3(0.04045)));
}
)";

std::string channel_declarations(const Preset& preset, std::size_t pass, const Reading& reading) {
    const Scene& scene = preset.scene;
    std::string text;
    for (std::size_t i = 0; i < preset.channels.size(); ++i) {
        const std::string name = fmt::format("iChannel{}", i);
        const auto known = find_sampler(preset, pass, name);
        const bool by_scene = known && *known < scene.samplers.size();
        const char* type =
            glsl_name(by_scene ? scene.samplers[*known].type
                               : scene.channel_types[i].value_or(preset.channels[i].type));
        if (!by_scene) text += fmt::format("uniform {} {};\n", type, name);
        // A struct of samplers costs a declaration in every shader, so only where it is used.
        if (reading.mentions(fmt::format("iCh{}", i))) {
            text += fmt::format(
                "uniform struct {{ {} sampler; vec3 size; float time; int loaded; }} iCh{};\n",
                type, i);
        }
    }
    return text;
}

// Names that the site does not have, or no more: a text may mean something of its own.
std::string other_names(const Reading& reading) {
    constexpr std::pair<std::string_view, std::string_view> kOthers[] = {{"float", "iGlobalTime"},
                                                                         {"uint", "iTick"}};
    std::string text;
    for (const auto& [type, name] : kOthers)
        if (!means_its_own(reading, name)) text += fmt::format("uniform {} {};\n", type, name);
    return text;
}

// The site has none of the first three in a sound, so that texts for it may use the names
// themselves; other passes of the same text may want them. A text with a main() of its own knows
// nothing of the host's, and fills variables of these names from what it does know.
std::string host_uniforms(const Reading& reading, bool sound, bool plain_main) {
    std::string text;
    const auto add = [&](const HostName& host) {
        text += fmt::format("uniform {} {}{};\n", host.type, host.name, host.array);
    };
    for (const HostName& host : kOfPictures)
        if (!(sound && declares(reading, host.name)) &&
            !(plain_main && reading.find_global(host.name)))
            add(host);
    for (const HostName& host : kOfAll)
        if (!(plain_main && reading.find_global(host.name))) add(host);
    return text;
}

// The site's drivers take every precision as highp, where Mesa computes mediump and lowp in halves.
// Samplers must be told: their default is lowp, and a buffer of 32-bit floats is then read as
// halves.
constexpr std::string_view kPrecision = R"(precision highp float;
precision highp int;
precision highp sampler2D;
precision highp samplerCube;
precision highp sampler3D;
)";

// Desktop GLSL asks for none.
std::string other_precisions(const Reading& reading) {
    std::string text;
    for (const std::string_view name :
         {"isampler2D", "isampler3D", "isamplerCube", "isampler2DArray", "usampler2D", "usampler3D",
          "usamplerCube", "usampler2DArray", "sampler2DArray", "sampler2DShadow",
          "samplerCubeShadow", "sampler2DArrayShadow"})
        if (reading.mentions(name)) text += fmt::format("precision highp {};\n", name);
    return text;
}

// Functions that a text may define on the site, and that Mesa knows already from other GLSL.
constexpr std::array<std::string_view, 18> kOtherFunctions = {
    "texture2D",    "texture3D",      "textureCube",      "texture2DProj", "texture2DLod",
    "texture3DLod", "textureCubeLod", "texture2DProjLod", "texture3DProj", "texture3DProjLod",
    "atomicAdd",    "atomicMin",      "atomicMax",        "atomicAnd",     "atomicOr",
    "atomicXor",    "atomicExchange", "atomicCompSwap"};

// Ordinary names on the site, and reserved in Mesa.
constexpr std::string_view kOrdinaryNames[] = {
    "packed",  "dmat2",   "dmat3",   "dmat4",   "dmat2x2", "dmat2x3", "dmat2x4",
    "dmat3x2", "dmat3x3", "dmat3x4", "dmat4x2", "dmat4x3", "dmat4x4"};

std::string renamed_words(const Reading& reading) {
    std::string text;
    for (const std::string_view name : kOtherFunctions) {
        if (!reading.functions_named(name).empty())
            text += fmt::format("#define {0} glint_{0}\n", name);
    }
    for (const std::string_view word : {"mediump", "lowp"}) {
        if (reading.mentions(word) && !reading.defines_macro(word))
            text += fmt::format("#define {} highp\n", word);
    }
    for (const std::string_view name : kOrdinaryNames) {
        if (reading.mentions(name) && !reading.defines_macro(name))
            text += fmt::format("#define {0} glint_{0}\n", name);
    }
    return text;
}

// An `out` parameter is undefined on entry. Browsers make it 0, on which `color += light` relies,
// whatever value the site hands in; drivers make anything of it. So the entry's parameters become
// `inout`, and start at 0; if the text calls it itself they stay `out`, for each call starts at 0.
// Says whether there were any.
bool make_colour_defined(const Reading& reading, std::string_view entry, Edits& edits) {
    bool found = false;
    for (const Function& function : reading.functions) {
        if (!reading.is_for_the_host(function, entry)) continue;
        for (const std::uint32_t parameter : function.parameters) {
            const TokenRange words = reading.declarations[parameter].qualifiers;
            for (std::uint32_t at = words.begin; at < words.end; ++at)
                found |= reading.tokens[at].is("inout") ||
                         (reading.tokens[at].is("out") && edits.replace({at, at + 1}, "inout"));
        }
    }
    return found;
}

// Browsers take a function whose parameter has no name, Mesa only declarations of one; and a
// mainImage whose place is constant, which is declared before it as any other. They refuse a
// semicolon that ends no declaration.
void mend_declarations(const Reading& reading, std::string_view entry, Edits& edits) {
    leave_out_semicolons(reading, edits);
    for (const Function& function : reading.functions) {
        if (!function.is_defined()) continue;
        for (std::size_t i = 0; i < function.parameters.size(); ++i) {
            const Declaration& parameter = reading.declarations[function.parameters[i]];
            if (parameter.names.empty() && !parameter.tokens.empty())
                edits.after(parameter.tokens.end - 1, " " + unnamed_parameter(i));
            const TokenRange words = parameter.qualifiers;
            for (std::uint32_t at = words.begin; at < words.end; ++at)
                if (reading.tokens[at].is("const") && reading.word(function.name) == entry)
                    edits.replace({at, at + 1}, "     ");  // so that no column moves
        }
    }
}

// gl_FragCoord counts from the corner of the tile that is drawn. Where the scene's text uses it, a
// name as long stands for the place in the picture, so that no column moves.
constexpr std::string_view kTiles =
    "uniform vec2 glint_origin;\n"
    "#define glFragCoord_ (gl_FragCoord + vec4(glint_origin, 0.0, 0.0))\n";

std::string image_main(const char* out, const ProgramOptions& options) {
    std::string text = fmt::format("void mainImage({} vec4 color, in vec2 coord);\n", out);
    if (options.tiles) text += kTiles;
    text += kAssert;
    if (options.average) (text += kJitter) += kDecode;
    text +=
        "layout(location = 0) out vec4 glint_out0;\nvoid main() {\n    vec4 color = vec4(0.0);\n";
    text += fmt::format("    mainImage(color, {}.xy{});\n",
                        options.tiles ? "glFragCoord_" : "gl_FragCoord",
                        options.average ? " + glint_jitter" : "");
    text += "    color = glint_asserted(color);\n";
    if (options.average) {
        if (options.clamp_to_bytes) text += "    color = clamp(color, 0.0, 1.0);\n";
        text += "    color.rgb = glint_decode(color.rgb);\n";
    }
    return text + "    glint_out0 = vec4(color.rgb, 1.0);\n}\n";
}

void put_in_place_of(std::string_view theirs, std::string_view ours, const Reading& reading,
                     Edits& edits) {
    for (const Token& token : reading.written)
        if (token.is(theirs)) edits.replace_bytes(token.span(), std::string(ours));
}

std::string buffer_main(const Pass& pass, const char* out, const ProgramOptions& options) {
    std::string parameters, outputs, variables, arguments, results;
    for (std::size_t i = 0; i < pass.outputs.size(); ++i) {
        parameters += fmt::format("{} vec4 color{}, ", out, i);
        outputs += fmt::format("layout(location = {0}) out vec4 glint_out{0};\n", i);
        variables += fmt::format("    vec4 color{} = vec4(0.0);\n", i);
        arguments += fmt::format("color{}, ", i);
        results += fmt::format("    glint_out{0} = color{0};\n", i);
    }
    const std::string_view jitter = options.average ? kJitter : "";
    return fmt::format(
        "void {0}({1}in vec2 coord);\n{2}{3}{4}void main() {{\n{5}    "
        "{0}({6}gl_FragCoord.xy{7});\n{8}}}\n",
        pass.entry == "main" ? "mainImage" : pass.entry, parameters, kAssert, jitter, outputs,
        variables, arguments, options.average ? " + glint_jitter" : "", results);
}

// The site's older form of mainSound takes the time alone.
std::string sound_main(const Reading& reading) {
    const auto has = [&](std::initializer_list<std::string_view> types) {
        return std::ranges::any_of(
            reading.functions_named("mainSound"), [&](std::uint32_t function) {
                return std::ranges::equal(
                    reading.functions[function].parameters, types, {},
                    [&](std::uint32_t parameter) {
                        return reading.word(reading.declarations[parameter].type);
                    });
            });
    };
    const bool old = has({"float"}) && !has({"int", "float"});
    return fmt::format(
        "vec2 mainSound({});\n{}layout(location = 0) out vec4 glint_out0;\nvoid main() {{\n"
        "    int samp = (iFrame * {} + int(gl_FragCoord.y)) * {} + int(gl_FragCoord.x);\n"
        "    float time = float(uint(samp)) / {}.0;\n"
        "    glint_out0 = vec4(mainSound({}), 0.0, 1.0);\n}}\n",
        old ? "float time" : "int samp, float time", kAssert, kSoundBlockRows, kSoundBlockWidth,
        kSampleRate, old ? "time" : "samp, time");
}

// Directions as GL reads cubemaps (OpenGL 4.5, table 8.19), so that texture(sky, rayDir) gives back
// what was drawn for rayDir.
std::string cube_main(const Pass& pass, const char* out) {
    return fmt::format(
        "void {0}({1} vec4 color, in vec2 coord, in vec3 rayOri, in vec3 rayDir);\n{2}"
        R"(uniform int glint_face;
layout(location = 0) out vec4 glint_out0;
void main() {{
    vec2 p = gl_FragCoord.xy / iResolution.xy * 2.0 - 1.0;
    vec3 ray = glint_face == 0 ? vec3(1, -p.y, -p.x) : glint_face == 1 ? vec3(-1, -p.y, p.x)
             : glint_face == 2 ? vec3(p.x, 1, p.y) : glint_face == 3 ? vec3(p.x, -1, -p.y)
             : glint_face == 4 ? vec3(p.x, -p.y, 1) : vec3(-p.x, -p.y, -1);
    vec4 color = vec4(0.0);
    {0}(color, gl_FragCoord.xy, vec3(0), normalize(ray));
    glint_out0 = color;
}}
)",
        pass.entry, out, kAssert);
}

// A literal that GLSL reads back as exactly this value.
std::string literal(TweakType type, double value) {
    if (type == TweakType::int1) return fmt::format("{:.0f}", value);
    if (type == TweakType::bool1) return value != 0.0 ? "true" : "false";
    std::string text = fmt::format("{:.9g}", static_cast<float>(value));
    if (text.find_first_of(".e") == text.npos) text += ".0";
    return text;
}

std::string variable(const Tweak& tweak, const TweakValue& value) {
    const int count = component_count(tweak.type);
    std::string components;
    for (int i = 0; i < count; ++i) {
        if (i > 0) components += ", ";
        components += literal(tweak.type, value[static_cast<std::size_t>(i)]);
    }
    const char* type = glsl_name(tweak.type);
    return count == 1 ? fmt::format("{} {} = {};", type, tweak.name, components)
                      : fmt::format("{0} {1} = {0}({2});", type, tweak.name, components);
}

std::string constant(const Tweak& tweak, const TweakValue& value) {
    return "const " + variable(tweak, value);
}

// Whether this bracket begins the size of what is declared here, as in `float a[`.
bool begins_size(const Reading& reading, std::size_t bracket) {
    constexpr std::string_view kNoTypes[] = {"return", "else", "do"};
    if (bracket < 2) return true;
    const Token &before = reading.tokens[bracket - 2], &name = reading.tokens[bracket - 1];
    return name.is_word() && before.is_word() && !is_one_of(before.text, kNoTypes);
}

std::unordered_set<std::string_view> words_of_indices(const Reading& reading) {
    std::unordered_set<std::string_view> words;
    int depth = 0;
    for (std::size_t at = 0; at < reading.tokens.size(); ++at) {
        const Token& token = reading.tokens[at];
        if (token.is("["))
            depth += depth > 0 || !begins_size(reading, at);
        else if (token.is("]"))
            depth = std::max(depth - 1, 0);
        else if (depth > 0)
            words.insert(token.text);
    }
    return words;
}

bool is_constant(const ProgramOptions& options, std::size_t tweak) {
    return options.specialise ||
           std::ranges::find(options.constants, tweak) != options.constants.end();
}

// Every tweak that the options want so, as a constant; nothing for those that are unused. What an
// index is made of stays a uniform: NVIDIA's driver tells what is out of range of variables, too.
void specialise(const Preset& preset, const ProgramOptions& options, const Reading& reading,
                const std::unordered_set<std::string_view>& unused, Edits& edits) {
    const std::unordered_set<std::string_view> indices = words_of_indices(reading);
    for (std::size_t i = 0; i < preset.scene.tweaks.size(); ++i) {
        if (!is_constant(options, i)) continue;
        const Tweak& tweak = preset.scene.tweaks[i];
        const bool is_unused = unused.contains(tweak.name);
        if (indices.contains(tweak.name) && !is_unused) continue;
        for (const Span declaration : tweak.declarations)
            edits.replace_bytes(declaration, is_unused ? "" : constant(tweak, preset.values[i]));
    }
}

// Another value of what a pass does not ask for leaves its text as it was.
std::unordered_set<std::string_view> unused_constants(const Reading& reading, const Scene& scene,
                                                      const std::vector<bool>& reached,
                                                      const ProgramOptions& options) {
    std::unordered_set<std::string_view> tweaks;
    for (std::size_t i = 0; i < scene.tweaks.size(); ++i)
        if (is_constant(options, i) && !options.named) tweaks.insert(scene.tweaks[i].name);
    return unused_constants(reading, reached, tweaks);
}

void name_tweaks(const Scene& scene, Edits& edits) {
    for (std::size_t i = 0; i < scene.tweaks.size(); ++i)
        for (const Span declaration : scene.tweaks[i].declarations)
            edits.replace_bytes(declaration, named_tweak(i));
}

// Those of specialise() that become a 0, or a vector with one. Of -0.0 the driver makes -inf
// itself.
std::unordered_set<std::string_view> zero_tweaks(const Preset& preset,
                                                 const ProgramOptions& options, bool vectors) {
    std::unordered_set<std::string_view> names;
    for (std::size_t i = 0; i < preset.scene.tweaks.size(); ++i) {
        const Tweak& tweak = preset.scene.tweaks[i];
        const bool is_vector = std::string_view(glsl_name(tweak.type)).starts_with("vec");
        if (!is_constant(options, i) ||
            !(tweak.type == TweakType::float1 || (vectors && is_vector)))
            continue;
        const auto end = preset.values[i].begin() + component_count(tweak.type);
        const auto is_zero = [](double value) {
            return static_cast<float>(value) == 0.0f && !std::signbit(value);
        };
        if (std::any_of(preset.values[i].begin(), end, is_zero)) names.insert(tweak.name);
    }
    return names;
}

// By their names: the numbers of those that a text may divide by.
std::unordered_map<std::string_view, std::size_t> float_tweaks(const Scene& scene) {
    std::unordered_map<std::string_view, std::size_t> numbers;
    for (std::size_t i = 0; i < scene.tweaks.size(); ++i)
        if (scene.tweaks[i].type == TweakType::float1) numbers[scene.tweaks[i].name] = i;
    return numbers;
}

// The host's main(), for another one to call at a place that it chooses.
std::string in_words_of_probe(std::string main, ProbeKind kind) {
    replace_all(main, "void main()", "void glint0_draw()");
    replace_all(main, "gl_FragCoord", "glint0_coord");
    if (kind == ProbeKind::faults)  // which may be born in the picture's alpha, too
        replace_all(main, "vec4(color.rgb, 1.0)", "color");
    return main;
}

// So that a __LINE__ of the user's is that of the plain text.
std::string on_one_line(std::string text) {
    std::ranges::replace(text, '\n', ' ');
    return text;
}

// What the driver reads before the user's text.
std::string prologue(const Preset& preset, std::size_t pass, const ProgramOptions& options,
                     const ProbeWish* probe, const Reading& reading, bool colour_is_defined) {
    const Scene& scene = preset.scene;
    const bool image = pass == kImagePass, sound = pass == kSoundPass;
    const char* out = colour_is_defined ? "inout" : "out";
    std::string text = "#version 300 es\n" + definitions_of_pass(output_names(scene, pass));
    text += renamed_words(reading);
    text += kPrecision;
    const bool plain_main = draws_by_main(scene, pass);
    if (draws_by_main(scene)) text += other_precisions(reading);
    text += host_uniforms(reading, sound, plain_main);
    text += other_names(reading);
    text += channel_declarations(preset, pass, reading);
    std::string main = sound                     ? sound_main(reading)
                       : image                   ? image_main(out, options)
                       : scene.passes[pass].cube ? cube_main(scene.passes[pass], out)
                                                 : buffer_main(scene.passes[pass], out, options);
    if (probe) {
        main = on_one_line(probe_declarations(probe->kind)) +
               in_words_of_probe(std::move(main), probe->kind);
        main.back() = ' ';  // its line's end
        main += on_one_line(probe_main(probe->kind, output_names(scene, pass).size())) + '\n';
    }
    return text + main + own_overloads(reading);
}

std::string numbers_uniform(const std::vector<float>& numbers) {
    if (numbers.empty()) return {};
    return fmt::format("uniform vec4 {}[{}];\n", kNumbers, (numbers.size() + 3) / 4);
}

// For a watch of faults they stay divisions.
void mend_divisions(const Preset& preset, const ProgramOptions& options, const ProbeWish* probe,
                    const Reading& reading, Edits& edits) {
    if (probe && probe->kind == ProbeKind::faults)
        hide_named_zeros(reading, zero_tweaks(preset, options, false), edits);
    else
        mend_division_by_zero(reading, zero_tweaks(preset, options, false), edits);
    if (options.named) name_divisions(reading, float_tweaks(preset.scene), edits);
}

// What the mends of a text need.
std::string mends_named_in(std::string_view text) {
    const bool has_zero = text.find(kHiddenZero) != text.npos;
    const std::string zero =
        has_zero ? fmt::format("uniform float {0};\nuniform int {0}_i;\n", kHiddenZero) : "";
    return zero + (text.find(kRemainder) != text.npos ? remainder_functions() : "");
}

void mend_own_main(const Reading& reading, bool plain_main, Edits& edits) {
    put_in_place_of("gl_FragColor", kPlainColour, reading, edits);
    put_in_place_of_data(reading, edits);
    if (plain_main) make_ends_variables(reading, edits);
    if (plain_main) put_off_values(reading, edits);
}

void add_behind_main(const Reading& reading, const std::optional<Marked>& marked,
                     PassText& result) {
    const Declaration* output = colour_output(reading);
    const auto unset = unset_colour(reading, output);
    if (unset) result.unset.push_back(*unset);
    const bool is_marked = unset && marked && marked->holds(*unset);
    result.text +=
        behind_plain_main(reading, output, is_marked ? std::optional(marked->value) : std::nullopt);
}

// Passes of a text are asked for one after the other, and reading it is half of the work. A text
// without a part for one pass alone reads the same for all.
const Reading& reading_for(const Scene& scene, std::size_t pass) {
    struct Last {
        std::string text;
        Reading reading;
    };
    thread_local std::unique_ptr<Last> last;
    const bool has_parts = scene.text.find(kPassPrefix) != std::string::npos;
    if (last && last->text == scene.text && !has_parts) return last->reading;
    last = std::make_unique<Last>(Last{.text = scene.text, .reading = {}});
    last->reading = read_glsl(last->text, known_of_pass(output_names(scene, pass)));
    return last->reading;
}

}  // namespace

bool declares(const Reading& reading, std::string_view name) {
    return reading.find_global(name) || reading.defines_macro(name);
}

bool means_its_own(const Reading& reading, std::string_view name) {
    return declares(reading, name) || !reading.functions_named(name).empty() ||
           std::ranges::any_of(reading.structs, [&](const Struct& structure) {
               return reading.word(structure.name) == name;
           });
}

std::string named_tweak(std::size_t tweak) {
    return fmt::format("glint_tweak{}", tweak);
}

std::optional<std::size_t> PassText::origin(std::size_t at) const {
    if (at < user_begin || at >= user_end) return std::nullopt;
    return map.origin(at - user_begin);
}

std::vector<bool> index_tweaks(const Scene& scene, const Reading& reading) {
    const std::unordered_set<std::string_view> indices = words_of_indices(reading);
    std::vector<bool> list;
    for (const Tweak& tweak : scene.tweaks) list.push_back(indices.contains(tweak.name));
    return list;
}

EditedText specialised_text(const Preset& preset) {
    const Scene& scene = preset.scene;
    const Reading reading = read_glsl(scene.text, known_of_scene());
    Edits edits(reading);
    const std::vector<bool> indices = index_tweaks(scene, reading);
    for (std::size_t i = 0; i < scene.tweaks.size(); ++i) {
        const Tweak& tweak = scene.tweaks[i];
        const std::string written = variable(tweak, preset.values[i]);
        for (const Span declaration : tweak.declarations)
            edits.replace_bytes(declaration, indices[i] ? written : "const " + written);
    }
    return edits.apply();
}

PassText pass_text(const Preset& preset, std::size_t pass, const ProgramOptions& options,
                   const ProbeWish* probe) {
    const Scene& scene = preset.scene;
    const bool image = pass == kImagePass, sound = pass == kSoundPass;
    const bool plain_main = draws_by_main(scene, pass);
    const Reading& reading = reading_for(scene, pass);
    const bool has_main = !reading.functions_named("main").empty();
    Edits edits(reading);
    const bool is_lean = options.lean && can_be_lean(reading);
    std::vector<bool> reached;
    if (is_lean || options.feed) reached = reading.reached_from({entry_of(scene, pass)});
    std::unordered_set<std::string_view> unused;
    if (is_lean) unused = unused_constants(reading, scene, reached, options);
    if (options.named)
        name_tweaks(scene, edits);
    else
        specialise(preset, options, reading, unused, edits);
    const std::string entry = sound ? "" : entry_of(scene, pass);
    const bool defined = plain_main || (!sound && make_colour_defined(reading, entry, edits));
    if (plain_main || (image && options.tiles))
        put_in_place_of("gl_FragCoord", "glFragCoord_", reading, edits);
    else if (probe)
        put_in_place_of("gl_FragCoord", "glint0_coord", reading, edits);
    if (has_main) mend_own_main(reading, plain_main, edits);
    rename_overloads(reading, edits);
    const bool needs_gap = mend_macros(reading, edits);
    if (!plain_main) hide_extensions(reading, edits);
    mend_declarations(reading, entry_of(scene, pass), edits);
    const std::vector<Remainder> remainders = find_remainders(reading, edits);
    if (!probe) mend_remainders(remainders, edits);
    mend_divisions(preset, options, probe, reading, edits);

    PassText result;
    result.pass = pass;
    if (!is_lean && !probe) result.refused = find_taken_by_mesa(reading);
    if (is_lean) leave_out_functions(reading, reached, edits);
    if (is_lean) leave_out_constants(reading, unused, edits);
    if (options.feed) result.numbers = feed_numbers(reading, reached, kNumbers, is_lean, edits);
    result.unset = write_zeros(reading, edits, entry, options.marked);
    hide_zeros(reading, result.unset, zero_tweaks(preset, options, true), edits);
    mend_stored_indices(reading, edits);
    if (probe)
        result.probed = instrument(reading, *probe, entry_of(scene, pass), edits, remainders,
                                   options.marked ? result.unset : std::vector<Unset>());
    result.text = prologue(preset, pass, options, probe, reading, defined);
    if (needs_gap) result.text += kGap;
    result.text += numbers_uniform(result.numbers);
    EditedText edited = edits.apply();
    result.text += mends_named_in(edited.text);
    if (plain_main) result.text += before_plain_main(reading);
    result.text += has_main ? before_own_main(reading, plain_main) : older_names(reading);
    result.user_begin = result.text.size();
    result.text += edited.text;
    result.user_end = result.text.size();
    result.map = std::move(edited.map);
    if (!result.text.ends_with('\n')) result.text += '\n';
    if (plain_main) add_behind_main(reading, options.marked, result);
    if (is_lean) result.text = without_comments(result.text);
    return result;
}

}  // namespace glint
