// Sounds to and from files.
#include "../base/test_folder.h"
#include "base/temporary_file.h"
#include "media/sound.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <numbers>
#include <string>

namespace glint::sound_file_test {
namespace {

namespace fs = std::filesystem;

class SoundFiles : public testing::Test {
protected:
    fs::path write(const char* name, const std::vector<std::int16_t>& samples) const {
        TemporaryFile out(folder_ / name);
        SoundWriter writer(out.descriptor(), folder_ / name);
        writer.append(samples);
        if (const int error = writer.finish()) out.fail(error);
        out.commit();
        return folder_ / name;
    }

    std::string ffmpeg(const char* from, const std::string& to) const {
        const std::string command =
            "ffmpeg -nostdin -loglevel error -i '" + (folder_ / from).string() + "' " + to;
        return std::system(command.c_str()) == 0 ? "" : command;
    }

    TestFolder made_;
    fs::path folder_ = made_.path();
};

std::vector<std::int16_t> sine(double hz, long count) {
    std::vector<std::int16_t> samples;
    for (long i = 0; i < count; ++i) {
        const double phase = 2 * std::numbers::pi * hz * static_cast<double>(i) / kSoundRate;
        samples.push_back(static_cast<std::int16_t>(std::lround(16000 * std::sin(phase))));
        samples.push_back(static_cast<std::int16_t>(std::lround(8000 * std::cos(phase))));
    }
    return samples;
}

double root_mean_square_difference(const std::vector<std::int16_t>& a,
                                   const std::vector<std::int16_t>& b, std::size_t from,
                                   std::size_t to) {
    double sum = 0.0;
    for (std::size_t i = from; i < to; ++i) sum += std::pow(static_cast<double>(a[i]) - b[i], 2.0);
    return std::sqrt(sum / static_cast<double>(to - from));
}

TEST_F(SoundFiles, WavAndFlacKeepEverySample) {
    const std::vector<std::int16_t> samples = sine(441.0, 10000);
    EXPECT_EQ(read_sound(write("a.wav", samples)).samples, samples);
    EXPECT_EQ(read_sound(write("a.flac", samples)).samples, samples);
    EXPECT_EQ(read_sound(write("a.wav", samples)).seconds(), 10000.0 / 44100);
}

TEST_F(SoundFiles, OggSoundsTheSame) {
    const std::vector<std::int16_t> samples = sine(441.0, 44100);
    const Sound sound = read_sound(write("a.ogg", samples));
    ASSERT_EQ(sound.samples.size(), samples.size());
    EXPECT_LT(root_mean_square_difference(samples, sound.samples, 4000, 80000), 300)
        << "2 % of the amplitude; Vorbis loses something";
}

TEST_F(SoundFiles, OtherRatesOtherChannelsAndMp3BecomeStereoOf44100Hz) {
    const std::vector<std::int16_t> samples = sine(441.0, 44100);
    write("a.wav", samples);
    ASSERT_EQ(ffmpeg("a.wav", "-ar 48000 '" + (folder_ / "b.wav").string() + "'"), "");
    const Sound resampled = read_sound(folder_ / "b.wav");
    ASSERT_NEAR(static_cast<double>(resampled.count()), 44100, 2);
    EXPECT_LT(root_mean_square_difference(samples, resampled.samples, 4000, 80000), 30)
        << "two resamplers in a row, each with some -60 dB at the least";

    ASSERT_EQ(ffmpeg("a.wav", "-map_channel 0.0.0 '" + (folder_ / "mono.flac").string() + "'"), "");
    const Sound mono = read_sound(folder_ / "mono.flac");
    ASSERT_EQ(mono.count(), 44100);
    EXPECT_EQ(mono.samples[2000], samples[2000]);
    EXPECT_EQ(mono.samples[2001], samples[2000]) << "the one channel, on both sides";

    ASSERT_EQ(ffmpeg("a.wav", "-b:a 192k '" + (folder_ / "a.mp3").string() + "'"), "");
    EXPECT_NEAR(read_sound(folder_ / "a.mp3").seconds(), 1.0, 0.06) << "to a frame of the codec";
}

TEST_F(SoundFiles, WhatIsNoSoundIsRefusedWithTheReason) {
    const auto refusal = [](const fs::path& file) -> std::string {
        try {
            read_sound(file);
        } catch (const std::runtime_error& error) {
            return error.what();
        }
        return "read";
    };
    EXPECT_NE(refusal(folder_ / "none.wav").find("No such file"), std::string::npos);
    EXPECT_NE(refusal(folder_).find("it is a folder"), std::string::npos);
    std::ofstream(folder_ / "text.wav") << "no sound at all";
    EXPECT_TRUE(refusal(folder_ / "text.wav").starts_with("Cannot read "))
        << refusal(folder_ / "text.wav");
    write("empty.wav", {});
    EXPECT_NE(refusal(folder_ / "empty.wav").find("no sound"), std::string::npos);
}

TEST_F(SoundFiles, AFullDiskIsTold) {
    const int full = ::open("/dev/full", O_RDWR | O_CLOEXEC);
    ASSERT_GE(full, 0);
    SoundWriter writer(full, "a.wav");
    writer.append(sine(441.0, 100000));
    EXPECT_EQ(writer.finish(), ENOSPC);
    ::close(full);
}

}  // namespace
}  // namespace glint::sound_file_test
