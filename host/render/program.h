// One pass of a scene as a linked GL program, and what it really reads.
#pragma once

#include "gl/objects.h"
#include "render/pass_text.h"

#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

namespace glint {

// Built-in uniforms whose value the host supplies.
enum class Builtin {
    resolution,
    time,
    time_delta,
    frame_rate,
    frame,
    mouse,
    date,
    sample_rate,
    tick,
    channel_time,
    channel_resolution,
    channel_struct,  // size, time and loaded of iCh0..3
    resolution_2d,   // u_resolution, u_mouse: the first two components alone
    mouse_2d,
    mouse_share,  // mouse of GLSL Sandbox, of the picture's sides
    jitter,       // sub-pixel position, averaged pictures only
    face,         // of a cubemap pass
    origin,       // of a tile of the picture
};

// Whether it hangs on the mouse.
constexpr bool is_of_mouse(Builtin builtin) {
    return builtin == Builtin::mouse || builtin == Builtin::mouse_2d ||
           builtin == Builtin::mouse_share;
}

// Whether it is another in every frame, so that a pass that reads it is drawn in each.
constexpr bool changes_by_itself(Builtin builtin) {
    switch (builtin) {
        case Builtin::time:
        case Builtin::frame:
        case Builtin::tick:
        case Builtin::date:
            return true;
        case Builtin::resolution:
        case Builtin::time_delta:
        case Builtin::frame_rate:
        case Builtin::mouse:
        case Builtin::sample_rate:
        case Builtin::channel_time:
        case Builtin::channel_resolution:
        case Builtin::channel_struct:
        case Builtin::resolution_2d:
        case Builtin::mouse_2d:
        case Builtin::mouse_share:
        case Builtin::jitter:
        case Builtin::face:
        case Builtin::origin:
            return false;
    }
    return false;
}

// An active uniform: where it is, and which value belongs there.
struct BuiltinUniform {
    Builtin builtin;
    std::string name;
    int index = 0;  // element, for iChannelTime[i], iChannelResolution[i] and iCh<i>
    GLint location = -1;
};
struct TweakUniform {
    std::size_t tweak;
    GLint location = -1;
};
struct SamplerUniform {
    std::size_t sampler;  // as in sampler_at
    GLint unit = 0;
};

// A sampler that nothing fills; it reads 0. It has a unit of its own: those that are not told
// otherwise all share unit 0, and would read what stands there.
struct UnfilledSampler {
    std::string name;
    std::optional<SamplerType> type;  // none: one of GLSL's other types, which no texture here fits
    GLint unit = 0;
};

struct PassProgram {
    std::size_t pass = kImagePass;
    Program own;    // unless a shelf owns it
    GLuint id = 0;  // of the program
    std::vector<BuiltinUniform> builtins;
    std::vector<TweakUniform> tweaks;
    std::vector<SamplerUniform> samplers;
    std::vector<UnfilledSampler> unfilled;
    std::vector<float> numbers;  // of kNumbers, four to an element
    GLint numbers_location = -1;
};

// Linked programs by their texts: what an edit leaves as it was is not compiled again. It outlives
// the scenes and renderers that take programs from it; of two renderers one draws at a time.
class ProgramShelf {
public:
    // 0 where there is none.
    GLuint find(const std::string& text) const;
    GLuint add(const std::string& text, Program program);
    // Null where it is not here.
    const std::string* text_of(GLuint id) const;
    // All others go.
    void keep_only(const std::vector<GLuint>& ids);
    std::size_t size() const { return programs_.size(); }

private:
    std::unordered_map<std::string, Program> programs_;
};

// The samplers of iChannel0..3 about which the pass asks: their sizes or times.
std::vector<std::size_t> channels_told_of(const Preset& preset, const PassProgram& program);

struct CompiledPass {
    std::optional<PassProgram> program;  // empty when there are errors
    Diagnostics diagnostics;             // with places in the user's text
};
// Programs are taken from the shelf, where there is one, and added to it; what the driver said of
// them is told once, when they are compiled. `was_kept` says whether it was there.
CompiledPass compile_pass(const Preset& preset, std::size_t pass, const ProgramOptions& options,
                          ProgramShelf* shelf = nullptr, bool* was_kept = nullptr);
// The same of a program that is linked already, of which the driver had nothing to say.
CompiledPass linked_pass(const Preset& preset, std::size_t pass, PassText source, Program own,
                         ProgramShelf* shelf = nullptr);
// The same of a text that is written already.
CompiledPass compile_text(const Preset& preset, std::size_t pass, PassText source,
                          ProgramShelf* shelf = nullptr, bool* was_kept = nullptr);

// Of a text for one pass. Nothing is said of it but by the driver.
LinkedProgram make_pass_program(const std::string& text);

}  // namespace glint
