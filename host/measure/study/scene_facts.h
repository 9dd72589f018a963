// What of a scene a study can turn.
#pragma once

#include "scene/preset.h"

#include <cstddef>
#include <functional>
#include <vector>

namespace glint {

// What the compiled scene tells.
struct SceneFacts {
    std::vector<bool> drawn;  // by pass: the picture needs it, with some values
    std::vector<bool> read;   // by tweak: something reads it, with some values of the others
    std::vector<bool> acts;   // by tweak: what later frames depend on reads it, or may
    // The same while one tweak has this value.
    std::function<std::vector<bool>(std::size_t tweak, const TweakValue&)> read_with;
    // Whether frames with time held bring something new, with these values.
    std::function<bool(const std::vector<TweakValue>&)> accumulates;
};
// Compiles the scene; throws Stop where that fails. The facts keep the preset by reference.
SceneFacts scene_facts(const Preset& preset, std::size_t root_pass);

}  // namespace glint
