// A preset: a small TOML file that keeps a look of a scene. A bare scene file opens as a preset of
// its defaults.
#pragma once

#include "base/diagnostic.h"
#include "scene/expect.h"
#include "scene/frame.h"
#include "scene/scene.h"

#include <glm/vec2.hpp>

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

// Values of some tweaks under one name: `[quality.fast]`, chosen with --quality fast.
struct QualitySet {
    std::string name;
    std::vector<Turned> values;
};

struct Preset {
    std::filesystem::path file;  // what was opened: a .toml, or the scene itself
    Scene scene;
    std::string title;
    double time = 0.0;               // s; where a still is taken and where the window starts
    glm::ivec2 size{1280, 720};      // pixels
    bool has_size = false;           // whether the file says so
    int settle = 0;                  // frames drawn with time held, for scenes that accumulate
    Date date;                       // when time is 0
    std::vector<TweakValue> values;  // one for each of scene.tweaks, within its range
    // Names of tweaks that a random look leaves alone, as the file lists them; also of some that
    // the scene does not have today.
    std::vector<std::string> locked;
    std::vector<QualitySet> qualities;
    // What is watched in the window and by `probe`: `EXPR@LINE`, as `--expr` names it.
    std::vector<std::string> watch;
    std::array<Sampler, 4>
        channels;               // iChannel0..3 of pasted text; those the scene declares itself win
    std::vector<Event> events;  // in order of time
    Expect expect;              // of the file's own look, whatever has been turned since
};

struct ReadPreset {
    std::optional<Preset> preset;  // empty when there are errors
    Diagnostics diagnostics;
    // Every file that was read or asked for, also when there are errors: what a reload watches.
    std::vector<std::filesystem::path> files;
};

// By its name alone, which ends in ".toml"; any other is a scene.
bool is_preset(const std::filesystem::path& file);

// Reads a preset with its scene, or a scene with its defaults (".json": a shader of the site).
// Never throws for what the files say.
ReadPreset read_preset(const std::filesystem::path& file);

// A preset's text as read_preset would read it in `file`, but for this scene, whichever it names.
// No file is touched.
ReadPreset parse_preset(std::string_view text, const std::filesystem::path& file,
                        const Scene& scene);

}  // namespace glint
