// Loops of one software renderer share 65,535 turns a pixel, then end without a word.
#include "measure/check/loops.h"

#include "measure/check/budget.h"
#include "measure/check/case.h"
#include "measure/check/space.h"

#include <fmt/format.h>

#include <algorithm>

namespace glint {
namespace {

constexpr std::uint32_t kBudget = 65535, kNearly = 65000;
constexpr std::size_t kLoopEnds = 16;  // sets of tweaks

// What is specialised has no other values than the preset's.
std::vector<std::vector<TweakValue>> values_to_try(const CheckSubject& subject) {
    if (subject.specialised()) return {subject.preset.values};
    return values_at_ends(subject, kLoopEnds);
}

void run_loops(Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    std::optional<LoopTurns> turns;
    try {
        turns.emplace(subject);
    } catch (const ProbeRefused& refused) {
        result.verdict = CaseVerdict::skip;
        result.note = fmt::format("left out: {}", refused.what());
        return;
    }
    const Frame frame = subject.frame_at(subject.preset.time, 1.0 / 60, 0);
    const CaseClock clock(check);
    for (const auto& values : values_to_try(subject)) {
        subject.restore();
        subject.preset.values = values;
        if (!turns->count(frame) || turns->most() >= kNearly) break;
        if (clock.is_over(0.03)) break;
    }
    result.note = fmt::format("at most {} turns in a pixel{}", turns->most(),
                              subject.specialised() && !subject.preset.values.empty()
                                  ? ", with the preset's values"
                                  : "");
    if (turns->most() >= kNearly)
        result.fail(
            fmt::format("loops of {} use all {} turns that llvmpipe has for a pixel, then end "
                        "silently; split the work over passes, frames or --tile",
                        turns->pass(), kBudget));
}

}  // namespace

LoopTurns::LoopTurns(CheckSubject& subject) : subject_(subject) {
    for (const GraphPass& one : subject.renderer().graph().passes) {
        probes_.emplace_back(subject.opened(), one.pass,
                             ProgramOptions{.specialise = subject.specialised()},
                             ProbeWish{.kind = ProbeKind::cost});
        if (subject.after_frame) subject.after_frame();  // compiling is no hang
    }
}

bool LoopTurns::count(const Frame& frame) {
    Renderer& renderer = subject_.renderer();
    turns_ = 0.0;
    pixels_ = static_cast<double>(subject_.preset.size.x) * subject_.preset.size.y;
    renderer.before_pass = [&](std::size_t index) {
        if (probes_[index].probed().sites.empty()) return;
        for (const ProbeCell& cell : probes_[index].map(renderer, frame, 0, 0)) {
            turns_ += cell.kept[0];
            if (cell.kept[0] <= most_) continue;
            most_ = cell.kept[0];
            pass_ = pass_name(subject_.scene(), renderer.graph().passes[index].pass);
        }
    };
    renderer.redraw();
    const bool is_finite = subject_.draw(frame);
    renderer.before_pass = nullptr;
    return is_finite;
}

void add_loop_case(std::vector<Case>& list, const CheckSubject& subject) {
    const std::string& text = subject.scene().text;
    const bool has_loops =
        text.find("for") != std::string::npos || text.find("while") != std::string::npos;
    // A long text takes too long to compile with all that its tweaks may ask for.
    const bool all_values = subject.is_short() && !subject.scene().tweaks.empty();
    if (has_loops && subject.context().renderer().find("llvmpipe") != std::string::npos)
        list.push_back(
            {"loop budget", run_loops, all_values ? Case::Tweaks::all : Case::Tweaks::none});
}

}  // namespace glint
