// What moves or is set a hair further looks a hair different: no rays that meet their own start,
// and nothing that leaps where a cycle ends.
#include "probe.h"

#include <algorithm>
#include <cmath>

namespace glint::continuity_test {
namespace {

using Continuity = GlTest;

std::string scene_text(const std::string& scene) {
    return "#include \"" GLINT_REPOSITORY "/fragments/" + scene + ".frag\"\n";
}

class Scene {
public:
    Scene(const std::string& name, glm::ivec2 size)
        : player_(scene_text(name), {.size = size, .specialise = false}) {}

    void set(const std::string& tweak, double number) {
        for (std::size_t i = 0; i < player_.preset.scene.tweaks.size(); ++i)
            if (player_.preset.scene.tweaks[i].name == tweak)
                player_.preset.values[i] = {number, 0.0, 0.0, 0.0};
    }
    std::vector<float> at(double time) {
        const Playback playback{.end = time};
        player_.draw(playback.frame(player_.preset, playback.last_frame()));
        return player_.floats();
    }

    std::vector<float> dragged_to(glm::dvec2 pixel) {
        Frame frame;
        frame.input.mouse = {pixel.x, pixel.y, 30.0, 20.0};
        player_.draw(frame);
        return player_.floats();
    }

private:
    Player player_;
};

double mean_difference(const std::vector<float>& a, const std::vector<float>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
    return 255.0 * sum / static_cast<double>(a.size());
}

// Of three frames 1/60 s apart, the second change over the first.
double leap(Scene& scene, double before, double time) {
    const auto first = scene.at(before - 1.0 / 60.0), second = scene.at(before);
    return mean_difference(second, scene.at(time)) / mean_difference(first, second);
}

// 10 um higher: an edge may move by a pixel here and there, as at most 1 did; 137 pixels flickered.
TEST_F(Continuity, WatersBallIsNotStrewnWithDots) {
    Scene water("water", {640, 360});
    for (const char* flat : {"waveHeight", "ripples"}) water.set(flat, 0.0);
    water.set("cameraHeight", 1.7);
    const std::vector<float> low = water.at(0.2);
    water.set("cameraHeight", 1.70001);
    const std::vector<float> high = water.at(0.2);
    int flickers = 0;
    for (std::size_t i = 0; i < low.size(); i += 4) {
        float most = 0.0f;
        for (std::size_t c = 0; c < 3; ++c)
            most = std::max(most, std::abs(low[i + c] - high[i + c]));
        flickers += most > 40.0f / 255.0f;
    }
    EXPECT_LE(flickers, 10);
}

// Slopes that a pixel has lost lean towards the eye. Where their mean faced away, the ray was
// mirrored along the surface until none was left: 1638 pixels were dark between bright ones.
TEST_F(Continuity, WatersCrestsAreNotDottedWithDarkPixels) {
    Scene water("water", {640, 360});
    const std::pair<const char*, double> kLow[] = {{"waveHeight", 0.06},    {"longestWave", 0.9},
                                                   {"cameraDistance", 2.6}, {"cameraAngle", -28.0},
                                                   {"cameraHeight", 0.62},  {"targetHeight", 0.02},
                                                   {"focalLength", 32.0},   {"sunHeight", 4.0}};
    for (const auto& [tweak, value] : kLow) water.set(tweak, value);
    const std::vector<float> picture = water.at(0.2);
    const auto green = [&](int x, int y) {
        return picture[static_cast<std::size_t>(y * 640 + x) * 4 + 1];
    };
    int dark = 0;
    for (int y = 1; y < 359; ++y)
        for (int x = 0; x < 640; ++x)
            dark += std::min(green(x, y - 1), green(x, y + 1)) - green(x, y) > 40.0f / 255.0f;
    EXPECT_LE(dark, 600);  // 420
}

// From thirty times as far through as long a lens, the dial on the floor is as sharp as the pixels
// admit, which four times as many of them tell. It was blurred as if the eye stood where it did.
TEST_F(Continuity, AnalyticsFarEyeSeesAsSharply) {
    const auto from_far = [](glm::ivec2 size) {
        Scene analytic("analytic", size);
        analytic.set("cameraHeight", 8.0);
        analytic.set("targetHeight", 0.0);
        analytic.set("magnitude", 30.0);
        return analytic.at(0.0);
    };
    const std::vector<float> small = from_far({320, 180}), large = from_far({1280, 720});
    double sum = 0.0;
    for (int y = 10; y < 40; ++y)  // the floor with the dial
        for (int x = 60; x < 260; ++x) {
            float mean = 0.0f;
            for (int k = 0; k < 16; ++k)
                mean += large[static_cast<std::size_t>((4 * y + k / 4) * 1280 + 4 * x + k % 4) * 4];
            sum += std::abs(mean / 16.0f - small[static_cast<std::size_t>(y * 320 + x) * 4]);
        }
    EXPECT_LE(255.0 * sum / (30 * 200), 6.0);  // 4.3; 8.0
}

// Where the mouse has been dragged into the corner, its place is (0, 0).
TEST_F(Continuity, ACornerIsAPlaceForTheMouseLikeAnyOther) {
    for (const char* name : {"analytic", "caustics", "christmas", "magic", "terrain"}) {
        SCOPED_TRACE(name);
        Scene scene(name, {64, 36});
        const std::vector<float> corner = scene.dragged_to({0.0, 0.0});
        const std::vector<float> beside = scene.dragged_to({0.01, 0.01});
        EXPECT_LE(mean_difference(corner, beside), 3.0);
    }
}

// The drum is convex. More samples of its shade made it brighter by 8 of 255.
TEST_F(Continuity, AnalyticsDrumIsAsBrightWithMoreSamplesOfShade) {
    Scene analytic("analytic", {320, 180});
    const auto brightness = [&](int samples) {
        analytic.set("shadowSamples", samples);
        const std::vector<float> picture = analytic.at(3.0);
        double sum = 0.0;
        for (int y = 56; y < 60; ++y)
            for (int x = 76; x < 80; ++x) sum += picture[static_cast<std::size_t>(y * 320 + x) * 4];
        return 255.0 * sum / 16.0;
    };
    EXPECT_NEAR(brightness(1), brightness(16), 1.0);
}

// The end of the old slide, and of the new one at 65536 / 10 s: 2.9 and 1.1 times the change
// before.
TEST_F(Continuity, SeasCloudsSlideOnWhereTheirCycleEnds) {
    Scene sea("sea", {160, 90});
    for (const char* still : {"waveHeight", "ripples"}) sea.set(still, 0.0);
    for (const double end : {65536.0 / 19.0, 65536.0 / 10.0})
        EXPECT_LT(leap(sea, end - 0.005, end + 0.012), 1.8) << end;
}

// A blur of half a pixel, here at 0.0093, set in at once: half of all that changed.
TEST_F(Continuity, TerrainsBlurBeginsByDegrees) {
    Scene terrain("terrain", {96, 54});
    const auto blurred = [&](double tilt_shift) {
        terrain.set("tiltShift", tilt_shift);
        return terrain.at(0.0);
    };
    const auto change = [](const std::vector<float>& a, const std::vector<float>& b) {
        double sum = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
        return sum;
    };
    const double all = change(blurred(0.004), blurred(0.02));
    EXPECT_LT(change(blurred(0.009), blurred(0.0095)), 0.1 * all);
}

// All streaks were other ones each second.
TEST_F(Continuity, BoatsRainFallsOnWhereItsCyclesEnd) {
    Scene boat("boat", {160, 90});
    boat.set("rain", 1.0);
    for (const char* still : {"steepness", "ripples"}) boat.set(still, 0.0);
    EXPECT_LT(leap(boat, 1.0 - 0.008, 1.0 + 0.0087), 1.4);
}

}  // namespace
}  // namespace glint::continuity_test
