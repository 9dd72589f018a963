// Whether every sample of a scene's sound is a number, and one that all drivers give. What is none
// is silence in a file, and whatever the driver likes in a browser.
#include "measure/check/budget.h"
#include "measure/check/case.h"
#include "measure/check/situation.h"
#include "measure/check/unset.h"
#include "measure/probe/faults.h"
#include "measure/probe/loop_turns.h"
#include "offline/sound.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace glint {
namespace {

constexpr double kHeard = 20.0;  // s from the start, with the preset's values
// s, of which a fifth of a second each is heard at other values; `samp` ends after 13 h.
constexpr double kMoments[] = {0.0, 1.0, 2.37, 7.71, 60.0, 3600.0, 43200.0};
constexpr std::size_t kEnds = 16;     // sets of tweaks
constexpr int kHeardSpread = 8;       // points within all ranges
constexpr double kHeardShare = 0.05;  // of the seconds

long block_at(double seconds) {
    return static_cast<long>(seconds * kSampleRate) / SoundRenderer::kBlock;
}

class Ear {
public:
    Ear(Check& check, CaseResult& result)
        : subject_(check.subject),
          result_(result),
          sound_(subject_.opened(), {.specialise = false}) {
        const ProgramOptions by_uniforms{.specialise = false};
        try {
            survey_.emplace(subject_.opened(), sound_.renderer(), by_uniforms);
        } catch (const ProbeRefused&) {  // then samples alone tell
        }
        answered();
        try {
            if (ends_loops(check.subject.context()))
                turns_.emplace(subject_.opened(), sound_.renderer(), by_uniforms,
                               subject_.after_frame);
        } catch (const ProbeRefused&) {
        }
    }

    // False once a sample was no number.
    bool hears(long index, const Situation& situation) {
        const Frame frame = sound_.frame_of(index);
        const std::vector<float> rgba = drawn(sound_, index, situation);
        for (std::size_t i = 0; i < rgba.size(); i += 4) {
            const bool left = !std::isfinite(rgba[i]);
            if (!left && std::isfinite(rgba[i + 1])) continue;
            const long sample = index * SoundRenderer::kBlock + static_cast<long>(i / 4);
            result_.fail(fmt::format("{} in the {} channel at {:.5f} s, sample {}{}",
                                     std::isnan(rgba[i + (left ? 0 : 1)]) ? "NaN" : "Inf",
                                     left ? "left" : "right",
                                     static_cast<double>(sample) / kSampleRate, sample,
                                     where_words(situation, subject_)));
            count(rgba);
            find_birth(frame);
            return false;
        }
        return true;
    }

    // Whether all of this block is what any driver gives, though all its samples are numbers.
    bool is_sure_of(long index, const Situation& situation) {
        if (!survey_) return true;
        const Frame frame = sound_.frame_of(index);
        survey_->begin(frame, false);
        drawn(sound_, index, situation);
        survey_->end();
        const auto& fault = survey_->fault();
        if (!fault) return ends_its_loops(index, situation);
        const long sample = index * SoundRenderer::kBlock + fault->pixel.x +
                            long{fault->pixel.y} * kSoundBlockWidth;
        result_.where = place_of(*fault);
        result_.fail(fmt::format("{}:{}: in {}: {} is undefined, {}; at {:.3f} s{}", fault->file,
                                 fault->line, fault->function, fault->expression, fault->what,
                                 static_cast<double>(sample) / kSampleRate,
                                 where_words(situation, subject_)));
        return false;
    }

    // Whether the driver does not do so instead, silently.
    bool ends_its_loops(long index, const Situation& situation) {
        if (!turns_) return true;
        turns_->forget();
        turns_->count(sound_.frame_of(index), [&] { drawn(sound_, index, situation); });
        if (!turns_->is_cut()) return true;
        result_.fail(fmt::format(
            "loops use all {} turns that llvmpipe has for a sample, then end "
            "silently; take fewer of them; at {:.3f} s{}",
            kLoopBudget, static_cast<double>(index * SoundRenderer::kBlock) / kSampleRate,
            where_words(situation, subject_)));
        return false;
    }

    // Whether it counts on nothing that is unset: in the first block of these situations, and with
    // the first of them in all blocks that are heard.
    bool sets_all(const std::vector<Situation>& all, long heard) {
        const std::vector<Unset> list = unset_values(subject_.opened(), sound_.renderer(), false);
        const auto shows = [&](Span range, FirstValue mark) {
            SoundRenderer marked(subject_.opened(),
                                 {.specialise = false, .marked = Marked{range, mark}});
            answered();
            sound_.renderer().reset();  // what its buffers keep begins alike
            const auto is_other = [&](long index, const Situation& one) {
                return drawn(marked, index, one) != drawn(sound_, index, one);
            };
            for (long index = 1; index < heard; ++index)
                if (is_other(index, all.front())) return true;
            return std::ranges::any_of(all, [&](const Situation& one) { return is_other(0, one); });
        };
        const auto mark = std::ranges::find_if(kMarks, [&](FirstValue value) {
            return !list.empty() && shows({0, subject_.scene().text.size()}, value);
        });
        if (mark == std::end(kMarks)) return true;
        const Unset& first =
            first_that_shows(list, [&](Span range) { return shows(range, *mark); });
        result_.fail(words_of(subject_.scene(), first));
        return false;
    }

private:
    // The samples, left and right, that are no numbers.
    void count(const std::vector<float>& rgba) {
        for (std::size_t i = 0; i < rgba.size(); ++i) {
            if (i % 4 > 1) continue;
            result_.nan += std::isnan(rgba[i]) ? 1 : 0;
            result_.infinite += std::isinf(rgba[i]) ? 1 : 0;
        }
    }

    void answered() const {  // what compiles, or draws, is no hang
        if (subject_.after_frame) subject_.after_frame();
    }

    std::vector<float> drawn(SoundRenderer& sound, long index, const Situation& situation) const {
        sound.renderer().set_values(situation.values);
        std::vector<float> rgba = sound.drawn(sound.frame_of(index));
        answered();
        return rgba;
    }

    // The operation at which it came about, where the probe can tell.
    void find_birth(const Frame& frame) {
        try {
            FaultWatch watch(subject_.opened(), sound_.renderer(), {.specialise = false});
            watch.after_program = subject_.after_frame;
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
    std::optional<FaultSurvey> survey_;
    std::optional<LoopTurns> turns_;
};

void run_sound_case(Check& check, CaseResult& result) {
    const CaseClock clock(check);
    Ear ear(check, result);
    const std::vector<Situation> all = situations(check.subject, kEnds, kHeardSpread);
    if (!ear.ends_its_loops(0, all.front())) return;
    long index = 0;
    for (; index <= block_at(kHeard) && (index == 0 || !clock.is_over(kHeardShare)); ++index)
        if (!ear.hears(index, all.front())) return;
    result.note =
        fmt::format("{:.0f} s", static_cast<double>(index * SoundRenderer::kBlock) / kSampleRate);
    const long heard = index;
    if (!ear.sets_all(all, heard)) return;
    for (index = 1; index < heard && !clock.is_over(kHeardShare); ++index)
        if (!ear.is_sure_of(index, all.front())) return;
    for (const double moment : kMoments)
        for (const Situation& one : all) {
            if (clock.is_over(kHeardShare)) return;
            if (!ear.hears(block_at(moment), one) || !ear.is_sure_of(block_at(moment), one)) return;
        }
    result.note += ", and moments of 12 hours with other values";
}

}  // namespace

void add_sound_case(std::vector<Case>& list, const CheckSubject& subject) {
    if (subject.scene().has_sound)
        list.push_back(
            {.name = "sound",
             .run = run_sound_case,
             .tweaks = subject.scene().tweaks.empty() ? Case::Tweaks::none : Case::Tweaks::all,
             .shows = false});
}

}  // namespace glint
