// Loops of one software renderer share 65,535 turns a pixel, then end without a word.
#include "base/words.h"
#include "measure/check/budget.h"
#include "measure/check/case.h"
#include "measure/check/situation.h"
#include "measure/check/subject.h"
#include "measure/probe/loop_turns.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <utility>

namespace glint {
namespace {

constexpr std::size_t kLoopEnds = 16;  // sets of tweaks
constexpr int kLoopSpread = 8;         // points within all ranges
// A day, when a float's steps are 0.008 s, a month with steps of 0.25 s, and a year with those of
// 2 s. Less than half a step that is added to such a clock is lost, and so a loop may never end,
// while the end itself is not lost yet.
constexpr double kLate[] = {86400.0, 2592000.0, 31536000.0};  // s

constexpr double kLoopShare = 0.03;

// Of the tweaks those stay that it takes, as far as there is time to tell.
void fail(CheckSubject& subject, const std::function<bool(const Situation&)>& runs_out,
          const CaseClock& clock, const LoopTurns& turns, bool with_neighbours, Situation at,
          CaseResult& result) {
    const std::string pass = with_neighbours ? "image" : turns.pass();
    for (std::size_t i = 0; i < at.values.size() && !clock.is_over(kLoopShare); ++i) {
        if (at.values[i] == subject.opened().values[i]) continue;
        const TweakValue tried = std::exchange(at.values[i], subject.opened().values[i]);
        if (!runs_out(at)) at.values[i] = tried;
    }
    Situation as_opened = at;
    as_opened.events = subject.opened().events;
    as_opened.time = subject.opened().time;
    if (!clock.is_over(kLoopShare) && runs_out(as_opened)) at = as_opened;
    runs_out(at);  // the picture is of this
    const bool is_late = at.time >= kLate[0] && at.time != subject.opened().time;
    result.fail(fmt::format(
        "loops of {} use all {} turns that llvmpipe has for a pixel{}, then end silently; {}{}{}",
        pass, kLoopBudget, with_neighbours ? " and its neighbours" : "",
        is_late ? "bound the turns by an int, and add small steps to 0 rather than to iTime"
                : "split the work over passes, frames or --tile",
        where_words(at, subject), is_late ? ": a float of that age holds no small steps" : ""));
}

// Of a scene without a state, which a late clock brings to nothing else.
std::vector<Situation> late_situations(const CheckSubject& subject) {
    std::vector<Situation> late;
    if (subject.stateful() || !subject.reads(Builtin::time)) return late;
    for (const double time : kLate)
        late.push_back({subject.opened().values, subject.opened().events, time});
    return late;
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
    std::vector<Situation> all = situations(subject, kLoopEnds, kLoopSpread);
    std::ranges::copy(late_situations(subject), std::back_inserter(all));
    for (const Situation& one : all) {
        if (runs_out(one))
            return fail(subject, runs_out, clock, *turns, with_neighbours, one, result);
        if (!is_finite) {
            const std::string where = where_words(one, subject);
            result.note = where.empty() ? "" : where.substr(2);
            return;
        }
        if (clock.is_over(kLoopShare)) break;
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
        find_whole_word(text, "for") != text.npos || find_whole_word(text, "while") != text.npos;
    // A long text takes too long to compile with all that its tweaks may ask for.
    const bool all_values = subject.is_short() && !subject.scene().tweaks.empty();
    if (has_loops && ends_loops(subject.context()))
        list.push_back({.name = "loop budget",
                        .run = run_loops,
                        .tweaks = all_values ? Case::Tweaks::all : Case::Tweaks::none,
                        .ends_itself = true});
}

}  // namespace glint
