// Whether every sample of a scene's sound is a number. What is none is silence in a file, and
// whatever the driver likes in a browser.
#include "measure/check/budget.h"
#include "measure/check/case.h"
#include "measure/check/space.h"
#include "measure/probe/faults.h"
#include "offline/sound.h"

#include <fmt/format.h>

#include <cmath>

namespace glint {
namespace {

constexpr double kHeard = 20.0;  // s from the start, with the preset's values
// s, of which a fifth of a second each is heard at the ends of all ranges; `samp` ends after 13 h.
constexpr double kMoments[] = {0.0, 1.0, 60.0, 3600.0, 43200.0};
constexpr std::size_t kEnds = 16;  // sets of tweaks

long block_at(double seconds) {
    return static_cast<long>(seconds * kSampleRate) / SoundRenderer::kBlock;
}

std::vector<std::vector<TweakValue>> values_to_hear(CheckSubject& subject) {
    std::vector<std::vector<TweakValue>> all = values_at_ends(subject, kEnds);
    const Space space(subject);
    for (const Point& point : space.zeros()) {
        space.apply(point, subject);
        all.push_back(subject.preset.values);
    }
    subject.restore();
    return all;
}

std::string tweak_words(const CheckSubject& subject, const std::vector<TweakValue>& values) {
    std::string words;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (values[i] == subject.opened().values[i]) continue;
        const Tweak& tweak = subject.scene().tweaks[i];
        words += fmt::format("{}{}={}", words.empty() ? " with " : ", ", tweak.name,
                             format_value(tweak, values[i]));
    }
    return words;
}

class Ear {
public:
    Ear(Check& check, CaseResult& result)
        : subject_(check.subject), result_(result), sound_(subject_.opened(), false) {}

    // False once a sample was no number.
    bool hears(long index, const std::vector<TweakValue>& values) {
        sound_.renderer().set_values(values);
        const Frame frame = sound_.frame_of(index);
        const std::vector<float> rgba = sound_.drawn(frame);
        if (subject_.after_frame) subject_.after_frame();
        for (std::size_t i = 0; i < rgba.size(); i += 4) {
            const bool left = !std::isfinite(rgba[i]);
            if (!left && std::isfinite(rgba[i + 1])) continue;
            const long sample = index * SoundRenderer::kBlock + static_cast<long>(i / 4);
            result_.fail(fmt::format(
                "{} in the {} channel at {:.5f} s, sample {}{}",
                std::isnan(rgba[i + (left ? 0 : 1)]) ? "NaN" : "Inf", left ? "left" : "right",
                static_cast<double>(sample) / kSampleRate, sample, tweak_words(subject_, values)));
            find_birth(frame);
            return false;
        }
        return true;
    }

private:
    // The operation at which it came about, where the probe can tell.
    void find_birth(const Frame& frame) {
        try {
            FaultWatch watch(subject_.opened(), sound_.renderer(), {.specialise = false});
            watch.after_program = subject_.after_frame;  // compiling is no hang
            watch.begin(frame);
            sound_.drawn(frame);
            const auto& fault = watch.first();
            if (!fault) return;
            result_.where = place_of(*fault);  // its pixel is a sample
            result_.note += fmt::format("; born at {}:{}: {}: {}", fault->file, fault->line,
                                        fault->expression, fault->what);
        } catch (const ProbeRefused&) {  // the case has failed all the same
        }
    }

    CheckSubject& subject_;
    CaseResult& result_;
    SoundRenderer sound_;
};

void run_sound_case(Check& check, CaseResult& result) {
    const CaseClock clock(check);
    Ear ear(check, result);
    long index = 0;
    for (; index <= block_at(kHeard) && !clock.is_over(0.05); ++index)
        if (!ear.hears(index, check.subject.opened().values)) return;
    result.note =
        fmt::format("{:.0f} s", static_cast<double>(index * SoundRenderer::kBlock) / kSampleRate);
    for (const double moment : kMoments)
        for (const auto& values : values_to_hear(check.subject)) {
            if (clock.is_over(0.05)) return;
            if (!ear.hears(block_at(moment), values)) return;
        }
    result.note += ", and moments of 12 hours at the ends of all ranges";
}

}  // namespace

void add_sound_case(std::vector<Case>& list, const CheckSubject& subject) {
    if (subject.scene().has_sound)
        list.push_back({.name = "sound", .run = run_sound_case, .shows = false});
}

}  // namespace glint
