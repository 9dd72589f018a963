// Loops of one software renderer share 65,535 turns a pixel, then end without a word.
#include "measure/check/budget.h"
#include "measure/check/case.h"
#include "measure/check/space.h"
#include "measure/check/subject.h"
#include "measure/probe/loop_turns.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <utility>

namespace glint {
namespace {

constexpr std::size_t kLoopEnds = 16;  // sets of tweaks

// What is specialised has no other values than the preset's.
std::vector<std::vector<TweakValue>> values_to_try(const CheckSubject& subject) {
    if (subject.specialised()) return {subject.preset.values};
    return values_at_ends(subject, kLoopEnds);
}

// Of the tweaks those stay that it takes.
void fail(CheckSubject& subject,
          const std::function<bool(const std::vector<TweakValue>&)>& runs_out,
          const LoopTurns& turns, bool with_neighbours, std::vector<TweakValue> values,
          CaseResult& result) {
    const std::string pass = with_neighbours ? "image" : turns.pass();
    std::string at;
    for (std::size_t i = 0; i < values.size(); ++i) {
        const Tweak& tweak = subject.scene().tweaks[i];
        const TweakValue tried = std::exchange(values[i], subject.opened().values[i]);
        if (tried == values[i] || runs_out(values)) continue;
        values[i] = tried;
        at += fmt::format("{}{}={}", at.empty() ? "; at " : ", ", tweak.name,
                          format_value(tweak, tried));
    }
    runs_out(values);  // the picture is of these
    result.fail(
        fmt::format("loops of {} use all {} turns that llvmpipe has for a pixel{}, then "
                    "end silently; split the work over passes, frames or --tile{}",
                    pass, kLoopBudget, with_neighbours ? " and its neighbours" : "", at));
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
    const Frame frame = subject.frame_at(subject.preset.time, 1.0 / 60, 0);
    const CaseClock clock(check);
    bool with_neighbours = false, is_finite = false;
    std::uint32_t most = 0;
    const auto runs_out = [&](const std::vector<TweakValue>& values) {
        subject.restore();
        subject.preset.values = values;
        turns->forget();
        turns->count(frame, [&] { is_finite = subject.draw(frame); });
        most = std::max(most, turns->most());
        if (!is_finite || turns->is_cut()) return turns->is_cut();
        with_neighbours = turns->most() >= kFewTurns && !subject.stateful() &&
                          differs_alone(subject.opened(), subject.renderer(), program, frame);
        if (subject.after_frame) subject.after_frame();  // compiling is no hang
        return with_neighbours;
    };
    for (const auto& values : values_to_try(subject)) {
        if (runs_out(values))
            return fail(subject, runs_out, *turns, with_neighbours, values, result);
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
