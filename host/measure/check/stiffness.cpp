// How far a simulation's step is from where the state explodes or grows for good, and of which
// order it is: told, not judged.
#include "base/median.h"
#include "measure/check/budget.h"
#include "measure/check/case.h"
#include "measure/check/space.h"
#include "measure/check/to_and_fro.h"

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

// A part of a course is a second, or so many steps where these are longer.
constexpr double kStepsOfPart = 8.0;
constexpr int kStiffPlayed = 4;        // parts, after which a step that explodes has
constexpr int kGrowthPlayed = 16;      // parts, after which one that only grows has shown itself
constexpr double kLooks = 10.0;        // a second, at the largest value, or each step
constexpr double kCompareAfter = 4.0;  // s, after which what explodes is compared
// Steps after which states of halved steps are compared, and how long they may last: what comes to
// rest soon has no order then.
constexpr int kCompared[] = {2, 8, 32, 128};
constexpr double kComparedFor = 0.6;  // s, after the first two
constexpr double kMostTimes = 64.0;   // the step in use
constexpr long kParts = 64;           // of a step; how finely it is told
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

// What a step makes of the state: the largest value that is kept in each part, and at last.
struct Course {
    double part = 1.0;  // s
    std::vector<float> peaks;
    float early = 0.0f;  // at the end of the first parts of 4 s
    bool is_finite = true;

    double seconds() const { return part * static_cast<double>(peaks.size()); }

    float peak() const { return std::ranges::max(peaks); }
    // From a second to the next, as it mostly is, up to where it is largest: what a guard sets back
    // has grown before.
    double growth() const {
        std::vector<double> ratios;
        const auto most = std::ranges::max_element(peaks) - peaks.begin();
        for (std::size_t i = 1; i <= static_cast<std::size_t>(most); ++i)
            ratios.push_back(static_cast<double>(std::max(peaks[i], 1e-12f)) /
                             static_cast<double>(std::max(peaks[i - 1], 1e-12f)));
        return ratios.empty() ? 1.0 : std::pow(median_of(ratios), 1.0 / part);
    }
    bool may_grow() const {
        const auto middle = peaks.begin() + static_cast<std::ptrdiff_t>(peaks.size() / 2);
        return *std::max_element(middle, peaks.end()) >
               kGrows * *std::max_element(peaks.begin(), middle);
    }
};

bool grows(const Course& course, const Course& usual) {
    const double a_part = std::pow(course.growth() / std::max(usual.growth(), 1.0), course.part);
    return a_part > static_cast<double>(kGrows) && course.peak() > kFarther * usual.peak();
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

    // From the start, so many parts.
    Course play(long parts, const std::vector<TweakValue>& values, int count) {
        set(parts, kParts);
        subject_.restore();
        subject_.preset.values = values;
        Course course;
        course.part = std::max(1.0, kStepsOfPart * seconds());
        play_on(course, count);
        return course;
    }

    // What was played last, to so many parts in all: at 60 Hz, or a step a frame where one lasts
    // longer than from look to look.
    void play_on(Course& course, int count) {
        const bool is_long = seconds() > 1.0 / kLooks;
        const double fps = is_long ? 1.0 / seconds() : 60.0;
        const int apart = is_long ? 1 : static_cast<int>(60.0 / kLooks);
        const auto frame_of = [&](std::size_t part) {
            return static_cast<int>(std::lround(course.part * static_cast<double>(part) * fps));
        };
        while (course.is_finite && course.peaks.size() < static_cast<std::size_t>(count)) {
            float peak = 0.0f, last = 0.0f;
            const int end = frame_of(course.peaks.size() + 1);
            for (int k = frame_of(course.peaks.size()); k < end; k += apart) {
                course.is_finite = subject_.play_frames(k, std::min(k + apart, end), fps);
                if (!course.is_finite) break;
                last = subject_.largest_state();
                peak = std::max(peak, last);
            }
            course.peaks.push_back(peak);
            if (course.seconds() - course.part < kCompareAfter) course.early = last;
        }
    }

    // Whether the state then goes to and fro from step to step.
    bool chatters(const Course& played) {
        const double fps = 1.0 / seconds();
        return goes_to_and_fro(subject_, static_cast<int>(std::lround(played.seconds() * fps)),
                               fps);
    }

    // What the passes hold after so many of its steps, each done in so many parts.
    std::vector<std::vector<float>> states_with_parts(long parts) {
        set(1, 1);
        const double fps = 1.0 / seconds();
        set(1, parts);
        subject_.restore();
        std::vector<std::vector<float>> states;
        int begin = 0;
        for (const int count : kCompared) {
            if (states.size() >= 2 && count > kComparedFor * fps) break;
            subject_.play_frames(begin, count + 1, fps);
            states.push_back(state());
            begin = count + 1;
        }
        return states;
    }

    // Whether any of it can know how long a step is.
    bool knows_length() const {
        return std::ranges::any_of(passes_,
                                   [&](std::size_t pass) { return subject_.knows_step(pass); });
    }

private:
    double seconds() const { return subject_.preset.scene.passes[passes_.front()].step.seconds(); }

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

// Whether a shorter step ends what goes to and fro; else that is what it is to do. `half` has been
// played with half the step.
bool calms_down(Stepped& stepped, const std::vector<TweakValue>& values, const Course& half) {
    if (!stepped.chatters(half)) return true;
    for (const long part : {4, 16, 64})
        if (!stepped.chatters(stepped.play(kParts / part, values, kStiffPlayed))) return true;
    return false;
}

// How many times the step in use is stable, with each of these values; by doubling, then halving.
double largest_stable(Stepped& stepped, const std::vector<TweakValue>& values) {
    const Course usual = stepped.play(kParts, values, kStiffPlayed);
    if (!usual.is_finite) return 0.0;
    const bool usual_chatters = stepped.chatters(usual);
    const float floor = usual.peak() > 0.0f ? usual.peak() : kLeast;
    const auto is_beyond = [&](float value, float than) {
        return !(value <= std::max(floor, kBeyond * than));
    };
    // What explodes by the step in use is none to compare with; with half of it it does so less.
    const Course half = stepped.play(kParts / 2, values, kStiffPlayed);
    if (usual.early > std::max(kBeyond * half.early, half.peak())) return 0.0;
    if (usual_chatters && calms_down(stepped, values, half)) return 0.0;
    std::optional<Course> usual_for_long;
    const auto is_stable = [&](long parts) {
        Course course = stepped.play(parts, values, kStiffPlayed);
        if (!course.is_finite || is_beyond(course.early, usual.early)) return false;
        if (!usual_chatters && stepped.chatters(course)) return false;
        if (!course.may_grow() || course.peak() <= floor) return true;
        stepped.play_on(course, kGrowthPlayed);
        if (!usual_for_long) usual_for_long = stepped.play(kParts, values, kGrowthPlayed);
        return course.is_finite && !grows(course, *usual_for_long);
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

// What two states may differ by that are the same but for rounding: half a digit of each value that
// differs with each of some operations of every step of the shortest, which may all add up.
double rounding_of(const std::vector<float>& state, const std::vector<float>& other, double steps) {
    const double digit = std::numeric_limits<float>::epsilon();
    double squares = 0.0;
    for (std::size_t i = 0; i < std::min(state.size(), other.size()); ++i)
        if (state[i] != other[i])
            squares += static_cast<double>(state[i]) * static_cast<double>(state[i]);
    constexpr double kOperations = 4.0;
    return 0.5 * digit * kOperations * steps * std::sqrt(squares);
}

// By how many powers of two halving the step brings the state nearer to where it converges; told
// where it matters most.
std::string order_of(Stepped& stepped, double step) {
    const auto whole = stepped.states_with_parts(1), half = stepped.states_with_parts(2),
               quarter = stepped.states_with_parts(4);
    std::size_t at = 0;
    double most = 0.0;
    for (std::size_t k = 0; k < whole.size(); ++k) {
        const double share =
            distance(whole[k], half[k]) / std::max(rounding_of(whole[k], half[k], 1.0), 1e-30);
        if (share > most) most = share, at = k;
    }
    const double one = distance(whole[at], half[at]), next = distance(half[at], quarter[at]);
    const bool moves = distance(whole.front(), whole.back()) > 0.0;
    if (!(one > 0.0) || !(next > 0.0))
        return moves ? "no order: halving it changes nothing" : "no order is told: it is at rest";
    if (std::max(one, next) <= rounding_of(quarter[at], whole[at], 4.0 * kCompared[at]))
        return "exact to rounding: halving it changes no more than last digits";
    const double order = std::log2(one / next);
    // One that does not converge has none: what is added a step is no share of iTimeDelta.
    if (!(order > kLeastOrder)) return "no order: halving it brings the state no nearer to any";
    const double off = distance(whole.back(), half.back()), of = distance(half.back(), {});
    return fmt::format("order {:.2f}{}", order,
                       of > 0.0 ? fmt::format(": after {:.2g} s half the step changes {:.2g} % of "
                                              "the state",
                                              step * kCompared[whole.size() - 1], 100.0 * off / of)
                                : "");
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
    const double own = largest_stable(stepped, subject.opened().values);
    double least = own;
    const CaseClock clock(check);
    for (const auto& values : values_at(subject)) {
        if (clock.is_over(kStiffShare)) break;
        least = std::min(least, largest_stable(stepped, values));
    }
    const double seconds = static_cast<double>(step.first) / static_cast<double>(step.second);
    if (least < 1.0) {
        result.note =
            fmt::format("unstable by the step in use, {:.3g} s, {}; take a shorter step", seconds,
                        own < 1.0 ? "at the preset as it is" : "at an end of the ranges");
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
