// A picture that stands still, refined in another process, is the still of as many samples.
#include "window/trial/refiner.h"

#include "../../base/test_folder.h"
#include "base/launch.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <functional>
#include <set>
#include <thread>

namespace glint::refiner_test {
namespace {

namespace fs = std::filesystem;

bool eventually(const std::function<bool()>& is_true) {
    for (int i = 0; i < 60000; ++i) {
        if (is_true()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

// Edges, a buffer of the picture's size, a smaller one, a tweak, and the mouse.
constexpr const char* kScene = R"(
uniform float level; //@ 0.5 [0, 1]
uniform sampler2D large; //@ pass mainLarge
uniform sampler2D small; //@ pass mainSmall scale=0.5
void mainLarge(out vec4 c, in vec2 p) {
    c = vec4(step(length(fract(p / 17.0 + iTime) - 0.5), level * 0.6), fract(p.x / 31.0), 0, 1);
}
void mainSmall(out vec4 c, in vec2 p) { c = vec4(0, 0, fract(p.y / 13.0), 1); }
void mainImage(out vec4 c, in vec2 p) {
    c = texelFetch(large, ivec2(p), 0) + texture(small, p / iResolution.xy);
    if (p.x * 0.3 + iMouse.x > p.y) c.r = 1.0 - c.r;
}
)";

Preset preset_of(const fs::path& file) {
    ReadPreset read = read_preset(file);
    for (const Diagnostic& diagnostic : read.diagnostics) ADD_FAILURE() << to_string(diagnostic);
    return std::move(read.preset).value();
}

int largest_difference(const Image& rgba, const Image& rgb) {
    int largest = 0;
    const std::size_t pixels = rgb.pixels.size() / 3;
    for (std::size_t i = 0; i < 3 * pixels; ++i) {
        const auto at = i / 3 * 4 + i % 3;
        largest = std::max(
            largest, std::abs(static_cast<int>(rgba.pixels[at]) - static_cast<int>(rgb.pixels[i])));
    }
    return largest;
}

TEST(RefiningSample, EachComesOnceAndThoseSoFarLieAllOver) {
    for (const int count : {1, 2, 3, 7, 16, 64, 100}) {
        std::set<int> seen;
        for (int k = 0; k < count; ++k) seen.insert(refining_sample(k, count));
        EXPECT_EQ(seen.size(), static_cast<std::size_t>(count));
    }
    double sum = 0.0;
    for (int k = 0; k < 8; ++k) sum += refining_sample(k, 64) + 0.5;
    EXPECT_NEAR(sum / 8.0, 32.0, 5.0);  // their mean is near the pixel's, after few
}

TEST(Refiner, WhatItEndsWithIsTheStillOfAsManySamples) {
    const TestFolder folder;
    const fs::path file = folder.write("scene.frag", kScene), still = folder.path() / "still.png";
    RefineOrder order{.preset = preset_of(file), .samples = 64, .time = 0.7, .frame = 42};
    order.preset.size = {160, 90};
    order.preset.values = {TweakValue{0.8}};
    Refiner refiner("", GLINT_BINARY);
    refiner.start(order);
    ASSERT_TRUE(eventually([&] {
        refiner.update();
        return refiner.done() == 64 && !refiner.is_running();
    }));
    EXPECT_EQ(refiner.of(), 64);
    const int code = wait_for(
        launch({.words = {GLINT_BINARY, "still", file.string(), "-o", still.string(), "--size",
                          "160x90", "--samples", "64", "--time", "0.7", "--tweak", "level=0.8"}})
            .process);
    ASSERT_EQ(code, 0);
    const Image wanted = read_image(still);
    ASSERT_EQ(refiner.picture().size, wanted.size);
    // The samples are added in another order: the last digits of the sums.
    EXPECT_LE(largest_difference(refiner.picture(), wanted), 1);
}

TEST(Refiner, WhatASceneHasSimulatedStaysAsItIs) {
    const TestFolder folder;
    const fs::path file = folder.write("scene.frag", R"(
uniform sampler2D count; //@ pass mainCount size=2x2
void mainCount(out vec4 c, in vec2 p) { c = texelFetch(count, ivec2(0), 0) + 0.25; }
void mainImage(out vec4 c, in vec2 p) { c = vec4(texelFetch(count, ivec2(0), 0).rgb, 1); }
)");
    RefineOrder order{.preset = preset_of(file), .samples = 4, .frame = 1};
    order.preset.size = {8, 8};
    const std::vector<float> texels(2 * 2 * 4 * 2, 0.5f);  // both sides of a feedback buffer
    const auto bytes = std::as_bytes(std::span(texels));
    order.state = {{.pass = "count",
                    .shape = {.size = {2, 2}, .feedback = true},
                    .bytes = {bytes.begin(), bytes.end()}}};
    Refiner refiner("", GLINT_BINARY);
    refiner.start(order);
    ASSERT_TRUE(eventually([&] {
        refiner.update();
        return !refiner.is_running();
    }));
    ASSERT_FALSE(refiner.picture().pixels.empty());
    EXPECT_NEAR(static_cast<int>(refiner.picture().pixels[0]), 128, 1);
}

TEST(Refiner, TellsHowFarItIsAndOneThatIsStoppedIsGoneAtOnceAndBeginsAnew) {
    const TestFolder folder;
    RefineOrder order{.preset = preset_of(folder.write("scene.frag", kScene)), .samples = 4000};
    order.preset.size = {640, 360};
    Refiner refiner("", GLINT_BINARY);
    refiner.start(order);
    std::set<int> counts;  // with far too many samples for a busy machine to miss them all
    ASSERT_TRUE(eventually([&] {
        refiner.update();
        counts.insert(refiner.done());
        return counts.size() > 2;
    }));
    refiner.stop();
    EXPECT_EQ(refiner.done(), 0);
    EXPECT_EQ(refiner.descriptor(), -1);
    EXPECT_TRUE(refiner.picture().pixels.empty());
    order.samples = 2;
    refiner.start(order);
    EXPECT_TRUE(eventually([&] { return refiner.update() && refiner.done() == 2; }));
}

TEST(Refiner, WhatCannotBeRefinedSaysNothingAndRests) {
    const TestFolder folder;
    RefineOrder order{.preset = preset_of(folder.write("scene.frag", kScene)), .samples = 4};
    order.preset.scene.text = "nonsense";
    Refiner refiner("", GLINT_BINARY);
    refiner.start(order);
    EXPECT_TRUE(eventually([&] {
        refiner.update();
        return !refiner.is_running();
    }));
    EXPECT_EQ(refiner.done(), 0);
    EXPECT_TRUE(refiner.picture().pixels.empty());
}

}  // namespace
}  // namespace glint::refiner_test
