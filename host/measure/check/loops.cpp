// Loops of one software renderer share 65,535 turns a pixel, then end without a word.
#include "measure/check/budget.h"
#include "measure/check/case.h"
#include "measure/check/situation.h"
#include "measure/check/subject.h"
#include "measure/probe/loop_turns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

namespace glint {
namespace {

constexpr std::size_t kLoopEnds = 16;  // sets of tweaks
constexpr int kLoopSpread = 8;         // points within all ranges

// Of the tweaks those stay that it takes.
void fail(CheckSubject& subject, const std::function<bool(const Situation&)>& runs_out,
          const LoopTurns& turns, bool with_neighbours, Situation at, CaseResult& result) {
    const std::string pass = with_neighbours ? "image" : turns.pass();
    for (std::size_t i = 0; i < at.values.size(); ++i) {
        const TweakValue tried = std::exchange(at.values[i], subject.opened().values[i]);
        if (tried != at.values[i] && !runs_out(at)) at.values[i] = tried;
    }
    Situation as_opened = at;
    as_opened.events = subject.opened().events;
    as_opened.time = subject.opened().time;
    if (runs_out(as_opened)) at = as_opened;
    runs_out(at);  // the picture is of this
    const std::string where = where_words(at, subject);
    result.fail(
        fmt::format("loops of {} use all {} turns that llvmpipe has for a pixel{}, then "
                    "end silently; split the work over passes, frames or --tile{}",
                    pass, kLoopBudget, with_neighbours ? " and its neighbours" : "", where));
}

void run_loops(Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    const ProgramOptions program{.specialise = subject.specialised()};
    std::optional<LoopTurns> turns;
    try {
        turns.emplace(subject.opened(), subject.renderer(), program, subject.after_frame);
    } catch (const ProbeRefused& refused) {
        result.verdict = CaseVerdict::skip;
        result.note = fmt::format("left out: {}", refused.what());
        return;
    }
    const CaseClock clock(check);
    bool with_neighbours = false, is_finite = false;
    std::uint32_t most = 0;
    const auto runs_out = [&](const Situation& one) {
        one.bring(subject);
        const long index = subject.stateful() ? 0 : std::lround(one.time * 60.0);
        const Frame frame = subject.frame_at(one.time, 1.0 / 60, index);
        turns->forget();
        turns->count(frame, [&] { is_finite = subject.draw(frame); });
        most = std::max(most, turns->most());
        if (!is_finite || turns->is_cut()) return turns->is_cut();
        with_neighbours = turns->most() >= kFewTurns && !subject.stateful() &&
                          differs_alone(subject.opened(), subject.renderer(), program, frame);
        if (subject.after_frame) subject.after_frame();  // compiling is no hang
        return with_neighbours;
    };
    for (const Situation& one : situations(subject, kLoopEnds, kLoopSpread)) {
        if (runs_out(one)) return fail(subject, runs_out, *turns, with_neighbours, one, result);
        if (!is_finite || clock.is_over(0.03)) break;
    }
    result.note = fmt::format("at most {} turns in a pixel{}", most,
                              subject.specialised() && !subject.preset.values.empty()
                                  ? ", with the preset's values"
                                  : "");
}

}  // namespace

void add_loop_case(std::vector<Case>& list, const CheckSubject& subject) {
    const std::string& text = subject.scene().text;
    const bool has_loops =
        text.find("for") != std::string::npos || text.find("while") != std::string::npos;
    // A long text takes too long to compile with all that its tweaks may ask for.
    const bool all_values = subject.is_short() && !subject.scene().tweaks.empty();
    if (has_loops && ends_loops(subject.context()))
        list.push_back(
            {"loop budget", run_loops, all_values ? Case::Tweaks::all : Case::Tweaks::none});
}

}  // namespace glint
