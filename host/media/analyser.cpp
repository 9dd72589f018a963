#include "media/analyser.h"

#include "base/loop_place.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace glint {
namespace {

constexpr double kBlockRate = 60.0;              // Hz
constexpr long kBlockSamples = kSoundRate / 60;  // exactly
constexpr float kSmoothing = 0.8f;
constexpr float kQuietest = -100.0f, kLoudest = -30.0f;  // dB; 0 and 255
// 0.8^64 is -124 dB: what lies further back is below the quietest byte.
constexpr long kRemembered = 64;  // blocks

// Blackman's window with alpha = 0.16.
float window(int i) {
    const double x = 2.0 * std::numbers::pi * i / kSpectrumSize;
    return static_cast<float>(0.42 - 0.5 * std::cos(x) + 0.08 * std::cos(2.0 * x));
}

std::byte to_byte(float value) {
    return static_cast<std::byte>(std::clamp(std::floor(value), 0.0f, 255.0f));
}

std::byte spectrum_byte(float magnitude) {
    if (!(magnitude > 0.0f)) return std::byte{0};
    const float decibels = 20.0f * std::log10(magnitude);
    return to_byte(255.0f / (kLoudest - kQuietest) * (decibels - kQuietest));
}

}  // namespace

Analyser::Analyser(Sound sound) : sound_(std::move(sound)), known_(kRemembered) {}

long Analyser::round() const {
    return std::max(static_cast<long>(std::ceil(seconds() * kBlockRate - 1e-6)), 1L);
}

// A spectrum remembers so many blocks, and the first of these the samples before it.
long Analyser::settled() const {
    return kRemembered + kSpectrumSize / kBlockSamples + 1;
}

// A sample of the spectrum of a block, from the oldest one on: silence before the start, the end of
// the sound before each other round.
float Analyser::heard(long block, long sample) const {
    const long index = block % round() * kBlockSamples - kSpectrumSize + sample;
    if (index < 0 && block < round()) return 0.0f;
    const long count = sound_.count();
    const auto at = static_cast<std::size_t>((index % count + count) % count) * 2;
    return static_cast<float>(sound_.samples[at] + sound_.samples[at + 1]) / 65536.0f;
}

// Of the samples that have been heard when a block begins.
const Analyser::Magnitudes& Analyser::magnitudes(long block) {
    Known& known = known_[static_cast<std::size_t>(block % kRemembered)];
    if (known.block == block) return known.magnitudes;
    static const auto kWindow = [] {
        std::array<float, kSpectrumSize> values;
        for (int i = 0; i < kSpectrumSize; ++i) values[static_cast<std::size_t>(i)] = window(i);
        return values;
    }();
    std::array<float, kSpectrumSize> values;
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = kWindow[i] * heard(block, static_cast<long>(i));
    spectrum(values, known.magnitudes);
    known.block = block;
    return known.magnitudes;
}

std::span<const std::byte> Analyser::rows_at(double time) {
    time = std::max(time, 0.0);
    const LoopPlace place = place_in_loop(time, seconds());
    // The tolerance forgives times such as 7/60 s, which lie a rounding below a whole block.
    const auto block = static_cast<long>(std::floor(place.into * kBlockRate + 1e-6));
    return rows_of(static_cast<long>(place.rounds) * round() + std::min(block, round() - 1));
}

std::span<const std::byte> Analyser::rows_of(long block) {
    Magnitudes smooth{};
    for (long k = std::max(block - kRemembered + 1, 0L); k <= block; ++k) {
        const Magnitudes& now = magnitudes(k);
        for (std::size_t i = 0; i < smooth.size(); ++i)
            smooth[i] = kSmoothing * smooth[i] + (1.0f - kSmoothing) * now[i];
    }
    for (std::size_t i = 0; i < kSpectrumBins; ++i) {
        rows_[i] = spectrum_byte(smooth[i]);
        // The first 512 of the samples that the spectrum is of, as on the site.
        rows_[kSpectrumBins + i] = to_byte(128.0f * (1.0f + heard(block, static_cast<long>(i))));
    }
    return rows_;
}

}  // namespace glint
