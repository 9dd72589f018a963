#include "measure/probe/cut_loops.h"

#include "base/terminal.h"
#include "base/words.h"
#include "measure/probe/loop_turns.h"
#include "measure/probe/session.h"
#include "offline/common.h"
#include "offline/sound.h"
#include "render/compile.h"
#include "scene/lint.h"
#include "scene/passes.h"
#include "scene/scene_text.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace glint {
namespace {

constexpr int kMostPixels = 160;  // a side

// Where loops begin that may take too many turns, but for those that the text allows.
std::vector<Place> long_loops(const Preset& preset) {
    const std::string& text = preset.scene.text;
    if (find_whole_word(text, "for") == text.npos && find_whole_word(text, "while") == text.npos)
        return {};
    std::vector<PlacedFinding> findings = lint(preset).findings;
    std::erase_if(findings, std::not_fn(is_of_long_loop));
    drop_allowed(preset.scene, findings);
    std::vector<Place> places;
    for (const PlacedFinding& finding : findings) places.push_back(finding.place);
    return places;
}

// The first that this pass comes to; of all where none is seen to be its.
Place first_of(const std::vector<Place>& loops, const Scene& scene, const std::string& pass) {
    const std::size_t index = find_pass(scene, pass, true);
    const Reading reading = read_glsl(scene.text, known_of_pass(output_names(scene, index)));
    const std::vector<bool> reached = reading.reached_from({entry_of(scene, index)});
    const auto is_in = [&](const Place& loop) {
        for (std::size_t i = 0; i < reached.size(); ++i) {
            const Span span = reading.place(reading.functions[i].tokens);
            const Place begin = scene.place_at(span.begin), end = scene.place_at(span.end);
            const auto where = std::pair(loop.line, loop.column);
            if (reached[i] && loop.file == begin.file &&
                where >= std::pair(begin.line, begin.column) &&
                where <= std::pair(end.line, end.column))
                return true;
        }
        return false;
    };
    const auto loop = std::ranges::find_if(loops, is_in);
    return loop == loops.end() ? loops.front() : *loop;
}

void say_cut(const std::vector<Place>& loops, const Scene& scene, const LoopTurns& turns,
             std::string_view what, std::string_view over) {
    say_diagnostic({Severity::warning, first_of(loops, scene, turns.pass()),
                    fmt::format("llvmpipe has ended loops of {} after {} turns, so that the {} is "
                                "not what the text says: share the work out over {}",
                                turns.pass(), kLoopBudget, what, over)});
}

}  // namespace

void say_cut_loops(Preset preset, const ProbeOptions& options) {
    preset.time = time_of(options, preset.time);
    const std::vector<Place> loops = long_loops(preset);
    if (loops.empty()) return;
    const int longest = std::max(preset.size.x, preset.size.y);
    if (longest > kMostPixels) preset.size = glm::max(preset.size * kMostPixels / longest, 1);
    ProbeSession session(std::move(preset), options);
    if (!ends_loops(session.context())) return;
    // The probe's own text keeps what no pass comes to, by which all may seem to read each other.
    const CompileResult plain =
        compile_scene(session.preset(), {.root = kImagePass, .program = session.program_options()});
    if (!plain.scene || plain.scene->graph.stateful) return;
    try {
        LoopTurns turns(session.preset(), session.renderer(), session.program_options());
        // Nothing comes from the frames before.
        const Preset& drawn = session.preset();
        const Frame frame = settled_frame(drawn, {.end = drawn.time, .fps = options.fps},
                                          options.settle.value_or(drawn.settle));
        turns.count(frame, [&] { session.renderer().draw(frame); });
        if (turns.is_cut())
            say_cut(loops, session.preset().scene, turns, "picture", "passes, samples or frames");
    } catch (const ProbeRefused&) {  // nobody can tell
    }
}

void say_cut_loops_of_sound(const Preset& preset, const ViewOptions& view) {
    if (!preset.scene.has_sound) return;
    const std::vector<Place> loops = long_loops(preset);
    if (loops.empty()) return;
    const auto context = make_egl_context(view.device);
    if (!ends_loops(*context)) return;
    const ProgramOptions options{.specialise = view.specialise};
    SoundRenderer sound(preset, options);
    if (sound.renderer().graph().stateful) return;
    try {
        LoopTurns turns(preset, sound.renderer(), options);
        const Frame frame = sound.frame_of(0);
        turns.count(frame, [&] { sound.drawn(frame); });
        if (turns.is_cut()) say_cut(loops, preset.scene, turns, "sound", "buffers");
    } catch (const ProbeRefused&) {
    }
}

}  // namespace glint
