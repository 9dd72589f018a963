// What 16-bit floats cannot hold. llvmpipe keeps their largest number instead, and the picture may
// look right; other drivers keep Inf, from which NaN comes.
#include "measure/check/case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace glint {
namespace {

constexpr float kRoundsToInf = 65520.0f;  // the least that is nearer to 2^16 than to 65504
constexpr int kMostFramesAgain = 240;

// The largest magnitude that the output is given in the frames up to the one drawn last.
float largest_given(CheckSubject& wide, const Playback& playback, std::string_view output) {
    float largest = 0.0f;
    const auto& passes = wide.renderer().graph().passes;
    for (int k = wide.stateful() ? 0 : playback.last_frame(); k <= playback.last_frame(); ++k) {
        wide.draw_blindly(playback.frame(wide.preset, k));
        for (std::size_t i = 0; i < passes.size(); ++i) {
            const auto names = output_names(wide.scene(), passes[i].pass);
            const auto named = std::ranges::find(names, output);
            if (named == names.end()) continue;
            const auto number = static_cast<std::size_t>(named - names.begin());
            for (const float value : wide.renderer().read_buffer(i, number))
                if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
        }
    }
    return largest;
}

}  // namespace

CheckSubject& wide_of(Check& check) {
    const CheckSubject& subject = check.subject;
    if (!check.wide) {
        check.wide = std::make_unique<CheckSubject>(
            subject.view(), subject.opened(), subject.context(),
            SubjectOptions{.float_bytes = 4, .specialise = subject.specialised()});
        check.wide->after_frame = subject.after_frame;
    }
    CheckSubject& wide = *check.wide;
    wide.restore();
    if (!subject.specialised()) wide.preset.values = subject.preset.values;
    wide.preset.events = subject.preset.events;
    wide.preset.date = subject.preset.date;
    wide.resize(subject.preset.size);
    return wide;
}

void judge_overflow(Check& check, CaseResult& result) {
    const CheckSubject& subject = check.subject;
    const Observed& seen = subject.observed();
    if (seen.at_largest_half.empty() || !seen.is_finite() || !subject.still) return;
    const Playback playback{.end = subject.still->time, .fps = subject.still->fps};
    if (subject.stateful() && playback.last_frame() > kMostFramesAgain) return;
    const float largest = largest_given(wide_of(check), playback, seen.at_largest_half);
    if (largest < kRoundsToInf) return;
    result.fail(fmt::format(
        "{} is given {:.6g}, and floats of 16 bits end at 65504: drivers keep that or Inf; write "
        "min(x, 65504.0), or ask for 32 bits{}",
        seen.at_largest_half, largest, result.note.empty() ? "" : "; " + result.note));
}

}  // namespace glint
