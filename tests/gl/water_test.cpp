// The pool: its march, waves, refraction and light against double precision, its simulation against
// a kernel and a closed form of its own, and what its two ways of drawing leave out.
#include "probe.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <sstream>

namespace glint {
namespace {

using Water = GlTest;
constexpr double kPi = std::numbers::pi;
constexpr double kHalfWidth = 4.0, kHalfLength = 6.0;  // m, of the pool

std::string water_text() {
    std::ifstream file(GLINT_REPOSITORY "/fragments/water.frag");
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

// The scene with other defaults, so that probes see them: {"waveHeight", "0.05"}.
std::string with_defaults(std::string text,
                          const std::vector<std::pair<std::string, std::string>>& defaults) {
    for (const auto& [name, value] : defaults) {
        std::size_t declared = text.find(" " + name + ";");
        while (text.compare(text.rfind('\n', declared) + 1, 7, "uniform") != 0)
            declared = text.find(" " + name + ";", declared + 1);
        const std::size_t start = text.find("//@ ", declared) + 4;
        const std::size_t end = text.find(' ', start);
        text.replace(start, end - start, value);
    }
    return text;
}

std::string replaced(std::string text, std::string_view old, std::string_view now) {
    std::size_t count = 0;
    for (std::size_t at = text.find(old); at != std::string::npos; at = text.find(old, at)) {
        text.replace(at, old.size(), now);
        at += now.size();
        ++count;
    }
    if (count == 0) throw std::runtime_error(fmt::format("the scene no longer says {}", old));
    return text;
}

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
    double crests() const {
        double sum = 0.0;
        for (const double h : height) sum += h;
        return sum;
    }
};

PlaneWaves plane_waves(const std::string& text) {
    std::vector<ProbeCase> cases(8);
    for (int i = 0; i < 8; ++i) cases[static_cast<std::size_t>(i)].a.x = static_cast<float>(i);
    const auto texels = probe(text, "texelFetch(wavelets, ivec2(int(a.x), 0), 0)", cases);
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

float uniform(std::mt19937& random, double low, double high) {
    return static_cast<float>(low + (high - low) * (static_cast<double>(random()) / 4294967296.0));
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

// ---- The simulation -----------------------------------------------------------------------------

// pcg3d, Jarzynski and Olano 2020, as the scene has it.
glm::vec3 random3(std::int32_t x, std::int32_t y, std::int32_t z) {
    std::array<std::uint32_t, 3> v = {static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y),
                                      static_cast<std::uint32_t>(z)};
    for (std::uint32_t& c : v) c = c * 1664525u + 1013904223u;
    const auto mix = [&] {
        v[0] += v[1] * v[2];
        v[1] += v[2] * v[0];
        v[2] += v[0] * v[1];
    };
    mix();
    for (std::uint32_t& c : v) c ^= c >> 16u;
    mix();
    return glm::vec3(v[0] >> 8u, v[1] >> 8u, v[2] >> 8u) / 16777216.0f;
}

// The wave equation in double: heights, their speeds half a step earlier, squared wave speeds.
struct Pond {
    int width = 0, length = 0;
    double dt = 0.0, damping = 0.0;
    std::vector<double> h{}, v{}, c2{}, old_c2{};

    std::size_t at(int x, int z) const {
        return static_cast<std::size_t>(std::clamp(z, 0, length - 1) * width +
                                        std::clamp(x, 0, width - 1));
    }
    template <class Kick>
    void step(Kick kick) {
        const double cell = 2 * kHalfWidth / width, kept = std::exp(-damping * dt);
        const std::vector<double> now = h;
        for (int z = 0; z < length; ++z) {
            for (int x = 0; x < width; ++x) {
                const std::size_t i = at(x, z);
                const std::array<std::size_t, 4> round = {at(x - 1, z), at(x + 1, z), at(x, z - 1),
                                                          at(x, z + 1)};
                double flux = 0.0, mean = 0.0;
                for (const std::size_t j : round) {
                    const double sum = old_c2[i] + old_c2[j];
                    if (sum > 0.0) flux += 2 * old_c2[i] * old_c2[j] / sum * (now[j] - now[i]);
                    mean += 0.25 * now[j];
                }
                const double px = ((x + 0.5) / width - 0.5) * 2 * kHalfWidth;
                const double pz = ((z + 0.5) / length - 0.5) * 2 * kHalfLength;
                v[i] = kept * v[i] + dt * 0.5 * (1 + kept) * flux / (cell * cell) + kick(px, pz);
                h[i] = now[i] + dt * v[i];
                if (c2[i] <= 0.0) h[i] = mean, v[i] = 0.0;
            }
        }
        old_c2 = c2;
    }
};

// The real pass in the real scene, with columns, ball, steps and rain, against the kernel above.
TEST_F(Water, TheSimulationIsTheWaveEquationOfTheKernel) {
    const std::string preset = "[tweaks]\nrain = 30\ndamping = 0.6\nwaveSpeed = 2.5\n";
    constexpr int kWidth = 256, kLength = 384, kSteps = 240;
    Player bed(water_text(), {.preset = preset, .pass = "bed"});
    bed.still(0.0);
    const std::vector<float> grounds = bed.floats();
    Pond pond{.width = kWidth, .length = kLength, .dt = 1.0 / 240, .damping = 0.6};
    pond.h.assign(kWidth * kLength, 0.0);
    pond.v = pond.old_c2 = pond.h;
    for (std::size_t i = 0; i < pond.h.size(); ++i) pond.c2.push_back(grounds[4 * i]);
    int drops = 0, solid = 0;
    for (const double c2 : pond.c2) solid += c2 <= 0.0;
    EXPECT_GT(solid, 2000) << "six columns, a ball and a step";
    for (int k = 1; k <= kSteps; ++k) {
        const auto at_tick = static_cast<std::int32_t>(tick(k / 240.0));
        const glm::vec3 r = random3(at_tick, 17, 5), s = random3(at_tick, 29, 7);
        const bool falls = r.z < 30.0f / 240.0f;
        drops += falls;
        pond.step([&](double x, double z) {
            if (!falls) return 0.0;
            const double size = 0.13 * (0.8 + 0.5 * s.x);
            const double dx = x - (2.0 * r.x - 1.0) * kHalfWidth;
            const double dz = z - (2.0 * r.y - 1.0) * kHalfLength;
            const double q = std::min((dx * dx + dz * dz) / (size * size), 50.0);
            return -0.9 * (0.3 + 0.9 * s.y) * (1 - q) * std::exp(-q);
        });
    }
    Player player(water_text(), {.preset = preset, .pass = "pond"});
    player.still(1.0);
    const std::vector<float> texels = player.floats();
    double error = 0.0, size = 0.0;
    for (std::size_t i = 0; i < pond.h.size(); ++i) {
        error += std::pow(texels[4 * i] - pond.h[i], 2.0);
        size += std::pow(pond.h[i], 2.0);
    }
    EXPECT_GT(drops, 15);
    fmt::print("{} drops, {:.2e} of {:.2e} m\n", drops, std::sqrt(error / kWidth / kLength),
               std::sqrt(size / kWidth / kLength));
    EXPECT_LE(std::sqrt(error / size), 1e-4) << "240 steps in float";
}

// A press of the mouse in an empty pool, whose waves have a closed form as a sum of cosines.
struct Press {
    static constexpr double kSize = 0.5, kForce = 1.0, kSpeed = 2.0, kDamping = 0.35, kStart = 0.1;
    glm::dvec2 place{0.0};

    // Heights on every `stride`-th cell of a grid, at a time.
    std::vector<double> heights(int width, int length, int stride, double time) const {
        constexpr int kModes = 80;
        std::vector<double> sum(static_cast<std::size_t>((width / stride) * (length / stride)),
                                0.0);
        const double w = 2 * kHalfWidth, l = 2 * kHalfLength, age = time - kStart;
        for (int n = 0; n < kModes * 3 / 2; ++n) {
            for (int m = 0; m < kModes; ++m) {
                const double kx = m * kPi / w, kz = n * kPi / l, k2 = kx * kx + kz * kz;
                const double u = 0.25 * k2 * kSize * kSize;
                const double weight = -kForce * kPi * kSize * kSize * u * std::exp(-u);
                const double norm = (m == 0 ? 1 : 2) * (n == 0 ? 1 : 2) / (w * l);
                const std::complex<double> root = std::sqrt(
                    std::complex<double>(kSpeed * kSpeed * k2 - 0.25 * kDamping * kDamping));
                const std::complex<double> swing =
                    std::abs(root) < 1e-9 ? age : std::sin(root * age) / root;
                const double amplitude = weight * norm * std::cos(kx * (place.x + kHalfWidth)) *
                                         std::cos(kz * (place.y + kHalfLength)) * swing.real() *
                                         std::exp(-0.5 * kDamping * age);
                if (std::abs(amplitude) < 1e-12) continue;
                std::size_t i = 0;
                for (int z = stride / 2; z < length; z += stride) {
                    const double cz = std::cos(kz * (z + 0.5) / length * l);
                    for (int x = stride / 2; x < width; x += stride, ++i)
                        sum[i] += amplitude * cz * std::cos(kx * (x + 0.5) / width * w);
                }
            }
        }
        return sum;
    }
};

// `scale` times fewer cells and steps.
std::string coarser(int scale) {
    const std::string text = with_defaults(water_text(), {{"columns", "off"},
                                                          {"mirrorBall", "off"},
                                                          {"steps", "off"},
                                                          {"rain", "0"},
                                                          {"depth", "4"},
                                                          {"waveSpeed", "2"},
                                                          {"dropSize", "0.5"},
                                                          {"dropForce", "1"}});
    return replaced(replaced(text, "step=1/240", fmt::format("step=1/{}", 240 / scale)),
                    "size=256x384", fmt::format("size={}x{}", 256 / scale, 384 / scale));
}
const std::string kPressOnce =
    "[[events]]\nt = 0.1005\nmouse = [0.45, 0.3]\ndown = true\n"
    "[[events]]\nt = 0.2\nmouse = [0.45, 0.3]\ndown = false\n";
constexpr glm::ivec2 kPressSize(160, 80);

glm::dvec2 place_of_press() {
    Player player(coarser(1), {.size = kPressSize, .preset = kPressOnce, .pass = "pointer"});
    player.still(25.0 / 240.0);
    const glm::vec4 texel = player.pixel(0, 0);
    return {texel.x, texel.y};
}

TEST_F(Water, TheSimulationIsOfSecondOrder) {
    const Press press{.place = place_of_press()};
    ASSERT_LT(std::abs(press.place.x), 3.0);
    ASSERT_LT(std::abs(press.place.y), 5.0);
    constexpr double kTime = 1.6;  // s: the rings have met a wall
    std::vector<double> errors;
    for (const int scale : {4, 2, 1}) {
        Player player(coarser(scale), {.size = kPressSize, .preset = kPressOnce, .pass = "pond"});
        player.still(kTime);
        const std::vector<float> texels = player.floats();
        const int width = 256 / scale, length = 384 / scale, stride = 8 / scale;
        const std::vector<double> exact = press.heights(width, length, stride, kTime);
        double error = 0.0, size = 0.0;
        std::size_t i = 0;
        for (int z = stride / 2; z < length; z += stride) {
            for (int x = stride / 2; x < width; x += stride, ++i) {
                error +=
                    std::pow(texels[static_cast<std::size_t>(4 * (z * width + x))] - exact[i], 2);
                size += exact[i] * exact[i];
            }
        }
        errors.push_back(std::sqrt(error / size));
    }
    for (std::size_t i = 1; i < errors.size(); ++i) {
        const double order = std::log2(errors[i - 1] / errors[i]);
        fmt::print("relative error {:.3e}, then {:.3e}: order {:.2f}\n", errors[i - 1], errors[i],
                   order);
        EXPECT_NEAR(order, 2.0, 0.2);
    }
}

TEST_F(Water, TheSimulationIsTheSameAtEveryFrameRate) {
    const std::string text = coarser(2);
    std::vector<float> first;
    for (const double fps : {30.0, 60.0, 240.0}) {
        Player player(text, {.size = kPressSize, .preset = kPressOnce, .pass = "pond", .fps = fps});
        player.still(1.0);
        if (first.empty()) first = player.floats();
        EXPECT_EQ(player.floats(), first) << fps;
    }
}

// A hundred thousand steps at the greatest Courant number, 0.5, and the least damping: the water
// never rises above what the press left.
TEST_F(Water, AHundredThousandStepsStayBounded) {
    const std::string text =
        replaced(replaced(with_defaults(coarser(1), {{"waveSpeed", "3.75"}, {"damping", "0.05"}}),
                          "step=1/240", "step=1/30"),
                 "size=256x384", "size=32x48");
    Player player(text, {.size = kPressSize, .preset = kPressOnce, .pass = "pond", .fps = 2});
    const auto highest = [&](double time) {
        player.still(time);
        float most = 0.0f;
        for (const float value : player.floats()) {
            EXPECT_TRUE(std::isfinite(value));
            most = std::max(most, std::abs(value));
        }
        return most;
    };
    double most = 0.0;
    for (const double time : {0.2, 0.3, 0.5, 1.0}) {
        player.renderer().reset();
        player.still(time);
        const std::vector<float> texels = player.floats();
        for (std::size_t i = 0; i < texels.size(); i += 4)
            most = std::max(most, std::abs(static_cast<double>(texels[i])));
    }
    EXPECT_GT(most, 0.01);
    EXPECT_LT(most, 0.3) << "the ceiling is not what holds it";
    player.renderer().reset();
    EXPECT_LE(highest(1e5 / 30.0), 14.1f) << "the squared wave speed, which is in there, too";
    const std::vector<float> texels = player.floats();
    for (std::size_t i = 0; i < texels.size(); i += 4) EXPECT_LE(std::abs(texels[i]), most);
}

// A texel that went bad, by whatever mishap, does not spread.
TEST_F(Water, ANotANumberInThePondIsGoneAtOnce) {
    for (const char* bad :
         {"uintBitsToFloat(0x7fc00000u)", "uintBitsToFloat(0x7f800000u)", "1e30"}) {
        SCOPED_TRACE(bad);
        const std::string text = replaced(
            coarser(4), "    colour = vec4(height, clamp(speed",
            fmt::format(
                "    if (iFrame == 20 && c == ivec2(30, 40)) {{ colour = vec4({}); return; }}\n"
                "    colour = vec4(height, clamp(speed",
                bad));
        Player player(text, {.size = kPressSize, .preset = kPressOnce, .pass = "pond"});
        player.still(21.0 / 60.0);
        EXPECT_FALSE(std::abs(player.pixel(30, 40).x) < 1e9f) << "it is there";
        player.still(23.0 / 60.0);
        for (const float value : player.floats()) ASSERT_LT(std::abs(value), 10.0f);
    }
}

// ---- What is drawn ------------------------------------------------------------------------------

std::vector<std::string> drawn(const std::string& tweaks) {
    const Player player(water_text(), {.size = {16, 9}, .preset = "[tweaks]\n" + tweaks});
    std::vector<std::string> names;
    for (const GraphPass& pass : player.renderer().graph().passes)
        names.push_back(pass_name(player.preset.scene, pass.pass));
    return names;
}

TEST_F(Water, EachWayOfDrawingLeavesOutThePassesOfTheOther) {
    const auto has = [](const std::vector<std::string>& names, const char* name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    const auto traced = drawn("water = \"traced\"\n"), planar = drawn("water = \"planar\"\n");
    for (const char* name : {"mirror", "below", "dudv"}) {
        EXPECT_FALSE(has(traced, name)) << name;
        EXPECT_TRUE(has(planar, name)) << name;
    }
    EXPECT_TRUE(has(traced, "pond"));
    const auto still = drawn("water = \"traced\"\nripples = false\n");
    for (const char* name : {"bed", "pointer", "pond", "relief", "peaks", "crest"})
        EXPECT_FALSE(has(still, name)) << name;
    EXPECT_FALSE(has(drawn("ripples = false\nwaveHeight = 0\nlanterns = 0\n"), "floats"));
}

// On level water the classic pictures are the truth, but for what their own pixels blur: both ways
// must show the same, waterlines included.
TEST_F(Water, BothWaysShowTheSameStillWater) {
    const std::string tweaks = "ripples = false\nwaveHeight = 0\n";
    constexpr glm::ivec2 kSize(192, 108);
    Player traced(water_text(),
                  {.size = kSize, .preset = "[tweaks]\nwater = \"traced\"\n" + tweaks});
    Player planar(water_text(),
                  {.size = kSize, .preset = "[tweaks]\nwater = \"planar\"\n" + tweaks});
    traced.draw(0);
    planar.draw(0);
    const std::vector<float> a = traced.floats(), b = planar.floats();
    double sum = 0.0;
    int far_off = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += std::pow(a[i] - b[i], 2.0);
        far_off += std::abs(a[i] - b[i]) > 0.25f;
    }
    const double rmse = std::sqrt(sum / static_cast<double>(a.size()));
    fmt::print("still water: RMSE {:.4f}, {:.3f} % of values off by a quarter\n", rmse,
               100.0 * far_off / static_cast<double>(a.size()));
    EXPECT_LE(rmse, 0.04) << "edges and joints are as sharp as a picture's pixels";
    EXPECT_LE(far_off, 0.004 * static_cast<double>(a.size()));
}

// The scene without its display curve, which would hide what is not a number, and a coarse pond.
std::string bare() {
    return replaced(
        replaced(water_text(), "vec4(display(exp2(exposure) * sum / float(antialias)), 1.0)",
                 "vec4(exp2(exposure) * sum / float(antialias), 1.0)"),
        "size=256x384", "size=64x96");
}

// The first pass of which a buffer holds something that is not finite.
std::string not_finite(const Player& player) {
    const Renderer& renderer = player.renderer();
    for (std::size_t i = 0; i < renderer.graph().passes.size(); ++i) {
        for (const float value : renderer.read_buffer(i, 0)) {
            if (!std::isfinite(value))
                return pass_name(player.preset.scene, renderer.graph().passes[i].pass);
        }
    }
    return {};
}

const std::string kPressNow = "[[events]]\nt = 0.01\nmouse = [0.5, 0.3]\ndown = true\n";

// A tweak at its least or greatest value.
TweakValue at_end(const Tweak& tweak, bool greatest) {
    TweakValue value{};
    double end = greatest ? 1.0 : 0.0;
    if (tweak.min) end = greatest ? *tweak.max : *tweak.min;
    if (!tweak.names.empty()) end = greatest ? static_cast<double>(tweak.names.size()) - 1.0 : 0.0;
    value.fill(end);
    return value;
}

TEST_F(Water, EveryTweakAtItsEndsIsFinite) {
    for (const char* way : {"planar", "traced"}) {
        Player player(bare(), {.size = {24, 14},
                               .preset = fmt::format("[tweaks]\nwater = \"{}\"\n", way) + kPressNow,
                               .specialise = false});
        const std::vector<TweakValue> defaults = player.preset.values;
        const auto check = [&](const std::string& what) {
            player.renderer().reset();
            player.still(0.1);
            EXPECT_EQ(not_finite(player), "") << way << ", " << what;
        };
        const auto& tweaks = player.preset.scene.tweaks;
        for (std::size_t i = 1; i < tweaks.size(); ++i) {
            for (const bool greatest : {false, true}) {
                player.preset.values = defaults;
                player.preset.values[i] = at_end(tweaks[i], greatest);
                check(fmt::format("{} {}", tweaks[i].name, greatest));
            }
        }
        for (const bool greatest : {false, true}) {
            for (std::size_t i = 1; i < tweaks.size(); ++i) {
                player.preset.values[i] = at_end(tweaks[i], greatest);
                // Many paths a pixel times many steps a path are beyond llvmpipe's budget of turns.
                if (tweaks[i].quality && greatest) player.preset.values[i] = defaults[i];
            }
            check(greatest ? "all at their greatest" : "all at their least");
        }
    }
}

TEST_F(Water, RandomTweaksAreFinite) {
    Player player(bare(), {.size = {24, 14}, .preset = kPressNow, .specialise = false});
    std::mt19937 random(13);
    const auto& tweaks = player.preset.scene.tweaks;
    for (int k = 0; k < 64; ++k) {
        for (std::size_t i = 0; i < tweaks.size(); ++i) {
            const TweakValue low = at_end(tweaks[i], false), high = at_end(tweaks[i], true);
            if (tweaks[i].quality) continue;
            for (std::size_t c = 0; c < 4; ++c)
                player.preset.values[i][c] = uniform(random, low[c], high[c]);
            if (tweaks[i].type == TweakType::int1 || tweaks[i].type == TweakType::bool1)
                player.preset.values[i][0] = std::round(player.preset.values[i][0]);
        }
        player.renderer().reset();
        player.still(0.1);
        EXPECT_EQ(not_finite(player), "") << "case " << k;
    }
}

TEST_F(Water, AnySizeAndMouseAndAgeIsFinite) {
    for (const char* way : {"planar", "traced"}) {
        const std::string tweaks = fmt::format("[tweaks]\nwater = \"{}\"\n", way);
        Player player(bare(), {.size = {1, 1}, .preset = tweaks});
        for (const glm::ivec2 size : {glm::ivec2(1, 1), {7, 3}, {1, 512}, {512, 1}, {64, 36}}) {
            player.renderer().resize(size);
            for (const glm::vec4 mouse : {glm::vec4(0),
                                          {0, 0, 0, 0.5f},
                                          {size.x, size.y, 1, 1},
                                          {-50, 4000, -9, -9},
                                          {1, 1, 900, -900}}) {
                Frame frame;
                frame.time = 0.05;
                frame.input.mouse = mouse;
                player.renderer().reset();
                player.draw(frame);
                EXPECT_EQ(not_finite(player), "") << way << ", " << size.x << " x " << size.y;
            }
        }
        Player old(bare(), {.size = {48, 27}, .preset = tweaks + "ripples = false\n"});
        for (const double time : {0.0, 3600.0, 86400.0, 2592000.0, 31536000.0}) {
            Frame frame;
            frame.time = time;
            old.draw(frame);
            EXPECT_EQ(not_finite(old), "") << way << ", " << time << " s";
        }
    }
}

}  // namespace
}  // namespace glint
