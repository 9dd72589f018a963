// The texture of a sound against the Web Audio specification, computed anew in double precision.
#include "media/analyser.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>

namespace glint::analyser_test {
namespace {

constexpr long kBlock = 735;  // 1/60 s

Sound tone(double hz, double amplitude, double seconds) {
    Sound sound;
    for (long i = 0; i < std::lround(seconds * kSoundRate); ++i) {
        const double value =
            amplitude * std::sin(2 * std::numbers::pi * hz * static_cast<double>(i) / kSoundRate);
        const auto sample = static_cast<std::int16_t>(std::lround(value * 32767));
        sound.samples.insert(sound.samples.end(), {sample, sample});
    }
    return sound;
}

std::vector<int> rows(Analyser& analyser, double time) {
    std::vector<int> bytes;
    for (const std::byte byte : analyser.rows_at(time)) bytes.push_back(std::to_integer<int>(byte));
    return bytes;
}

double value_at(const Sound& sound, long i) {
    if (i < 0) return 0.0;
    const auto at = static_cast<std::size_t>(i % sound.count()) * 2;
    return (sound.samples[at] + sound.samples[at + 1]) / 65536.0;
}

// One bin of one block, by the definition of the Fourier transform.
double magnitude(const Sound& sound, long block, int bin) {
    std::complex<double> sum = 0.0;
    for (int n = 0; n < 2048; ++n) {
        const double x = 2 * std::numbers::pi * n / 2048;
        const double window = 0.42 - 0.5 * std::cos(x) + 0.08 * std::cos(2 * x);
        sum += window * value_at(sound, block * kBlock - 2048 + n) * std::polar(1.0, -x * bin);
    }
    return std::abs(sum) / 2048;
}

int spectrum_byte(const Sound& sound, long block, int bin) {
    double smooth = 0.0;
    for (long k = 0; k <= block; ++k) smooth = 0.8 * smooth + 0.2 * magnitude(sound, k, bin);
    return static_cast<int>(
        std::clamp(std::floor(255.0 / 70.0 * (20 * std::log10(smooth) + 100)), 0.0, 255.0));
}

TEST(Analyser, TheSpectrumIsThatOfTheSpecification) {
    const Sound sound = tone(1000.0, 0.1, 2.0);
    Analyser analyser(sound);
    for (const long block : {1, 7, 30}) {
        const std::vector<int> bytes = rows(analyser, static_cast<double>(block) / 60.0);
        // 1000 Hz lies between the bins 46 and 47; bin 500 holds rounding alone, and is 0.
        for (const int bin : {0, 20, 40, 45, 46, 47, 50, 300, 500}) {
            EXPECT_NEAR(bytes[static_cast<std::size_t>(bin)], spectrum_byte(sound, block, bin), 1)
                << "bin " << bin << ", block " << block << "; float may round across a whole byte";
        }
    }
    const std::vector<int> bytes = rows(analyser, 1.0);
    const auto loudest = std::max_element(bytes.begin(), bytes.begin() + 512) - bytes.begin();
    EXPECT_TRUE(loudest == 46 || loudest == 47) << loudest;
}

TEST(Analyser, TheWaveIsTheOldestQuarterOfTheSamplesOfTheSpectrum) {
    Sound sound;
    for (long i = 0; i < 44100; ++i) {
        sound.samples.push_back(static_cast<std::int16_t>(i % 20000));
        sound.samples.push_back(static_cast<std::int16_t>(i % 20000));
    }
    Analyser analyser(sound);
    const std::vector<int> bytes = rows(analyser, 20.0 / 60);
    for (int i = 0; i < 512; ++i) {
        const long sample = 20 * kBlock - 2048 + i;
        const double wanted = std::floor(128.0 * (1.0 + static_cast<double>(sample) / 32768.0));
        EXPECT_EQ(bytes[static_cast<std::size_t>(512 + i)], wanted) << i;
    }
    EXPECT_EQ(rows(analyser, 0.0)[512], 128) << "silence before the start";
}

TEST(Analyser, ATimeHasOneTextureWhateverWasAskedBefore) {
    Sound sound = tone(440.0, 0.5, 3.0);
    Analyser walks(sound);
    for (int k = 0; k < 150; ++k) rows(walks, k / 60.0);
    Analyser jumps(sound);
    rows(jumps, 2.9);
    EXPECT_EQ(rows(walks, 2.5), rows(jumps, 2.5));
    EXPECT_EQ(rows(walks, 2.5), rows(walks, 2.5 + 0.9 / 60)) << "the same block";
    EXPECT_EQ(rows(walks, 0.1), rows(jumps, 0.1)) << "backwards";
    EXPECT_EQ(rows(walks, 7.0 / 60), rows(walks, 7.0 / 60 + 1e-9));
}

TEST(Analyser, ItBeginsAnewAtItsEndAndFadesNotBeyond) {
    // A second of tone, a second of silence.
    Sound sound = tone(1000.0, 0.5, 1.0);
    sound.samples.resize(4 * kSoundRate, 0);
    Analyser analyser(sound);
    EXPECT_EQ(analyser.seconds(), 2.0);
    EXPECT_GT(rows(analyser, 0.9)[46], 200);
    EXPECT_LT(rows(analyser, 1.5)[46], rows(analyser, 1.1)[46]);
    EXPECT_EQ(rows(analyser, 1.999)[46], 0);
    EXPECT_EQ(rows(analyser, 2.9), rows(analyser, 4.9));
}

TEST(Analyser, ARoundIsLikeTheNextOneOnceItHasSettled) {
    Analyser analyser(tone(500.0, 0.3, 0.7123));  // no whole number of blocks
    const auto rows_of = [&](long block) {
        const auto bytes = analyser.rows_of(block);
        return std::vector<std::byte>(bytes.begin(), bytes.end());
    };
    ASSERT_EQ(analyser.round(), 43);
    const long settled = analyser.settled();
    EXPECT_EQ(rows_of(settled), rows_of(settled + 43));
    EXPECT_EQ(rows_of(settled + 40), rows_of(settled + 40 + 5 * 43));
    EXPECT_NE(rows_of(0), rows_of(43)) << "silence came before the start";
    EXPECT_EQ(rows(analyser, 0.7123 + 1e-9), rows(analyser, 0.7123 + 1.0 / 60.0 - 1e-5));
}

// A time and the length of a sound are rounded apart.
TEST(Analyser, EachRoundOfATenthOfASecondIsTheSame) {
    Sound sound = tone(500.0, 0.3, 0.1);
    for (std::size_t i = 0; i < 2 * 2600; ++i)
        sound.samples[i] = 0;  // its end is another than its start
    Analyser analyser(sound);
    const std::vector<int> settled = rows(analyser, 10.0);
    for (int round = 101; round < 160; ++round)
        EXPECT_EQ(rows(analyser, round * 6 / 60.0), settled) << round;
}

}  // namespace
}  // namespace glint::analyser_test
