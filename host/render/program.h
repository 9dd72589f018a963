// One pass of a scene as a linked GL program: the prologue, the map back to the user's lines, and
// what the program really reads.
#pragma once

#include "gl/objects.h"
#include "scene/preset.h"

#include <optional>
#include <string>
#include <vector>

namespace glint {

// The pass that draws the picture itself; the others are indices into Scene::passes.
inline constexpr std::size_t kImagePass = static_cast<std::size_t>(-1);

// The name a person knows a pass by: "image", or that of the first sampler that it fills.
std::string pass_name(const Scene& scene, std::size_t pass);

// A sampler that some pass may read: one of the scene's, or one of the four channels of a preset.
const Sampler& sampler_at(const Preset& preset, std::size_t index);  // channels follow the scene's
std::size_t sampler_count(const Preset& preset);

struct ProgramOptions {
    bool specialise = true;  // write the tweaks in as constants
    bool average = false;    // the picture in linear light at a sub-pixel position, to be added up
    bool clamp_to_bytes = false;  // with `average`: what a display would clip is clipped first
};

// The GLSL ES 3.00 text that the driver sees for one pass.
struct PassText {
    // A place of the text, behind which its line is longer than the user's.
    struct Widened {
        int line = 0, column = 0;  // from 1
        int by = 0;                // characters
    };
    std::string text;
    int prologue_lines = 0;  // the user's text starts on the next line
    std::vector<Widened> widened{};
};
PassText pass_text(const Preset& preset, std::size_t pass, const ProgramOptions& options);

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
    jitter,          // sub-pixel position, averaged pictures only
    face,            // of a cubemap pass
};

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
    std::optional<SamplerType> type;  // none: one of GLSL's other types, which no texture here fits
    GLint unit = 0;
};

struct PassProgram {
    std::size_t pass = kImagePass;
    Program program;
    std::vector<BuiltinUniform> builtins;
    std::vector<TweakUniform> tweaks;
    std::vector<SamplerUniform> samplers;
    std::vector<UnfilledSampler> unfilled;
};

struct CompiledPass {
    std::optional<PassProgram> program;  // empty when there are errors
    Diagnostics diagnostics;             // with places in the user's text
};
CompiledPass compile_pass(const Preset& preset, std::size_t pass, const ProgramOptions& options);

// The driver's log about a text as diagnostics. Reads the forms of Mesa "0:12(5): error: …", NVIDIA
// "0(12) : error C1: …" and ANGLE or Intel "ERROR: 0:12: …".
Diagnostics read_driver_log(const Scene& scene, const std::string& log, const PassText& text);

}  // namespace glint
