// Frame times from 1/1000 s to the 30 s of a laptop's lid, and thousands of frames.
#include "measure/check/budget.h"
#include "measure/check/case.h"
#include "measure/check/drift.h"
#include "measure/check/endure.h"
#include "measure/check/invariants.h"
#include "measure/rows/difference.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <utility>

namespace glint {
namespace {

// s, where states are compared: between the moments, such as whole seconds, at which scenes switch
// something on, of which the first frame after it would be all that is seen. Long frames meet 60 Hz
// at whole ones alone.
constexpr double kEarly = 0.35, kLater = 28.0 / 30.0, kWhole = 1.0;
// s, at which another rate goes on from 60 Hz, and how long.
constexpr double kChanges[] = {kLater, kLater + 1.0, kLater + 2.0}, kChanged = 14.0 / 30.0;
constexpr double kLidCatchUp = 0.25;                   // s, as in the window
constexpr int kSteppedFrames = 64, kLeastStepped = 8;  // at each frame time
// A step's own state may differ by rounding alone; pictures by what a rate may change, such as the
// noise of an average. Noise is gone from the means of tiles, a place is not.
constexpr float kMostStateOff = 1e-3f;  // of the largest value
constexpr double kMostTilesOff = 0.02;  // root mean square, in display values
constexpr glm::ivec2 kTiles(8, 5);
constexpr int kLongMoments = 240;
constexpr double kLongSpan = 600.0;  // s
constexpr int kShownHidden = 120;    // frames, after which a picture shows what a limit hides
constexpr float kGrowth = 20.0f;     // from the first quarter of a long run to its last

struct FrameTime {
    const char* name;
    double fps;
};
constexpr FrameTime kFrameTimes[] = {{"1/1000 s", 1000}, {"1/240 s", 240}, {"1/60 s", 60},
                                     {"1/30 s", 30},     {"0.25 s", 4},    {"1 s", 1},
                                     {"30 s", 1.0 / 30}};

State state_of(const CheckSubject& subject) {
    State state{.picture = subject.picture(), .largest = subject.largest_state()};
    const auto& graph = subject.renderer().graph().passes;
    for (std::size_t i = 0; i < graph.size(); ++i) {
        if (graph[i].pass == kImagePass || !subject.scene().passes[graph[i].pass].step) continue;
        for (int output = 0; output < subject.renderer().buffer(i).shape().outputs; ++output) {
            state.buffers.push_back(
                subject.renderer().read_buffer(i, static_cast<std::size_t>(output)));
        }
    }
    return state;
}

// What is drawn frame by frame, such as the trail of a pen, has gaps where frames take long: of
// these it is only asked that it does not explode.
bool has_steps(const CheckSubject& subject) {
    return std::ranges::any_of(subject.scene().passes,
                               [](const Pass& pass) { return static_cast<bool>(pass.step); });
}

// The states that every frame rate has to reach. False when a frame was not finite.
bool play_at_60_hz(Check& check) {
    if (check.whole) return true;
    CheckSubject& subject = check.subject;
    int first = 0;
    for (auto [time, state] : {std::pair(kEarly, &check.early), std::pair(kLater, &check.later),
                               std::pair(kWhole, &check.whole)}) {
        const int end = static_cast<int>(std::lround(time * 60.0)) + 1;
        if (!subject.play_frames(first, end, 60.0)) return false;
        *state = state_of(subject);
        first = end;
    }
    subject.renderer().reset();
    return true;
}

// Largest difference of two buffers, as a share of the largest value.
float buffers_off(std::span<const float> a, std::span<const float> b) {
    float largest = 1e-6f, off = 0.0f;
    for (std::size_t i = 0; i < a.size(); ++i) {
        largest = std::max({largest, std::abs(a[i]), std::abs(b[i])});
        off = std::max(off, std::abs(a[i] - b[i]));
    }
    return off / largest;
}

// Means over tiles of the picture, red, green and blue.
std::vector<double> tile_means(std::span<const float> picture, glm::ivec2 size) {
    const auto tiles = static_cast<std::size_t>(kTiles.x * kTiles.y);
    std::vector<double> sums(tiles * 3), counts(tiles, 1e-9);
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            const auto tile =
                static_cast<std::size_t>(y * kTiles.y / size.y * kTiles.x + x * kTiles.x / size.x);
            const auto pixel = static_cast<std::size_t>(y * size.x + x);
            counts[tile] += 1.0;
            for (std::size_t c = 0; c < 3; ++c) {
                sums[tile * 3 + c] +=
                    std::clamp(static_cast<double>(picture[pixel * 4 + c]), 0.0, 1.0);
            }
        }
    }
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] /= counts[i / 3];
    return sums;
}

// What the noise of single pixels leaves of a tile's mean: neighbours tell how much there is.
double mean_noise(std::span<const float> a, std::span<const float> b, glm::ivec2 size) {
    double squares = 0.0, count = 1e-9;
    for (std::size_t i = 0; i + 7 < a.size(); ++i) {
        if (i % 4 == 3) continue;
        const double step = static_cast<double>(a[i] - b[i]) - (a[i + 4] - b[i + 4]);
        squares += std::min(step * step, 4.0) / 2.0;
        count += 1.0;
    }
    const double pixels = std::max(1.0, static_cast<double>(size.x) * size.y / kTiles.x / kTiles.y);
    constexpr double kSure = 2.0;  // some tiles stray further than most
    return kSure * squares / count / pixels;
}

double tiles_off(std::span<const float> a, std::span<const float> b, glm::ivec2 size) {
    const std::vector<double> left = tile_means(a, size), right = tile_means(b, size);
    double squares = 0.0;
    for (std::size_t i = 0; i < left.size(); ++i) {
        squares += (left[i] - right[i]) * (left[i] - right[i]);
    }
    const double mean = squares / static_cast<double>(left.size());
    return std::sqrt(std::max(0.0, mean - mean_noise(a, b, size)));
}

void compare_states(const State& now, const State& at_60_hz, double time, glm::ivec2 size,
                    CaseResult& result) {
    float off = 0.0f;
    for (std::size_t i = 0; i < now.buffers.size(); ++i) {
        off = std::max(off, buffers_off(now.buffers[i], at_60_hz.buffers[i]));
    }
    const double tiles = tiles_off(now.picture, at_60_hz.picture, size);
    const Difference pictures = difference(now.picture, at_60_hz.picture);
    if (off > kMostStateOff) {
        result.fail(
            fmt::format("after {:.3g} s the state of a step pass is {:.2g} of its largest value "
                        "off what 60 Hz reaches",
                        time, off));
    } else if (tiles > kMostTilesOff) {
        result.fail(
            fmt::format("after {:.3g} s the picture is off what 60 Hz shows: by {:.3f} in the "
                        "means of tiles, {:.1f} dB",
                        time, tiles, pictures.psnr));
    } else {
        result.note = fmt::format("{:.1f} dB beside 60 Hz after {:.3g} s", pictures.psnr, time);
    }
}

// Beyond what halves hold, and beyond a thousand times what it is at 60 Hz after a second, a state
// has exploded; one that counts goes on by as much in each.
void judge_growth(const CheckSubject& subject, const State& at_60_hz, double seconds,
                  CaseResult& result) {
    const float largest = subject.largest_state();
    const float most = std::max(1000.0f, 4.0f * static_cast<float>(seconds / kLater));
    if (largest > std::max(kLargestHalf, most * at_60_hz.largest)) {
        result.fail(
            fmt::format("the state explodes: {:.3g}, at 60 Hz {:.3g}", largest, at_60_hz.largest));
    }
}

// What begins later is seen from a state that both rates have: a screen's rate changes, and the
// frames' numbers go on.
void compare_after_changes(double fps, Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    const CaseClock clock(check);
    const auto play = [&](double from, double rate, long first) {
        const long frames = std::lround(kChanged * rate);
        for (long k = 1; k <= frames; ++k) {
            const double time = from + static_cast<double>(k) / rate;
            if (!subject.draw(subject.frame_at(time, 1.0 / rate, first + k))) return false;
        }
        return true;
    };
    for (const double change : kChanges) {
        const long first = std::lround(change * 60.0);
        State at_60_hz;
        for (const double rate : {60.0, fps}) {
            subject.renderer().reset();
            if (!subject.play_frames(0, static_cast<int>(first) + 1, 60.0)) return;
            subject.still.reset();
            if (!play(change, rate, first)) return;
            if (rate == 60.0) at_60_hz = state_of(subject);
        }
        compare_states(state_of(subject), at_60_hz, change + kChanged, subject.preset.size, result);
        if (result.verdict == CaseVerdict::fail)
            return result.fail(fmt::format("{}; 60 Hz up to {:.3g} s", result.note, change));
        if (clock.is_over(0.03)) return;
    }
}

// Frames of one length: first to where states are compared, then on, to see what grows.
void run_steps(const FrameTime& step, Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    if (!subject.stateful()) {
        subject.play_frames(0, 3, step.fps);
        return;
    }
    if (!play_at_60_hz(check)) return;
    const bool lid = step.fps < 1.0;
    const bool is_compared = step.fps > 10.0 || (!lid && has_steps(subject));
    const double met = step.fps > 500.0 ? kEarly : step.fps > 10.0 ? kLater : kWhole;
    const int last = lid ? 1 : static_cast<int>(std::lround(met * step.fps));
    const Playback endless{.end = 1e6, .fps = step.fps};
    const int frames = std::max(last, check.paced(kSteppedFrames, kLeastStepped));
    for (int k = 0; k <= frames; ++k) {
        Frame frame = endless.frame(subject.preset, k);
        if (lid) frame.longest_catch_up = kLidCatchUp;
        subject.still.reset();
        if (!lid) subject.still = StillPlace{k / step.fps, step.fps};
        if (!subject.draw(frame)) return;
        if (k != last || !is_compared) continue;
        const State& at_60_hz = met == kEarly   ? *check.early
                                : met == kLater ? *check.later
                                                : *check.whole;
        compare_states(state_of(subject), at_60_hz, met, subject.preset.size, result);
        if (result.verdict == CaseVerdict::fail) return;
    }
    judge_growth(subject, *check.later, frames / step.fps, result);
    if (step.fps == 240.0 && result.verdict != CaseVerdict::fail)
        compare_after_changes(step.fps, check, result);
}

// Frames of any length, one after the other.
void run_mixed_steps(Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    if (!play_at_60_hz(check)) return;
    constexpr double kShort[] = {1.0 / 1000, 1.0 / 240, 1.0 / 60, 1.0 / 30, 0.25};
    const std::size_t lengths = std::size(kShort) - (has_steps(subject) ? 0 : 1);
    constexpr double kAny[] = {1.0 / 1000, 1.0 / 240, 1.0 / 60, 1.0 / 30, 0.25, 1.0, 30.0};
    std::mt19937 random(1);
    double time = 0.0;
    subject.still.reset();
    if (!subject.draw(subject.frame_at(0.0, 1.0 / 60, 0))) return;
    long index = 1;
    for (; time < kLater; ++index) {
        const double delta = std::min(kShort[random() % lengths], kLater - time);
        time = kLater - time - delta < 1e-9 ? kLater : time + delta;
        if (!subject.draw(subject.frame_at(time, delta, index))) return;
    }
    compare_states(state_of(subject), *check.later, kLater, subject.preset.size, result);
    if (result.verdict == CaseVerdict::fail) return;
    for (int k = 0; k < check.paced(kSteppedFrames, kLeastStepped); ++k) {
        const double delta = kAny[random() % std::size(kAny)];
        time += delta;
        Frame frame = subject.frame_at(time, delta, index + k);
        frame.longest_catch_up = kLidCatchUp;
        if (!subject.draw(frame)) return;
    }
    judge_growth(subject, *check.later, time, result);
}

// A simulation frame by frame; of another scene, moments spread over ten minutes.
void run_long(Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    Invariants invariants(subject);
    const auto is_broken = [&] {
        if (invariants.broken().empty()) return false;
        result.fail(invariants.broken());
        subject.still.reset();  // it is a buffer's, in some frame
        return true;
    };
    if (!subject.stateful()) {
        const int moments = check.paced(kLongMoments, 12);
        for (int k = 0; k < moments; ++k) {
            if (!subject.show(subject.preset.time + k * kLongSpan / moments, 0.0)) return;
            invariants.add(subject, k);
        }
        result.curves = invariants.curves();
        result.note = fmt::format("{} moments over 10 minutes{}", moments, invariants.words());
        is_broken();
        return;
    }
    const int wanted = check.effort.frames.value_or(Effort::kFrames);
    const CaseClock clock(check);
    StateCurves curves;
    int done = 0;
    for (; done < wanted; ++done) {
        if (!subject.play_frames(done, done + 1, 60.0)) return;
        curves.add(subject);
        invariants.add(subject, done);
        if (!check.effort.frames && clock.is_over(0.25)) break;
    }
    result.note = done < wanted ? fmt::format("{} of {} frames; --seconds {} were over", done,
                                              wanted, check.effort.seconds)
                                : fmt::format("{} frames", done);
    result.note += invariants.words();
    result.curves = invariants.curves();
    if (is_broken()) return;
    const std::size_t quarter = curves.frames() / 4;
    if (quarter == 0) return;
    const float first = curves.largest_before(quarter);
    const float last = curves.largest_from(curves.frames() - quarter);
    const std::string growth = curves.growth();
    // What starts at nothing may rise to 1; a sum over frames grows by four, the place of what is
    // pushed steadily, such as a boat that sets out, by sixteen.
    if (last > 1.0f && last > kGrowth * first) {
        result.fail(
            fmt::format("the state grows from {:.3g} in the first {} frames to {:.3g} in "
                        "the last",
                        first, quarter, last));
    } else if (!growth.empty()) {
        result.fail(growth);
    } else if (const std::string why = what_hides(check, curves, curves.largest()); !why.empty()) {
        subject.restore();
        subject.play_frames(0, kShownHidden, 60.0);
        result.fail(why);
    }
}

}  // namespace

void add_step_cases(std::vector<Case>& list, const CheckSubject& subject) {
    if (!subject.moves()) return;
    for (const FrameTime& step : kFrameTimes) {
        list.push_back(
            {fmt::format("frames of {}", step.name),
             [&step](Check& check, CaseResult& result) { run_steps(step, check, result); }});
    }
    if (subject.stateful()) list.push_back({"frames of mixed lengths", run_mixed_steps});
}

void add_long_case(std::vector<Case>& list, const CheckSubject& subject) {
    if (subject.moves() || Invariants(subject).any()) list.push_back({"long run", run_long});
}

}  // namespace glint
