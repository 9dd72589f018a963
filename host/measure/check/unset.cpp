// What a scene reads before setting it: is the picture another one where that is not 0?
//
// Drivers owe such values nothing. Glint and browsers write zeros (glsl/zeros.h); here they are
// marks instead. Where these show, halves of what was unset are tried until the first is found that
// shows on its own.
#include "measure/check/unset.h"

#include "measure/check/budget.h"
#include "measure/check/case.h"
#include "measure/check/situation.h"
#include "measure/rows/difference.h"

#include <fmt/format.h>

#include <algorithm>

namespace glint {
namespace {

constexpr double kUnsetPlayed = 0.5;  // s of a simulation
constexpr double kUnsetShare = 0.03;  // of the seconds, before marks are looked for
constexpr std::size_t kEnds = 16;     // sets of tweaks
constexpr int kUnsetSpread = 8;       // points within all ranges

// The pictures with and without marks.
class Comparison {
public:
    explicit Comparison(CheckSubject& subject)
        : subject_(subject), situations_(situations(subject, kEnds, kUnsetSpread)) {
        if (subject.stateful() || !subject.moves()) return;
        // What a scene does for a while only; then every second, as long as there is time.
        for (const double time : {1.3, 2.9, 4.7, 7.1, 10.3, 14.9, 21.1, 33.7, 55.3})
            situations_.push_back(
                {subject.opened().values, subject.opened().events, time, subject.opened().date});
        for (int second = 0; second < 60; ++second)
            situations_.push_back({subject.opened().values, subject.opened().events, second + 0.6,
                                   subject.opened().date});
    }

    // As many situations as there is time for. False where the scene is not finite by itself; then
    // the subject stands there.
    bool draw_usual(const CaseClock& clock) {
        for (const Situation& one : situations_) {
            one.bring(subject_);
            if (!subject_.show(one.time, kUnsetPlayed)) return false;
            usual_.push_back(subject_.picture());
            if (clock.is_over(kUnsetShare)) break;
        }
        situations_.resize(usual_.size());
        return true;
    }

    // The first situation, if any, in which these show.
    const Situation* where_shows(const Marked& range) const {
        CheckSubject marked(subject_.view(), subject_.opened(), subject_.context(),
                            {.specialise = subject_.specialised(), .marked = range});
        marked.after_frame = subject_.after_frame;
        for (std::size_t i = 0; i < situations_.size(); ++i) {
            situations_[i].bring(marked);
            if (!marked.show(situations_[i].time, kUnsetPlayed)) return &situations_[i];
            const Difference found = difference(marked.picture(), usual_[i]);
            if (found.not_finite > 0 || found.share_off > 0.0) return &situations_[i];
        }
        return nullptr;
    }

private:
    CheckSubject& subject_;
    std::vector<Situation> situations_;
    std::vector<std::vector<float>> usual_;  // by situation
};

// Some are marked, too, where nothing jumps over them.
bool is_never_marked(const Unset& one) {
    return !one.why_not.empty() && !one.why_not.starts_with("a switch");
}

// "; not sure of `big` (12:5, no value can be written for its type, or a macro keeps it)"
std::string words_of_unmarked(const CheckSubject& subject, const std::vector<Unset>& list) {
    std::string words;
    for (const Unset& one : list) {
        if (one.why_not.empty()) continue;
        const Place place = subject.scene().place_at(one.at);
        words += fmt::format("{} `{}` ({}:{}, {})", words.empty() ? "; not sure of" : ",", one.name,
                             place.line, place.column, one.why_not);
    }
    return words;
}

void tell(Check& check, const Unset& unset, const Situation* situation, CaseResult& result) {
    check.subject.still.reset();
    result.fail(words_of(check.subject.scene(), unset) +
                (situation ? where_words(*situation, check.subject) : ""));
}

// Outputs that are not written everywhere, one by one.
bool find_output(Check& check, const Comparison& comparison, std::span<const Unset> list,
                 CaseResult& result) {
    for (const Unset& one : list)
        for (const FirstValue value : kMarks) {
            if (!one.is_output) continue;
            const Situation* situation =
                comparison.where_shows({{one.at, one.at + 1}, value, true});
            if (!situation) continue;
            tell(check, one, situation, result);
            return true;
        }
    return false;
}

void run_unset(Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    std::vector<Unset> list =
        unset_values(subject.opened(), subject.renderer(), subject.specialised());
    const std::string unmarked = words_of_unmarked(subject, list);
    std::erase_if(list, is_never_marked);
    const std::size_t count = list.size();
    Comparison comparison(subject);
    if (!comparison.draw_usual(CaseClock(check))) return;
    if (find_output(check, comparison, list, result)) return;
    std::erase_if(list, [](const Unset& one) { return one.is_output; });
    const auto mark = std::ranges::find_if(kMarks, [&](FirstValue value) {
        return !list.empty() && comparison.where_shows({{0, subject.scene().text.size()}, value});
    });
    if (mark == std::end(kMarks)) {
        result.note = fmt::format("{} values, none shows{}", count, unmarked);
        return;
    }
    const Unset& first = first_that_shows(list, [&](Span range) {
        return comparison.where_shows({range, *mark}) != nullptr;
    });
    tell(check, first, comparison.where_shows({{first.at, first.at + 1}, *mark}), result);
}

}  // namespace

std::vector<Unset> unset_values(const Preset& preset, const Renderer& renderer, bool specialise) {
    std::vector<Unset> list;
    for (const GraphPass& pass : renderer.graph().passes) {
        const PassText text = pass_text(preset, pass.pass, {.specialise = specialise});
        list.insert(list.end(), text.unset.begin(), text.unset.end());
    }
    std::ranges::stable_sort(list, {}, &Unset::at);
    const auto same = std::ranges::unique(list, {}, &Unset::at);
    list.erase(same.begin(), same.end());
    return list;
}

const Unset& first_that_shows(const std::vector<Unset>& list,
                              const std::function<bool(Span)>& shows) {
    std::size_t begin = 0, end = list.size();
    while (end - begin > 1) {
        const std::size_t middle = begin + (end - begin) / 2;
        if (shows({list[begin].at, list[middle].at}))
            end = middle;
        else
            begin = middle;
    }
    return list[begin];
}

std::string words_of(const Scene& scene, const Unset& unset) {
    const Place place = scene.place_at(unset.at);
    return fmt::format(
        "counts on uninitialised values: {}:{}:{}: {}", place.file, place.line, place.column,
        unset.has_no_name
            ? "what a parameter without a name hands back is read; give it a name and a value"
        : unset.is_result ? fmt::format("the function `{}` may end without a return", unset.name)
        : unset.is_output
            ? fmt::format("`{}` is not written everywhere, or added to; give it a first value",
                          unset.name)
            : fmt::format("`{}` is read where nothing has set it; give it a first value",
                          unset.name));
}

void add_unset_case(std::vector<Case>& list, const CheckSubject& subject) {
    if (!unset_values(subject.opened(), subject.renderer(), subject.specialised()).empty())
        list.push_back({"uninitialised values", run_unset,
                        subject.scene().tweaks.empty() ? Case::Tweaks::none : Case::Tweaks::all});
}

}  // namespace glint
