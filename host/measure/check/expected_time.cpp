// `ms_ratio` of a preset's `[expect]`: how many times longer its frames may take than another
// look's. A ratio within one run, since no clock of one machine says anything of another.
#include "base/stopwatch.h"
#include "measure/check/case.h"
#include "measure/study/pair.h"

#include <fmt/format.h>

#include <algorithm>

namespace glint {
namespace {

constexpr int kRounds = 15, kFewest = 5;  // at least, the latter where frames are slow
constexpr double kSeconds = 20.0;         // after which no verdict is waited for
constexpr double kTimingShare = 0.3;      // of the seconds of all cases, if that is less
constexpr glm::ivec2 kSize{640, 360};     // unless --size says otherwise, as in a study

// Throws Stop for a look that cannot be read, with the reason on stderr, as everywhere.
Preset opened_for_timing(const ViewOptions& view, const std::filesystem::path& file) {
    ViewOptions timed = view;
    timed.file = file;
    if (timed.size.empty()) timed.size = fmt::format("{}x{}", kSize.x, kSize.y);
    return file == view.file ? open_preset_again(timed) : open_preset(timed);
}

// As many as the seconds have room for; an interval of fewer is wider, and blames nobody.
int rounds_within(double seconds, MeasuredScene& a, MeasuredScene& b) {
    const Stopwatch frames;
    a.draw_picture();
    b.draw_picture();
    return static_cast<int>(
        std::clamp(seconds * 1e3 / frames.ms(), double{kFewest}, double{kRounds}));
}

std::unique_ptr<MeasuredScene> drawn_once(const Preset& preset, Context& context, bool specialise) {
    auto scene = std::make_unique<MeasuredScene>(
        preset, Setting{.values = preset.values, .settle = preset.settle}, context,
        MeasureOptions{.specialise = specialise});
    scene->draw_picture();
    return scene;
}

void check_time(Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    const Expect& expect = subject.opened().expect;
    const ViewOptions& view = subject.view();
    if (is_another_look(subject, result)) return;
    std::error_code none;
    if (!std::filesystem::exists(expect.ms_of, none))
        return result.fail(fmt::format(
            "there is no {}, beside which its time is expected; name a preset or scene in ms_ratio",
            expect.ms_of.string()));
    const double all = check.effort.seconds;
    const double seconds = all > 0.0 ? std::min(kSeconds, kTimingShare * all) : kSeconds;
    TimedPair times;
    try {
        const Preset other = opened_for_timing(view, expect.ms_of);
        const Preset own = opened_for_timing(view, view.file);
        const auto a = drawn_once(other, subject.context(), view.specialise);
        const auto b = drawn_once(own, subject.context(), view.specialise);
        times = time_pair(*a, *b,
                          {.least = rounds_within(seconds, *a, *b),
                           .seconds = seconds,
                           .on_software = subject.context().is_software()},
                          subject.after_frame);
    } catch (const Stop&) {
        return result.fail(
            fmt::format("{} cannot be drawn to compare its time", expect.ms_of.string()));
    }
    const std::string found =
        fmt::format("its frames take {:.3f} of the time of {} ({:.3f} to {:.3f})", times.ratio,
                    expect.ms_of.string(), times.between.low, times.between.high);
    // As long as the bound is within what the ratio may be, nothing is said against it.
    if (times.between.low > *expect.ms_ratio)
        result.fail(fmt::format("{}; {:.3g} is expected at most", found, *expect.ms_ratio));
    else
        result.note = found;
}

}  // namespace

void add_expected_time_case(std::vector<Case>& list, const CheckSubject& subject) {
    if (subject.opened().expect.ms_ratio)
        list.push_back({.name = "expected time", .run = check_time, .shows = false});
}

}  // namespace glint
