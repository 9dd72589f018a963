#include "measure/check/budget.h"

#include <algorithm>

namespace glint {

bool SharedSeconds::is_over(const Case& next, double ms) {
    constexpr double kGroupShare = 0.3;  // of the seconds that are left when it begins
    if (effort_.seconds == 0.0) return false;
    const double all_ms = effort_.seconds * 1000.0;
    if (next.group != group_) {
        group_ = next.group;
        group_end_ms_ = ms + kGroupShare * std::max(all_ms - ms, 0.0);
    }
    const bool all_wanted = next.tweaks == Case::Tweaks::random && effort_.random;
    return ms > all_ms || (!all_wanted && ms > group_end_ms_);
}

CaseLimit::CaseLimit(Check& check, const Case& limited)
    : check_(check), usual_(check.subject.after_frame) {
    constexpr double kShareOfLeft = 0.3, kLeastShare = 0.1;  // the latter of all
    const double all_ms = check.effort.seconds * 1000.0;
    if (all_ms == 0.0 || limited.group == 0 || limited.ends_itself) return;
    const double ms = std::max(kShareOfLeft * (all_ms - check.begun.ms()), kLeastShare * all_ms);
    const WorkClock work(check.subject.context());
    check.subject.after_frame = [usual = usual_, work, ms] {
        if (usual) usual();
        if (work.ms() > ms) throw CaseIsOver{work.ms() / 1000.0};
    };
}

double frame_wait_seconds(double hang_seconds, double all_seconds, double left_seconds) {
    constexpr double kLeast = 10.0;  // the largest pictures of the slowest scenes here take 2 s
    if (all_seconds == 0.0) return hang_seconds;
    return std::min(hang_seconds, std::max(left_seconds, kLeast));
}

}  // namespace glint
