// How far a simulation's step is from where the state explodes or grows for good, and of which
// order it is: told, not judged.
#include "base/median.h"
#include "measure/check/budget.h"
#include "measure/check/case.h"
#include "measure/check/space.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace glint {
namespace {

constexpr int kStiffPlayed = 4;      // s, after which a step that explodes has
constexpr int kGrowthPlayed = 16;    // s, after which one that only grows has shown itself
constexpr int kTurns = 32;           // steps, one by one, that tell whether it goes to and fro
constexpr int kLooks = 10;           // a second, at the largest value
constexpr double kCompared = 0.5;    // s, after which states of halved steps are compared
constexpr double kMostTimes = 64.0;  // the step in use
constexpr long kParts = 64;          // of a step; how finely it is told
constexpr double kLeastOrder = 0.25;
constexpr std::size_t kStiffEnds = 9;            // sets of tweaks
constexpr double kStiffShare = 0.1;              // of the seconds
constexpr float kBeyond = 16.0f, kLeast = 1.0f;  // the largest value, beside the step in use

// A growth is told that goes on from second to second, faster than the usual step's, to where that
// never comes. What a limit holds or a guard sets back has grown before.
constexpr float kGrows = 1.03f, kFarther = 1.25f;

using StepKey = std::pair<long, long>;

std::set<StepKey> steps_of(const CheckSubject& subject) {
    std::set<StepKey> steps;
    for (const GraphPass& pass : subject.renderer().graph().passes) {
        if (pass.pass == kImagePass) continue;
        const Step step = subject.scene().passes[pass.pass].step;
        if (step) steps.insert({step.numerator, step.denominator});
    }
    return steps;
}

// What a step makes of the state: the largest value that is kept in each second, and at last.
struct Course {
    std::vector<float> peaks;
    float end = 0.0f;  // infinite where it was not finite

    float peak() const { return std::ranges::max(peaks); }
    // From a second to the next, as it mostly is.
    double growth() const {
        std::vector<double> ratios;
        for (std::size_t i = 1; i < peaks.size(); ++i)
            ratios.push_back(std::max(peaks[i], 1e-12f) / std::max(peaks[i - 1], 1e-12f));
        return median_of(ratios);
    }
    bool may_grow() const {
        const auto middle = peaks.begin() + static_cast<std::ptrdiff_t>(peaks.size() / 2);
        return *std::max_element(middle, peaks.end()) >
               kGrows * *std::max_element(peaks.begin(), middle);
    }
};

bool grows(const Course& course, const Course& usual) {
    return course.growth() > kGrows * std::max(usual.growth(), 1.0) &&
           course.peak() > kFarther * usual.peak();
}

double distance(const std::vector<float>& a, const std::vector<float>& b) {
    double squares = 0.0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
        squares += static_cast<double>(a[i] - b[i]) * static_cast<double>(a[i] - b[i]);
    return std::sqrt(squares);
}

// Whether each step goes back what the one before went, and that is no small part of the state.
// What swings faster than its steps tell goes to and fro, too, but hardly ever to where it was.
bool goes_to_and_fro(const std::vector<std::vector<float>>& states) {
    constexpr double kBack = 1e-3, kPart = 0.05;
    std::size_t back = 0;
    for (std::size_t i = 2; i < states.size(); ++i) {
        const double gone = distance(states[i - 1], states[i]);
        const double nothing = distance(states[i], std::vector<float>(states[i].size()));
        back += gone > kPart * nothing && distance(states[i - 2], states[i]) <= kBack * gone;
    }
    return 4 * back >= 3 * states.size();
}

// A subject whose passes of one step have another, until the end of this.
class Stepped {
public:
    Stepped(CheckSubject& subject, StepKey step) : subject_(subject), step_(step) {
        auto& passes = subject.preset.scene.passes;
        for (std::size_t i = 0; i < passes.size(); ++i)
            if (passes[i].step == Step{step.first, step.second}) passes_.push_back(i);
    }
    ~Stepped() {
        set(1, 1);
        subject_.restore();
    }
    Stepped(const Stepped&) = delete;
    Stepped& operator=(const Stepped&) = delete;

    // From the start, so many seconds.
    Course play(long parts, const std::vector<TweakValue>& values, int seconds) {
        set(parts, kParts);
        subject_.restore();
        subject_.preset.values = values;
        Course course;
        play_on(course, seconds);
        return course;
    }

    // What was played last, to so many seconds in all.
    void play_on(Course& course, int seconds) {
        constexpr int kApart = 60 / kLooks;
        while (course.peaks.size() < static_cast<std::size_t>(seconds)) {
            float peak = 0.0f;
            const auto begin = static_cast<int>(course.peaks.size()) * 60;
            for (int k = begin; k < begin + 60; k += kApart) {
                if (!subject_.play_frames(k, k + kApart, 60.0)) {
                    course.end = INFINITY;
                    return;
                }
                course.end = subject_.largest_state();
                peak = std::max(peak, course.end);
            }
            course.peaks.push_back(peak);
        }
    }

    // Whether the state then goes to and fro from step to step, and no less with time: as that of
    // an unstable step does that a limit holds.
    bool chatters(const Course& played) {
        const double fps = 1.0 / subject_.preset.scene.passes[passes_.front()].step.seconds();
        const auto first = static_cast<int>(static_cast<double>(played.peaks.size()) * fps);
        std::vector<std::vector<float>> states;
        for (int k = first; k < first + kTurns && subject_.play_frames(k, k + 1, fps); ++k)
            states.push_back(state());
        return goes_to_and_fro(states);
    }

    // What the passes hold when their step is a part of it.
    std::vector<float> state_with_part(long of) {
        set(1, of);
        subject_.restore();
        subject_.play_frames(0, static_cast<int>(kCompared * 60.0) + 1, 60.0);
        return state();
    }

    // Whether any of it can know how long a step is.
    bool knows_length() const {
        constexpr Builtin kTold[] = {Builtin::time_delta, Builtin::frame_rate, Builtin::time};
        return std::ranges::any_of(passes_, [&](std::size_t pass) {
            return std::ranges::any_of(
                kTold, [&](Builtin builtin) { return subject_.reads(builtin, pass); });
        });
    }

private:
    bool steps(const GraphPass& drawn) const {
        return std::ranges::find(passes_, drawn.pass) != passes_.end();
    }

    std::vector<float> state() const {
        std::vector<float> all;
        const auto& drawn = subject_.renderer().graph().passes;
        for (std::size_t i = 0; i < drawn.size(); ++i) {
            if (!steps(drawn[i])) continue;
            const std::vector<float> values = subject_.renderer().read_buffer(i, 0);
            all.insert(all.end(), values.begin(), values.end());
        }
        return all;
    }

    void set(long parts, long of) {
        for (const std::size_t pass : passes_)
            subject_.preset.scene.passes[pass].step = {step_.first * parts, step_.second * of};
    }

    CheckSubject& subject_;
    StepKey step_;
    std::vector<std::size_t> passes_;
};

std::vector<TweakValue> all_at(const CheckSubject& subject, bool to_max) {
    std::vector<TweakValue> values = subject.opened().values;
    const auto& tweaks = subject.scene().tweaks;
    for (std::size_t i = 0; i < tweaks.size(); ++i) {
        const auto range = range_of(tweaks[i]);
        if (!range) continue;
        values[i].fill(to_max ? range->max : range->min);
        values[i] = clamp_to_range(tweaks[i], values[i]);
    }
    return values;
}

// Of a long text two sets, since a step of it takes long.
std::vector<std::vector<TweakValue>> values_at(const CheckSubject& subject) {
    if (subject.scene().tweaks.empty()) return {};
    if (subject.is_short()) return values_at_ends(subject, kStiffEnds);
    return {all_at(subject, false), all_at(subject, true)};
}

// How many times the step in use is stable, with each of these values; by doubling, then halving.
double largest_stable(Stepped& stepped, const std::vector<TweakValue>& values) {
    const Course usual = stepped.play(kParts, values, kStiffPlayed);
    if (!std::isfinite(usual.end)) return 0.0;
    const bool usual_chatters = stepped.chatters(usual);
    // What explodes by the step in use is none to compare with; with half of it it does so less.
    const Course half = stepped.play(kParts / 2, values, kStiffPlayed);
    if (!(usual.end <= std::max(kLeast, kBeyond * half.end))) return 0.0;
    if (usual_chatters && !stepped.chatters(half)) return 0.0;  // else it is what it is to do
    std::optional<Course> usual_for_long;
    const auto is_stable = [&](long parts) {
        Course course = stepped.play(parts, values, kStiffPlayed);
        if (!(course.end <= std::max(kLeast, kBeyond * usual.end))) return false;
        if (!usual_chatters && stepped.chatters(course)) return false;
        if (!course.may_grow() || course.peak() <= kLeast) return true;
        stepped.play_on(course, kGrowthPlayed);
        if (!usual_for_long) usual_for_long = stepped.play(kParts, values, kGrowthPlayed);
        return std::isfinite(course.end) && !grows(course, *usual_for_long);
    };
    long good = kParts;
    while (good < kParts * static_cast<long>(kMostTimes) && is_stable(2 * good)) good *= 2;
    if (good >= kParts * static_cast<long>(kMostTimes)) return kMostTimes;
    long bad = 2 * good;
    for (int k = 0; k < 4 && bad - good > 1; ++k) {
        const long middle = (good + bad) / 2;
        (is_stable(middle) ? good : bad) = middle;
    }
    return static_cast<double>(good) / static_cast<double>(kParts);
}

// What two states may differ by that are the same but for rounding: half a digit of each value with
// every step of the shortest, which may all add up.
double rounding_of(const std::vector<float>& state, double steps) {
    const double digit = std::numeric_limits<float>::epsilon();
    return 0.5 * digit * steps * distance(state, std::vector<float>(state.size(), 0.0f));
}

// By how many powers of two halving the step brings the state nearer to where it converges.
std::string order_of(Stepped& stepped, double step_seconds) {
    const auto whole = stepped.state_with_part(1), half = stepped.state_with_part(2),
               quarter = stepped.state_with_part(4);
    const double one = distance(whole, half), next = distance(half, quarter);
    if (!(one > 0.0) || !(next > 0.0)) return "no order: halving it changes nothing";
    if (std::max(one, next) <= rounding_of(quarter, 4.0 * kCompared / step_seconds))
        return "exact to rounding: halving it changes no more than last digits";
    const double order = std::log2(one / next);
    // One that does not converge has none: what is added a step is no share of iTimeDelta.
    if (!(order > kLeastOrder)) return "no order: halving it brings the state no nearer to any";
    return fmt::format("order {:.2f}", order);
}

void run_stiffness(StepKey step, Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    result.verdict = CaseVerdict::report;
    Stepped stepped(subject, step);  // what fails at a longer step is no failure
    if (!stepped.knows_length()) {
        result.note =
            "it reads no iTimeDelta: of longer steps there are fewer, and each is the same";
        return;
    }
    double least = largest_stable(stepped, subject.opened().values);
    const CaseClock clock(check);
    for (const auto& values : values_at(subject)) {
        if (clock.is_over(kStiffShare)) break;
        least = std::min(least, largest_stable(stepped, values));
    }
    const double seconds = static_cast<double>(step.first) / static_cast<double>(step.second);
    if (least < 1.0) {
        result.note = fmt::format(
            "unstable by the step in use, {:.3g} s, at an end of the ranges; take a shorter step",
            seconds);
        return;
    }
    result.note =
        fmt::format("{} up to {:.3g} times the step in use, {:.3g} s, over the ranges' ends; {}",
                    least >= kMostTimes ? "stable at least" : "stable", least, seconds * least,
                    order_of(stepped, seconds));
}

}  // namespace

void add_stiffness_cases(std::vector<Case>& list, const CheckSubject& subject) {
    for (const StepKey& step : steps_of(subject))
        list.push_back(
            {fmt::format("step {}/{} s", step.first, step.second),
             [step](Check& check, CaseResult& result) { run_stiffness(step, check, result); },
             Case::Tweaks::all});
}

}  // namespace glint
