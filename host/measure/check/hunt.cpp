// Where anything at all fails: the search over tweaks, time, mouse, keys and size, and every key.
#include "measure/check/budget.h"
#include "measure/check/case.h"
#include "measure/check/endure.h"
#include "measure/check/keys.h"
#include "measure/check/space.h"
#include "measure/probe/faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <optional>
#include <utility>

namespace glint {
namespace {

constexpr int kHuntedSteps = 8;                  // of a simulation, frames or longer, at each point
constexpr int kMostHunted = 60;                  // frames
constexpr int kPlayedOn = 600, kLookApart = 30;  // frames that it goes on for, and a look each
constexpr double kPlayedOnShare = 0.02;          // of the seconds
constexpr int kSmallest = 160;                   // trials for the smallest reproducer
constexpr double kHuntShare = 0.12;              // of the seconds, that a search may take
constexpr double kSpreadShare = 0.1;             // before it follows single operations
constexpr int kEvaluations = 256;                // of one effort
constexpr int kFollowed = 256;  // more, to where an operation's distance would be 0
constexpr int kLeastFollowed = 16;
constexpr int kDescended = 768;       // as many, along all ranges
constexpr int kOfSizes = 192;         // where there is nothing but the size to change
constexpr std::size_t kMostKeys = 6;  // that the search presses
constexpr int kSmallestLong = 16;     // trials, each a long run
constexpr double kLongText = 5e3;     // ms that instrumented programs of a long text may take

// A subject that is brought to points, its operations watched where they can be.
class Hunter {
public:
    Hunter(Check& check, const std::vector<int>& keys)
        : subject_(check.subject), space_(check.subject, keys) {
        CheckSubject& subject = subject_;
        if (!subject.is_short() && check.effort.over(kLongText, kHuntShare)) return;
        try {
            survey_ =
                std::make_unique<FaultSurvey>(subject.opened(), subject.renderer(),
                                              ProgramOptions{.specialise = subject.specialised()});
        } catch (const ProbeRefused&) {  // then it is looked for without a guide
        }
        if (subject.after_frame) subject.after_frame();  // compiling is no hang
    }

    const Space& space() const { return space_; }
    bool is_guided() const { return survey_ != nullptr; }

    Trial operator()(const Point& point) {
        subject_.restore();
        fault_.reset();
        const double time = space_.apply(point, subject_);
        const Playback playback{.end = subject_.stateful() ? hunted_frames() / 60.0 : time};
        const int last = playback.last_frame();
        bool finite = true;
        float earlier = 0.0f;  // of the state, half way
        for (int k = subject_.stateful() ? 0 : last; k <= last && finite; ++k) {
            const Frame frame = playback.frame(subject_.preset, k);
            subject_.still = StillPlace{frame.time, playback.fps};
            // In as many frames as the slowest step lasts, that each pass is met.
            const int begin = subject_.stateful() ? last + 1 - frames_of_step() : last;
            if (k == begin && survey_) survey_->begin(frame, std::exchange(anew_, reports_));
            if (k > begin && survey_) survey_->go_on(frame);
            finite = subject_.draw(frame);
            if (survey_ && (k == last || !finite)) survey_->end();
            if (k == last / 2 && subject_.stateful()) earlier = subject_.largest_state();
        }
        Trial trial{.fails = !finite};
        if (survey_) {
            trial.distances = survey_->distances();
            fault_ = survey_->fault();
            trial.fails |= fault_.has_value();
        }
        if (subject_.stateful() && finite) add_state(point, earlier, trial);
        return trial;
    }

    // What is undefined later in a simulation; nothing where there is nothing, or no time.
    std::optional<ProbeFault> later_fault(const Point& point, const CaseClock& clock) {
        subject_.restore();
        space_.apply(point, subject_);
        const Playback playback{.end = kPlayedOn / 60.0};
        for (int k = 0; k <= kPlayedOn && survey_; ++k) {
            const Frame frame = playback.frame(subject_.preset, k);
            subject_.still = StillPlace{frame.time, playback.fps};
            const int before = kLookApart - k % kLookApart;  // the last of each look
            if (before == frames_of_step()) survey_->begin(frame, false);
            if (before < frames_of_step()) survey_->go_on(frame);
            const bool finite = subject_.draw(frame);
            if (before == 1 || !finite) survey_->end();
            if (before == 1 && survey_->fault()) return survey_->fault();
            if (!finite || clock.is_over(kPlayedOnShare)) break;
        }
        if (survey_) survey_->end();
        return std::nullopt;
    }

    // From now on a point is looked at as if it were the first, for the sake of what is said of it.
    void begin_report() { anew_ = reports_ = true; }

    // Where the state grew most within its few frames, and where it became largest.
    const Point& steepest() const { return steepest_; }
    const Point& largest() const { return largest_; }

    // Of the last point.
    const std::optional<ProbeFault>& fault() const { return fault_; }

private:
    // That the slowest step lasts.
    int frames_of_step() const {
        double longest = 1.0 / 60;
        for (const GraphPass& pass : subject_.renderer().graph().passes)
            if (pass.pass != kImagePass && subject_.scene().passes[pass.pass].step)
                longest = std::max(longest, subject_.scene().passes[pass.pass].step.seconds());
        return std::clamp(static_cast<int>(std::ceil(longest * 60.0 - 1e-6)), 1, kLookApart);
    }
    int hunted_frames() const { return std::min(kMostHunted, kHuntedSteps * frames_of_step()) - 1; }

    // Growth and magnitude are goals like any distance.
    void add_state(const Point& point, float earlier, Trial& trial) {
        const float now = subject_.largest_state();
        const float growth = now / std::max(earlier, 1e-6f);
        if (steepest_.empty() || growth > most_growth_) {
            steepest_ = point;
            most_growth_ = growth;
        }
        if (largest_.empty() || now > most_) {
            largest_ = point;
            most_ = now;
        }
        trial.distances.push_back(1.0f / (1.0f + growth));
        trial.distances.push_back(1.0f / (1.0f + now));
    }

    CheckSubject& subject_;
    Space space_;
    Point steepest_{}, largest_{};
    float most_growth_ = 0.0f, most_ = 0.0f;
    std::unique_ptr<FaultSurvey> survey_;
    std::optional<ProbeFault> fault_;
    bool anew_ = true, reports_ = false;  // passes that nothing has changed for are looked at, too
};

std::string words_of(const ProbeFault& fault) {
    return fmt::format("{}:{}: in {}: {} is undefined, {}", fault.file, fault.line, fault.function,
                       fault.expression, fault.what);
}

// Of one that is known to fail, the smallest; leaves the subject there.
void report(Hunter& hunter, Check& check, const Point& found, CaseResult& result) {
    hunter.begin_report();
    const auto fails = [&](const Point& point) { return hunter(point).fails; };
    const Point& usual = hunter.space().usual();
    const Point point = smallest(found, usual, fails, kSmallest);
    fails(point);
    const std::string where = hunter.space().words(point, check.subject);
    // Of what NaN or Inf in a picture are born is asked later, as in all other cases.
    const bool is_told =
        hunter.fault() && (check.subject.observed().is_finite() || check.birthplaces <= 0);
    if (is_told) result.where = place_of(*hunter.fault());
    result.fail(is_told ? fmt::format("{}; at {}", words_of(*hunter.fault()), where)
                        : fmt::format("at {}", where));
}

// A simulation that goes on, as the preset has it, and where it grew most and became largest.
void play_on(Hunter& hunter, Check& check, CaseResult& result) {
    const CaseClock clock(check);
    std::vector<Point> points{hunter.space().usual()};
    for (const Point& point : {hunter.steepest(), hunter.largest()})
        if (!point.empty() && std::ranges::find(points, point) == points.end())
            points.push_back(point);
    for (const Point& point : points) {
        const auto fault = hunter.later_fault(point, clock);
        if (!check.subject.observed().is_finite()) {
            result.note = "at " + hunter.space().words(point, check.subject);
            return;
        }
        if (!fault) continue;
        result.where = place_of(*fault);
        return result.fail(fmt::format("{}; after {:.1f} s, at {}", words_of(*fault),
                                       check.subject.still->time,
                                       hunter.space().words(point, check.subject)));
    }
}

// The points at which the state grew most and became largest play on for long.
void endure_worst(const Hunter& hunter, Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    const Space& space = hunter.space();
    const float usual = usual_largest(check);
    const auto why_at = [&](const Point& point) {
        subject.restore();
        space.apply(point, subject);
        return subject.observed().is_finite() ? why_not_for_long(check, usual) : "";
    };
    for (const Point& worst : {hunter.steepest(), hunter.largest()}) {
        if (worst.empty() || why_at(worst).empty()) continue;
        const Point point = smallest(
            worst, space.usual(), [&](const Point& one) { return !why_at(one).empty(); },
            kSmallestLong);
        const std::string why = why_at(point);
        if (why.empty()) continue;  // it hung on the time that there was
        return result.fail(fmt::format("{}; at {}", why, space.words(point, subject)));
    }
}

// Keys that change the picture or what is kept, each alone and with the preset's values; and those
// that the text names, which may do so together.
std::vector<int> keys_that_matter(Check& check) {
    std::vector<int> keys;
    CheckSubject& subject = check.subject;
    if (!subject.renderer().reads_keyboard()) return keys;
    const CaseClock clock(check);
    const auto seen = [&](int key) {
        subject.restore();
        const double time = subject.stateful() ? 2.0 / 60 : subject.preset.time;
        if (key >= 0)
            subject.preset.events = {
                {.time = subject.stateful() ? 1.0 / 60 : std::max(0.0, time - 0.5 / 60),
                 .key = key,
                 .down = true}};
        subject.show(time, time);
        return std::pair(subject.picture(), subject.largest_state());
    };
    const auto usual = seen(-1);
    for (const int key : keys_in_order()) {
        if (keys.size() == kMostKeys) break;
        if (clock.is_over(0.03)) break;
        if (seen(key) != usual) keys.push_back(key);
    }
    const bool is_any = keys.empty();
    // A modifier does nothing alone.
    for (const int key : keys_named(subject.scene().text))
        if (std::ranges::find(keys, key) == keys.end() && (is_any || is_usual_key(key)))
            keys.push_back(key);
    keys.resize(std::min(keys.size(), kMostKeys));
    return keys;
}

// Each operation to its zero: along one range, then along all, one after the other, from where they
// have few digits.
std::optional<Point> followed(Hunter& hunter, const Search& search, const Check& check,
                              const CaseClock& clock) {
    const Space& space = hunter.space();
    const auto rounded = [&](Point point, std::size_t axis) {
        return space.rounded(std::move(point), axis);
    };
    for (const bool along_all : {false, true}) {
        int left = check.paced(along_all ? kDescended : kFollowed, kLeastFollowed);
        const auto attempt = [&](const Point& point) {
            --left;
            return hunter(point);
        };
        for (const Search::Near& near : search.nearest()) {
            if (left <= 0 || clock.is_over(kHuntShare)) break;
            const auto failing =
                along_all ? descend_to_zero(space.usual(), near.operation, attempt, rounded, left)
                          : follow_to_zero(near, attempt, rounded, left);
            if (failing) return failing;
        }
    }
    return std::nullopt;
}

void run_search(Check& check, CaseResult& result) {
    const CaseClock clock(check);
    Hunter hunter(check, keys_that_matter(check));
    const Space& space = hunter.space();
    Search search(space.usual(), space.rare());
    const int one = space.usual().size() == space.rare() ? kOfSizes : kEvaluations;
    const int wanted = check.effort.tries ? check.paced(one * *check.effort.tries, 1) : one;
    std::vector<Point> zeros = space.zeros();
    if (!zeros.empty() && hunter(zeros[0]).fails) return report(hunter, check, zeros[0], result);
    int done = 0;
    for (; done < wanted; ++done) {
        if (clock.is_over(kSpreadShare)) break;
        const Point point = search.next();
        const Trial trial = hunter(point);
        if (trial.fails) return report(hunter, check, point, result);
        search.tell(point, trial);
    }
    std::ranges::copy(space.equals(), std::back_inserter(zeros));
    if (const auto failing = followed(hunter, search, check, clock))
        return report(hunter, check, *failing, result);
    for (std::size_t i = 0; i < zeros.size() && !clock.is_over(kHuntShare); ++i)
        for (const Point& point : {zeros[i], space.at_odd_size(zeros[i])})
            if (hunter(point).fails) return report(hunter, check, point, result);
    result.note =
        fmt::format("{}{} points{}", done, done < wanted ? fmt::format(" of {}", wanted) : "",
                    hunter.is_guided() ? "" : ", without a guide");
    if (done == 0) {
        result.verdict = CaseVerdict::skip;
        result.note += "; the seconds were over before the first; longer --seconds reach it";
        return;
    }
    if (check.subject.stateful()) play_on(hunter, check, result);
    if (check.subject.stateful() && result.verdict != CaseVerdict::fail)
        endure_worst(hunter, check, result);
}

// Down in frame 1, up in frame 3; seen in frames 1 (pressed), 2 (held) and 3 (toggled).
bool play_key(CheckSubject& subject, int key) {
    subject.preset.events = {{.time = 1.0 / 60, .key = key, .down = true},
                             {.time = 3.0 / 60, .key = key, .down = false}};
    return subject.play_frames(0, 4, 60.0);
}

void run_keys(Check& check, CaseResult& result) {
    const CaseClock clock(check);
    int done = 0;
    for (const int key : keys_in_order()) {
        if (clock.is_over(0.05)) break;
        if (check.subject.stateful()) check.subject.renderer().reset();
        result.note = fmt::format("key {}", key_name(key));
        if (!play_key(check.subject, key)) return;
        ++done;
    }
    result.note = done < kKeyCount ? fmt::format("{} of {} keys", done, kKeyCount) : "every key";
}

}  // namespace

void add_key_case(std::vector<Case>& list, const CheckSubject& subject) {
    if (subject.renderer().reads_keyboard()) list.push_back({"keys", run_keys});
}

void add_search_case(std::vector<Case>& list, const CheckSubject& subject) {
    list.push_back({"search", run_search,
                    subject.scene().tweaks.empty() ? Case::Tweaks::none : Case::Tweaks::all});
}

}  // namespace glint
