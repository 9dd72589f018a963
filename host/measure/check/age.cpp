// Age: does a scene still move as it did when it was young, and come back to the same picture?
//
// A float iTime steps unevenly after a day and stands still after a month. Motion is judged by
// comparison with the scene itself at 1 s and at 60 s, so that what never moves, comes to rest or
// jumps by nature is not blamed. Where motion comes from iTick the picture must be the same again
// after any multiple of 65536 s.
//
// Simulations cannot be played for a year. They run for their first second; then the clock jumps,
// as when a laptop wakes: time is late, buffers and iFrame go on from where they were.
#include "measure/check/budget.h"
#include "measure/check/case.h"
#include "measure/check/situation.h"
#include "measure/check/space.h"
#include "measure/rows/difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace glint {
namespace {

constexpr int kFrames = 64, kFineFrames = 32, kLeastFrames = 8;
constexpr double kFrame = 1.0 / 60, kFineFrame = 1.0 / 960;
constexpr int kFirstSecond = 60;       // frames
constexpr double kLidCatchUp = 0.25;   // s, as in the window
constexpr double kTickPeriod = 65536;  // s
// An aged scene may move in this share of the frames in which it moved when it was young, and be
// this much more uneven. A float iTime is twice below and beyond both after a day.
constexpr double kLeastMoving = 0.75, kLeastFinelyMoving = 0.5;
constexpr double kBeats = 2.0;  // frames: what beats slowly has one more or less, now and then
// A change a frame that is lost in a colour's last digits, as where something slows down for good.
constexpr double kHardly = 1e-6;
constexpr double kSeen = 0.5 / 255.0;
// What stands still in most frames, such as a lightning, may be seen between two: at other moments.
constexpr double kSeldom = 0.5;
// Of a scene that moves at so many moments, all of kOtherMoments are at rest once in 250 scenes.
constexpr double kOften = 0.5;
constexpr double kOtherMoments[] = {0.0, 1.1, 2.3, 3.4, 4.6, 5.7, 6.9, 8.0};  // s later
constexpr double kSettled = 600.0;                                            // s
constexpr double kUnevennessFactor = 2.0, kUnevennessAllowed = 0.1;
// The same phase: where a display shows a difference.
constexpr double kLeastPsnr = 55.0, kMostOff = 0.0005;
// What a tweak switches on may age though the preset does not: then a year is seen with others.
constexpr std::size_t kSetsAtAYear = 5;

struct Age {
    const char* name;
    double seconds;
};
constexpr Age kAges[] = {{"0", 0.0},         {"1 s", 1.0},         {"1 hour", 3600.0},
                         {"1 day", 86400.0}, {"30 days", 2592000}, {"1 year", 31536000.0}};
// Multiples of 65536 s that reach a day, a month and a year.
struct Period {
    const char* name;
    int count;
};
constexpr Period kPeriods[] = {{"1.5 days", 2}, {"30 days", 40}, {"1 year", 482}};

// The clock of an aged scene: frame 0 stands at the age, later ones follow.
class AgedClock {
public:
    // Plays the first second of a simulation; another scene needs no past.
    AgedClock(CheckSubject& subject, double age) : subject_(subject), age_(age) {
        if (!subject.stateful()) return;
        subject.renderer().reset();
        alive_ = subject.play_frames(0, kFirstSecond, 60.0);
    }

    bool draw(double seconds_on, double delta) {
        if (!subject_.observed().is_finite()) return false;
        const double time = age_ + seconds_on;
        const long index = subject_.stateful() ? kFirstSecond + drawn_ : std::lround(time * 60.0);
        ++drawn_;
        Frame frame = subject_.frame_at(time, delta, index);
        if (subject_.stateful()) frame.longest_catch_up = kLidCatchUp;
        subject_.still.reset();
        if (!subject_.stateful()) subject_.still = StillPlace{time, 60.0};
        return alive_ && subject_.draw(frame);
    }

private:
    CheckSubject& subject_;
    double age_;
    long drawn_ = 0;
    bool alive_ = true;
};

// Root mean square of the change from one picture to the next.
double change(std::span<const float> a, std::span<const float> b) {
    double squares = 0.0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        const double d = static_cast<double>(a[i]) - static_cast<double>(b[i]);
        if (i % 4 != 3) squares += d * d;
    }
    return std::sqrt(squares / static_cast<double>(a.size()));
}

// The change of each of `count` frames from the one before; shorter when a frame is not finite.
std::vector<double> changes(AgedClock& clock, CheckSubject& subject, double from, double delta,
                            int count) {
    std::vector<double> list;
    std::vector<float> before;
    for (int k = 0; k <= count; ++k) {
        if (!clock.draw(from + k * delta, delta)) return list;
        std::vector<float> now = subject.picture();
        if (k > 0) list.push_back(change(before, now));
        before = std::move(now);
    }
    return list;
}

double mean_of(const std::vector<double>& list) {
    const double sum = std::accumulate(list.begin(), list.end(), 0.0);
    return sum / std::max(static_cast<double>(list.size()), 1.0);
}

double share_moving(const std::vector<double>& list) {
    const auto moving = std::ranges::count_if(list, [](double d) { return d > 0; });
    return static_cast<double>(moving) / std::max(static_cast<double>(list.size()), 1.0);
}

// How much the change jumps from frame to frame, beside its mean: second differences, which a
// smooth motion that speeds up or slows down hardly has.
double unevenness(const std::vector<double>& list) {
    double jumps = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < list.size(); ++i) {
        sum += list[i];
        if (i >= 2) jumps += std::abs(list[i] - 2.0 * list[i - 1] + list[i - 2]);
    }
    return sum > 0.0 ? jumps / sum : 0.0;
}

Motion motion_at(const Check& check, double age) {
    const int frames = check.paced(kFrames, kLeastFrames);
    const int fine_frames = check.paced(kFineFrames, kLeastFrames);
    AgedClock clock(check.subject, age);
    const std::vector<double> coarse = changes(clock, check.subject, 0.0, kFrame, frames);
    const std::vector<double> fine =
        changes(clock, check.subject, (frames + 1) * kFrame, kFineFrame, fine_frames);
    return {.moving = share_moving(coarse),
            .finely_moving = share_moving(fine),
            .unevenness = unevenness(coarse),
            .mean = mean_of(coarse),
            .frame = 1.0 / frames,
            .fine_frame = 1.0 / fine_frames};
}

// The least that is asked of both.
Motion least_of(const Motion& a, const Motion& b) {
    return {.moving = std::min(a.moving, b.moving),
            .finely_moving = std::min(a.finely_moving, b.finely_moving),
            .unevenness = std::max(a.unevenness, b.unevenness),
            .mean = std::max(a.mean, b.mean),
            .frame = a.frame,
            .fine_frame = a.fine_frame};
}

// A scene may come to rest within its first minute. One that goes by time alone, and rests at one
// of two moments, moves at others: then these are asked of.
Motion young_motion(const Check& check) {
    constexpr double kOthers[] = {3.3, 7.9, 13.7, 23.1, 41.9, 77.3};
    std::vector<Motion> moving{motion_at(check, 1.0), motion_at(check, 60.0)};
    const Motion both = least_of(moving[0], moving[1]);
    if (both.moving > 0.0 || check.subject.stateful()) return both;
    for (const double moment : kOthers) moving.push_back(motion_at(check, moment));
    const auto moments = static_cast<double>(moving.size());
    std::erase_if(moving, [](const Motion& one) { return one.moving == 0.0; });
    if (moving.empty()) return both;
    // The half of them in which it moves most: among as many moments of any age is one as good.
    const double often = static_cast<double>(moving.size()) / moments;
    std::ranges::sort(moving, std::greater(), &Motion::moving);
    moving.resize((moving.size() + 1) / 2);
    Motion least = moving.front();
    for (const Motion& one : moving) least = least_of(least, one);
    least.often = often;
    return least;
}

// Whether nothing moves any more after an hour, when a float clock has all digits of a frame.
bool rests_after_an_hour(CheckSubject& subject) {
    constexpr double kHour = 3600.0;  // s
    constexpr double kLater[] = {0.3, 1.9, 3.7, 7.0, 11.3, 19.1, 31.0, 53.9};
    if (subject.stateful() || !subject.show(kHour, 0.0)) return false;
    const std::vector<float> at_the_hour = subject.picture();
    return std::ranges::all_of(kLater, [&](double later) {
        return subject.show(kHour + later, 0.0) && subject.picture() == at_the_hour;
    });
}

// Windows at other ages are windows at other phases, in which it may rest.
bool goes_by_tick_alone(const CheckSubject& subject) {
    return !subject.stateful() && subject.reads(Builtin::tick) && !subject.reads(Builtin::time) &&
           !subject.reads(Builtin::frame) && !subject.reads(Builtin::date);
}

void judge_motion(const Motion& young, const Motion& old, CaseResult& result) {
    const double least = kLeastMoving * young.moving - kBeats * young.frame;
    const double finely_least =
        kLeastFinelyMoving * young.finely_moving - kBeats * young.fine_frame;
    if (old.moving < least || (old.moving == 0.0 && young.moving > 0.0)) {
        result.fail(fmt::format("stands still in {:.0f} % of frames, when young in {:.0f} %",
                                100.0 - 100.0 * old.moving, 100.0 - 100.0 * young.moving));
    } else if (old.finely_moving < finely_least) {
        result.fail(
            fmt::format("moves in coarse steps: {:.0f} % of frames 1/960 s apart differ, "
                        "when young {:.0f} %",
                        100.0 * old.finely_moving, 100.0 * young.finely_moving));
    } else if (old.unevenness > kUnevennessFactor * young.unevenness + kUnevennessAllowed) {
        result.fail(fmt::format("moves unevenly, by {:.0f} %, when young by {:.0f} %",
                                100.0 * old.unevenness, 100.0 * young.unevenness));
    } else {
        result.note = fmt::format("moves in {:.0f} % of frames, uneven by {:.0f} %",
                                  100.0 * old.moving, 100.0 * old.unevenness);
    }
}

// Whether the change a frame, which falls as a power of time while a float clock has all digits of
// a frame, has become so small that a step of that clock shows nothing.
bool has_slowed_down(const Check& check, const Age& age, const Motion& young, double float_step) {
    constexpr double kMinute = 60.0, kHour = 3600.0;  // s
    constexpr double kLeastPower = 0.4;               // beyond what chance makes of two ages
    double at_ten_minutes = 0.0, at_the_hour = 0.0;
    for (const double later : kOtherMoments) {
        at_ten_minutes = std::max(at_ten_minutes, motion_at(check, kSettled + later).mean);
        at_the_hour = std::max(at_the_hour, motion_at(check, kHour + later).mean);
    }
    if (at_the_hour == 0.0) return false;
    const double power =
        std::min(std::log(young.mean / at_ten_minutes) / std::log(kSettled / kMinute),
                 std::log(at_ten_minutes / at_the_hour) / std::log(kHour / kSettled));
    const double now = at_the_hour * std::pow(kHour / std::max(age.seconds, kHour), power);
    return power > kLeastPower && now * 60.0 * float_step < kSeen;
}

void judge_age(const Age& age, Check& check, const Motion& young, CaseResult& result) {
    CheckSubject& subject = check.subject;
    if (!subject.observed().is_finite()) return;
    const double float_step = std::nextafter(static_cast<float>(age.seconds), 1e9f) - age.seconds;
    const bool is_slow = young.mean < kHardly && young.mean * 60.0 * float_step < kSeen;
    CaseResult judged;
    bool has_moved = false;
    int unevenly = 0;  // moments; at one of them a picture may be cut
    for (const double later : kOtherMoments) {
        const Motion old = motion_at(check, age.seconds + later);
        if (!subject.observed().is_finite()) return;
        has_moved |= old.moving > 0.0;
        judged = {.name = result.name};
        if (young.moving == 0.0)
            judged.note = "comes to rest within its first minute";
        else if (is_slow || (old.mean > 0.0 && old.mean < kHardly && old.mean < young.mean))
            judged.note = "hardly moves any more";
        else
            judge_motion(young, old, judged);
        if (judged.verdict != CaseVerdict::fail) break;
        const bool rests = old.moving == 0.0 || old.finely_moving == 0.0;  // as it may for a while
        if (!rests && young.often == 1.0 && young.moving >= kSeldom && ++unevenly == 2) break;
    }
    if (!has_moved && young.often < kOften) judged = {.name = result.name, .note = "moves seldom"};
    // What has ended after some minutes, when a clock has all its digits, was to; a state goes on.
    if (judged.verdict == CaseVerdict::fail && subject.stateful() && young.moving > 0.0) {
        const Motion settled = motion_at(check, kSettled);
        if (!subject.observed().is_finite()) return;
        CaseResult again{.name = result.name};
        judge_motion({.moving = std::min(young.moving, settled.moving),
                      .finely_moving = std::min(young.finely_moving, settled.finely_moving),
                      .unevenness = young.unevenness,
                      .mean = young.mean,
                      .frame = young.frame,
                      .fine_frame = young.fine_frame},
                     motion_at(check, age.seconds), again);
        if (again.verdict != CaseVerdict::fail) judged = std::move(again);
    }
    if (judged.verdict == CaseVerdict::fail && !subject.stateful()) {
        if (has_slowed_down(check, age, young, float_step))
            judged = {.name = result.name, .note = "hardly moves any more"};
        else
            motion_at(check, age.seconds);  // which is shown
    }
    result = std::move(judged);
}

void run_age(const Age& age, Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    if (!subject.moves()) {
        subject.show(age.seconds, 1.0);
        result.note = "nothing moves";
        return;
    }
    if (age.seconds <= 1.0) {
        AgedClock clock(subject, age.seconds);
        changes(clock, subject, 0.0, kFrame, check.paced(kFrames, kLeastFrames));
        return;
    }
    if (goes_by_tick_alone(subject)) {
        result.note = "goes by iTick, which has no age; `same phase` tells whether it is used well";
        subject.show(age.seconds, 0.0);
        return;
    }
    if (!check.rests) check.rests = rests_after_an_hour(subject);
    if (*check.rests) {
        result.note = "comes to rest within its first hour";
        subject.show(age.seconds, 0.0);
        return;
    }
    if (!check.young) check.young = young_motion(check);
    judge_age(age, check, *check.young, result);
}

// At the end of its ranges, and with other entries of its menus, as long as there is time.
void run_age_of_others(const Age& age, Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    const CaseClock clock(check);
    std::vector<std::vector<TweakValue>> sets = values_at_ends(subject, kSetsAtAYear);
    for (std::size_t i = 1; i < sets.size() && !clock.is_over(0.03); ++i) {
        if (result.verdict == CaseVerdict::fail || !subject.observed().is_finite()) return;
        subject.restore();
        subject.preset.values = sets[i];
        CaseResult judged{.name = result.name};
        if (!rests_after_an_hour(subject)) judge_age(age, check, young_motion(check), judged);
        const bool is_finite = subject.observed().is_finite();
        if (is_finite && judged.verdict != CaseVerdict::fail) continue;
        result = std::move(judged);
        if (!is_finite) result.note = "at the ends of ranges";  // whatever the age
        const double time =
            is_finite || !subject.still ? subject.opened().time : subject.still->time;
        result.note += where_words({sets[i], subject.opened().events, time}, subject);
    }
}

// The picture some frames after the clock has jumped to a time. iFrame and iDate are the same
// whatever the time: they are no phases.
std::vector<float> picture_at(const Check& check, double time, double periods) {
    CheckSubject& subject = check.subject;
    const int frames = subject.stateful() ? check.paced(kFineFrames, kLeastFrames) : 0;
    if (subject.stateful()) {
        subject.renderer().reset();
        if (!subject.play_frames(0, kFirstSecond, 60.0)) return {};
    }
    for (int k = 0; k <= frames; ++k) {
        const double young = time + k * kFrame;
        Frame frame = subject.frame_at(young + periods * kTickPeriod, kFrame, kFirstSecond + k);
        frame.date = shadertoy_date(subject.preset.date, young);
        if (subject.stateful()) frame.longest_catch_up = kLidCatchUp;
        subject.still.reset();
        if (!subject.draw(frame)) return {};
    }
    return subject.picture();
}

void run_same_phase(const Period& period, Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    // Later than the first second by more than is ever caught up, so that both clocks jump.
    const double time = std::max(subject.preset.time, 2.0);
    // What has a beginning that ends, such as a fade, is the same once that is over.
    constexpr double kBegun = 600.0;  // s
    for (const double later : {0.0, kBegun}) {
        const std::vector<float> young = picture_at(check, time + later, 0);
        const std::vector<float> old = picture_at(check, time + later, period.count);
        if (young.empty() || old.empty()) return;
        const Difference found = difference(old, young);
        result.note = fmt::format("{:.1f} dB, {:.2f} % of pixels off by more than 1/255",
                                  found.psnr, 100.0 * found.share_off);
        if (found.psnr >= kLeastPsnr && found.share_off <= kMostOff) return;
    }
    result.fail(fmt::format("{} (at least {:.0f} dB and at most {:.2f} %){}", result.note,
                            kLeastPsnr, 100.0 * kMostOff,
                            subject.reads(Builtin::time) ? "; it reads iTime beside iTick" : ""));
    if (!subject.stateful()) {
        subject.still = StillPlace{time + period.count * kTickPeriod, 60.0};
    }
}

// The tick wraps after 65536 s, and is negative as an int from half of that on: nothing jumps there
// by more than from frame to frame, or where a period of the scene's own begins again, as that of
// all its low bits does after each 2048 s, too, where nothing else happens, by more or less where
// chance says what comes next; or as others do within a few seconds.
void run_wrap(Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    constexpr double kMoves = 4.0, kJump = 0.01, kAlike = 1.5;  // times, RMSE, times
    constexpr int kCuts = 480;                                  // frames
    const auto picture = [&](double time) {
        subject.draw(subject.frame_at(time, kFrame, kFirstSecond));
        return subject.picture();
    };
    const auto is_as_others = [&](double jump) {
        constexpr int kOthers = 16;
        for (int k = 1; k < kOthers; ++k) {
            const double seam = k * kTickPeriod / (2 * kOthers);
            const std::vector<float> last = picture(seam - 0.5 * kFrame);
            if (jump <= kAlike * difference(picture(seam + 0.5 * kFrame), last).rmse) return true;
        }
        std::vector<float> last = picture(kTickPeriod / 8.0 + 1.0);
        for (int k = 1; k <= check.paced(kCuts, kCuts / 8); ++k) {
            std::vector<float> now = picture(kTickPeriod / 8.0 + 1.0 + k * kFrame);
            if (jump <= kAlike * difference(now, last).rmse) return true;
            last = std::move(now);
        }
        return false;
    };
    for (const double seam : {kTickPeriod / 2.0, kTickPeriod}) {
        const std::vector<float> before = picture(seam - 1.5 * kFrame),
                                 last = picture(seam - 0.5 * kFrame),
                                 first = picture(seam + 0.5 * kFrame);
        if (!subject.observed().is_finite()) return;
        const double usual = difference(last, before).rmse, jump = difference(first, last).rmse;
        if (jump <= kMoves * usual + kJump || is_as_others(jump)) continue;
        subject.still = StillPlace{seam + 0.5 * kFrame, 60.0};
        return result.fail(fmt::format(
            "at {:.0f} s, where iTick {}, a frame is off the last by {:.2g}, and that off the one "
            "before by {:.2g}; take what 2^32 is a multiple of, as in iTick & 0xFFFFu",
            seam, seam < kTickPeriod ? "is negative as an int" : "wraps", jump, usual));
    }
}

}  // namespace

void add_age_cases(std::vector<Case>& list, const CheckSubject& subject) {
    for (const Age& age : kAges) {
        const bool with_others = &age == std::end(kAges) - 1 && !subject.scene().tweaks.empty() &&
                                 reads_a_clock(subject.scene().text);
        list.push_back({fmt::format("age {}", age.name),
                        [&age, with_others](Check& check, CaseResult& result) {
                            run_age(age, check, result);
                            if (with_others) run_age_of_others(age, check, result);
                        },
                        with_others ? Case::Tweaks::all : Case::Tweaks::none});
    }
    if (!subject.reads(Builtin::tick)) return;
    if (!subject.stateful()) list.push_back({"tick wraps", run_wrap});
    for (const Period& period : kPeriods) {
        list.push_back({fmt::format("same phase after {}", period.name),
                        [&period](Check& check, CaseResult& result) {
                            run_same_phase(period, check, result);
                        }});
    }
}

}  // namespace glint
