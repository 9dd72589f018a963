#include "measure/study/scene_facts.h"

#include "offline/common.h"

#include <algorithm>

namespace glint {

SceneFacts scene_facts(const Preset& preset, std::size_t root_pass) {
    const auto read_by = [](const Preset& view, const CompiledScene& compiled) {
        std::vector<bool> read(view.scene.tweaks.size(), false);
        for (const PassProgram& program : compiled.programs) {
            for (const TweakUniform& uniform : program.tweaks) read[uniform.tweak] = true;
        }
        return read;
    };
    const CompiledScene fed =
        compile_or_stop(preset, {.root = root_pass, .program = {.specialise = false}});
    SceneFacts facts{.drawn = std::vector<bool>(preset.scene.passes.size(), false),
                     .read = read_by(preset, fed),
                     .acts = std::vector<bool>(preset.scene.tweaks.size(), false),
                     .read_with = {},
                     .accumulates = {}};
    for (const GraphPass& pass : fed.graph.passes) {
        if (pass.pass != kImagePass) facts.drawn[pass.pass] = true;
    }
    for (std::size_t i = 0; i < fed.programs.size(); ++i) {
        if (!fed.graph.passes[i].feeds_state) continue;
        for (const TweakUniform& uniform : fed.programs[i].tweaks) facts.acts[uniform.tweak] = true;
    }
    facts.read_with = [&preset, root_pass, read_by](std::size_t tweak, const TweakValue& value) {
        Preset turned = preset;
        turned.values[tweak] = value;
        return read_by(
            turned,
            compile_or_stop(turned, {.root = root_pass,
                                     .program = {.specialise = false, .constants = {tweak}}}));
    };
    const auto any_state = [](const CompiledScene& compiled) {
        const auto& passes = compiled.graph.passes;
        return std::ranges::any_of(passes, [](const GraphPass& pass) {
            return pass.feeds_state && pass.runs == Runs::every_frame;
        });
    };
    // Tweaks can only take a state away from what the uniform-fed form has.
    facts.accumulates = [&preset, root_pass, any_state,
                         possible = any_state(fed)](const std::vector<TweakValue>& values) {
        if (!possible) return false;
        Preset turned = preset;
        turned.values = values;
        return any_state(compile_or_stop(turned, {.root = root_pass, .program = {}}));
    };
    return facts;
}

}  // namespace glint
