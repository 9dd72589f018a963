// The skies that are kept as a picture all round: straight up, all its columns meet in a point.
#include "probe.h"

namespace glint::sky_test {
namespace {

using Skies = GlTest;

struct Sky {
    const char *scene, *light;  // of a direction and a cone
};
constexpr Sky kSkies[] = {{"boat", "heavens"}, {"water", "skyLight"}};

// Round the zenith, at an angle, what each of 32 bearings shows.
std::vector<glm::vec4> round_the_zenith(const Sky& sky, const std::string& look, double degrees,
                                        double cone) {
    const std::string file = fmt::format("{}/fragments/{}.frag", GLINT_REPOSITORY, sky.scene);
    Player player(
        with_picture(
            file, fmt::format("    float a = p.x / 32.0 * 2.0 * kPi, e = radians({:.2f});\n"
                              "    c = {}(vec3(sin(e) * sin(a), cos(e), sin(e) * cos(a)), {});\n",
                              degrees, sky.light, cone)),
        {.size = {32, 1}, .preset = "[tweaks]\n" + look});
    player.still(3.0);
    return pixels_of(player);
}

// How far the largest and the smallest are apart, as a share of the mean.
double spread(const std::vector<glm::vec4>& pixels) {
    double low = 1e9, high = 0.0, sum = 0.0;
    for (const glm::vec4& pixel : pixels) {
        const double light = (pixel.r + pixel.g + pixel.b) / 3.0;
        low = std::min(low, light);
        high = std::max(high, light);
        sum += light;
    }
    return (high - low) * static_cast<double>(pixels.size()) / sum;
}

// With the bearing half a degree from the zenith nothing that can be seen changes: what a cone
// between two levels of the picture sees lies up to seven degrees away, where the sky differs by a
// tenth. It had a beam towards a low sun, of five times the light, and what lies at the horizon.
TEST_F(Skies, AreTheSameAtTheZenithWhateverTheBearing) {
    for (const Sky& sky : kSkies)
        for (const char* look :
             {"sunHeight = 5\nhaze = 6\nclouds = 1\n", "clouds = 0.7\n", "clouds = 0\n"})
            for (const double cone : {0.0005, 0.0042, 0.0058})
                EXPECT_LT(spread(round_the_zenith(sky, look, 0.5, cone)), cone < 0.001 ? 0.02 : 0.1)
                    << sky.scene << ", " << look << ", " << cone;
}

// Light from the horizon below a cloud is not the cloud's: 30 degrees from the zenith nothing
// points at a sun 5 degrees high.
TEST_F(Skies, HaveNoBeamAboveALowSun) {
    for (const Sky& sky : kSkies)
        EXPECT_LT(
            spread(round_the_zenith(sky, "sunHeight = 5\nhaze = 6\nclouds = 1\n", 30.0, 0.05)), 0.7)
            << sky.scene;
}

}  // namespace
}  // namespace glint::sky_test
