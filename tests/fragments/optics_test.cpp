// What the scenes' tweaks say of light and waves, and the closed forms they share with textbooks,
// as values: tints, Snell's law, dispersion, light along a ray.
#include "probe.h"
#include "worst_case.h"

#include <array>
#include <cmath>

namespace glint::optics_test {
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

// What level water does not mirror goes through, and none is lost: of a beam that is bent towards
// the vertical, the same light falls on level ground. (Red: the sun's own colour is 1 there.)
TEST_F(Optics, LevelWaterLetsThroughWhatItDoesNotMirror) {
    struct {
        const char *scene, *share;
    } const cases[] = {
        {"deep_ocean",
         "float probed() { Medium m = oceanMedium(); vec3 s = sunAbove();\n"
         "    return m.sun.r * m.towards.y / (sunPower * (1.0 - fresnel(s.y, 1.34)) * s.y); }\n"},
        {"caustics",
         "float probed() { Medium m = waterMedium(); vec3 s = sunAbove();\n"
         "    return m.sun.r * m.towards.y / (sunPower * (1.0 - fresnel(s.y, 1.3345)) * s.y); }\n"},
    };
    for (const auto& c : cases)
        EXPECT_NEAR(value_of(c.scene, c.share, "probed()").x, 1.0, 1e-4) << c.scene;
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

// What the air leaves of a sun overhead: molecules (5.8, 13.5 and 33.1 1/Mm at the sea's level,
// half as many every 5.5 km up), ozone (0.65, 1.88 and 0.085 1/Mm at 25 km, none 15 km from there;
// Hillaire 2020, table 1), and the haze, which is taken out here.
TEST_F(Optics, TheAirOverheadIsOfMoleculesAndOzone) {
    const double molecules[] = {5.8e-6, 13.5e-6, 33.1e-6}, ozone[] = {0.65e-6, 1.88e-6, 0.085e-6};
    for (const char* scene : {"terrain", "sea"}) {
        const glm::vec4 depth =
            value_of(scene, "", "-log(airTransmittance(0.0, 1.0, 400)) - 1.32e3 * kMie * haze");
        for (int c = 0; c < 3; ++c) {
            const double right = molecules[c] * 8e3 + ozone[c] * 15e3;
            EXPECT_NEAR(depth[c] / right, 1.0, 5e-3) << scene << " " << c << ": a sum of 400";
        }
    }
}

// Twice as far from a small lamp, a fourth of its light. (Close to it: what the other lamps of the
// hall add is a few percent.)
TEST_F(Optics, LampsFadeWithTheSquareOfTheDistance) {
    struct {
        const char *scene, *light;
    } const cases[] = {
        {"christmas",
         "float lit(float far) {\n"
         "    Lamp source = lamp(0);\n"
         "    vec3 way = normalize(kAim - source.pos), p = source.pos + far * way;\n"
         "    return (irradiance(p, -way, false, 1) - irradiance(p, -way, false, 0)).g;\n}\n"},
        {"magic",
         "float lit(float far) {\n"
         "    vec3 p = thing(kLamps).xyz + vec3(0.0, far, 0.0), sheen;\n"
         "    return lampsLight(p, vec3(0, -1, 0), vec3(1, 0, 0), 0.3, sheen).r;\n}\n"},
    };
    for (const auto& c : cases) {
        const glm::vec4 light = value_of(c.scene, c.light, "vec2(lit(0.5), lit(1.0))");
        EXPECT_GT(light.y, 0.0f) << c.scene;
        EXPECT_NEAR(light.x / light.y, 4.0f, 0.5f) << c.scene;
    }
}

// Q19: what a lake scatters towards the eye, along rays up and down: daylight fades with the depth,
// and the light along the ray. Against 20,000 steps.
void expect_the_sum(double rise, double far, Bar& error) {
    const std::vector<ProbeCase> one = {
        {.a = {static_cast<float>(rise), static_cast<float>(far), 0, 0}}};
    const glm::vec4 loss = probe(scene_text("terrain"), "waterLoss()", one)[0];
    const glm::vec4 got = probe(scene_text("terrain"),
                                "lakeGlow(12.0, a.x, a.y) / lakeGlow(12.0, 0.0, 1e-4)", one)[0];
    for (int c = 0; c < 3; ++c) {
        double sum = 0.0;
        for (int k = 0; k < 20000; ++k) {
            const double t = (k + 0.5) * one[0].a.y / 20000.0;
            sum += std::exp(loss[c] * (0.7 * one[0].a.x - 1.0) * t) * one[0].a.y / 20000.0;
        }
        error.see(std::abs(got[c] * 1e-4 / sum - 1.0),
                  fmt::format("rise {:.5g}, {:.4g} m", rise, far));
    }
}
constexpr const char* kGlow = "Q19 terrain: relative error of the lake's glow";
TEST_F(Optics, TheGlowOfALakeIsTheSumAlongTheRay) {
    Bar error(kGlow, 1e-4);
    for (const double rise : {-0.9, -0.3, 0.0, 0.4, 0.9}) expect_the_sum(rise, 10.0, error);
}
TEST_F(Optics, TheGlowOfALakeIsTheSumWhateverTheCase) {
    Bar error(kGlow, 1e-4);
    search_worst(2, 64, {&error}, [&](Dials& dials) {
        const double rise = dials.between(-0.99, 0.99);
        expect_the_sum(rise, dials.between_logs(0.05, 50.0), error);
    });
}

// Q19: the mean of what fades evenly is exact, from clear air to ink.
struct Fade {
    const char *scene, *mean;
    // 4000 fades between two.
    void see(double first, double last, Bar& error) const {
        std::vector<ProbeCase> cases;
        for (int i = 0; i < 4000; ++i)
            cases.push_back({.a = {first * std::pow(last / first, i / 4000.0), 0, 0, 0}});
        const auto got = probe(scene_text(scene), mean, cases);
        for (std::size_t i = 0; i < cases.size(); ++i) {
            const double x = cases[i].a.x;
            error.see(std::abs(got[i].x * x / -std::expm1(-x) - 1.0), fmt::format("x = {:.7g}", x));
        }
    }
    std::string bar() const {
        return fmt::format("Q19 {}: relative error of the mean fade", scene);
    }
};
constexpr Fade kFades[] = {{"boat", "meanDecay(a.x)"},
                           {"caustics", "meanFade(vec3(a.x)).x"},
                           {"terrain", "meanTransmittance(a.x)"}};
TEST_F(Optics, TheMeanOfAnEvenFadeIsExact) {
    for (const Fade& fade : kFades) {
        Bar error(fade.bar(), 1e-4);
        fade.see(1e-7, 1e4, error);
    }
}
TEST_F(Optics, TheMeanOfAnEvenFadeIsExactWhateverTheCase) {
    for (const Fade& fade : kFades) {
        Bar error(fade.bar(), 1e-4);
        search_worst(1, 40, {&error}, [&](Dials& dials) {
            const double x = dials.between_logs(1e-7, 1e4);
            fade.see(0.9 * x, 1.1 * x, error);
        });
    }
}

}  // namespace
}  // namespace glint::optics_test
