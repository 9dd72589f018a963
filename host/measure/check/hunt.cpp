// Where anything at all fails: the search over tweaks, time and mouse, and every key.
#include "measure/check/case.h"
#include "measure/check/space.h"
#include "measure/probe/faults.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

namespace glint {
namespace {

constexpr int kHuntedFrames = 8;     // of a simulation, at each point
constexpr int kSmallest = 160;       // trials for the smallest reproducer
constexpr double kHuntShare = 0.12;  // of the seconds, that a search may take
constexpr int kEvaluations = 256;    // of one effort
constexpr double kLongText = 5e3;    // ms that instrumented programs of a long text may take

// A subject that is brought to points, its operations watched where they can be.
class Hunter {
public:
    explicit Hunter(Check& check) : subject_(check.subject), space_(check.subject) {
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
        const Playback playback{.end = subject_.stateful() ? (kHuntedFrames - 1) / 60.0 : time};
        const int last = playback.last_frame();
        bool finite = true;
        for (int k = subject_.stateful() ? 0 : last; k <= last && finite; ++k) {
            const Frame frame = playback.frame(subject_.preset, k);
            subject_.still = StillPlace{frame.time, playback.fps};
            if (k == last && survey_) survey_->begin(frame);
            finite = subject_.draw(frame);
            if (survey_) survey_->end();
        }
        Trial trial{.fails = !finite};
        if (!survey_) return trial;
        trial.distances = survey_->distances();
        fault_ = survey_->fault();
        trial.fails |= fault_.has_value();
        return trial;
    }

    // Of the last point.
    const std::optional<ProbeFault>& fault() const { return fault_; }

private:
    CheckSubject& subject_;
    Space space_;
    std::unique_ptr<FaultSurvey> survey_;
    std::optional<ProbeFault> fault_;
};

std::string words_of(const ProbeFault& fault) {
    std::string operands;
    for (const double operand : fault.operands)
        operands += fmt::format("{}{:.7g}", operands.empty() ? " of " : ", ", operand);
    return fmt::format("{}:{}: in {}: {} is undefined, {}{}", fault.file, fault.line,
                       fault.function, fault.expression, fault.what,
                       fault.what.find('(') == std::string::npos ? operands : "");
}

// Of one that is known to fail, the smallest; leaves the subject there.
void report(Hunter& hunter, Check& check, const Point& found, CaseResult& result) {
    const auto fails = [&](const Point& point) { return hunter(point).fails; };
    const Point& usual = hunter.space().usual();
    const Point point = smallest(found, usual, fails, kSmallest);
    fails(point);
    const std::string where = hunter.space().words(point, check.subject);
    if (hunter.fault()) result.where = place_of(*hunter.fault());
    result.fail(hunter.fault() ? fmt::format("{}; at {}", words_of(*hunter.fault()), where)
                               : fmt::format("at {}", where));
}

void run_search(Check& check, CaseResult& result) {
    const Stopwatch clock;
    Hunter hunter(check);
    Search search(hunter.space().usual());
    const int wanted =
        hunter.space().usual().empty() ? 1 : kEvaluations * check.effort.tries.value_or(1);
    int done = 0;
    for (; done < wanted; ++done) {
        if (!check.effort.tries && check.effort.over(clock.ms(), kHuntShare)) break;
        const Point point = search.next();
        const Trial trial = hunter(point);
        if (trial.fails) return report(hunter, check, point, result);
        search.tell(point, trial);
    }
    result.note =
        fmt::format("{}{} points{}", done, done < wanted ? fmt::format(" of {}", wanted) : "",
                    hunter.is_guided() ? "" : ", without a guide");
}

// Arrows, space, letters and digits first, then all others.
std::vector<int> keys_in_order() {
    std::vector<int> keys = {37, 38, 39, 40, 32, 13, 27, 16, 17};
    for (int key = 'A'; key <= 'Z'; ++key) keys.push_back(key);
    for (int key = '0'; key <= '9'; ++key) keys.push_back(key);
    for (int key = 0; key < kKeyCount; ++key)
        if (std::ranges::find(keys, key) == keys.end()) keys.push_back(key);
    return keys;
}

// Down in frame 1, up in frame 3; seen in frames 1 (pressed), 2 (held) and 3 (toggled).
bool play_key(CheckSubject& subject, int key) {
    subject.preset.events = {{.time = 1.0 / 60, .key = key, .down = true},
                             {.time = 3.0 / 60, .key = key, .down = false}};
    return subject.play_frames(0, 4, 60.0);
}

void run_keys(Check& check, CaseResult& result) {
    const Stopwatch clock;
    int done = 0;
    for (const int key : keys_in_order()) {
        if (!check.effort.tries && check.effort.over(clock.ms(), 0.05)) break;
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
