// Two looks beside each other, as far as no frame need be drawn.
#include "measure/study/looks.h"

#include "../base/test_folder.h"
#include "measure/rows/heat.h"
#include "measure/study/pair.h"
#include "media/image.h"
#include "offline/common.h"
#include "offline/picture_file.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstring>
#include <random>

namespace glint {
namespace {

// Frames of `ms` on a machine whose load drifts, and now and then takes a frame twice its time.
FrameTimes frames(double ms, int count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> part;
    FrameTimes times;
    for (int i = 0; i < count; ++i) {
        const double load = 1.0 + 0.3 * std::sin(i * 0.2);
        const double jitter = 1.0 + 0.02 * part(random) + (part(random) < 0.1 ? 1.0 : 0.0);
        times.wall.push_back(ms * load * jitter);
        times.gpu.push_back(0.0);
        times.processor.push_back(ms * load * jitter);
    }
    return times;
}

TEST(TimedPair, ALookThatTakesATenthLongerIsSlower) {
    const TimedPair pair = judged_pair(frames(20.0, 60, 1), frames(22.0, 60, 2), 0, true);
    EXPECT_EQ(pair.verdict, TimeVerdict::slower);
    EXPECT_NEAR(pair.ratio, 1.1, 0.02);
    EXPECT_LT(pair.between.low, 1.1);
    EXPECT_GT(pair.between.high, 1.1);
    EXPECT_GT(pair.between.low, 1.05) << "the drift, of both alike, is not in it";
    EXPECT_EQ(judged_pair(frames(22.0, 60, 1), frames(20.0, 60, 2), 0, true).verdict,
              TimeVerdict::faster);
}

TEST(TimedPair, TheSameLookIsNotToldFromItself) {
    int wrong = 0;
    for (unsigned seed = 0; seed < 40; seed += 2) {
        const TimedPair pair =
            judged_pair(frames(20.0, 60, seed), frames(20.0, 60, seed + 1), 0, true);
        wrong += pair.verdict != TimeVerdict::not_told_apart;
    }
    EXPECT_LE(wrong, 1) << "of 20";
}

TEST(Looks, TwoFilesAreComparedUnlessTheirTweaksAreAskedFor) {
    const StudyOptions two{.files = {"a.toml", "b.frag"}};
    EXPECT_TRUE(compares_looks(two));
    EXPECT_FALSE(compares_looks({.files = {"a.toml"}}));
    EXPECT_FALSE(compares_looks({.files = {"a.toml", "b.toml", "c.toml"}}));
    const auto with = [&](auto change) {
        StudyOptions options = two;
        change(options);
        return compares_looks(options);
    };
    EXPECT_FALSE(with([](StudyOptions& o) { o.each = true; }));
    EXPECT_FALSE(with([](StudyOptions& o) { o.vary = {"steps"}; }));
    EXPECT_FALSE(with([](StudyOptions& o) { o.reference = {"steps=4"}; }));
    EXPECT_FALSE(with([](StudyOptions& o) { o.second = {"steps=4"}; }));
    EXPECT_FALSE(with([](StudyOptions& o) { o.time_only = true; }));
    // It names no tweaks: two files were studied, and nobody had asked for that.
    EXPECT_THROW(with([](StudyOptions& o) { o.pass = "waves"; }), UsageError);
    EXPECT_FALSE(with([](StudyOptions& o) {
        o.pass = "waves";
        o.each = true;
    }));
}

TEST(Looks, APictureIsOneOfTwo) {
    EXPECT_TRUE(compares_looks({.files = {"a.png", "b.toml"}}));
    EXPECT_TRUE(compares_looks({.files = {"a.exr", "b.jpg"}}));
    EXPECT_THROW(compares_looks({.files = {"a.png"}}), UsageError);
    EXPECT_THROW(compares_looks({.files = {"a.png", "b.toml", "c.toml"}}), UsageError);
}

// A grey ramp of 16 pixels, from 0 to `most`, whose last is brighter than a display shows.
Image grey_ramp(ChannelType type, float most, bool is_light) {
    Image image{.size = {16, 1}, .channels = 3, .type = type, .pixels = {}};
    for (int i = 0; i < 48; ++i) {
        const float shown = std::round(most * 17.0f * static_cast<float>(i / 3)) / 255.0f;
        const float light =
            shown <= 0.04045f ? shown / 12.92f : std::pow((shown + 0.055f) / 1.055f, 2.4f);
        const float value = is_light ? light : shown;
        std::byte bytes[sizeof value];
        std::memcpy(bytes, &value, sizeof value);
        if (type == ChannelType::u8)
            image.pixels.push_back(static_cast<std::byte>(std::lround(255.0f * value)));
        else
            image.pixels.insert(image.pixels.end(), std::begin(bytes), std::end(bytes));
    }
    return image;
}

nlohmann::json compared(const std::filesystem::path& a, const std::filesystem::path& b) {
    StudyOptions options{.files = {a, b}};
    options.view.json = true;
    testing::internal::CaptureStdout();
    run_looks(options);
    return nlohmann::json::parse(testing::internal::GetCapturedStdout());
}

TEST(Looks, LightOfOthersIsNotCutToWhatAPictureOfBytesKeeps) {
    const TestFolder folder;
    const auto file = [&](const char* name) { return folder.path() / name; };
    write_image(file("a.png"), grey_ramp(ChannelType::u8, 1.0f, false));
    write_image(file("a.exr"), grey_ramp(ChannelType::f32, 1.0f, true));
    write_image(file("bright.exr"), grey_ramp(ChannelType::f32, 4.0f, true));
    write_image(file("drawn.exr"), grey_ramp(ChannelType::f32, 1.0f, false),
                {{"glint:pass", "image"}});
    EXPECT_LT(compared(file("a.png"), file("a.exr"))["rmse"], 1e-6);
    EXPECT_GT(compared(file("a.png"), file("bright.exr"))["max"], 5.0) << "four times as bright";
    EXPECT_EQ(compared(file("drawn.exr"), file("a.png"))["max"], 0.0);
}

// Radiance's files hold light. This program keeps what a display shows, and numbers of buffers.
TEST(Looks, AnHdrIsComparedAsWhatItSaysThatItHolds) {
    const TestFolder folder;
    const auto file = [&](const char* name) { return folder.path() / name; };
    const Image drawn = grey_ramp(ChannelType::f32, 1.0f, false);
    write_image(file("a.png"), grey_ramp(ChannelType::u8, 1.0f, false));
    write_image(file("foreign.hdr"), grey_ramp(ChannelType::f32, 1.0f, true));
    write_image(file("drawn.hdr"), drawn,
                {{"glint:tweak:" + std::string(200, 'x'), "1"}, {"glint:pass", "image"}});
    write_image(file("buffer.hdr"), drawn, {{"glint:pass", "waves"}});
    const double kept = 0.01;  // eight bits of each number
    for (const char* name : {"foreign.hdr", "drawn.hdr"})
        EXPECT_LT(compared(file("a.png"), file(name))["max"], kept) << name;
    EXPECT_TRUE(read_compared_picture(file("foreign.hdr")).is_light);
    EXPECT_FALSE(read_compared_picture(file("drawn.hdr")).is_light);
    EXPECT_EQ(read_compared_picture(file("buffer.hdr")).buffer, "waves");
}

TEST(Heat, GoesFromBlackToWhiteInFourSteps) {
    const std::vector<float> map = {0.0f, 0.5f, 1.0f};
    const std::vector<std::byte> rgb = heat(map);
    const auto at = [&](std::size_t i) { return static_cast<int>(rgb[i]); };
    ASSERT_EQ(rgb.size(), 9u);
    EXPECT_EQ(at(0) + at(1) + at(2), 0);
    EXPECT_NEAR(at(3), 0.7 * 255, 1.0) << "violet in the middle";
    EXPECT_EQ(at(6) + at(7) + at(8), 3 * 255);
}

TEST(Heat, OfADifferenceIsAStepADecade) {
    const std::vector<float> a = {0.01f, 0.0f, 0.0f, 1.0f, std::nanf(""), 0.0f, 0.0f, 1.0f};
    const std::vector<float> b(8, 0.0f);
    const std::vector<std::byte> rgb = difference_heat(a, b, Values::light);
    const std::vector<std::byte> violet = heat(std::vector<float>{0.5f});
    for (std::size_t c = 0; c < 3; ++c)  // 0.01 is no float
        EXPECT_NEAR(static_cast<int>(rgb[c]), static_cast<int>(violet[c]), 1);
    EXPECT_EQ(std::vector(rgb.begin() + 3, rgb.end()),
              (std::vector{std::byte{255}, std::byte{0}, std::byte{255}}));
}

}  // namespace
}  // namespace glint
