// The Fourier transform behind a spectrum.
#pragma once

#include <span>

namespace glint {

constexpr int kSpectrumSize = 2048;  // samples
constexpr int kSpectrumBins = 512;   // of the 1024; up to 11 kHz

// The lower magnitudes of the spectrum, each divided by the number of samples. Throws
// std::runtime_error when the library does not load.
void spectrum(std::span<const float, kSpectrumSize> values,
              std::span<float, kSpectrumBins> magnitudes);

}  // namespace glint
