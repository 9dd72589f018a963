// How the seconds of a check are shared out: which case may still begin, and how long a frame is
// waited for.
#pragma once

#include "base/process_time.h"
#include "measure/check/case.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <utility>

namespace glint {

// Who may still begin: no group of cases takes the seconds that later ones need.
class SharedSeconds {
public:
    explicit SharedSeconds(const Effort& effort) : effort_(effort) {}

    // Whether no time is left for this case, `ms` milliseconds after the first one began. To be
    // asked once for each case, in order.
    bool is_over(const Case& next, double ms);

private:
    Effort effort_;
    std::size_t group_ = static_cast<std::size_t>(-1);
    double group_end_ms_ = 0.0;
};

// Milliseconds of work since it was made. Where the processors draw, what they spent on this
// process counts instead of the wall's time if that is less: beside other work as much is found as
// on a machine of its own, later.
class WorkClock {
public:
    explicit WorkClock(const Context& context) : on_processors_(context.is_software()) {}
    double ms() const {
        return on_processors_ ? std::min(wall_.ms(), own_processor_ms() - begun_) : wall_.ms();
    }

private:
    bool on_processors_;
    Stopwatch wall_;
    double begun_ = own_processor_ms();
};

// What one case may take of the seconds.
class CaseClock {
public:
    explicit CaseClock(const Check& check) : check_(check), work_(check.subject.context()) {}
    // Whether it has worked for more than this share of them, or all of them are over by the wall.
    bool is_over(double share) const {
        return check_.effort.over(work_.ms(), share) || check_.effort.over(check_.begun.ms());
    }

private:
    const Check& check_;
    WorkClock work_;
};

// Thrown by a case's frame, when the case has taken all that it may.
struct CaseIsOver {
    double seconds;  // of work
};

// A case of few frames that each take long would take the seconds of all that follow: while this
// lives, each frame of the subject may end it. What was asked for by name, which is the first
// group's, is done to its end.
class CaseLimit {
public:
    CaseLimit(Check& check, const Case& limited);
    ~CaseLimit() { check_.subject.after_frame = std::move(usual_); }
    CaseLimit(const CaseLimit&) = delete;
    CaseLimit& operator=(const CaseLimit&) = delete;

private:
    Check& check_;
    std::function<void()> usual_;
};

// How long the next frame is waited for: as long as a hang may take, but with a limit on all of it
// no longer than what is left of that, and 10 s even when nothing is.
double frame_wait_seconds(double hang_seconds, double all_seconds, double left_seconds);

}  // namespace glint
