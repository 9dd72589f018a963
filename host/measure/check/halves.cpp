// What is fed back in floats of 16 bits: what is added in small parts is lost, or too much of it.
#include "measure/check/budget.h"
#include "measure/check/case.h"
#include "measure/check/poison.h"
#include "measure/rows/difference.h"

#include <fmt/format.h>

#include <optional>

namespace glint {
namespace {

constexpr int kHalvesPlayed = 1800, kHalvesApart = 60;  // at 60 Hz, and from look to look
constexpr int kRoundedAfter = 6;
constexpr double kHalvesShare = 0.1;
constexpr double kHalvesPsnr = 34.0;  // dB: 2 % of white, root mean square
// One rounding of the whole state is worth far less than one in each frame, but where the scene is
// chaotic, and no digits would be enough.
constexpr double kRoundedPsnr = 6.0;  // dB: twice

bool is_fed_back_in_halves(const CheckSubject& subject, std::size_t graph_index) {
    return subject.is_fed_back(graph_index) &&
           bytes_a_channel(subject.renderer().buffer(graph_index).shape().format) == 2;
}

// How far the pictures of the two are after so many frames; nothing where one is not finite.
std::optional<double> psnr_at(CheckSubject& subject, const std::vector<float>& wide, int first,
                              int end) {
    if (!subject.play_frames(first, end, 60.0)) return std::nullopt;
    return difference(subject.picture(), wide).psnr;
}

// What one rounding soon after the start makes of the picture after so many frames.
double psnr_of_one_rounding(Check& check, const std::vector<std::size_t>& buffers,
                            const std::vector<float>& picture, int frames) {
    CheckSubject& wide = wide_of(check);
    if (!wide.play_frames(0, kRoundedAfter, 60.0)) return 0.0;
    for (const std::size_t index : buffers) round_to_halves(wide, index);
    return psnr_at(wide, picture, kRoundedAfter, frames).value_or(0.0);
}

void run_halves(Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    CheckSubject& wide = wide_of(check);
    const CaseClock clock(check);
    std::vector<std::size_t> buffers;
    for (std::size_t i = 0; i < subject.renderer().graph().passes.size(); ++i)
        if (is_fed_back_in_halves(subject, i)) buffers.push_back(i);
    double psnr = 0.0;
    for (int end = kHalvesApart; end <= kHalvesPlayed && !clock.is_over(kHalvesShare);
         end += kHalvesApart) {
        if (!wide.play_frames(end - kHalvesApart, end, 60.0)) return;  // which other cases tell of
        const std::vector<float> picture = wide.picture();
        const auto found = psnr_at(subject, picture, end - kHalvesApart, end);
        if (!found) return;
        psnr = *found;
        result.note = fmt::format("{:.1f} dB beside floats of 32 bits after {} s", psnr, end / 60);
        if (psnr >= kHalvesPsnr) continue;
        if (psnr_of_one_rounding(check, buffers, picture, end) < psnr + kRoundedPsnr) {
            result.note += "; one rounding does as much, it is chaotic";
            return;
        }
        const std::size_t pass = subject.renderer().graph().passes[buffers.front()].pass;
        return result.fail(
            fmt::format("{}: {} rounds in each frame what it adds to; ask for format={}",
                        result.note, pass_name(subject.scene(), pass),
                        name_of(with_channel_bytes(subject.scene().passes[pass].format, 4))));
    }
}

}  // namespace

void add_halves_case(std::vector<Case>& list, const CheckSubject& subject) {
    for (std::size_t i = 0; i < subject.renderer().graph().passes.size(); ++i) {
        if (!is_fed_back_in_halves(subject, i)) continue;
        list.push_back({"buffers of rgba32f", run_halves});
        return;
    }
}

}  // namespace glint
