// What the host may do to a scene: poison a texel, keep buffers at half the precision, feed tweaks
// as uniforms.
#include "gl/resample.h"
#include "measure/check/case.h"
#include "measure/check/poison.h"
#include "measure/rows/difference.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>

namespace glint {
namespace {

constexpr int kFramesBefore = 30, kFramesToHeal = 2;
constexpr double kBuffersPlayed = 2.0;  // s of a simulation, drawn in another way

struct Poison {
    const char* name;
    float value;
};
constexpr Poison kPoisons[] = {{"NaN", std::numeric_limits<float>::quiet_NaN()},
                               {"Inf", std::numeric_limits<float>::infinity()},
                               {"1e30", 1e30f}};

// Frames at 60 Hz, or at the pass's own step where that is longer.
double frames_a_second(const CheckSubject& subject, std::size_t index) {
    const Step step = subject.scene().passes[subject.renderer().graph().passes[index].pass].step;
    return step ? std::min(60.0, 1.0 / step.seconds()) : 60.0;
}

void run_poison(std::size_t index, const Poison& kind, Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    const double fps = frames_a_second(subject, index);
    if (!subject.play_frames(0, kFramesBefore, fps)) return;
    const float before = subject.largest_state();
    const Buffer& buffer = subject.renderer().buffer(index);
    for (const glm::ivec2 texel : texels_to_poison(subject, index, check.effort.inject)) {
        poison(buffer, texel, kind.value);
    }
    const Playback endless{.end = 1e6, .fps = fps};
    for (int k = 1; k < kFramesToHeal; ++k) {
        subject.draw_blindly(endless.frame(subject.preset, kFramesBefore + k - 1));
    }
    subject.still.reset();
    const bool finite =
        subject.draw(endless.frame(subject.preset, kFramesBefore + kFramesToHeal - 1));
    const float after = subject.largest_state();
    if (!finite) {
        result.note = fmt::format("not gone after {} frames", kFramesToHeal);
    } else if (after > std::max(kLargestHalf, 10.0f * before)) {
        result.fail(fmt::format("not gone after {} frames: the state is at {:.3g}, {:.3g} before",
                                kFramesToHeal, after, before));
    }
}

// How far the picture is when the host draws the scene in another way: told, not judged. With
// uniforms, too, since a silhouette may flip by a rounding; but NaN is NaN.
void run_other(const SubjectOptions& options, Check& check, CaseResult& result) {
    CheckSubject& subject = check.subject;
    result.verdict = CaseVerdict::report;
    CheckSubject other(subject.view(), subject.opened(), subject.context(), options);
    other.after_frame = subject.after_frame;
    // One of the two may have a state and play for a while only: both are seen at that time.
    const bool any_state = subject.stateful() || other.stateful();
    const double time = any_state ? kBuffersPlayed : subject.preset.time;
    if (!subject.show(time, kBuffersPlayed)) return;
    const std::vector<float> usual = subject.picture();
    const bool finite = other.show(time, kBuffersPlayed);
    const Difference found = difference(other.picture(), usual);
    result.note = fmt::format("{:.1f} dB, {:.2f} % of pixels off by more than 1/255{}", found.psnr,
                              100.0 * found.share_off,
                              finite ? "" : "; NaN or Inf in " + other.observed().found[0].output);
    const Observed& seen = other.observed();
    if (!seen.at_largest_half.empty())
        result.note +=
            "; values reach 65504, the largest that 16 bits have, beyond which some "
            "drivers have Inf";
    if (!finite && !options.specialise) result.fail(result.note);
}

}  // namespace

std::vector<glm::ivec2> texels_to_poison(const CheckSubject& subject, std::size_t index,
                                         int count) {
    const glm::ivec2 size = subject.renderer().buffer(index).shape().size;
    const std::vector<float> values = subject.renderer().read_buffer(index, 0);
    const auto largest = std::ranges::max_element(
        values, [](float a, float b) { return std::abs(a) < std::abs(b); });
    const auto at = static_cast<int>(largest - values.begin()) / 4;
    const int row = static_cast<int>(values.size()) / 4 / size.y;
    std::vector<glm::ivec2> texels = {{0, 0}, {at % row % size.x, at / row}, size / 2};
    std::mt19937 random(1);
    while (texels.size() < static_cast<std::size_t>(count)) {
        texels.emplace_back(random() % static_cast<unsigned>(size.x),
                            random() % static_cast<unsigned>(size.y));
    }
    texels.resize(static_cast<std::size_t>(count));
    return texels;
}

void poison(const Buffer& buffer, glm::ivec2 texel, float value) {
    const std::array<float, 4> rgba = {value, value, value, value};
    for (int output = 0; output < buffer.shape().outputs; ++output) {
        const GLuint texture = buffer.texture(static_cast<std::size_t>(output));
        if (buffer.shape().cube) {
            glTextureSubImage3D(texture, 0, texel.x, texel.y, 0, 1, 1, 1, GL_RGBA, GL_FLOAT,
                                rgba.data());
        } else {
            glTextureSubImage2D(texture, 0, texel.x, texel.y, 1, 1, GL_RGBA, GL_FLOAT, rgba.data());
        }
        if (buffer.shape().mipmaps) make_mipmaps(texture);
    }
}

void exchange(const CheckSubject& subject, std::size_t index, const std::vector<glm::ivec2>& texels,
              int round, int times) {
    const Buffer& buffer = subject.renderer().buffer(index);
    const glm::ivec2 size = buffer.shape().size, away = glm::max(times * size / 4, glm::ivec2(1));
    for (std::size_t output = 0; output < static_cast<std::size_t>(buffer.shape().outputs);
         ++output) {
        const std::vector<float> values = subject.renderer().read_buffer(index, output);
        const GLuint texture = buffer.texture(output);
        const auto put = [&](glm::ivec2 at) {
            const glm::ivec2 from = (at + away) % size;
            const auto first = 4 * static_cast<std::size_t>(from.x + from.y * size.x);
            glTextureSubImage2D(texture, 0, at.x, at.y, 1, 1, GL_RGBA, GL_FLOAT, &values[first]);
        };
        for (const glm::ivec2 texel : texels)
            for (int y = texel.y - round; y <= texel.y + round; ++y)
                for (int x = texel.x - round; x <= texel.x + round; ++x)
                    put((glm::ivec2(x, y) + round * size) % size);
        if (buffer.shape().mipmaps) make_mipmaps(texture);
    }
}

void put_values(const CheckSubject& subject, std::size_t index, std::size_t output,
                const std::vector<float>& values) {
    const Buffer& buffer = subject.renderer().buffer(index);
    const glm::ivec2 size = buffer.shape().size;
    const GLuint texture = buffer.texture(output);
    glTextureSubImage2D(texture, 0, 0, 0, size.x, size.y, GL_RGBA, GL_FLOAT, values.data());
    if (buffer.shape().mipmaps) make_mipmaps(texture);
}

void change_values(const CheckSubject& subject, std::size_t index, float (*changed)(float)) {
    const Buffer& buffer = subject.renderer().buffer(index);
    if (buffer.shape().cube) return;
    for (std::size_t output = 0; output < static_cast<std::size_t>(buffer.shape().outputs);
         ++output) {
        std::vector<float> values = subject.renderer().read_buffer(index, output);
        std::ranges::transform(values, values.begin(), changed);
        put_values(subject, index, output, values);
    }
}

void add_poison_cases(std::vector<Case>& list, const CheckSubject& subject, const Effort& effort) {
    if (effort.inject == 0) return;
    const auto& passes = subject.renderer().graph().passes;
    for (std::size_t i = 0; i < passes.size(); ++i) {
        const PixelFormat format = subject.renderer().buffer(i).shape().format;
        if (!subject.is_fed_back(i) || bytes_a_channel(format) == 1) continue;
        for (const Poison& kind : kPoisons) {
            // Half floats end at 65504.
            if (bytes_a_channel(format) == 2 && kind.value == 1e30f) continue;
            list.push_back(
                {fmt::format("{} in {}", kind.name, pass_name(subject.scene(), passes[i].pass)),
                 [i, &kind](Check& check, CaseResult& result) {
                     run_poison(i, kind, check, result);
                 }});
        }
    }
}

void add_other_cases(std::vector<Case>& list, const CheckSubject& subject) {
    const auto& passes = subject.renderer().graph().passes;
    const bool any = std::ranges::any_of(passes, [&](const GraphPass& pass) {
        return pass.pass != kImagePass &&
               bytes_a_channel(subject.scene().passes[pass.pass].format) == 4;
    });
    if (any) {
        list.push_back({"buffers of rgba16f", [](Check& check, CaseResult& result) {
                            run_other({.float_bytes = 2}, check, result);
                        }});
    }
    if (!subject.scene().tweaks.empty()) {
        list.push_back({"tweaks as uniforms", [](Check& check, CaseResult& result) {
                            run_other({.specialise = false}, check, result);
                        }});
    }
}

}  // namespace glint
