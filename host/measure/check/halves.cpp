// What is fed back in floats of 16 bits, or in bytes: what is added in small parts is lost, or too
// much of it.
#include "measure/check/budget.h"
#include "measure/check/case.h"
#include "measure/check/poison.h"
#include "measure/check/to_and_fro.h"
#include "measure/rows/difference.h"

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace glint {
namespace {

constexpr int kHalvesPlayed = 1800, kHalvesApart = 60;  // at 60 Hz, and from look to look
constexpr double kHalvesShare = 0.1;                    // of the seconds
// What the picture and the buffers are off by, look after look: 2 % of white and 1 % of what is
// kept, root mean square. An edge that one rounding moves by a pixel is neither for long.
constexpr double kHalvesPsnr = 34.0, kHalvesState = 0.01;  // dB, a share
constexpr int kLooksInARow = 2;
// One rounding of the whole state is worth far less than one in each frame, but where the scene is
// chaotic, and no digits would be enough.
constexpr int kRoundedAfter = 6;  // frames
constexpr double kRounded = 2.0;

int bytes_of(const CheckSubject& subject, std::size_t graph_index) {
    const std::size_t pass = subject.renderer().graph().passes[graph_index].pass;
    return bytes_a_channel(subject.scene().passes[pass].format);
}

bool is_fed_back_in_few_bits(const CheckSubject& subject, std::size_t graph_index) {
    const bool is_image = subject.renderer().graph().passes[graph_index].pass == kImagePass;
    return !is_image && subject.is_fed_back(graph_index) && bytes_of(subject, graph_index) < 4;
}

float to_half(float value) {
    return glm::unpackHalf1x16(glm::packHalf1x16(value));
}

float to_byte(float value) {
    return std::round(255.0f * std::clamp(value, 0.0f, 1.0f)) / 255.0f;
}

// What these buffers hold, one after the other.
std::vector<float> state_of(const CheckSubject& subject, const std::vector<std::size_t>& buffers) {
    std::vector<float> state;
    for (const std::size_t index : buffers)
        for (int output = 0; output < subject.renderer().buffer(index).shape().outputs; ++output) {
            const auto values =
                subject.renderer().read_buffer(index, static_cast<std::size_t>(output));
            state.insert(state.end(), values.begin(), values.end());
        }
    return state;
}

// How far a subject is from one with more bits at the same time.
struct Off {
    double psnr = 0.0;   // dB, of the picture
    double state = 0.0;  // of what is kept, as a share of it
};

Off off(const CheckSubject& subject, const CheckSubject& wide,
        const std::vector<std::size_t>& buffers) {
    const std::vector<float> kept = state_of(wide, buffers);
    return {difference(subject.picture(), wide.picture()).psnr,
            distance(state_of(subject, buffers), kept) / std::max(distance(kept, {}), 1e-12)};
}

// What one rounding soon after the start makes of the state after so many frames.
double off_by_one_rounding(Check& check, const std::vector<std::size_t>& buffers,
                           const std::vector<float>& kept, int frames) {
    CheckSubject& wide = wide_of(check);
    if (!wide.play_frames(0, kRoundedAfter, 60.0)) return 0.0;
    for (const std::size_t index : buffers)
        change_values(wide, index, bytes_of(check.subject, index) == 1 ? to_byte : to_half);
    if (!wide.play_frames(kRoundedAfter, frames, 60.0)) return 0.0;
    return distance(state_of(wide, buffers), kept) / std::max(distance(kept, {}), 1e-12);
}

void run_halves(Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    CheckSubject& wide = wide_of(check);
    const CaseClock clock(check);
    std::vector<std::size_t> buffers;
    for (std::size_t i = 0; i < subject.renderer().graph().passes.size(); ++i)
        if (is_fed_back_in_few_bits(subject, i)) buffers.push_back(i);
    const bool any_halves = std::ranges::any_of(
        buffers, [&](std::size_t index) { return bytes_of(subject, index) == 2; });
    const char* finer = any_halves ? "floats of 32 bits" : "16 bits a channel";
    int in_a_row = 0;
    for (int end = kHalvesApart; end <= kHalvesPlayed && !clock.is_over(kHalvesShare);
         end += kHalvesApart) {
        if (!wide.play_frames(end - kHalvesApart, end, 60.0)) return;  // which other cases tell of
        if (!subject.play_frames(end - kHalvesApart, end, 60.0)) return;
        const Off found = off(subject, wide, buffers);
        result.note = fmt::format("{:.1f} dB beside {} after {} s, the buffers {:.2g} % off",
                                  found.psnr, finer, end / 60, 100.0 * found.state);
        in_a_row = found.psnr < kHalvesPsnr && found.state > kHalvesState ? in_a_row + 1 : 0;
        if (in_a_row < kLooksInARow) continue;
        const std::vector<float> kept = state_of(wide, buffers);
        if (off_by_one_rounding(check, buffers, kept, end) * kRounded > found.state) {
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
        if (!is_fed_back_in_few_bits(subject, i)) continue;
        list.push_back({"buffers of rgba32f", run_halves});
        return;
    }
}

}  // namespace glint
