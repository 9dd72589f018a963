#include "render/program.h"

#include "gl/context.h"
#include "glsl/loops.h"
#include "render/driver_log.h"
#include "scene/blame.h"
#include "scene/builtin.h"
#include "scene/scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

namespace glint {
namespace {

struct BuiltinName {
    std::string_view name;
    Builtin builtin;
};
constexpr std::array kBuiltinNames = {
    BuiltinName{"iResolution", Builtin::resolution},
    BuiltinName{"iTime", Builtin::time},
    BuiltinName{"iTimeDelta", Builtin::time_delta},
    BuiltinName{"iFrameRate", Builtin::frame_rate},
    BuiltinName{"iFrame", Builtin::frame},
    BuiltinName{"iMouse", Builtin::mouse},
    BuiltinName{"iDate", Builtin::date},
    BuiltinName{"iSampleRate", Builtin::sample_rate},
    BuiltinName{"iTick", Builtin::tick},
    BuiltinName{"glint_jitter", Builtin::jitter},
    BuiltinName{"glint_face", Builtin::face},
    BuiltinName{"glint_origin", Builtin::origin},
};

// Where the scene declares one, it may mean another by that name.
std::optional<Builtin> foreign_builtin(std::string_view name, GLenum type) {
    constexpr std::pair<std::string_view, Builtin> kWords[] = {
        {"iTime", Builtin::time},
        {"iTimeDelta", Builtin::time_delta},
        {"iFrame", Builtin::frame},
        {"iDate", Builtin::date},
        {"iResolution", Builtin::resolution},
        {"iResolution.xy", Builtin::resolution_2d},
        {"iMouse.xy", Builtin::mouse_2d},
        {"iMouse.xy / iResolution.xy", Builtin::mouse_share}};
    constexpr std::pair<GLenum, std::string_view> kTypes[] = {{GL_FLOAT, "float"},
                                                              {GL_FLOAT_VEC2, "vec2"},
                                                              {GL_FLOAT_VEC3, "vec3"},
                                                              {GL_FLOAT_VEC4, "vec4"},
                                                              {GL_INT, "int"}};
    const auto type_name =
        std::ranges::find(kTypes, type, &std::pair<GLenum, std::string_view>::first);
    if (type_name == std::end(kTypes)) return std::nullopt;
    const ForeignName* known = find_foreign_name(type_name->second, name);
    if (!known) return std::nullopt;
    return std::ranges::find(kWords, known->words, &std::pair<std::string_view, Builtin>::first)
        ->second;
}

// "iCh2.size" is a member of channel 2; "iChannelTime[0]" an array of four.
std::optional<BuiltinUniform> builtin_uniform(const std::string& name, GLenum type,
                                              GLint location) {
    if (const auto foreign = foreign_builtin(name, type))
        return BuiltinUniform{*foreign, name, 0, location};
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
std::string sampler_name(const std::string& uniform) {
    const bool is_member =
        uniform.size() == 12 && uniform.starts_with("iCh") && uniform.ends_with(".sampler");
    return is_member ? fmt::format("iChannel{}", uniform[3]) : uniform;
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
    const GLuint program = pass.id;
    pass.numbers_location = glGetUniformLocation(program, kNumbers);
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
            const std::string known = sampler_name(name);
            const auto sampler = find_sampler(preset, pass.pass, known);
            if (sampler && sampler_at(preset, *sampler).source != Source::none)
                pass.samplers.push_back({*sampler, unit});
            else
                pass.unfilled.push_back({known, kind.type, unit});
        } else {
            // A tweak may bear a name that other programs feed.
            const auto& tweaks = preset.scene.tweaks;
            const auto tweak = std::find_if(tweaks.begin(), tweaks.end(),
                                            [&](const Tweak& t) { return t.name == name; });
            if (tweak != tweaks.end()) {
                pass.tweaks.push_back({static_cast<std::size_t>(tweak - tweaks.begin()), location});
            } else if (auto builtin = builtin_uniform(name, type, location)) {
                pass.builtins.push_back(std::move(*builtin));
            }
        }
    }
}

}  // namespace

std::vector<std::size_t> channels_told_of(const Preset& preset, const PassProgram& program) {
    std::vector<std::size_t> list;
    for (int i = 0; i < 4; ++i) {
        const bool asked = std::any_of(
            program.builtins.begin(), program.builtins.end(), [&](const BuiltinUniform& uniform) {
                return uniform.builtin == Builtin::channel_time ||
                       uniform.builtin == Builtin::channel_resolution ||
                       (uniform.builtin == Builtin::channel_struct && uniform.index == i);
            });
        const auto sampler = find_sampler(preset, program.pass, fmt::format("iChannel{}", i));
        if (asked && sampler) list.push_back(*sampler);
    }
    return list;
}

namespace {

// What a pass reads of iChannel0..3 and nothing fills. Of other samplers the scene has spoken.
Diagnostics empty_channels(const Preset& preset, const PassProgram& program) {
    Diagnostics list;
    for (const UnfilledSampler& unfilled : program.unfilled) {
        if (!find_builtin(unfilled.name) || !unfilled.type) continue;
        const std::string pass = pass_name(preset.scene, program.pass);
        list.push_back(
            {Severity::warning, reading_place(preset.scene, pass, unfilled.name),
             fmt::format("nothing fills {0}, which is read here, so it is 0; fill it in a preset's "
                         "[channels], or write uniform {1} {0}; //@ noise {2}",
                         unfilled.name, glsl_name(*unfilled.type),
                         *unfilled.type == SamplerType::sampler2D ? "rgba 256" : "rgba 32")});
    }
    return list;
}

}  // namespace

GLuint ProgramShelf::find(const std::string& text) const {
    const auto found = programs_.find(text);
    return found == programs_.end() ? 0 : found->second.id();
}

GLuint ProgramShelf::add(const std::string& text, Program program) {
    return (programs_[text] = std::move(program)).id();
}

const std::string* ProgramShelf::text_of(GLuint id) const {
    for (const auto& [text, program] : programs_)
        if (program.id() == id) return &text;
    return nullptr;
}

void ProgramShelf::keep_only(const std::vector<GLuint>& ids) {
    std::erase_if(programs_, [&](const auto& entry) {
        return std::ranges::find(ids, entry.second.id()) == ids.end();
    });
}

// The same program for less work of drivers that draw in software. What they say of it would tell
// places of another text, so that where they say anything the text itself is asked.
LinkedProgram make_pass_program(const std::string& text) {
    if (draws_in_software()) {
        const std::string changed = test_loops_at_end(text);
        LinkedProgram linked = make_program(changed);
        // Of a text that it has just compiled, Mesa would not warn again.
        if (changed == text || (linked.program && linked.log.empty())) return linked;
    }
    return make_program(text);
}

static CompiledPass described(const Preset& preset, std::size_t pass, GLuint id,
                              std::vector<float> numbers) {
    CompiledPass result;
    PassProgram& program = result.program.emplace();
    program.pass = pass;
    program.id = id;
    program.numbers = std::move(numbers);
    program.numbers.resize((program.numbers.size() + 3) / 4 * 4);
    find_uniforms(preset, program);
    result.diagnostics = empty_channels(preset, program);
    return result;
}

CompiledPass compile_pass(const Preset& preset, std::size_t pass, const ProgramOptions& options,
                          ProgramShelf* shelf, bool* was_kept) {
    if (pass == kSoundPass) {
        const Reading reading = read_glsl(preset.scene.text, known_of_scene());
        if (const auto wrong = find_wrong_sound(reading))
            return {.program = std::nullopt,
                    .diagnostics = {{Severity::error, preset.scene.place_at(wrong->begin),
                                     "this makes the sound, and so has to be vec2 mainSound(int "
                                     "samp, float time)"}}};
    }
    return compile_text(preset, pass, pass_text(preset, pass, options), shelf, was_kept);
}

CompiledPass linked_pass(const Preset& preset, std::size_t pass, PassText source, Program own,
                         ProgramShelf* shelf) {
    CompiledPass result = described(preset, pass, own.id(), std::move(source.numbers));
    if (shelf)
        shelf->add(source.text, std::move(own));
    else
        result.program->own = std::move(own);
    return result;
}

CompiledPass compile_text(const Preset& preset, std::size_t pass, PassText source,
                          ProgramShelf* shelf, bool* was_kept) {
    const GLuint kept = shelf ? shelf->find(source.text) : 0;
    if (was_kept) *was_kept = kept != 0;
    if (kept != 0) return described(preset, pass, kept, std::move(source.numbers));
    LinkedProgram linked = make_pass_program(source.text);
    Diagnostics said = read_driver_log(preset.scene, linked.log, source);
    if (!linked.program && !has_errors(said)) {
        said.push_back(refusal_without_words(preset.scene, source));
    }
    for (const Finding& one : source.refused)
        if (linked.program)
            said.push_back({Severity::error, preset.scene.place_at(one.at), one.text});
    CompiledPass result;
    if (linked.program && source.refused.empty())
        result = linked_pass(preset, pass, std::move(source), std::move(linked.program), shelf);
    append_once(said, result.diagnostics);
    result.diagnostics = std::move(said);
    return result;
}

}  // namespace glint
