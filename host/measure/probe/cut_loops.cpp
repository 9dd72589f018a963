#include "measure/probe/cut_loops.h"

#include "base/terminal.h"
#include "base/words.h"
#include "measure/probe/loop_turns.h"
#include "measure/probe/session.h"
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
        if (!turns.is_cut()) return;
        say_diagnostic({Severity::warning, *place,
                        fmt::format("llvmpipe has ended loops of {} after {} turns, so that the "
                                    "picture is not what the text says: share the work out over "
                                    "passes, samples or frames",
                                    turns.pass(), kLoopBudget)});
    } catch (const ProbeRefused&) {  // nobody can tell
    }
}

}  // namespace glint
