// The wreck on the sea floor: noise, rays to the floor, the hull's field, water, tears and the net
// of light, in figures.
#include "probe.h"
#include "worst_case.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <random>

namespace glint::deep_ocean_test {
namespace {

using DeepOcean = GlTest;

const std::string kScene =
    "#include \"" GLINT_REPOSITORY "/fragments/deep_ocean.frag\"\n";  // tweaks at their defaults

constexpr double kTile = 256.0;  // m, after which the floor repeats, as in the scene
constexpr int kGround = 1024;    // its texels, a side

// One buffer of the scene at a time, RGBA.
std::vector<float> buffer(std::string_view pass, double time = 0.0,
                          const std::string& tweaks = {}) {
    Player player(kScene, {.preset = "[tweaks]\n" + tweaks, .pass = std::string(pass)});
    Frame frame = player.frame(0);
    frame.time = time;
    player.draw(frame);
    return player.floats();
}

// pcg3d (Jarzynski and Olano 2020), and Perlin's noise on it in double precision.
std::array<std::uint32_t, 3> pcg3d(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    x = x * 1664525u + 1013904223u;
    y = y * 1664525u + 1013904223u;
    z = z * 1664525u + 1013904223u;
    x += y * z, y += z * x, z += x * y;
    x ^= x >> 16u, y ^= y >> 16u, z ^= z >> 16u;
    x += y * z, y += z * x, z += x * y;
    return {x, y, z};
}
double noise(int cx, int cy, double fx, double fy, int seed, int period) {
    const auto fade = [](double f) { return f * f * f * (f * (f * 6.0 - 15.0) + 10.0); };
    std::array<double, 4> corner{};
    for (int k = 0; k < 4; ++k) {
        const int i = k & 1, j = k >> 1;
        const auto bits = pcg3d(static_cast<std::uint32_t>((cx + i) & (period - 1)),
                                static_cast<std::uint32_t>((cy + j) & (period - 1)),
                                static_cast<std::uint32_t>(seed));
        const double gx = 2.0 * (bits[0] >> 8u) / 16777216.0 - 1.0;
        const double gy = 2.0 * (bits[1] >> 8u) / 16777216.0 - 1.0;
        corner[static_cast<std::size_t>(k)] = gx * (fx - i) + gy * (fy - j);
    }
    return std::lerp(std::lerp(corner[0], corner[1], fade(fx)),
                     std::lerp(corner[2], corner[3], fade(fx)), fade(fy));
}

// Cells as whole numbers keep it exact far out: at most 1e-6 from double precision, root mean
// square, round 0, 1e6 and beyond 2^24, where a float no longer knows its neighbour.
void expect_exact_noise(glm::ivec2 place, std::uint32_t seed, Bar& bar) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<ProbeCase> cases;
    for (int i = 0; i < 8000; ++i) {
        const int x = place.x + static_cast<int>(random() % 512) - 256;
        const int y = place.y + static_cast<int>(random() % 512) - 256;
        // Whole numbers come in two parts, each exact in a float.
        const auto high = [](int n) { return static_cast<float>(n >> 12); };
        const auto low = [](int n) { return static_cast<float>(n & 4095); };
        cases.push_back(
            {.a = {high(x), low(x), high(y), low(y)}, .b = {unit(random), unit(random), 0, 0}});
    }
    const auto got = probe(kScene,
                           "seabedNoise(ivec2(int(a.x) * 4096 + int(a.y), int(a.z) * 4096 + "
                           "int(a.w)), b.xy, 1 << 30, 3)",
                           cases);
    double squares = 0.0, top = 0.0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const glm::vec4& a = cases[i].a;
        const int x = static_cast<int>(a.x) * 4096 + static_cast<int>(a.y);
        const int y = static_cast<int>(a.z) * 4096 + static_cast<int>(a.w);
        const double expected = noise(x, y, cases[i].b.x, cases[i].b.y, 3, 1 << 30);
        squares += (got[i].x - expected) * (got[i].x - expected);
        top = std::max(top, std::abs(static_cast<double>(got[i].x)));
    }
    bar.see(std::sqrt(squares / static_cast<double>(cases.size())),
            fmt::format("cells round {} {}", place.x, place.y));
    EXPECT_LE(top, 1.0) << "a mean of four slopes over at most a cell";
    EXPECT_GE(top, 0.3) << "and not flat";
}
constexpr const char* kNoise = "Q9 deep_ocean: noise, RMS";
TEST_F(DeepOcean, NoiseIsAsExactFarOutAsAtTheOrigin) {
    Bar bar(kNoise, 1e-6);
    for (const int far : {0, -1'000'000, 1'000'000, (1 << 24) + 1, 100'000'000})
        expect_exact_noise({far, -far}, 7, bar);
}
TEST_F(DeepOcean, NoiseIsExactWhateverTheCase) {
    Bar bar(kNoise, 1e-6);
    search_worst(2, 48, {&bar}, [&](Dials& dials) {
        // Evenly in the number of digits, to 1e9 on both sides.
        const auto far = [&] {
            const double digits = dials.between(-9.0, 9.0);
            return static_cast<int>(std::copysign(std::pow(10.0, std::abs(digits)), digits));
        };
        const int x = far(), y = far();
        expect_exact_noise({x, y}, dials.number, bar);
    });
}

TEST_F(DeepOcean, NoiseHasNoSeamBetweenCellsNorAfterItsPeriod) {
    std::vector<ProbeCase> cases;
    for (int i = 0; i < 4000; ++i) {
        const float y = 0.37f * static_cast<float>(i);
        cases.push_back({.a = {static_cast<float>(i % 61 - 30), static_cast<float>(i % 53), 0, 0},
                         .b = {y - std::floor(y), 0, 0, 0}});
    }
    const auto edge = probe(kScene,
                            "vec4(seabedNoise(ivec2(a.xy), vec2(1.0, b.x), 16, 5), "
                            "seabedNoise(ivec2(a.xy) + ivec2(1, 0), vec2(0.0, b.x), 16, 5), "
                            "seabedNoise(ivec2(a.xy), vec2(b.x, 1.0), 16, 5), "
                            "seabedNoise(ivec2(a.xy) + ivec2(0, 1), vec2(b.x, 0.0), 16, 5))",
                            cases);
    const auto period = probe(kScene,
                              "vec2(seabedNoise(ivec2(a.xy), b.xx, 16, 5), "
                              "seabedNoise(ivec2(a.xy) + ivec2(16, -48), b.xx, 16, 5))",
                              cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        EXPECT_NEAR(edge[i].x, edge[i].y, 1e-6);
        EXPECT_NEAR(edge[i].z, edge[i].w, 1e-6);
        // The same corners; a driver may round the two copies of the text each in its own way.
        EXPECT_NEAR(period[i].x, period[i].y, 2e-7);
    }
}

// The floor as its filter sees it, in double precision.
class Floor {
public:
    Floor() : texels_(buffer("ground")) {}
    double height(double x, double z) const {
        const double u = x / kTile * kGround - 0.5, v = z / kTile * kGround - 0.5;
        const double iu = std::floor(u), iv = std::floor(v);
        return std::lerp(std::lerp(at(iu, iv), at(iu + 1, iv), u - iu),
                         std::lerp(at(iu, iv + 1), at(iu + 1, iv + 1), u - iu), v - iv);
    }

private:
    double at(double u, double v) const {
        const auto wrap = [](double i) {
            return static_cast<std::size_t>(static_cast<int>(i) & (kGround - 1));
        };
        return static_cast<double>(texels_[4 * (wrap(v) * kGround + wrap(u))]);
    }
    std::vector<float> texels_;
};

// Bars, at -20, -5 and -1.5 degrees: at most 0.5 % of the hits more than 5 cm off, at most 0.5 %
// hit or miss against the truth, at most 32 evaluations a ray, at most 0.1 % out of steps.
TEST_F(DeepOcean, RaysMeetTheFloorWhereTheyShould) {
    constexpr double kReach = 140.0;  // m, as far as the scene looks
    const Floor floor;
    for (const double degrees : {-20.0, -5.0, -1.5}) {
        std::vector<ProbeCase> cases;
        std::mt19937 random(3);
        std::uniform_real_distribution<double> unit(0.0, 1.0);
        for (int i = 0; i < 2000; ++i) {
            const double turn = 2.399963 * i, down = degrees * 3.14159265358979 / 180.0;
            const double x = 240.0 * unit(random) - 120.0, z = 240.0 * unit(random) - 120.0;
            cases.push_back({.a = {x, floor.height(x, z) + 0.7 + 3.0 * unit(random), z, 0},
                             .b = {std::cos(down) * std::cos(turn), std::sin(down),
                                   std::cos(down) * std::sin(turn), 0}});
        }
        const auto got = probe(kScene +
                                   "vec2 probed(vec3 ro, vec3 rd) {\n"
                                   "    float t = hitSeabed(ro, rd, 0.0, 140.0);\n"
                                   "    return vec2(t, float(seabedEvaluations));\n}\n",
                               "probed(a.xyz, b.xyz)", cases);
        int wrong = 0, flipped = 0, capped = 0;
        double evaluations = 0.0;
        for (std::size_t i = 0; i < cases.size(); ++i) {
            const glm::dvec3 ro(cases[i].a), rd(cases[i].b);
            const auto above = [&](double t) {
                return ro.y + t * rd.y - floor.height(ro.x + t * rd.x, ro.z + t * rd.z);
            };
            double lo = 0.0, hi = -1.0;
            for (double t = 0.0; t <= kReach && hi < 0.0; t += 0.01) {
                if (above(t) <= 0.0) {
                    hi = t;
                } else {
                    lo = t;
                }
            }
            for (int k = 0; k < 40 && hi > 0.0; ++k) {
                (above(0.5 * (lo + hi)) > 0.0 ? lo : hi) = 0.5 * (lo + hi);
            }
            evaluations += got[i].y;
            capped += got[i].y >= 256.0f;
            if ((got[i].x < 0.0f) != (hi < 0.0)) {
                ++flipped;
            } else if (hi > 0.0) {
                wrong += std::abs(got[i].x - hi) > 0.05;
            }
        }
        const auto count = static_cast<double>(cases.size());
        fmt::print(
            "{:5.1f} degrees: {:.2f} % wrong, {:.2f} % hit or miss, {:.1f} evaluations, {:.2f} % "
            "capped\n",
            degrees, 100.0 * wrong / count, 100.0 * flipped / count, evaluations / count,
            100.0 * capped / count);
        EXPECT_LE(100.0 * wrong / count, 0.5);
        EXPECT_LE(100.0 * flipped / count, 0.5);
        EXPECT_LE(evaluations / count, 32.0);
        EXPECT_LE(100.0 * capped / count, 0.1);
    }
}

// A step of a ray is as long as the field says, so no surface may lie nearer than that: from a
// point outside, nothing within the field's value is inside.
TEST_F(DeepOcean, TheHullsFieldNeverExceedsTheDistance) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(-1.0f, 1.0f);
    int outside = 0, passed = 0;
    for (int batch = 0; batch < 8; ++batch) {
        std::vector<ProbeCase> cases;
        for (int i = 0; i < 16384; ++i) {
            glm::vec4 way{unit(random), unit(random), unit(random), 0.0f};
            const float size = std::sqrt(way.x * way.x + way.y * way.y + way.z * way.z) + 1e-6f;
            cases.push_back({.a = {12.0f * unit(random), 3.0f + 3.8f * unit(random),
                                   3.3f * unit(random), 0.5f + 0.49f * unit(random)},
                             .b = way / size});
        }
        const auto got = probe(kScene +
                                   "vec2 probed(vec3 p, vec3 way, float part) {\n"
                                   "    float d = map(p).x;\n"
                                   "    return vec2(d, map(p + part * max(d, 0.0) * way).x);\n}\n",
                               "probed(a.xyz, b.xyz, a.w)", cases);
        for (const glm::vec4& one : got) {
            outside += one.x > 1e-3f;
            passed += one.x > 1e-3f && one.y < -2e-3f;
        }
    }
    fmt::print("{} of {} steps end inside\n", passed, outside);
    EXPECT_LE(passed, outside / 2000) << "0.05 %: corners that differ from plank to plank";
}

// Light along a ray through even water is exact: against 200,000 steps in double precision, for
// water from clear to ink, at most 1e-4 of it.
TEST_F(DeepOcean, EvenWaterIsExact) {
    std::vector<ProbeCase> cases;
    for (const float sigma : {0.01f, 0.1f, 1.0f, 10.0f, 100.0f, 1000.0f}) {
        for (const float rise : {-0.9f, -0.1f, -1e-6f, 0.0f, 1e-6f, 0.3f, 0.8f}) {
            for (const float t : {1e-4f, 0.1f, 5.0f, 20.0f}) {
                cases.push_back({.a = {sigma, rise, t, 24.0f}});
            }
        }
    }
    // The sun's part alone: a field without light, a sun of 1 at the surface.
    const auto got = probe(
        kScene +
            "vec2 probed(float sigma, float rise, float t, float below) {\n"
            "    Medium m = oceanMedium();\n"
            "    m.extinction = vec3(sigma); m.diffuse = vec3(0.3 * sigma);\n"
            "    vec3 rd = vec3(sqrt(1.0 - rise * rise), rise, 0.0), once;\n"
            "    vec3 all = veil(below / max(sigma, 1.0), rd, t, m, once);\n"
            "    vec3 field = 0.22 * haze * fieldLight(m) * exp(-m.diffuse * below / max(sigma, "
            "1.0));\n"
            "    return vec2(all.g, 0.0) / (once.g + field.g);\n}\n"
            "vec4 parts(float sigma, float rise, float below) {\n"
            "    Medium m = oceanMedium();\n"
            "    m.extinction = vec3(sigma); m.diffuse = vec3(0.3 * sigma);\n"
            "    vec3 once;\n"
            "    veil(below / max(sigma, 1.0), vec3(sqrt(1.0 - rise * rise), rise, 0.0), 1.0, m, "
            "once);\n"
            "    vec3 field = 0.22 * haze * fieldLight(m) * exp(-m.diffuse * below / max(sigma, "
            "1.0));\n"
            "    return vec4(once.g / (once.g + field.g), m.towards.y, 0.0, 0.0);\n}\n",
        "vec4(probed(a.x, a.y, a.z, a.w), parts(a.x, a.y, a.w).xy)", cases);
    Bar error("Q19 deep_ocean: relative error of light along a ray", 1e-4);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double sigma = cases[i].a.x, rise = cases[i].a.y, t = cases[i].a.z;
        const double share = got[i].z, up = got[i].w;
        const double sun = sigma * (1.0 - rise / up), field = sigma * (1.0 - 0.3 * rise);
        // Steps that grow with the distance resolve both ends.
        double sum = 0.0, before = 0.0;
        constexpr int kSteps = 20000;
        for (int k = 1; k <= kSteps; ++k) {
            const double x = t * std::pow(static_cast<double>(k) / kSteps, 3.0);
            const double middle = 0.5 * (before + x), h = x - before;
            const auto value = [&](double s) {
                return share * std::exp(-sun * s) + (1.0 - share) * std::exp(-field * s);
            };
            sum += h / 6.0 * (value(before) + 4.0 * value(middle) + value(x));
            before = x;
        }
        if (!std::isfinite(sum) || sum > 1e30) continue;  // up a ray far longer than the water
        error.see(std::abs(got[i].x - sum) / sum,
                  fmt::format("{:.5g} 1/m, rise {:.5g}, {:.5g} m", sigma, rise, t));
    }
}

// Gaussians on a lattice fill it evenly, and none of their light is lost.
TEST_F(DeepOcean, TheNetOfLightKeepsTheLight) {
    for (const float one : buffer("caustics", 3.0, "netSharpness = 0.0\n")) {
        if (one != 0.0f) {
            ASSERT_NEAR(one, 1.0f, 1e-5f) << "nothing bends: even";
        }
    }
    const std::vector<float> net = buffer("caustics", 3.0);
    double sum = 0.0, top = 0.0;
    for (std::size_t i = 0; i < net.size(); i += 4) {
        sum += net[i];
        top = std::max(top, static_cast<double>(net[i]));
    }
    EXPECT_NEAR(4.0 * sum / static_cast<double>(net.size()), 1.0, 5e-3);
    EXPECT_GE(top, 2.0) << "it has lines";
}

// The waves repeat after loopSeconds, and the step across the seam is no larger than any other.
TEST_F(DeepOcean, TheNetOfLightRepeatsWithoutAJump) {
    const auto apart = [](const std::vector<float>& a, const std::vector<float>& b) {
        double squares = 0.0;
        for (std::size_t i = 0; i < a.size(); i += 4) {
            squares += std::pow(static_cast<double>(a[i]) - static_cast<double>(b[i]), 2.0);
        }
        return std::sqrt(4.0 * squares / static_cast<double>(a.size()));
    };
    Player player(kScene, {.preset = "[tweaks]\nloopSeconds = 16.0\n", .pass = "caustics"});
    const auto at = [&](double time) {
        Frame frame = player.frame(0);
        frame.time = time;
        player.draw(frame);
        return player.floats();
    };
    EXPECT_LE(apart(at(3.0), at(19.0)), 1e-3);
    EXPECT_LE(apart(at(3.0), at(3.0 + 65536.0 * 480.0)), 1e-3) << "a year later";
    double most = 0.0;
    std::vector<float> before = at(2.0);
    for (int k = 1; k <= 20; ++k) {
        const std::vector<float> now = at(2.0 + k / 60.0);
        most = std::max(most, apart(now, before));
        before = now;
    }
    const double seam = apart(at(16.0 - 0.5 / 60.0), at(16.0 + 0.5 / 60.0));
    fmt::print("a frame: at most {:.3g}, across the seam {:.3g}\n", most, seam);
    EXPECT_LE(seam, 1.5 * most);
}

// Sails keep their area however far away they are: from 1 to 200 times the distance the share of
// covered pixels stays within a tenth of what many samples see.
TEST_F(DeepOcean, TearsKeepTheirShareAtAnyDistance) {
    constexpr int kSide = 256;  // samples across the sail
    double truth = 0.0;
    for (const int part : {1, 4, 16, 64, 200}) {
        const int side = std::max(kSide / part, 2);
        std::vector<ProbeCase> cases;
        for (int i = 0; i < side * side; ++i) {
            const float x = (static_cast<float>(i % side) + 0.5f) / static_cast<float>(side);
            const float y = (static_cast<float>(i / side) + 0.5f) / static_cast<float>(side);
            cases.push_back({.a = {6.0f * x, 4.2f * y, 6.0f / static_cast<float>(side),
                                   4.2f / static_cast<float>(side)}});
        }
        double sum = 0.0;
        for (std::size_t first = 0; first < cases.size(); first += 16384) {
            const std::size_t count = std::min<std::size_t>(16384, cases.size() - first);
            for (const glm::vec4& one : probe(kScene, "clothCover(a.xy, vec2(6.0, 4.2), 1.0, a.zw)",
                                              std::span(cases).subspan(first, count))) {
                sum += one.x;
            }
        }
        const double share = sum / static_cast<double>(cases.size());
        if (part == 1) truth = share;
        fmt::print("{:3} times: {:.4f}\n", part, share);
        EXPECT_NEAR(share / truth, 1.0, 0.1) << part;
    }
    EXPECT_GT(truth, 0.2);
    EXPECT_LT(truth, 0.98) << "torn";
}

// Groups of plants that a ray passes are left out: none of them may have been met, also from among
// them and from above.
TEST_F(DeepOcean, NoPlantIsLeftOutThatARayMeets) {
    const std::string text = kScene +
                             "vec2 plantsMet(vec3 ro, vec3 rd) {\n"
                             "    float level2 = max(dot(rd.xz, rd.xz), 1e-4);\n"
                             "    vec2 met = vec2(0.0);\n"
                             "    for (int k = 0; k < kelp; ++k) {\n"
                             "        Layer l = plantLayer(k, ro, rd, level2, 0.002);\n"
                             "        if (l.t < 0.3 || l.cover < 0.004) continue;\n"
                             "        met += vec2(1, meetsGroup(k / 5, ro, rd, level2) ? 0 : 1);\n"
                             "    }\n"
                             "    return met;\n"
                             "}\n";
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    std::vector<ProbeCase> cases;
    for (int i = 0; i < 16000; ++i) {
        const float around = 6.2831853f * unit(random), away = 30.0f * unit(random);
        const float y = 1.4f * unit(random) - 0.9f, level = std::sqrt(1.0f - y * y);
        const float heading = 6.2831853f * unit(random);
        cases.push_back({.a = {away * std::cos(around), 0.5f + 12.0f * unit(random),
                               away * std::sin(around), 0.0f},
                         .b = {level * std::cos(heading), y, level * std::sin(heading), 0.0f}});
    }
    double met = 0.0, lost = 0.0;
    for (const glm::vec4& got : probe(text, "plantsMet(a.xyz, b.xyz)", cases)) {
        met += got.x;
        lost += got.y;
    }
    EXPECT_GT(met, 500.0) << "enough to tell";
    EXPECT_EQ(lost, 0.0) << "of " << met;
}

TEST_F(DeepOcean, TheFloorIsDrawnOnce) {
    Player player(kScene, {.size = {32, 18}});
    std::map<std::string, int> counts;
    player.renderer().after_pass = [&](std::size_t index) {
        ++counts[pass_name(player.preset.scene, player.renderer().graph().passes[index].pass)];
    };
    player.draw_frames(0, 5);
    for (const char* once : {"ground", "relief", "tops", "summits", "shade", "grain"}) {
        EXPECT_EQ(counts[once], 1) << once;
    }
    for (const char* always : {"things", "surface", "caustics", "image"}) {
        EXPECT_EQ(counts[always], 5) << always;
    }
}

// Bells keep apart from each other, from the hull and from the floor at all times.
TEST_F(DeepOcean, JellyfishMeetNothing) {
    const Floor floor;
    Player player(kScene, {.preset = "[tweaks]\njellyfish = 12\n", .pass = "things"});
    double nearest = 1e9, lowest = 1e9;
    for (int k = 0; k < 200; ++k) {
        Frame frame = player.frame(0);
        frame.time = 0.83 * k;
        player.draw(frame);
        const std::vector<float> things = player.floats();
        const std::vector<float> bells(things.end() - 4 * 64, things.end());  // the last row
        for (std::size_t i = 0; i < 12; ++i) {
            const glm::dvec4 a(bells[4 * i], bells[4 * i + 1], bells[4 * i + 2], bells[4 * i + 3]);
            lowest = std::min(lowest, a.y - floor.height(a.x, a.z));
            for (std::size_t j = 0; j < i; ++j) {
                const glm::dvec4 b(bells[4 * j], bells[4 * j + 1], bells[4 * j + 2],
                                   bells[4 * j + 3]);
                nearest =
                    std::min(nearest, std::hypot(a.x - b.x, a.y - b.y, a.z - b.z) - a.w - b.w);
            }
        }
    }
    EXPECT_GE(nearest, 0.3) << "m between two bells";
    EXPECT_GE(lowest, 2.9) << "m over the floor";
}

// Every tweak at its least and its most, and all of them: no NaN, no infinity.
TEST_F(DeepOcean, IsFiniteAtEveryExtreme) {
    Player player(kScene, {.size = {24, 14}, .specialise = false});
    const std::vector<TweakValue> defaults = player.preset.values;
    const auto extreme = [&](std::size_t i, bool most) {
        const Tweak& tweak = player.preset.scene.tweaks[i];
        TweakValue value;
        value.fill(most ? 1e9f : -1e9f);
        player.preset.values[i] = clamp_to_range(tweak, value);
    };
    const auto finite = [&](const std::string& what) {
        player.draw(3);
        for (const float one : player.floats()) ASSERT_TRUE(std::isfinite(one)) << what;
    };
    for (const bool most : {false, true}) {
        for (std::size_t i = 0; i < defaults.size(); ++i) {
            extreme(i, most);
            finite(player.preset.scene.tweaks[i].name + (most ? " most" : " least"));
            player.preset.values = defaults;
        }
    }
    for (std::size_t i = 0; i < defaults.size(); ++i) extreme(i, false);
    finite("all least");
}

}  // namespace
}  // namespace glint::deep_ocean_test
