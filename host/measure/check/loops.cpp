// Loops of one software renderer share 65,535 turns a pixel, then end without a word.
#include "measure/check/budget.h"
#include "measure/check/case.h"
#include "measure/check/space.h"
#include "measure/probe/probe.h"

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
    const auto& passes = subject.renderer().graph().passes;
    std::uint32_t most = 0;
    std::string pass;
    std::vector<Probe> probes;
    try {
        for (const GraphPass& one : passes) {
            probes.emplace_back(subject.opened(), one.pass,
                                ProgramOptions{.specialise = subject.specialised()},
                                ProbeWish{.kind = ProbeKind::cost});
            if (subject.after_frame) subject.after_frame();  // compiling is no hang
        }
    } catch (const ProbeRefused& refused) {
        result.verdict = CaseVerdict::skip;
        result.note = fmt::format("left out: {}", refused.what());
        return;
    }
    const Frame frame = subject.frame_at(subject.preset.time, 1.0 / 60, 0);
    subject.renderer().before_pass = [&](std::size_t index) {
        if (probes[index].probed().sites.empty()) return;
        for (const ProbeCell& cell : probes[index].map(subject.renderer(), frame, 0, 0)) {
            if (cell.kept[0] <= most) continue;
            most = cell.kept[0];
            pass = pass_name(subject.scene(), passes[index].pass);
        }
    };
    const CaseClock clock(check);
    for (const auto& values : values_to_try(subject)) {
        subject.restore();
        subject.preset.values = values;
        subject.renderer().redraw();
        if (!subject.draw(frame) || most >= kNearly) break;
        if (clock.is_over(0.03)) break;
    }
    subject.renderer().before_pass = nullptr;
    result.note = fmt::format("at most {} turns in a pixel{}", most,
                              subject.specialised() && !subject.preset.values.empty()
                                  ? ", with the preset's values"
                                  : "");
    if (most >= kNearly)
        result.fail(
            fmt::format("loops of {} use all {} turns that llvmpipe has for a pixel, then end "
                        "silently; split the work over passes, frames or --tile",
                        pass, kBudget));
}

}  // namespace

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
