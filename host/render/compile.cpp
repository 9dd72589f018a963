#include "render/compile.h"

#include "base/process_time.h"
#include "glsl/lean.h"
#include "render/programs_ahead.h"
#include "scene/scene_text.h"

#include <algorithm>
#include <thread>

namespace glint {
namespace {

// What a buffer discards stays as it was when the buffer was last this one of its two.
bool keeps_pixels(const Preset& preset, std::size_t pass, ProgramOptions options) {
    if (!fills_a_buffer(pass) || preset.scene.text.find("discard") == std::string::npos)
        return false;
    options.lean = true;
    const std::string text = without_comments(pass_text(preset, pass, options).text);
    return text.find("discard") != std::string::npos;
}

PassReads reads_of(const Preset& preset, const PassProgram& program,
                   const ProgramOptions& options) {
    PassReads reads{.pass = program.pass, .buffers = {}};
    for (const SamplerUniform& uniform : program.samplers) {
        const Sampler& sampler = sampler_at(preset, uniform.sampler);
        if (sampler.source == Source::buffer &&
            std::find(reads.buffers.begin(), reads.buffers.end(), sampler.pass) ==
                reads.buffers.end()) {
            reads.buffers.push_back(sampler.pass);
        }
    }
    const bool reads_itself = std::ranges::find(reads.buffers, program.pass) != reads.buffers.end();
    if (!reads_itself && keeps_pixels(preset, program.pass, options))
        reads.buffers.push_back(program.pass);
    reads.changes_by_itself = std::ranges::any_of(
        program.builtins,
        [](const BuiltinUniform& uniform) { return changes_by_itself(uniform.builtin); });
    const auto sounds = [&](std::size_t sampler) {
        return sampler_at(preset, sampler).source == Source::sound;
    };
    const std::vector<std::size_t> told_of = channels_told_of(preset, program);
    reads.changes_by_itself |=
        std::any_of(program.samplers.begin(), program.samplers.end(),
                    [&](const SamplerUniform& uniform) { return sounds(uniform.sampler); }) ||
        std::any_of(told_of.begin(), told_of.end(), [&](std::size_t sampler) {
            return sounds(sampler) || sampler_at(preset, sampler).plays;
        });
    return reads;
}

// All of a text is judged with the root. The other passes need not be read by the driver whole
// once more each, unless functions of theirs are hidden from the root, or there is a word to say.
ProgramOptions behind_root(const Preset& preset, ProgramOptions options) {
    options.lean |= preset.scene.text.find(kPassPrefix) == std::string::npos;
    return options;
}

CompiledPass compile_behind_root(const Preset& preset, std::size_t pass,
                                 const ProgramOptions& options, ProgramShelf* shelf,
                                 ProgramsAhead* ahead) {
    const ProgramOptions leaner = behind_root(preset, options);
    auto linked = ahead ? ahead->take(pass) : std::nullopt;
    CompiledPass first = linked ? linked_pass(preset, pass, std::move(linked->source),
                                              std::move(linked->program), shelf)
                                : compile_pass(preset, pass, leaner, shelf);
    const bool is_done = first.program && first.diagnostics.empty();
    if (is_done || leaner.lean == options.lean) return first;
    return compile_pass(preset, pass, options, shelf);
}

void add_named_samplers(const Preset& preset, const ProgramOptions& options, PassProgram& program) {
    const auto is_read = [&](std::size_t sampler) {
        return std::ranges::find(program.samplers, sampler, &SamplerUniform::sampler) !=
               program.samplers.end();
    };
    const std::string text = pass_text(preset, program.pass, options).text;
    for (const std::size_t sampler : samplers_named(preset, program.pass, text)) {
        const auto unit = static_cast<GLint>(program.samplers.size() + program.unfilled.size());
        const bool is_filled = sampler_at(preset, sampler).source != Source::none;
        if (is_filled && !is_read(sampler)) program.samplers.push_back({sampler, unit});
    }
}

// A shorter text links faster than a context is made.
constexpr std::size_t kWorthAThread = 16 * 1024;  // bytes

bool is_worth_a_thread(const Preset& preset, const CompileOptions& options,
                       const ProgramShelf* shelf) {
    return options.side_by_side && options.root == kImagePass &&
           std::thread::hardware_concurrency() > 1 && !preset.scene.passes.empty() &&
           preset.scene.text.size() > kWorthAThread && (!shelf || shelf->size() == 0);
}

}  // namespace

CompileResult compile_scene(const Preset& preset, const CompileOptions& options,
                            const std::function<void(std::size_t pass)>& before_pass,
                            const GiveUp& give_up, ProgramShelf* shelf) {
    const double began_ms = own_processor_ms();
    CompileResult result;
    std::vector<PassProgram> programs;
    std::vector<PassReads> reads;
    std::vector<std::size_t> wanted = {options.root};
    std::optional<ProgramsAhead> ahead;
    if (is_worth_a_thread(preset, options, shelf))
        ahead.emplace(preset, behind_root(preset, options.program), give_up);
    for (std::size_t next = 0; next < wanted.size(); ++next) {
        if (before_pass) before_pass(wanted[next]);
        std::optional<CompileWatch> watch;
        if (give_up) watch.emplace(give_up, preset, wanted[next]);
        CompiledPass compiled = next == 0
                                    ? compile_pass(preset, wanted[next], options.program, shelf)
                                    : compile_behind_root(preset, wanted[next], options.program,
                                                          shelf, ahead ? &*ahead : nullptr);
        watch.reset();
        append_once(result.diagnostics, compiled.diagnostics);
        if (!compiled.program) return result;
        if (options.as_written) add_named_samplers(preset, options.program, *compiled.program);
        reads.push_back(reads_of(preset, *compiled.program, options.program));
        programs.push_back(std::move(*compiled.program));
        for (const std::size_t buffer : reads.back().buffers) {
            if (std::find(wanted.begin(), wanted.end(), buffer) == wanted.end()) {
                wanted.push_back(buffer);
            }
        }
    }
    // Drawing order is the order of declarations; the picture, whose index is the largest, is last.
    // A buffer that is wanted may read later ones back, and stand before them.
    std::sort(programs.begin(), programs.end(),
              [](const PassProgram& a, const PassProgram& b) { return a.pass < b.pass; });
    CompiledScene& scene = result.scene.emplace();
    scene.programs = std::move(programs);
    scene.root = static_cast<std::size_t>(
        std::find_if(scene.programs.begin(), scene.programs.end(),
                     [&](const PassProgram& program) { return program.pass == options.root; }) -
        scene.programs.begin());
    scene.give_up = give_up;
    scene.compile_ms = own_processor_ms() - began_ms;
    scene.graph = build_graph(preset.scene.passes, std::move(reads));
    return result;
}

std::vector<GLuint> ids_of(const CompiledScene& scene) {
    std::vector<GLuint> ids;
    for (const PassProgram& program : scene.programs) ids.push_back(program.id);
    return ids;
}

}  // namespace glint
