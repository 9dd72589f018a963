// What a shader is told of a sound: the texture of 512x2 bytes that the site makes of a browser's
// AnalyserNode, here as a function of time alone.
#pragma once

#include "media/sound.h"
#include "media/spectrum.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace glint {

// Web Audio API (W3C 2021), AnalyserNode, with its defaults: Blackman window, smoothing over time,
// decibels to bytes. A browser smooths over the frames that it happens to draw; here the frames are
// those of 60 Hz, whichever are drawn, so that a picture at a time has one texture only.
class Analyser {
public:
    // It plays from time 0 on, again and again; each round begins with a block.
    explicit Analyser(Sound sound);

    double seconds() const { return sound_.seconds(); }

    // The row of the spectrum (bin k is k * 44100 / 2048 Hz), then the row of the wave. Valid until
    // the next call.
    std::span<const std::byte> rows_at(double time);

    // The same by the number of the block, of 1/60 s, all rounds counted on. After settled() blocks
    // those of a round are the same as those of the next one.
    std::span<const std::byte> rows_of(long block);
    long round() const;  // blocks
    long settled() const;

private:
    using Magnitudes = std::array<float, kSpectrumBins>;

    float heard(long block, long sample) const;
    const Magnitudes& magnitudes(long block);

    Sound sound_;
    // Of the last blocks, each at its number modulo the length.
    struct Known {
        long block = -1;
        Magnitudes magnitudes{};
    };
    std::vector<Known> known_;
    std::array<std::byte, 2 * kSpectrumBins> rows_{};
};

}  // namespace glint
