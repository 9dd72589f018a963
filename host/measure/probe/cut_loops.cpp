#include "measure/probe/cut_loops.h"

#include "base/terminal.h"
#include "base/words.h"
#include "measure/probe/loop_turns.h"
#include "measure/probe/session.h"
#include "offline/sound.h"
#include "scene/lint.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <functional>
#include <optional>
#include <vector>

namespace glint {
namespace {

constexpr int kMostPixels = 160;  // a side

// Where a loop begins that may take too many turns; nothing where the text allows it.
std::optional<Place> long_loop(const Preset& preset) {
    const std::string& text = preset.scene.text;
    if (find_whole_word(text, "for") == text.npos && find_whole_word(text, "while") == text.npos)
        return std::nullopt;
    std::vector<PlacedFinding> findings = lint(preset).findings;
    std::erase_if(findings, std::not_fn(is_of_long_loop));
    drop_allowed(preset.scene, findings);
    return findings.empty() ? std::nullopt : std::optional(findings.front().place);
}

void say_cut(const Place& place, const LoopTurns& turns, std::string_view what,
             std::string_view over) {
    say_diagnostic({Severity::warning, place,
                    fmt::format("llvmpipe has ended loops of {} after {} turns, so that the {} is "
                                "not what the text says: share the work out over {}",
                                turns.pass(), kLoopBudget, what, over)});
}

}  // namespace

void say_cut_loops(Preset preset, const ProbeOptions& options) {
    preset.time = time_of(options, preset.time);
    const std::optional<Place> place = long_loop(preset);
    if (!place) return;
    const int longest = std::max(preset.size.x, preset.size.y);
    if (longest > kMostPixels) preset.size = glm::max(preset.size * kMostPixels / longest, 1);
    ProbeSession session(std::move(preset), options);
    if (!ends_loops(session.context()) || session.renderer().graph().stateful) return;
    try {
        LoopTurns turns(session.preset(), session.renderer(), session.program_options());
        const Frame& frame = session.play_to(options);
        turns.count(frame, [&] { session.renderer().draw(frame); });
        if (turns.is_cut()) say_cut(*place, turns, "picture", "passes, samples or frames");
    } catch (const ProbeRefused&) {  // nobody can tell
    }
}

void say_cut_loops_of_sound(const Preset& preset, const ViewOptions& view) {
    const std::optional<Place> place = preset.scene.has_sound ? long_loop(preset) : std::nullopt;
    if (!place) return;
    const auto context = make_egl_context(view.device);
    if (!ends_loops(*context)) return;
    const ProgramOptions options{.specialise = view.specialise};
    SoundRenderer sound(preset, options);
    if (sound.renderer().graph().stateful) return;
    try {
        LoopTurns turns(preset, sound.renderer(), options);
        const Frame frame = sound.frame_of(0);
        turns.count(frame, [&] { sound.drawn(frame); });
        if (turns.is_cut()) say_cut(*place, turns, "sound", "buffers");
    } catch (const ProbeRefused&) {
    }
}

}  // namespace glint
