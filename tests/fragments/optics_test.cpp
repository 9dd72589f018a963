// What the scenes' tweaks say of light and waves, and the closed forms they share with textbooks,
// as values: tints, Snell's law, dispersion, light along a ray.
#include "bar.h"
#include "probe.h"

#include <array>
#include <cmath>

namespace glint {
namespace {

using Optics = GlTest;

std::string scene_text(std::string_view scene) {
    return fmt::format("#include \"" GLINT_REPOSITORY "/fragments/{}.frag\"\n", scene);
}
glm::vec4 value_of(std::string_view scene, std::string_view functions,
                   std::string_view expression) {
    return probe(scene_text(scene) + std::string(functions), expression,
                 std::vector<ProbeCase>(1))[0];
}

// A tint is what so many metres of water leave of white light (1 % for the fit of sRGB's curve).
TEST_F(Optics, WaterLeavesItsTint) {
    struct {
        const char *scene, *left;
    } const cases[] = {
        {"boat", "exp(-3.0 * absorption()) / linearColour(waterTint)"},
        {"water", "exp(-3.0 * absorption()) / linearColour(waterTint)"},
        {"terrain", "exp(-10.0 * waterLoss()) / linearColour(waterTint)"},
        {"deep_ocean", "exp(-tintDistance * oceanMedium().absorption) / linearColour(waterTint)"},
        {"caustics", "exp(-tintDistance * waterMedium().absorption) / linearColour(waterTint)"},
    };
    for (const auto& c : cases) {
        const glm::vec4 left = value_of(c.scene, "", c.left);
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(left[k], 1.0f, 0.01f) << c.scene;
    }
}

// Q7: the sun under level water stands where Snell puts it: the level part of its direction is
// shortened by the index.
TEST_F(Optics, TheSunUnderLevelWaterIsWhereSnellPutsIt) {
    struct {
        const char *scene, *functions, *ratio;
        double index;
    } const cases[] = {
        {"deep_ocean", "", "length(sunAbove().xz) / length(oceanMedium().towards.xz)", 1.34},
        {"caustics", "", "length(sunAbove().xz) / length(waterMedium().towards.xz)", 1.3345},
        {"boat",
         "float probed() { mat2 m; vec3 l = sunUnderWater(sunDirection(), m);\n"
         "    return length(sunDirection().xz) / length(l.xz); }\n",
         "probed()", 1.333},
        {"water",
         "float probed() { mat2 m; vec3 s = towardsSun(), l = sunUnderWater(s, m);\n"
         "    return length(s.xz) / length(l.xz); }\n",
         "probed()", 1.333},
        {"terrain",
         "float probed() { vec3 s = sunDirection();\n"
         "    vec3 l = refractExactly(-s, vec3(0, 1, 0), 1.0 / kIorWater);\n"
         "    return length(s.xz) / length(l.xz); }\n",
         "probed()", 1.333},
    };
    for (const auto& c : cases)
        EXPECT_NEAR(value_of(c.scene, c.functions, c.ratio).x, c.index, 2e-3) << c.scene;
}

// Waves over a depth d: (2 pi f)^2 = g k tanh(k d), to the digits of a float.
TEST_F(Optics, TheBoatsWavesKeepTheDispersionOfTheirDepth) {
    std::vector<ProbeCase> cases;
    for (int i = 0; i < 200; ++i) cases.push_back({.a = {0.05 * std::pow(1.04, i), 0, 0, 0}});
    const auto hz = probe(scene_text("boat"), "vec2(waveHz(vec2(a.x, 0.0)), depth)", cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double k = cases[i].a.x, d = hz[i].y;
        const double right = std::sqrt(9.81 * k * std::tanh(k * d)) / (2.0 * std::acos(-1.0));
        EXPECT_NEAR(hz[i].x / right, 1.0, 1e-5) << k;
    }
}

// Q19: the mean of what fades evenly is exact, from clear air to ink.
TEST_F(Optics, TheMeanOfAnEvenFadeIsExact) {
    std::vector<ProbeCase> cases;
    for (int i = 0; i < 4000; ++i)
        cases.push_back({.a = {std::pow(10.0, -7.0 + 11.0 * i / 4000.0), 0, 0, 0}});
    struct {
        const char *scene, *mean;
    } const forms[] = {{"boat", "meanDecay(a.x)"}, {"caustics", "meanFade(vec3(a.x)).x"}};
    for (const auto& form : forms) {
        Bar error(fmt::format("Q19 {}: relative error of the mean fade", form.scene), 1e-4);
        const auto got = probe(scene_text(form.scene), form.mean, cases);
        for (std::size_t i = 0; i < cases.size(); ++i) {
            const double x = cases[i].a.x;
            error.see(std::abs(got[i].x * x / -std::expm1(-x) - 1.0), fmt::format("x = {:.3g}", x));
        }
    }
}

}  // namespace
}  // namespace glint
