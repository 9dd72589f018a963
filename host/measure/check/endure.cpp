// Simulations over many frames: every end of every tweak, and what becomes of a poisoned texel once
// it looks healed.
#include "measure/check/endure.h"

#include "measure/check/budget.h"
#include "measure/check/drift.h"
#include "measure/check/invariants.h"
#include "measure/check/poison.h"
#include "measure/check/space.h"
#include "measure/check/to_and_fro.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

namespace glint {
namespace {

constexpr int kEndured = 600, kLeastEndured = 30;  // at each end of a tweak
constexpr int kConfirmed = 2000;                   // before a growth is told
constexpr double kConfirmingShare = 0.1;           // of the seconds
constexpr float kFar = 1000.0f;
constexpr int kBefore = 30, kAfter = 120, kSweep = 1500;  // frames round a poisoning
constexpr double kHalfPlayed = 2.0;                       // s, with a part of each step
constexpr int kExchanges = 3,
              kRound = 2;           // sound disturbances, and texels round each that they move
constexpr std::size_t kChance = 3;  // times what these leave standing is no chance any more

// Frames at 60 Hz, as many as this share of the seconds allows. False when one was not finite.
bool play_curves(const Check& check, int frames, StateCurves& curves, Invariants& invariants,
                 double share = 0.02) {
    const CaseClock clock(check);
    for (int k = static_cast<int>(curves.frames()); k < frames; ++k) {
        if (k >= kLeastEndured && clock.is_over(share)) break;
        if (!check.subject.play_frames(k, k + 1, 60.0)) return false;
        curves.add(check.subject);
        invariants.add(check.subject, k);
    }
    return true;
}

// Of the shortest step, or of a frame, of what is fed back.
double steps_a_second(const CheckSubject& subject) {
    constexpr double kFrameRate = 60.0;
    double rate = 0.0;
    const auto& passes = subject.renderer().graph().passes;
    for (std::size_t i = 0; i < passes.size(); ++i) {
        if (!subject.is_fed_back(i)) continue;
        const bool steps =
            passes[i].pass != kImagePass && subject.scene().passes[passes[i].pass].step;
        rate = std::max(
            rate, steps ? 1.0 / subject.scene().passes[passes[i].pass].step.seconds() : kFrameRate);
    }
    return rate > 0.0 ? rate : kFrameRate;
}

constexpr const char* kHiddenByALimit =
    "the step is unstable, though a limit hides it: the state goes to and fro from step to step";
constexpr const char* kHiddenByAGuard =
    "the step is unstable, though a guard hides it: by shorter steps the state stays a thousand "
    "times smaller";

// What `play` says of the same text with so many steps in place of each, from its start; `often`:
// how many those are a second.
template <typename Play>
auto by_finer_steps(CheckSubject& subject, int finer, Play play) {
    const double often = finer * steps_a_second(subject);
    const std::vector<TweakValue> values = subject.preset.values;
    std::vector<Pass>& passes = subject.preset.scene.passes;
    const std::vector<Pass> whole = passes;
    for (Pass& pass : passes) pass.step.denominator *= finer;
    subject.restore();
    subject.preset.values = values;
    auto said = play(often);
    passes = whole;
    return said;
}

// What knows no lengths does the same by finer steps, only sooner: cells have come to rest, or not.
bool knows_steps(const CheckSubject& subject) {
    const auto& passes = subject.renderer().graph().passes;
    for (std::size_t i = 0; i < passes.size(); ++i)
        if (subject.is_fed_back(i) && subject.knows_step(passes[i].pass)) return true;
    return false;
}

// Whether the step is unstable, and a limit hides it: the state goes to and fro from step to step,
// and does not with a half or an eighth of each; or, whatever lengths a text gives its steps
// itself, far beyond `usual`, or as a chessboard that grows. The subject stands somewhere else
// afterwards.
bool chatters_by_steps(const Check& check, const StateCurves& curves, float usual) {
    CheckSubject& subject = check.subject;
    const double rate = steps_a_second(subject);
    const double played = static_cast<double>(curves.frames()) / 60.0;
    const int first = static_cast<int>(played * rate);
    if (!goes_to_and_fro(subject, first, rate)) return false;
    if (grows_to_a_chessboard(subject, first + kTurns, rate)) return true;
    const auto still = [&](double often) {
        const int frames = static_cast<int>(kHalfPlayed * often);
        return subject.play_frames(0, frames, often) && goes_to_and_fro(subject, frames, often);
    };
    if (curves.stands_beyond(usual)) return true;
    return knows_steps(subject) &&
           (!by_finer_steps(subject, 2, still) || !by_finer_steps(subject, 8, still));
}

// Whether it grows large at once, by the length of its steps alone: a guard that takes what is too
// large for 0 lets it begin anew, as if it had a level of its own. As long by a half or an eighth
// of each it stays small. The subject stands somewhere else afterwards.
bool grows_by_steps(const Check& check, const StateCurves& curves) {
    constexpr double kShare = 0.05;                                     // of the seconds
    if (curves.largest() < kFar || !curves.multiplies()) return false;  // an event leaps
    if (!knows_steps(check.subject)) return false;
    const CaseClock clock(check);
    const auto stays_small = [&](double often) {
        const int frames = static_cast<int>(static_cast<double>(curves.frames()) / 60.0 * often);
        for (int k = 0; k < frames; ++k) {
            if (clock.is_over(kShare) || !check.subject.play_frames(k, k + 1, often) ||
                check.subject.largest_state() * kFar > curves.largest())
                return false;
        }
        return true;
    };
    return by_finer_steps(check.subject, 2, stays_small) ||
           by_finer_steps(check.subject, 8, stays_small);
}

}  // namespace

std::string what_hides(const Check& check, const StateCurves& curves, float usual) {
    if (chatters_by_steps(check, curves, usual)) return kHiddenByALimit;
    return grows_by_steps(check, curves) ? kHiddenByAGuard : "";
}

namespace {

bool is_far(const StateCurves& curves, float usual) {
    return curves.largest() > std::max(kFar, kFar * usual);
}

// Whether the state explodes, beyond `usual` by far. What comes to rest, not too far, was to: a
// population grows so to what the land bears.
bool explodes(const Check& check, StateCurves& curves, Invariants& invariants, float usual) {
    if (!curves.explodes(usual)) return false;
    if (curves.chatters()) return true;
    if (!curves.rests() && !play_curves(check, kConfirmed, curves, invariants, kConfirmingShare))
        return true;
    return !curves.rests() || is_far(curves, usual);
}

// What begins as a growth may come to rest, too: then it goes on, and where time is too short to
// tell, nothing is told.
std::string why_not(const Check& check, StateCurves& curves, Invariants& invariants, float usual) {
    if (!check.subject.observed().is_finite()) return "";
    if (explodes(check, curves, invariants, usual))
        return fmt::format("the state explodes to {:.3g} (with the preset's values {:.3g})",
                           curves.largest(), usual);
    const std::size_t seen = curves.frames();
    std::string growth = curves.growth();
    if (growth.empty()) growth = curves.growth(seen / 3);  // what it begins with has faded then
    const int confirmed = std::max(kConfirmed, check.effort.frames.value_or(0));
    if (growth.empty() && invariants.broken().empty()) {
        return what_hides(check, curves, usual);
    }
    if (growth.empty() || !play_curves(check, confirmed, curves, invariants, kConfirmingShare))
        return invariants.broken();
    const bool goes_on =
        static_cast<int>(curves.frames()) >= confirmed && !curves.growth(seen).empty();
    return goes_on || is_far(curves, usual) ? growth : invariants.broken();
}

void run_end(std::size_t tweak, double value, Check& check, CaseResult& result) {
    TweakValue filled{};
    filled.fill(value);
    const float usual = usual_largest(check);
    check.subject.preset.values[tweak] =
        clamp_to_range(check.subject.scene().tweaks[tweak], filled);
    StateCurves curves;
    Invariants invariants(check.subject);
    if (!play_curves(check, check.paced(kEndured, kLeastEndured), curves, invariants)) return;
    result.note = fmt::format("{} frames, largest {:.3g}", curves.frames(), curves.largest());
    const std::string why = why_not(check, curves, invariants, usual);
    if (!why.empty()) result.fail(why);
}

struct Seen {
    float middle = 0.0f, end = 0.0f, all = 0.0f;  // largest of the buffer
    std::vector<float> at_middle{}, at_late{}, at_end{};
};

float largest_of(const std::vector<float>& values) {
    float largest = 0.0f;
    for (const float v : values)
        if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
    return largest;
}

// Disturbed after some frames, if at all.
std::optional<Seen> play_on(Check& check, std::size_t index, int after,
                            const std::function<void()>& disturb = nullptr) {
    CheckSubject& subject = check.subject;
    subject.renderer().reset();
    Seen seen;
    std::vector<float> values;
    for (int k = 0; k < kBefore + 2 + after; ++k) {
        if (k == kBefore && disturb) disturb();
        const Playback endless{.end = 1e6, .fps = 60.0};
        subject.draw_blindly(endless.frame(subject.preset, k));
        if (k < kBefore + 2) continue;
        values = subject.renderer().read_buffer(index, 0);
        if (largest_of(values) == 0.0f &&
            !std::ranges::all_of(values, [](float v) { return std::isfinite(v); }))
            return std::nullopt;
        seen.all = std::max(seen.all, largest_of(values));
        if (k == kBefore + 2 + after / 2) {
            seen.middle = largest_of(values);
            seen.at_middle = values;
        }
        if (k == kBefore + 2 + after * 3 / 4) seen.at_late = values;
    }
    seen.end = largest_of(values);
    seen.at_end = values;
    subject.still.reset();
    return seen;
}

// Whether a value stands still that would move, far from where it is.
bool is_stuck(const Seen& disturbed, const Seen& clean, std::size_t i) {
    const bool stands = disturbed.at_middle[i] == disturbed.at_late[i] &&
                        disturbed.at_late[i] == disturbed.at_end[i];
    const bool would_move =
        clean.at_middle[i] != clean.at_late[i] && clean.at_late[i] != clean.at_end[i];
    return stands && would_move &&
           std::abs(disturbed.at_end[i] - clean.at_end[i]) > 0.05f * clean.all;
}

// The texels and those round them, as they are elsewhere in the buffer: how many values stand still
// in spite of that, away from them. None, but where the least change has all go another way, as on
// a board of cells: some rest where they would not have.
std::size_t stuck_by_exchange(Check& check, std::size_t index, int after, const Seen& clean,
                              int times) {
    std::vector<glm::ivec2> texels;
    const auto seen = play_on(check, index, after, [&] {
        texels = texels_to_poison(check.subject, index, check.effort.inject);
        exchange(check.subject, index, texels, kRound, times);
    });
    if (!seen) return 0;
    const int width = check.subject.renderer().buffer(index).shape().size.x;
    std::size_t count = 0;
    for (std::size_t i = 0; i < clean.at_end.size(); ++i) {
        const auto texel = static_cast<int>(i / 4);
        const bool is_near = std::ranges::any_of(texels, [&](glm::ivec2 at) {
            return std::abs(texel % width - at.x) <= kRound + 1 &&
                   std::abs(texel / width - at.y) <= kRound + 1;
        });
        count += !is_near && is_stuck(*seen, clean, i);
    }
    return count;
}

// The least and the largest value of a channel, wherever.
std::pair<float, float> range_of(const Seen& seen, std::size_t channel) {
    std::pair<float, float> range(INFINITY, -INFINITY);
    for (const auto* values : {&seen.at_middle, &seen.at_late, &seen.at_end}) {
        for (std::size_t i = channel; i < values->size(); i += 4) {
            range.first = std::min(range.first, (*values)[i]);
            range.second = std::max(range.second, (*values)[i]);
        }
    }
    return range;
}

// Whether any stands at what no value of its channel comes to without NaN.
bool stands_at_a_value_of_its_own(const Seen& poisoned, const Seen& clean) {
    for (std::size_t channel = 0; channel < 4; ++channel) {
        const auto [least, most] = range_of(clean, channel);
        const float beyond = 0.05f * clean.all;
        for (std::size_t i = channel; i < clean.at_end.size(); i += 4) {
            const float value = poisoned.at_end[i];
            const bool is_own = value < least - beyond || value > most + beyond;
            if (is_own && is_stuck(poisoned, clean, i)) return true;
        }
    }
    return false;
}

// How many values stand still for NaN's sake.
std::size_t count_stuck(Check& check, std::size_t index, int after, const Seen& poisoned,
                        const Seen& clean) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < clean.at_end.size(); ++i) count += is_stuck(poisoned, clean, i);
    if (count == 0 || stands_at_a_value_of_its_own(poisoned, clean)) return count;
    std::size_t by_chance = 0;
    for (int times = 1; times <= kExchanges; ++times)
        by_chance = std::max(by_chance, stuck_by_exchange(check, index, after, clean, times));
    return count > kChance * by_chance ? count : 0;
}

void put_nan(Check& check, std::size_t index) {
    for (const glm::ivec2 texel : texels_to_poison(check.subject, index, check.effort.inject))
        poison(check.subject.renderer().buffer(index), texel,
               std::numeric_limits<float>::quiet_NaN());
}

// How many of these have not moved after some seconds more: what is swept now and then heals with
// the next sweep.
std::size_t count_stuck_later(Check& check, std::size_t index, int after, const Seen& poisoned,
                              const Seen& clean) {
    std::vector<std::size_t> left;
    for (std::size_t i = 0; i < clean.at_end.size(); ++i)
        if (is_stuck(poisoned, clean, i)) left.push_back(i);
    CheckSubject& subject = check.subject;
    subject.renderer().reset();
    const Playback endless{.end = 1e6, .fps = 60.0};
    const int end = kBefore + 2 + check.paced(kSweep, after);
    for (int k = 0; k < end && !left.empty(); ++k) {
        if (k == kBefore) put_nan(check, index);
        subject.draw_blindly(endless.frame(subject.preset, k));
        if (k < kBefore + 2 + after) continue;
        const std::vector<float> values = subject.renderer().read_buffer(index, 0);
        std::erase_if(left, [&](std::size_t i) { return values[i] != poisoned.at_end[i]; });
    }
    return left.size();
}

// Whether what NaN left otherwise stands where it comes to by itself, later: it was mended with
// where it goes.
bool is_where_it_ends(Check& check, std::size_t index, int after, const Seen& poisoned,
                      const Seen& clean) {
    constexpr float kNear = 0.05f;
    const auto later = play_on(check, index, check.paced(kSweep, after));
    if (!later) return false;
    for (std::size_t i = 0; i < clean.at_end.size(); ++i) {
        const auto is_near = [&](const Seen& other) {
            return std::abs(poisoned.at_end[i] - other.at_end[i]) <= kNear * other.all;
        };
        if (!is_near(clean) && !is_near(*later)) return false;
    }
    return true;
}

void run_after_poison(std::size_t index, Check& check, CaseResult& result) {
    const int after = check.paced(kAfter, 24);
    const auto clean = play_on(check, index, after);
    const auto poisoned = play_on(check, index, after, [&] { put_nan(check, index); });
    if (!clean || !poisoned) return;
    std::size_t stuck = count_stuck(check, index, after, *poisoned, *clean);
    if (stuck > 0)
        stuck = std::min(stuck, count_stuck_later(check, index, after, *poisoned, *clean));
    constexpr float kMost = 2.0f, kFading = 0.95f;
    const bool is_large =
        poisoned->end > kMost * clean->all + 1e-3f && poisoned->end > kFading * poisoned->middle;
    if ((is_large || stuck > 0) && is_where_it_ends(check, index, after, *poisoned, *clean)) {
        result.note = fmt::format("{} frames on, as it is later by itself", after);
    } else if (is_large) {
        result.fail(
            fmt::format("heals to a wrong state: {} frames after NaN the largest value is {:.3g} "
                        "and not fading, without NaN never above {:.3g}",
                        after, poisoned->end, clean->all));
    } else if (stuck > 0) {
        result.fail(
            fmt::format("heals to a wrong state: {} values stand still for {} frames after NaN, "
                        "and would move",
                        stuck, after / 2));
    } else {
        result.note = fmt::format("{} frames on", after);
    }
}

}  // namespace

float usual_largest(Check& check) {
    if (check.usual_largest) return *check.usual_largest;
    check.subject.restore();  // a search that asks stands elsewhere
    StateCurves curves;
    Invariants invariants(check.subject);
    play_curves(check, check.paced(kEndured, kLeastEndured), curves, invariants);
    check.subject.restore();  // what is no number there is another case's to tell
    check.usual_largest = curves.largest();
    return *check.usual_largest;
}

std::string why_not_for_long(Check& check, float usual) {
    StateCurves curves;
    Invariants invariants(check.subject);
    play_curves(check, check.paced(kEndured, kLeastEndured), curves, invariants);
    return why_not(check, curves, invariants, usual);
}

void add_endurance_cases(std::vector<Case>& list, const CheckSubject& subject) {
    if (!subject.stateful() && !Invariants(subject).any()) return;
    const auto& tweaks = subject.scene().tweaks;
    for (std::size_t i = 0; i < tweaks.size(); ++i) {
        const auto range = range_of(tweaks[i]);
        if (!range || !tweaks[i].names.empty()) continue;
        for (const double value : {range->min, range->max}) {
            TweakValue filled{};
            filled.fill(value);
            list.push_back(
                {fmt::format("{}={} for long", tweaks[i].name,
                             format_value(tweaks[i], clamp_to_range(tweaks[i], filled))),
                 [i, value](Check& check, CaseResult& result) { run_end(i, value, check, result); },
                 Case::Tweaks::one});
        }
    }
}

void add_healing_cases(std::vector<Case>& list, const CheckSubject& subject, const Effort& effort) {
    if (effort.inject == 0) return;
    const auto& passes = subject.renderer().graph().passes;
    for (std::size_t i = 0; i < passes.size(); ++i) {
        const BufferShape& shape = subject.renderer().buffer(i).shape();
        if (!subject.is_fed_back(i) || shape.cube || bytes_a_channel(shape.format) == 1) continue;
        list.push_back(
            {"healed " + pass_name(subject.scene(), passes[i].pass),
             [i](Check& check, CaseResult& result) { run_after_poison(i, check, result); }});
    }
}

}  // namespace glint
