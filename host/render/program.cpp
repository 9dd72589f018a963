#include "render/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <limits>
#include <regex>

namespace glint {
namespace {

constexpr std::string_view kUniforms = R"(uniform vec3 iResolution;
uniform float iTime;
uniform float iTimeDelta;
uniform float iFrameRate;
uniform int iFrame;
uniform vec4 iMouse;
uniform vec4 iDate;
uniform float iSampleRate;
uniform uint iTick;
uniform float iChannelTime[4];
uniform vec3 iChannelResolution[4];
)";

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

bool is_identifier(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

bool contains_word(std::string_view text, std::string_view word) {
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        if ((at == 0 || !is_identifier(text[at - 1])) &&
            (end == text.size() || !is_identifier(text[end]))) {
            return true;
        }
    }
    return false;
}

const char* glsl_name(SamplerType type) {
    switch (type) {
        case SamplerType::sampler2D:
            return "sampler2D";
        case SamplerType::samplerCube:
            return "samplerCube";
        case SamplerType::sampler3D:
            return "sampler3D";
    }
    return "";
}

std::string channel_declarations(const Preset& preset, bool image_pass) {
    const Scene& scene = preset.scene;
    std::string text;
    for (std::size_t i = 0; i < preset.channels.size(); ++i) {
        const std::string name = fmt::format("iChannel{}", i);
        const auto declared =
            std::find_if(scene.samplers.begin(), scene.samplers.end(),
                         [&](const Sampler& sampler) { return sampler.name == name; });
        const bool by_scene = declared != scene.samplers.end();
        const char* type = glsl_name(
            by_scene ? declared->type : scene.channel_types[i].value_or(preset.channels[i].type));
        if (!by_scene) text += fmt::format("uniform {} {};\n", type, name);
        // A struct of samplers costs a declaration in every shader, so only where it is used.
        if (image_pass && contains_word(scene.text, fmt::format("iCh{}", i))) {
            text += fmt::format(
                "uniform struct {{ {} sampler; vec3 size; float time; int loaded; }} iCh{};\n",
                type, i);
        }
    }
    return text;
}

// A name that older pastes still use, unless the text declares it itself. A local variable of that
// name, which stands indented, is no declaration for all.
std::string old_names(const Scene& scene) {
    if (!contains_word(scene.text, "iGlobalTime")) return "";
    static const std::regex declared(
        R"((uniform|#\s*define)[^;\n]*\biGlobalTime\b|(^|\n)(const\s+)?float\s+iGlobalTime\b)");
    return std::regex_search(scene.text, declared) ? "" : "uniform float iGlobalTime;\n";
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

// `packed` is an ordinary name on the site, and reserved in Mesa.
std::string renamed_words(const Scene& scene) {
    std::string text;
    for (const std::string_view word : {"mediump", "lowp"}) {
        if (contains_word(scene.text, word)) text += fmt::format("#define {} highp\n", word);
    }
    static const std::regex is_macro(R"(#\s*define\s+packed\b)");
    if (contains_word(scene.text, "packed") && !std::regex_search(scene.text, is_macro)) {
        text += "#define packed glint_packed\n";
    }
    return text;
}

// Where a list of `out` parameters of this function begins and ends, from `at` on; npos for none.
struct Range {
    std::size_t begin = std::string::npos, end = std::string::npos;
};
Range find_out_parameters(std::string_view text, std::string_view function, std::size_t at) {
    constexpr std::string_view kSpace = " \t\n";
    for (at = text.find(function, at); at != text.npos; at = text.find(function, at + 1)) {
        if (at > 0 && is_identifier(text[at - 1])) continue;
        const std::size_t open = text.find_first_not_of(kSpace, at + function.size());
        if (open == text.npos || text[open] != '(') continue;
        const std::size_t close = text.find_first_of("()", open + 1);
        if (close == text.npos || text[close] != ')') continue;
        if (contains_word(text.substr(open, close - open), "out")) return {open, close};
    }
    return {};
}

// An `out` parameter is undefined on entry, and Mesa makes any value of it. The site's colour
// starts at a known one, on which `color *= 0.0` relies; so the entry's parameters become `inout`.
// Says whether there were any.
bool make_colour_defined(PassText& pass, const std::string& entry) {
    std::string& text = pass.text;
    bool found = false;
    for (Range list = find_out_parameters(text, entry, 0); list.begin != text.npos;
         list = find_out_parameters(text, entry, list.end)) {
        found = true;
        for (std::size_t at = list.begin; (at = text.find("out", at)) < list.end; at += 5) {
            if (is_identifier(text[at - 1]) || is_identifier(text[at + 3])) continue;
            text.insert(at, "in");
            list.end += 2;
            const auto begin = text.begin(), here = begin + static_cast<std::ptrdiff_t>(at);
            const std::size_t line_begin = text.rfind('\n', at) + 1;
            pass.widened.push_back({.line = static_cast<int>(std::count(begin, here, '\n')) + 1,
                                    .column = static_cast<int>(at - line_begin) + 1,
                                    .by = 2});
        }
    }
    return found;
}

std::string image_main(const Scene& scene, const char* out, const ProgramOptions& options) {
    std::string text =
        fmt::format("void {}({} vec4 color, in vec2 coord);\n", scene.image_entry, out);
    text += kAssert;
    if (options.average) (text += kJitter) += kDecode;
    text +=
        "layout(location = 0) out vec4 glint_out0;\nvoid main() {\n    vec4 color = vec4(1e20);\n";
    text += fmt::format("    {}(color, gl_FragCoord.xy{});\n", scene.image_entry,
                        options.average ? " + glint_jitter" : "");
    text += "    color = glint_asserted(color);\n";
    if (options.average) {
        if (options.clamp_to_bytes) text += "    color = clamp(color, 0.0, 1.0);\n";
        text += "    color.rgb = glint_decode(color.rgb);\n";
    }
    return text + "    glint_out0 = vec4(color.rgb, 1.0);\n}\n";
}

std::string buffer_main(const Pass& pass, const char* out, const ProgramOptions& options) {
    std::string parameters, outputs, variables, arguments, results;
    for (std::size_t i = 0; i < pass.outputs.size(); ++i) {
        parameters += fmt::format("{} vec4 color{}, ", out, i);
        outputs += fmt::format("layout(location = {0}) out vec4 glint_out{0};\n", i);
        variables += fmt::format("    vec4 color{} = vec4(0, 0, 0, 1);\n", i);
        arguments += fmt::format("color{}, ", i);
        results += fmt::format("    glint_out{0} = color{0};\n", i);
    }
    const std::string_view jitter = options.average ? kJitter : "";
    return fmt::format(
        "void {0}({1}in vec2 coord);\n{2}{3}{4}void main() {{\n{5}    "
        "{0}({6}gl_FragCoord.xy{7});\n{8}}}\n",
        pass.entry, parameters, kAssert, jitter, outputs, variables, arguments,
        options.average ? " + glint_jitter" : "", results);
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
    vec4 color = vec4(0, 0, 0, 1);
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

std::string constant(const Tweak& tweak, const TweakValue& value) {
    const int count = component_count(tweak.type);
    std::string components;
    for (int i = 0; i < count; ++i) {
        if (i > 0) components += ", ";
        components += literal(tweak.type, value[static_cast<std::size_t>(i)]);
    }
    const char* type = glsl_name(tweak.type);
    return count == 1 ? fmt::format("const {} {} = {};", type, tweak.name, components)
                      : fmt::format("const {0} {1} = {0}({2});", type, tweak.name, components);
}

// The scene's text with every tweak as a constant, on the same lines. A declaration may span lines;
// its line ends are kept.
std::string specialised_text(const Preset& preset) {
    const std::string& text = preset.scene.text;
    std::string result;
    std::size_t done = 0;
    for (std::size_t i = 0; i < preset.scene.tweaks.size(); ++i) {
        const Tweak& tweak = preset.scene.tweaks[i];
        result.append(text, done, tweak.declaration_begin - done);
        result += constant(tweak, preset.values[i]);
        for (std::size_t at = tweak.declaration_begin; at < tweak.declaration_end; ++at) {
            if (text[at] == '\n') result += '\n';
        }
        done = tweak.declaration_end;
    }
    return result.append(text, done);
}

struct BuiltinName {
    std::string_view name;
    Builtin builtin;
};
constexpr std::array kBuiltinNames = {
    BuiltinName{"iResolution", Builtin::resolution},
    BuiltinName{"iTime", Builtin::time},
    BuiltinName{"iGlobalTime", Builtin::time},
    BuiltinName{"iTimeDelta", Builtin::time_delta},
    BuiltinName{"iFrameRate", Builtin::frame_rate},
    BuiltinName{"iFrame", Builtin::frame},
    BuiltinName{"iMouse", Builtin::mouse},
    BuiltinName{"iDate", Builtin::date},
    BuiltinName{"iSampleRate", Builtin::sample_rate},
    BuiltinName{"iTick", Builtin::tick},
    BuiltinName{"glint_jitter", Builtin::jitter},
    BuiltinName{"glint_face", Builtin::face},
};

// "iCh2.size" is a member of channel 2; "iChannelTime[0]" an array of four.
std::optional<BuiltinUniform> builtin_uniform(const std::string& name, GLint location) {
    for (const BuiltinName& known : kBuiltinNames) {
        if (name == known.name) return BuiltinUniform{known.builtin, name, 0, location};
    }
    if (name.starts_with("iChannelTime")) {
        return BuiltinUniform{Builtin::channel_time, name, 0, location};
    }
    if (name.starts_with("iChannelResolution")) {
        return BuiltinUniform{Builtin::channel_resolution, name, 0, location};
    }
    if (name.size() > 5 && name.starts_with("iCh") && name[4] == '.' && name[3] >= '0' &&
        name[3] <= '3') {
        return BuiltinUniform{Builtin::channel_struct, name, name[3] - '0', location};
    }
    return std::nullopt;
}

// "iCh2.sampler" reads what iChannel2 reads.
std::optional<std::size_t> sampler_index(const Preset& preset, std::string_view name) {
    std::string wanted(name);
    if (name.size() == 12 && name.starts_with("iCh") && name.ends_with(".sampler")) {
        wanted = fmt::format("iChannel{}", name[3]);
    }
    for (std::size_t i = 0; i < sampler_count(preset); ++i) {
        if (sampler_at(preset, i).name == wanted) return i;
    }
    return std::nullopt;
}

// Whether a uniform is a sampler, and of which of the types that textures here have.
struct SamplerKind {
    bool is_sampler = false;
    std::optional<SamplerType> type;
};
SamplerKind sampler_kind(GLenum type) {
    switch (type) {
        case GL_SAMPLER_2D:
            return {true, SamplerType::sampler2D};
        case GL_SAMPLER_3D:
            return {true, SamplerType::sampler3D};
        case GL_SAMPLER_CUBE:
            return {true, SamplerType::samplerCube};
        case GL_SAMPLER_2D_ARRAY:
        case GL_SAMPLER_2D_SHADOW:
        case GL_SAMPLER_2D_ARRAY_SHADOW:
        case GL_SAMPLER_CUBE_SHADOW:
        case GL_INT_SAMPLER_2D:
        case GL_INT_SAMPLER_3D:
        case GL_INT_SAMPLER_CUBE:
        case GL_INT_SAMPLER_2D_ARRAY:
        case GL_UNSIGNED_INT_SAMPLER_2D:
        case GL_UNSIGNED_INT_SAMPLER_3D:
        case GL_UNSIGNED_INT_SAMPLER_CUBE:
        case GL_UNSIGNED_INT_SAMPLER_2D_ARRAY:
            return {true, std::nullopt};
        default:
            return {};
    }
}

// Asks the linked program what it really reads, and gives every sampler its texture unit.
void find_uniforms(const Preset& preset, PassProgram& pass) {
    const GLuint program = pass.program.id();
    GLint count = 0;
    glGetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
    for (GLint i = 0; i < count; ++i) {
        std::array<char, 256> buffer{};
        GLint size = 0;
        GLenum type = 0;
        glGetActiveUniform(program, static_cast<GLuint>(i), buffer.size(), nullptr, &size, &type,
                           buffer.data());
        const std::string name = buffer.data();
        const GLint location = glGetUniformLocation(program, name.c_str());
        if (location < 0) continue;
        if (const SamplerKind kind = sampler_kind(type); kind.is_sampler) {
            const auto unit = static_cast<GLint>(pass.samplers.size() + pass.unfilled.size());
            const std::vector<GLint> units(static_cast<std::size_t>(size), unit);
            glProgramUniform1iv(program, location, size, units.data());
            const auto sampler = sampler_index(preset, name);
            if (sampler && sampler_at(preset, *sampler).source != Source::none)
                pass.samplers.push_back({*sampler, unit});
            else
                pass.unfilled.push_back({kind.type, unit});
        } else if (auto builtin = builtin_uniform(name, location)) {
            pass.builtins.push_back(std::move(*builtin));
        } else {
            const auto& tweaks = preset.scene.tweaks;
            const auto tweak = std::find_if(tweaks.begin(), tweaks.end(),
                                            [&](const Tweak& t) { return t.name == name; });
            if (tweak != tweaks.end()) {
                pass.tweaks.push_back({static_cast<std::size_t>(tweak - tweaks.begin()), location});
            }
        }
    }
}

// A link error carries no place. The commonest one can be said better than the driver does.
Diagnostic link_diagnostic(const Scene& scene, std::string text) {
    if (text.find("unresolved reference to function") != text.npos &&
        text.find(scene.image_entry) != text.npos) {
        text = fmt::format(
            "there is no `void {}(out vec4 fragColor, in vec2 fragCoord)`; write one, it draws the "
            "picture",
            scene.image_entry);
    }
    return {Severity::error, {scene.files.front().string(), 0, 0}, std::move(text)};
}

}  // namespace

std::string pass_name(const Scene& scene, std::size_t pass) {
    return pass == kImagePass ? "image" : scene.passes[pass].name;
}

const Sampler& sampler_at(const Preset& preset, std::size_t index) {
    const auto& own = preset.scene.samplers;
    return index < own.size() ? own[index] : preset.channels.at(index - own.size());
}

std::size_t sampler_count(const Preset& preset) {
    return preset.scene.samplers.size() + preset.channels.size();
}

PassText pass_text(const Preset& preset, std::size_t pass, const ProgramOptions& options) {
    const Scene& scene = preset.scene;
    const bool image = pass == kImagePass;
    PassText result{.text = options.specialise ? specialised_text(preset) : scene.text};
    const bool defined =
        make_colour_defined(result, image ? scene.image_entry : scene.passes[pass].entry);
    const char* out = defined ? "inout" : "out";
    std::string text = "#version 300 es\n#define HW_PERFORMANCE 1\n" + renamed_words(scene);
    if (image)
        text += "#define PASS_image 1\n";
    else
        for (const std::string& output : scene.passes[pass].outputs)
            text += fmt::format("#define PASS_{} 1\n", output);
    text += kPrecision;
    text += kUniforms;
    text += old_names(scene);
    text += channel_declarations(preset, image);
    text += image                     ? image_main(scene, out, options)
            : scene.passes[pass].cube ? cube_main(scene.passes[pass], out)
                                      : buffer_main(scene.passes[pass], out, options);
    result.prologue_lines = static_cast<int>(std::count(text.begin(), text.end(), '\n'));
    for (PassText::Widened& widened : result.widened) widened.line += result.prologue_lines;
    result.text.insert(0, text);
    if (!result.text.ends_with('\n')) result.text += '\n';
    return result;
}

CompiledPass compile_pass(const Preset& preset, std::size_t pass, const ProgramOptions& options) {
    const PassText source = pass_text(preset, pass, options);
    LinkedProgram linked = make_program(source.text);
    CompiledPass result;
    result.diagnostics = read_driver_log(preset.scene, linked.log, source);
    if (!linked.program) {
        if (!has_errors(result.diagnostics)) {
            result.diagnostics.push_back(
                link_diagnostic(preset.scene, "the driver refused the shader without a word"));
        }
        return result;
    }
    result.program.emplace(PassProgram{.pass = pass,
                                       .program = std::move(linked.program),
                                       .builtins = {},
                                       .tweaks = {},
                                       .samplers = {},
                                       .unfilled = {}});
    find_uniforms(preset, *result.program);
    return result;
}

namespace {

// The end of the spaces and comments that begin at a place of a line.
std::size_t after_space(std::string_view line, std::size_t at) {
    while (at < line.size()) {
        if (line[at] == ' ' || line[at] == '\t') {
            ++at;
        } else if (line.substr(at, 2) == "/*") {
            const std::size_t end = line.find("*/", at + 2);
            at = end == line.npos ? line.size() : end + 2;
        } else {
            break;
        }
    }
    return at;
}

// Mesa counts bytes after its preprocessor, for which a run of spaces and comments is one space.
// This is the column of the text itself, in characters from 1. Macros move columns too, by what
// cannot be known here.
int column_before_preprocessing(std::string_view line, int column) {
    std::size_t at = 0;
    for (int seen = 1; seen < column && at < line.size(); ++seen) {
        const std::size_t code = after_space(line, at);
        at = code > at ? code : at + 1;
    }
    return static_cast<int>(std::count_if(line.begin(), line.begin() + static_cast<long>(at),
                                          [](char c) { return (c & 0xC0) != 0x80; })) +
           1;
}

std::string_view line_of(std::string_view text, int number) {
    std::size_t begin = 0;
    for (int line = 1; line < number && begin < text.size(); ++line) {
        begin = std::min(text.find('\n', begin), text.size() - 1) + 1;
    }
    return text.substr(begin, text.find('\n', begin) - begin);
}

// A number of a log, however many digits it has.
int parse_count(const std::string& digits) {
    int count = 0;
    const char* end = digits.data() + digits.size();
    const bool fits = std::from_chars(digits.data(), end, count).ec == std::errc();
    return fits ? count : std::numeric_limits<int>::max();
}

// The lines of a log, without white space and zeros at their ends.
std::vector<std::string> lines_of(const std::string& log) {
    std::vector<std::string> lines;
    for (std::size_t begin = 0; begin < log.size();) {
        const std::size_t end = std::min(log.find('\n', begin), log.size());
        std::string line = log.substr(begin, end - begin);
        line.erase(line.find_last_not_of(std::string_view(" \t\r\0", 4)) + 1);
        lines.push_back(std::move(line));
        begin = end + 1;
    }
    return lines;
}

}  // namespace

Diagnostics read_driver_log(const Scene& scene, const std::string& log, const PassText& text) {
    static const std::regex mesa(
        R"(^\d+:(\d+)\((\d+)\):\s*(?:preprocessor )?(error|warning):\s*(.*)$)");
    static const std::regex nvidia(R"(^\d+\((\d+)\) ?: (error|warning) (?:C\d+: )?(.*)$)");
    static const std::regex angle(R"(^(ERROR|WARNING): \d+:(\d+): (.*)$)");
    static const std::regex unplaced(R"(^(?:error|ERROR):\s*(.*)$)");
    static const std::regex total(R"(^ERROR: .*\d+ compilation errors?\..*$)");
    const auto place = [&](const std::string& number, int column) {
        const int line = parse_count(number);
        int wider = 0;
        for (const PassText::Widened& widened : text.widened) {
            if (widened.line == line && column > widened.column) wider += widened.by;
        }
        return scene.place(line - text.prologue_lines, column - wider);
    };
    Diagnostics list;
    for (const std::string& line : lines_of(log)) {
        std::smatch m;
        if (std::regex_match(line, m, mesa)) {
            list.push_back(
                {m[3] == "error" ? Severity::error : Severity::warning,
                 place(m[1], column_before_preprocessing(line_of(text.text, parse_count(m[1])),
                                                         parse_count(m[2]))),
                 m[4]});
        } else if (std::regex_match(line, m, nvidia)) {
            list.push_back(
                {m[2] == "error" ? Severity::error : Severity::warning, place(m[1], 0), m[3]});
        } else if (std::regex_match(line, m, angle)) {
            list.push_back(
                {m[1] == "ERROR" ? Severity::error : Severity::warning, place(m[2], 0), m[3]});
        } else if (!std::regex_match(line, total) && std::regex_match(line, m, unplaced)) {
            list.push_back(link_diagnostic(scene, m[1]));
        }
    }
    return list;
}

}  // namespace glint
