// The pool's waves, march, refraction and light against double precision.
#include "water.h"

#include "looks.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace glint::water_test {
namespace {

// The plane waves as the scene has them, in double from here on.
struct PlaneWaves {
    std::array<double, 8> kx{}, kz{}, height{}, phase{};

    double at(double x, double z) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < 8; ++i)
            sum += height[i] * std::sin(kx[i] * x + kz[i] * z + phase[i]);
        return sum;
    }
    glm::dvec2 slope(double x, double z) const {
        glm::dvec2 sum(0.0);
        for (std::size_t i = 0; i < 8; ++i) {
            const double c = height[i] * std::cos(kx[i] * x + kz[i] * z + phase[i]);
            sum += glm::dvec2(c * kx[i], c * kz[i]);
        }
        return sum;
    }
    glm::dvec3 second(double x, double z) const {
        glm::dvec3 sum(0.0);
        for (std::size_t i = 0; i < 8; ++i) {
            const double s = -height[i] * std::sin(kx[i] * x + kz[i] * z + phase[i]);
            sum += s * glm::dvec3(kx[i] * kx[i], kx[i] * kz[i], kz[i] * kz[i]);
        }
        return sum;
    }
    double slopes() const {
        double sum = 0.0;
        for (std::size_t i = 0; i < 8; ++i) sum += height[i] * std::hypot(kx[i], kz[i]);
        return sum;
    }
    double crests() const {
        double sum = 0.0;
        for (const double h : height) sum += h;
        return sum;
    }
};

PlaneWaves plane_waves_in(const std::vector<glm::vec4>& texels) {
    PlaneWaves waves;
    for (std::size_t i = 0; i < 8; ++i) {
        const std::size_t group = i / 4 * 4;
        const int c = static_cast<int>(i % 4);
        waves.kx[i] = texels[group][c];
        waves.kz[i] = texels[group + 1][c];
        waves.height[i] = texels[group + 2][c];
        waves.phase[i] = texels[group + 3][c];
    }
    return waves;
}

PlaneWaves plane_waves(const std::string& text) {
    std::vector<ProbeCase> cases(8);
    for (int i = 0; i < 8; ++i) cases[static_cast<std::size_t>(i)].a.x = static_cast<float>(i);
    return plane_waves_in(probe(text, "texelFetch(wavelets, ivec2(int(a.x), 0), 0)", cases));
}

// ---- Plane waves --------------------------------------------------------------------------------

TEST_F(Water, HeightsAndSlopesAreThoseOfDoublePrecision) {
    const std::string text = with_defaults(water_text(), {{"waveHeight", "0.08"}});
    const PlaneWaves waves = plane_waves(text);
    std::mt19937 random(1);
    std::vector<ProbeCase> cases(4096);
    for (ProbeCase& c : cases) c.a = {uniform(random, -4, 4), uniform(random, -6, 6), 0, 0};
    const auto shapes = probe(
        text + "vec3 shapeAt(vec2 p) { loadWaves(); return vec3(waterHeight(p), waterSlope(p)); }",
        "shapeAt(a.xy)", cases);
    const auto bends =
        probe(text +
                  "vec4 bendAt(vec2 p) { loadWaves(); vec2 slope; vec3 second; float hidden = "
                  "waterShape(p, vec2(0), vec2(0), slope, second); return vec4(second, hidden); }",
              "bendAt(a.xy)", cases);
    double worst_degrees = 0.0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double x = cases[i].a.x, z = cases[i].a.y;
        // Phases up to some 200 rad in float: 1e-5 rad of rounding, times the height.
        EXPECT_NEAR(shapes[i].x, waves.at(x, z), 2e-6);
        const glm::dvec2 slope = waves.slope(x, z);
        const glm::dvec3 exact = glm::normalize(glm::dvec3(-slope.x, 1.0, -slope.y));
        const glm::dvec3 ours = glm::normalize(glm::dvec3(-shapes[i].y, 1.0, -shapes[i].z));
        worst_degrees = std::max(worst_degrees, glm::length(exact - ours) * 180.0 / kPi);
        const glm::dvec3 second = waves.second(x, z);
        for (int c = 0; c < 3; ++c) EXPECT_NEAR(bends[i][c], second[c], 1e-3);
        EXPECT_NEAR(bends[i].w, 0.0, 1e-6) << "a point hides no slope";
    }
    EXPECT_LE(worst_degrees, 0.01) << "normals within a hundredth of a degree";
}

// Q10, of any waves at any time; without drops, whose heights come from a buffer.
TEST_F(Water, HeightsAndNormalsAreRightWhateverTheCase) {
    const PlayerOptions options{.size = {32, 32}, .specialise = false};
    Player shapes(with_picture(GLINT_REPOSITORY "/fragments/water.frag",
                               "    loadWaves();\n"
                               "    vec2 at = (p / 32.0 - 0.5) * vec2(8.0, 12.0);\n"
                               "    c = vec4(waterHeight(at), waterSlope(at), 1.0);\n"),
                  options);
    Player table(water_text(), {.size = {8, 1}, .pass = "wavelets", .specialise = false});
    const std::vector<std::string> names = {"waveHeight", "longestWave", "windAngle", "windSpread",
                                            "depth"};
    Bar height("Q10 water: height, m", 2e-6), normal("Q10 water: normal, degrees", 0.01);
    search_worst(
        numbers_of(shapes.preset.scene, names) + 1, 80, {&height, &normal}, [&](Dials& dials) {
            const std::string look = look_at(shapes.preset.scene, names, dials) + " rain=0";
            const double time = std::floor(dials.between(0.0, 65536.0 * 64.0)) / 64.0;
            const auto drawn = [&](Player& player) {
                set_look(player, look);
                player.renderer().reset();
                Frame frame = player.frame(0);
                frame.time = time;
                frame.longest_catch_up = 0.01;  // s; the pool is level
                player.draw(frame);
                return pixels_of(player);
            };
            const PlaneWaves waves = plane_waves_in(drawn(table));
            const auto got = drawn(shapes);
            for (std::size_t i = 0; i < got.size(); ++i) {
                const double x = (static_cast<double>(i % 32) - 15.5) / 4.0;
                const double z = (static_cast<double>(i / 32) - 15.5) * 0.375;
                const std::string where =
                    fmt::format("{} at {:.4g} {:.4g} m, {:.3f} s", look, x, z, time);
                const glm::dvec2 slope = waves.slope(x, z);
                const glm::dvec3 exact = normalize(glm::dvec3(-slope.x, 1.0, -slope.y));
                const glm::dvec3 ours = normalize(glm::dvec3(-got[i].y, 1.0, -got[i].z));
                height.see(std::abs(got[i].x - waves.at(x, z)), where);
                normal.see(glm::length(exact - ours) * 180.0 / kPi, where);
            }
        });
}

// Q12: steeper sums than 0.95 fold over, or look like cliffs. Waves that break grow no more.
TEST_F(Water, SlopesOfTheWavesSumToLessThanOne) {
    Bar sum("Q12 water: sum of the waves' slopes", 0.95);
    for (const auto& [height, longest] :
         {std::pair{"0.12", "0.6"}, {"0.12", "1.7"}, {"0.05", "0.6"}, {"0.12", "6"}}) {
        const PlaneWaves waves = plane_waves(
            with_defaults(water_text(), {{"waveHeight", height}, {"longestWave", longest}}));
        sum.see(waves.slopes(), fmt::format("waveHeight={} longestWave={}", height, longest));
    }
    EXPECT_GT(sum.worst(), 0.85) << "the highest are meant to be near breaking";
}
TEST_F(Water, SlopesSumToLessThanOneWhateverTheCase) {
    Bar sum("Q12 water: sum of the waves' slopes", 0.95);
    Player player(water_text(), {.size = {8, 1}, .pass = "wavelets", .specialise = false});
    const std::vector<std::string> names = {"waveHeight", "longestWave", "windAngle", "windSpread",
                                            "depth"};
    search_worst(numbers_of(player.preset.scene, names), 200, {&sum}, [&](Dials& dials) {
        const std::string look = look_at(player.preset.scene, names, dials);
        set_look(player, look);
        player.draw(0);
        sum.see(plane_waves_in(pixels_of(player)).slopes(), look);
    });
}

// What a wide pixel no longer resolves, it must know as roughness: the variance of slope is kept.
TEST_F(Water, AWidePixelKeepsTheVarianceOfTheSlopesThatItHides) {
    const std::string text = with_defaults(water_text(), {{"waveHeight", "0.05"}});
    const PlaneWaves waves = plane_waves(text);
    double variance = 0.0;
    for (std::size_t i = 0; i < 8; ++i) {
        variance += 0.5 * waves.height[i] * waves.height[i] *
                    (waves.kx[i] * waves.kx[i] + waves.kz[i] * waves.kz[i]);
    }
    const auto wide =
        probe(text +
                  "vec4 wideAt(vec2 p) { loadWaves(); vec2 slope; vec3 second; float hidden = "
                  "waterShape(p, vec2(9, 0), vec2(0, 9), slope, second); "
                  "return vec4(slope, hidden, 0); }",
              "wideAt(a.xy)", std::vector<ProbeCase>(1));
    EXPECT_NEAR(wide[0].x, 0.0, 1e-3);
    EXPECT_NEAR(wide[0].z / variance, 1.0, 0.01);
}

// After an hour, a day, a month and a year the phases are still right (the bar for ageing), and
// after each 65536 s the picture is the same, bit for bit.
TEST_F(Water, WavesHoldForAYear) {
    const std::string text = water_text();
    Player player(text, {.preset = "[tweaks]\nripples = false\n", .pass = "wavelets"});
    for (const double time : {1.0, 3600.0, 86400.0, 2592000.0, 31536000.0}) {
        SCOPED_TRACE(time);
        Frame frame;
        frame.time = time;
        player.draw(frame);
        const std::vector<float> texels = player.floats();
        for (std::size_t i = 0; i < 8; ++i) {
            const std::size_t group = i / 4 * 4, c = i % 4;
            const double kx = texels[group * 4 + c], kz = texels[(group + 1) * 4 + c];
            const double k = std::hypot(kx, kz);
            const double hz = std::sqrt(9.81 * k * std::tanh(k * 1.5)) / (2 * kPi);
            // The frequency is a whole multiple of 1/65536 Hz, cut from the physical one.
            double best = 1.0;
            for (int step = -1; step <= 1; ++step) {
                const double kept = (std::floor(hz * 65536.0) + step) / 65536.0;
                const double turns = std::fmod(kept * time, 1.0);
                const double ours = texels[(group + 3) * 4 + c] / (2 * kPi);
                double offset = static_cast<double>(i) * 0.7548777;
                double apart = std::remainder(ours - offset + turns, 1.0);
                best = std::min(best, std::abs(apart));
            }
            EXPECT_LE(best, 1e-5) << "cycles, of wave " << i;
        }
    }
    Player picture(text, {.size = {48, 27}, .preset = "[tweaks]\nripples = false\n"});
    const auto drawn_at = [&](double time) {
        Frame frame;
        frame.time = time;
        picture.draw(frame);
        return picture.floats();
    };
    const std::vector<float> young = drawn_at(3.0), moved = drawn_at(3.1);
    EXPECT_NE(young, moved);
    for (const double days : {1.0, 30.0, 365.0})
        EXPECT_EQ(young, drawn_at(3.0 + 65536.0 * std::round(days * 86400.0 / 65536.0))) << days;
}

// Waves that are long beside the depth run slower: (2 pi f)^2 = g k tanh(k d), in steps of 1/65536
// Hz.
TEST_F(Water, LongWavesFeelTheFloor) {
    Player player(water_text(), {.preset = "[tweaks]\nripples = false\ndepth = 0.8\n"
                                           "longestWave = 6\n",
                                 .pass = "wavelets"});
    const auto drawn_at = [&](double time) {
        Frame frame;
        frame.time = time;
        player.draw(frame);
        return player.floats();
    };
    const std::vector<float> before = drawn_at(0.0), after = drawn_at(1.0);
    for (std::size_t i = 0; i < 8; ++i) {
        const std::size_t group = i / 4 * 4, c = i % 4, phase = (group + 3) * 4 + c;
        const double k = std::hypot(before[group * 4 + c], before[(group + 1) * 4 + c]);
        const double hz = std::sqrt(9.81 * k * std::tanh(k * 0.8)) / (2 * kPi);
        const double turned = (before[phase] - after[phase]) / (2 * kPi);
        EXPECT_NEAR(std::remainder(turned - hz, 1.0), 0.0, 2.0 / 65536.0) << "wave " << i;
    }
}

// ---- The march ----------------------------------------------------------------------------------

// The first crossing in double: 16384 steps, then 60 bisections.
double brute_force(const PlaneWaves& waves, const glm::dvec3& o, const glm::dvec3& d, double end) {
    const auto gap = [&](double t) {
        return o.y + t * d.y - waves.at(o.x + t * d.x, o.z + t * d.z);
    };
    constexpr int kSteps = 16384;
    double before = 0.0;
    for (int i = 1; i <= kSteps; ++i) {
        const double t = end * i / kSteps;
        if (gap(t) <= 0.0) {
            double low = before, high = t;
            for (int j = 0; j < 60; ++j) {
                const double middle = 0.5 * (low + high);
                (gap(middle) > 0.0 ? low : high) = middle;
            }
            return high;
        }
        before = t;
    }
    return -1.0;
}

// Looking down by 20, 5 and 1.5 degrees: at most 0.5 % of hits off by 5 cm, as many mistaken for
// misses or the reverse, 32 evaluations on average, 0.1 % out of steps.
TEST_F(Water, TheMarchFindsTheFirstCrossing) {
    const std::string text = with_defaults(water_text(), {{"waveHeight", "0.06"}});
    const PlaneWaves waves = plane_waves(text);
    const std::string functions =
        text +
        "vec2 marched(vec3 ro, vec3 rd) { loadWaves(); int n;"
        " float t = marchWater(ro, rd, kFar, false, n); return vec2(t, n); }";
    for (const double degrees : {20.0, 5.0, 1.5}) {
        SCOPED_TRACE(degrees);
        std::mt19937 random(7);
        std::vector<ProbeCase> cases(2000);
        for (ProbeCase& c : cases) {
            const double a = uniform(random, 0, 2 * kPi), down = degrees * kPi / 180.0;
            c.a = {uniform(random, -3.9, 3.9), 0.061f, uniform(random, -5.9, 5.9), 0};
            const glm::dvec3 d(std::cos(down) * std::sin(a), -std::sin(down),
                               std::cos(down) * std::cos(a));
            c.b = glm::vec4(glm::vec3(d), 0);
        }
        const auto found = probe(functions, "marched(a.xyz, b.xyz)", cases);
        int hits = 0, wrong = 0, mistaken = 0, out_of_steps = 0;
        double evaluations = 0.0;
        for (std::size_t i = 0; i < cases.size(); ++i) {
            const glm::dvec3 o(cases[i].a), d(cases[i].b);
            const auto leave = [](double at, double along, double half) {
                return along == 0.0 ? 1e9 : ((along > 0.0 ? half : -half) - at) / along;
            };
            const double end = std::min(leave(o.x, d.x, kHalfWidth), leave(o.z, d.z, kHalfLength));
            const double exact = brute_force(waves, o, d, end);
            const bool hit = found[i].x < 1e8f;
            mistaken += hit != (exact >= 0.0);
            if (hit && exact >= 0.0) {
                ++hits;
                wrong += std::abs(found[i].x - exact) > 0.05;
            }
            evaluations += found[i].y;
            out_of_steps += found[i].y >= 65.0f;
        }
        const double count = static_cast<double>(cases.size());
        RecordProperty("wrong", fmt::format("{}", wrong));
        fmt::print(
            "{} degrees: {} hits, {:.2f} % wrong, {:.2f} % hit or miss, {:.1f} evaluations, "
            "{:.2f} % out of steps\n",
            degrees, hits, 100.0 * wrong / hits, 100.0 * mistaken / count, evaluations / count,
            100.0 * out_of_steps / count);
        EXPECT_GT(hits, 500);
        EXPECT_LE(wrong, 0.005 * hits);
        EXPECT_LE(mistaken, 0.005 * count);
        EXPECT_LE(evaluations / count, 32.0);
        EXPECT_LE(out_of_steps, 0.001 * count);
    }
}

// Rays from an eye to points just above and below the waterline of columns, ball and steps: none
// gets past what stands there and the water round it.
TEST_F(Water, ThingsCrossTheSurfaceWithoutAGap) {
    const std::string text = with_defaults(water_text(), {{"waveHeight", "0.06"}});
    const PlaneWaves waves = plane_waves(text);
    std::mt19937 random(3);
    std::vector<ProbeCase> cases;
    std::vector<double> distances;
    while (cases.size() < 4000) {
        const glm::dvec3 eye(uniform(random, -3, 3), uniform(random, 0.4, 2.5), 7.0);
        glm::dvec3 p;
        switch (cases.size() % 3) {
            case 0: {  // the near side of a column's foot
                const double a = uniform(random, -0.9, 0.9);
                p = {-2.55 + 5.1 * static_cast<double>(random() % 2) + 0.31 * std::sin(a), 0,
                     -4.3 + 3.4 * static_cast<double>(random() % 3) + 0.31 * std::cos(a)};
                break;
            }
            case 1: {  // the near side of the ball, at the height of the water
                const double a = uniform(random, -0.9, 0.9), r = std::sqrt(0.55 * 0.55 - 0.01);
                p = {-0.60 + r * std::sin(a), 0, -1.0 + r * std::cos(a)};
                break;
            }
            default:  // the top step's riser
                p = {4.0 - 0.42, 0, uniform(random, 1.2, 4.2)};
        }
        p.y = waves.at(p.x, p.z) + uniform(random, -0.004, 0.004);
        if (cases.size() % 3 == 2 && p.y > 0.05) continue;  // the water covers it
        if (cases.size() % 3 == 1) {                        // back onto the ball at this height
            const glm::dvec2 axis(-0.60, -1.0), off = glm::dvec2(p.x, p.z) - axis;
            const double r = std::sqrt(0.55 * 0.55 - (p.y - 0.1) * (p.y - 0.1));
            const glm::dvec2 on = axis + off * (r / glm::length(off));
            p.x = on.x, p.z = on.y;
        }
        const glm::dvec3 d = glm::normalize(p - eye);
        cases.push_back({.a = glm::vec4(glm::vec3(eye), 0), .b = glm::vec4(glm::vec3(d), 0)});
        distances.push_back(glm::length(p - eye));
    }
    const auto first = probe(
        text +
            "float firstMet(vec3 ro, vec3 rd) { loadWaves(); int n; float t = intersect(ro, rd, "
            "false).t; return min(t, marchWater(ro, rd, t, false, n)); }",
        "firstMet(a.xyz, normalize(b.xyz))", cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        // 4 mm of height are 8 cm along a ray at the least slope here.
        EXPECT_LE(first[i].x, distances[i] + 0.08) << i;
    }
}

// ---- Refraction and light -----------------------------------------------------------------------

TEST_F(Water, RefractionIsFiniteEverywhereAndSnells) {
    std::mt19937 random(5);
    std::vector<ProbeCase> cases;
    for (int i = 0; i < 16000; ++i) {
        // Any normal within the waves' reach, any direction against it, grazing ones and exact
        // ones.
        const double tilt = i % 3 == 0 ? 0.0 : uniform(random, 0, 1.2),
                     a = uniform(random, 0, 2 * kPi);
        const glm::dvec3 n(std::sin(tilt) * std::sin(a), std::cos(tilt),
                           std::sin(tilt) * std::cos(a));
        glm::dvec3 side = glm::cross(n, glm::dvec3(0.3, 0.1, 0.9));
        side = glm::normalize(side);
        const double level = i % 7 == 0 ? 1e-5 * i / 16000 : uniform(random, 0, kPi / 2);
        const glm::dvec3 d = std::cos(level) * side - std::sin(level) * n;
        const float eta = std::array{1.0f / 1.333f, 1.333f, 1.0f}[static_cast<std::size_t>(i) % 3];
        cases.push_back(
            {.a = glm::vec4(glm::vec3(glm::normalize(d)), eta), .b = glm::vec4(glm::vec3(n), 0)});
    }
    const std::string functions =
        water_text() +
        "Ray bent(vec3 d, vec3 n, float eta, out bool passes) { Ray r; r.o = vec3(0); r.d = d; "
        "r.ox "
        "= vec3(.1, 0, 0); r.oy = vec3(0, 0, .1); r.dx = vec3(.001); r.dy = vec3(.001); r.carry = "
        "vec3(1); r.rough = 0.0; r.wet = false; passes = refractRay(r, n, vec3(.1, 0, 0), vec3(0, "
        "0, .1), eta); return r; }"
        "vec4 bentWay(vec3 d, vec3 n, float eta) { bool ok; Ray r = bent(d, n, eta, ok); return "
        "vec4(r.d, ok); }"
        "float bentSum(vec3 d, vec3 n, float eta) { bool ok; Ray r = bent(d, n, eta, ok); return "
        "dot(r.dx, vec3(1)) + dot(r.dy, vec3(1)) + fresnel(clamp(-dot(d, n), 0.0, 1.0), 1.0 / "
        "eta); }";
    const auto ways = probe(functions, "bentWay(a.xyz, b.xyz, a.w)", cases);
    const auto sums = probe(functions, "bentSum(a.xyz, b.xyz, a.w)", cases);
    const auto shares =
        probe(functions, "fresnel(clamp(-dot(a.xyz, b.xyz), 0.0, 1.0), 1.0 / a.w)", cases);
    double worst = 0.0, worst_share = 0.0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        ASSERT_TRUE(std::isfinite(sums[i].x)) << i;
        const glm::dvec3 d(cases[i].a), n(cases[i].b);
        const double eta = cases[i].a.w, cos_i = -glm::dot(d, n);
        const double k = 1.0 - eta * eta * (1.0 - cos_i * cos_i);
        if (std::abs(k) < 1e-5) continue;  // at the critical angle either answer is right
        ASSERT_EQ(ways[i].w, k > 0.0 ? 1.0f : 0.0f) << i;
        const double cos_t = std::sqrt(std::max(k, 0.0));
        if (k > 0.0) {
            const glm::dvec3 exact = glm::normalize(eta * d + (eta * cos_i - cos_t) * n);
            worst = std::max(worst, glm::length(exact - glm::dvec3(ways[i])));
        }
        double share = 1.0;
        if (k > 0.0) {
            const double s = (eta * cos_i - cos_t) / (eta * cos_i + cos_t);
            const double p = (cos_i - eta * cos_t) / (cos_i + eta * cos_t);
            share = 0.5 * (s * s + p * p);
        }
        if (std::abs(k) > 1e-3 && cos_i > 1e-3)
            worst_share = std::max(worst_share, std::abs(share - shares[i].x));
    }
    // Unit vectors in float: 1e-7 of length each; at grazing angles a root doubles the digits lost.
    EXPECT_LE(worst, 2e-4);
    EXPECT_LE(worst_share, 2e-4);
}

TEST_F(Water, LevelWaterGathersNoLight) {
    const std::string text =
        with_defaults(water_text(), {{"waveHeight", "0"}, {"depth", "4"}}) +
        "float gatheredAt(vec3 p, vec3 sun) { loadWaves(); mat2 m; vec2 entry; vec3 light = "
        "sunUnderWater(sun, m); return gathered(p.xz, -p.y, light, m, entry); }";
    std::mt19937 random(9);
    std::vector<ProbeCase> cases(500);
    for (ProbeCase& c : cases) {
        const double up = uniform(random, 0.02, kPi / 2), a = uniform(random, 0, 2 * kPi);
        c.a = {uniform(random, -4, 4), uniform(random, -4, 0), uniform(random, -6, 6), 0};
        c.b = {std::cos(up) * std::sin(a), std::sin(up), std::cos(up) * std::cos(a), 0};
    }
    for (const glm::vec4& light : probe(text, "gatheredAt(a.xyz, b.xyz)", cases))
        EXPECT_NEAR(light.x, 1.0, 1e-5);
}

// Calm waves, so that each floor point is lit through one place: found by Newton in double, with
// the area from differences of exact refraction. RMSE at most 1e-2.
TEST_F(Water, CalmWavesGatherLightAsTheyShould) {
    const std::string scene = with_defaults(
        water_text(), {{"waveHeight", "0.01"}, {"longestWave", "3"}, {"depth", "0.8"}});
    const PlaneWaves waves = plane_waves(scene);
    const std::string text =
        scene +
        "float gatheredAt(vec3 p, vec3 sun) { loadWaves(); mat2 m; vec2 entry; vec3 light = "
        "sunUnderWater(sun, m); return gathered(p.xz, -p.y, light, m, entry); }";
    const glm::dvec3 sun = glm::normalize(glm::dvec3(0.3, 0.8, -0.2));
    const double down = 0.8;
    const auto landing = [&](const glm::dvec2& s) {
        const glm::dvec2 slope = waves.slope(s.x, s.y);
        const glm::dvec3 n = glm::normalize(glm::dvec3(-slope.x, 1.0, -slope.y));
        const double eta = 1.0 / 1.333, cos_i = glm::dot(sun, n);
        const double cos_t = std::sqrt(1.0 - eta * eta * (1.0 - cos_i * cos_i));
        const glm::dvec3 l = -eta * sun + (eta * cos_i - cos_t) * n;
        return s + (down + waves.at(s.x, s.y)) * glm::dvec2(l.x, l.z) / -l.y;
    };
    std::mt19937 random(11);
    std::vector<ProbeCase> cases(2000);
    for (ProbeCase& c : cases)
        c.a = {uniform(random, -3, 3), -0.8f, uniform(random, -5, 5), 0},
        c.b = glm::vec4(glm::vec3(sun), 0);
    const auto ours = probe(text, "gatheredAt(a.xyz, b.xyz)", cases);
    double error = 0.0, contrast = 0.0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const glm::dvec2 target(cases[i].a.x, cases[i].a.z);
        glm::dvec2 s = target;
        double j = 1.0;
        for (int step = 0; step < 40; ++step) {
            constexpr double e = 1e-5;
            const glm::dvec2 f = landing(s) - target;
            const glm::dvec2 fx =
                (landing(s + glm::dvec2(e, 0)) - landing(s - glm::dvec2(e, 0))) / (2 * e);
            const glm::dvec2 fz =
                (landing(s + glm::dvec2(0, e)) - landing(s - glm::dvec2(0, e))) / (2 * e);
            j = fx.x * fz.y - fx.y * fz.x;
            s -= glm::dvec2(f.x * fz.y - f.y * fz.x, fx.x * f.y - fx.y * f.x) / j;
        }
        error += std::pow(ours[i].x - 1.0 / std::abs(j), 2.0);
        contrast += std::pow(1.0 / std::abs(j) - 1.0, 2.0);
    }
    error = std::sqrt(error / static_cast<double>(cases.size()));
    contrast = std::sqrt(contrast / static_cast<double>(cases.size()));
    fmt::print("caustics: RMSE {:.2e} where the contrast is {:.2e}\n", error, contrast);
    EXPECT_GT(contrast, 0.02);
    EXPECT_LE(error, 1e-2);
}

}  // namespace
}  // namespace glint::water_test
