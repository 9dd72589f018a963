// The block of land: its noise, heights and rays against double precision, whether it is closed,
// its glitter, age and limits, in figures.
#include "terrain.h"

#include "glitter.h"
#include "worst_case.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <random>

namespace glint::terrain_test {
namespace {

using Terrain = GlTest;

constexpr double kTau = 6.283185307179586;
constexpr double kHalf = 50.0, kBase = -24.0, kPerCell = 5.12;  // m, m, cells in a metre
constexpr int kNodes = 513;

// ---- Noise in double ----

std::array<std::uint32_t, 3> pcg3d(std::array<std::int64_t, 3> q) {
    std::array<std::uint32_t, 3> v{};
    for (std::size_t i = 0; i < 3; ++i)
        v[i] = static_cast<std::uint32_t>(q[i]) * 1664525u + 1013904223u;
    const auto mix = [&v] {
        v[0] += v[1] * v[2];
        v[1] += v[2] * v[0];
        v[2] += v[0] * v[1];
    };
    mix();
    for (auto& x : v) x ^= x >> 16u;
    mix();
    return v;
}
glm::dvec3 chance(std::int64_t x, std::int64_t y, std::int64_t z) {
    const auto v = pcg3d({x, y, z});
    return {(v[0] >> 8u) / 16777216.0, (v[1] >> 8u) / 16777216.0, (v[2] >> 8u) / 16777216.0};
}
// Its value; the scene's gradient is compared with differences of this.
double noise(std::array<std::int64_t, 3> cell, glm::dvec3 f, std::array<std::int64_t, 3> wrap) {
    const auto fade = [](double x) { return x * x * x * (x * (x * 6.0 - 15.0) + 10.0); };
    double sum = 0.0;
    for (int k = 0; k < 8; ++k) {
        const std::array<int, 3> o = {k & 1, (k >> 1) & 1, k >> 2};
        std::array<std::int64_t, 3> c{};
        double weight = 1.0;
        for (std::size_t i = 0; i < 3; ++i) {
            c[i] = (cell[i] + o[i]) & wrap[i];
            const double s = fade(f[static_cast<int>(i)]);
            weight *= o[i] ? s : 1.0 - s;
        }
        const glm::dvec3 g = 2.0 * chance(c[0], c[1], c[2]) - 1.0;
        sum += weight * dot(g, f - glm::dvec3(o[0], o[1], o[2]));
    }
    return sum;
}
double plane_noise(glm::dvec2 p, std::int64_t plane) {
    const glm::dvec2 c(std::floor(p.x), std::floor(p.y));
    return noise({static_cast<std::int64_t>(c.x), static_cast<std::int64_t>(c.y), plane},
                 {p.x - c.x, p.y - c.y, 0.0}, {-1, -1, -1});
}

// Bars: 1e-6 RMS against double however far out, no seam between cells.
// Cells out to `first` and more, to `last`.
void expect_exact_noise(double first, double last, std::uint32_t seed, Bar& values, Bar& slopes) {
    std::vector<ProbeCase> cases;
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    for (int i = 0; i < 8000; ++i) {
        const double reach = first * std::pow(last / first, i / 8000.0);
        const auto far = [&] {
            return static_cast<float>(std::floor((2.0f * unit(random) - 1.0f) * reach));
        };
        cases.push_back(
            {.a = {far(), far(), far(), 0}, .b = {unit(random), unit(random), unit(random), 0}});
    }
    const auto got = probe(terrain_text(""), "perlinIn(ivec3(a.xyz), b.xyz, ivec3(-1))", cases);
    double squares = 0.0, most = 0.0, slope_squares = 0.0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const glm::dvec3 f(cases[i].b);
        const std::array<std::int64_t, 3> cell = {static_cast<std::int64_t>(cases[i].a.x),
                                                  static_cast<std::int64_t>(cases[i].a.y),
                                                  static_cast<std::int64_t>(cases[i].a.z)};
        const std::array<std::int64_t, 3> all = {-1, -1, -1};
        squares += std::pow(got[i].w - noise(cell, f, all), 2.0);
        most = std::max(most, std::abs(static_cast<double>(got[i].w)));
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 e(0.0);
            e[axis] = 1e-5;
            const double slope = (noise(cell, f + e, all) - noise(cell, f - e, all)) / 2e-5;
            slope_squares += std::pow(got[i][axis] - slope, 2.0) / 3.0;
        }
    }
    const double count = static_cast<double>(cases.size());
    const std::string where = fmt::format("cells out to {:.3g}, seed {}", last, seed);
    values.see(std::sqrt(squares / count), where);
    slopes.see(std::sqrt(slope_squares / count), where);
    EXPECT_LE(most, 1.5);
    EXPECT_GE(most, 0.4);
}
TEST_F(Terrain, NoiseHasAllItsDigitsFarOut) {
    Bar values("Q9 terrain: noise, RMS", 1e-6), slopes("Q9 terrain: its gradient, RMS", 5e-6);
    expect_exact_noise(1.0, 1e8, 7, values, slopes);
}
TEST_F(Terrain, NoiseHasAllItsDigitsWhateverTheCase) {
    Bar values("Q9 terrain: noise, RMS", 1e-6), slopes("Q9 terrain: its gradient, RMS", 5e-6);
    search_worst(1, 40, {&values, &slopes}, [&](Dials& dials) {
        const double reach = dials.between_logs(4.0, 1e8);
        expect_exact_noise(reach / 2.0, reach, dials.number, values, slopes);
    });
}

TEST_F(Terrain, NoiseHasNoSeamAndItsTimeClosesAfter64Cells) {
    std::vector<ProbeCase> cases;
    std::mt19937 random(11);
    std::uniform_real_distribution<float> unit(0.0f, 1.0f);
    for (int i = 0; i < 6000; ++i) {
        const float side = 40.0f;
        cases.push_back(
            {.a = {std::floor(side * unit(random)) - 20.0f, std::floor(side * unit(random)) - 20.0f,
                   i % 2 == 0 ? 63.0f : std::floor(64.0f * unit(random)), 0},
             .b = {unit(random), unit(random), unit(random), 0},
             .c = {static_cast<float>(i % 3), 0, 0, 0}});
    }
    // On the face between a cell and the next along an axis, from both; then 64 cells later.
    const std::string text = terrain_text(
        "const ivec3 kWrap = ivec3(-1, -1, 63);\n"
        "vec4 seam(ivec3 c, vec3 f, int axis) {\n"
        "    ivec3 next = c; ++next[axis];\n"
        "    vec3 end = f, start = f; end[axis] = 1.0; start[axis] = 0.0;\n"
        "    return perlinIn(c, end, kWrap) - perlinIn(next & kWrap, start, kWrap);\n}\n"
        "vec4 later(ivec3 c, vec3 f) {\n"
        "    return perlinIn(c, f, kWrap) - perlinIn(c + ivec3(0, 0, 64), f, kWrap);\n}\n");
    for (const glm::vec4& d : probe(text, "seam(ivec3(a.xyz), b.xyz, int(c.x))", cases))
        for (int k = 0; k < 4; ++k) ASSERT_NEAR(d[k], 0.0f, 3e-6f);
    for (const glm::vec4& d : probe(text, "later(ivec3(a.xyz), b.xyz)", cases))
        ASSERT_EQ(d, glm::vec4(0.0f));
}

// The longest waves begin again after 64 cells of their third axis: 65536 / 460 s. Across that
// moment the waves change as they do at any other.
TEST_F(Terrain, WavesDoNotJumpWhenTheirTimeCloses) {
    Player player(terrain_text(""), {.pass = "waves"});
    const auto at = [&](double time) {
        Frame frame = player.frame(0);
        frame.time = time;
        player.draw(frame);
        return pixels_of(player);
    };
    const auto change = [&](double time) {
        const auto a = at(time), b = at(time + 1.0 / 60.0);
        double most = 0.0, sum = 0.0;
        for (std::size_t i = 0; i < a.size(); ++i) {
            const double d = std::abs(static_cast<double>(a[i].x) - b[i].x);
            most = std::max(most, d);
            sum += d;
        }
        EXPECT_GT(sum, 0.0) << "the water stands still";
        return glm::dvec2(sum, most);
    };
    const double closes = 65536.0 / 460.0;
    const glm::dvec2 usual = change(17.3);
    for (const double start : {closes - 0.5 / 60.0, 2.0 * closes - 0.5 / 60.0}) {
        const glm::dvec2 d = change(start);
        EXPECT_LE(d.x, 1.5 * usual.x);
        EXPECT_LE(d.y, 2.0 * usual.y);
    }
    const auto first = at(3.0), again = at(3.0 + 65536.0);
    EXPECT_EQ(first, again) << "all that moves comes from iTick, which wraps after 65536 s";
}

// ---- Land ----

struct Land {
    std::vector<glm::vec4> nodes = drawn(terrain_text(""), {.pass = "land"});

    double node(int x, int z) const {
        return nodes[static_cast<std::size_t>(z) * kNodes + static_cast<std::size_t>(x)].z;
    }
    double height(double x, double z) const {
        const double gx = std::clamp((x + kHalf) * kPerCell, 0.0, 512.0);
        const double gz = std::clamp((z + kHalf) * kPerCell, 0.0, 512.0);
        const int cx = std::min(static_cast<int>(gx), 511),
                  cz = std::min(static_cast<int>(gz), 511);
        const double u = gx - cx, v = gz - cz;
        return (node(cx, cz) * (1.0 - u) + node(cx + 1, cz) * u) * (1.0 - v) +
               (node(cx, cz + 1) * (1.0 - u) + node(cx + 1, cz + 1) * u) * v;
    }
};

// The same land as the scene's, in double, without its derivatives.
double bare_land(glm::dvec2 p) {
    constexpr std::array<std::array<double, 4>, 8> kHills = {{{-0.50f, -0.46f, 28.0f, 0.74f},
                                                              {0.08f, -0.90f, 20.0f, 0.54f},
                                                              {-1.02f, 0.60f, 20.0f, 0.50f},
                                                              {1.04f, 0.38f, 22.0f, 0.54f},
                                                              {0.76f, -0.84f, 18.0f, 0.42f},
                                                              {0.20f, -0.02f, 14.5f, 0.20f},
                                                              {-0.42f, 1.12f, 18.0f, 0.40f},
                                                              {-0.95f, -0.95f, 17.0f, 0.50f}}};
    const auto turned = [](glm::dvec2 v, double angle) {
        return glm::dvec2(std::cos(angle) * v.x + std::sin(angle) * v.y,
                          std::cos(angle) * v.y - std::sin(angle) * v.x);
    };
    const glm::dvec2 q = p + 11.0 * glm::dvec2(plane_noise(p / 31.0, 1), plane_noise(p / 31.0, 2));
    double hills = -12.5, smooth = 0.0, ridged = 0.0;
    for (std::size_t k = 0; k < kHills.size(); ++k) {
        const auto& hill = kHills[k];
        const glm::dvec2 d = (q / kHalf - glm::dvec2(hill[0], hill[1])) / hill[3];
        const double blunt = k < 2 ? 0.17f : 0.5f;
        hills += hill[2] * std::exp(2.1 * (blunt - std::sqrt(dot(d, d) + blunt * blunt)));
    }
    for (int k = 0; k < 6; ++k) {
        const double n = plane_noise(turned(p, 0.6 * k) / (31.0 * std::exp2(-k)), 8 + k);
        smooth += std::exp2(-k) * n;
        ridged += std::exp2(-k) * (0.22 - std::sqrt(n * n + 0.0025));
    }
    const double up = std::clamp((hills + 1.0) / 17.0, 0.0, 1.0);
    const double share = up * up * (3.0 - 2.0 * up);
    double h = hills + 7.0 * smooth * (1.0 - share) + 34.0 * ridged * share;
    h *= 1.0 - 0.62 * std::exp(-std::pow(h / 1.5, 2.0));
    return std::clamp(h, -19.0, 40.0);
}

// Bars: normals to 0.01 degrees (the mean; float noise of a few ulp of 50 m in a cell of 0.4 m at
// most 0.05), heights to a tenth of a millimetre. Of every so many of the land's nodes.
void compare_nodes(int every) {
    const auto nodes = drawn(terrain_text(""), {.pass = "bare"});
    Bar height("Q10 terrain: height, m", 1e-4), normal("Q10 terrain: normals, degrees RMS", 0.01);
    Bar most("Q10 terrain: normal, degrees at most", 0.05);
    double angles = 0.0;
    int count = 0;
    for (int i = 0; i < kNodes * kNodes; i += every) {
        const int x = i % kNodes, z = i / kNodes;
        const glm::dvec2 p(x / kPerCell - kHalf, z / kPerCell - kHalf);
        const std::string where = fmt::format("{:.4f} {:.4f} m", p.x, p.y);
        const auto& node = nodes[static_cast<std::size_t>(i)];
        height.see(std::abs(node.z - bare_land(p)), where);
        if (node.z <= -18.99f || node.z >= 39.99f) continue;  // cut there
        const double e = 1e-5;
        const glm::dvec2 slope((bare_land(p + glm::dvec2(e, 0)) - bare_land(p - glm::dvec2(e, 0))),
                               (bare_land(p + glm::dvec2(0, e)) - bare_land(p - glm::dvec2(0, e))));
        const glm::dvec3 nor = normalize(glm::dvec3(-slope.x / 2e-5, 1.0, -slope.y / 2e-5));
        const glm::dvec3 got = normalize(glm::dvec3(-node.x, 1.0, -node.y));
        const double angle = std::asin(std::min(length(cross(nor, got)), 1.0)) * 360.0 / kTau;
        most.see(angle, where);
        angles += angle * angle;
        ++count;
    }
    normal.see(std::sqrt(angles / count), fmt::format("one of {} nodes", every));
}
TEST_F(Terrain, HeightsAndSlopesAreThoseOfTheNoise) {
    compare_nodes(67);
}
TEST_F(Terrain, HeightsAndSlopesAreThoseOfTheNoiseWhateverTheCase) {
    compare_nodes(1);
}

// Rays into the air over the block, at a sine of elevation.
std::vector<ProbeCase> rays_over_land(double degrees, int count, const Land& land) {
    std::vector<ProbeCase> cases;
    std::mt19937 random(static_cast<unsigned>(1000.0 - degrees * 10.0));
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    const double down = degrees * kTau / 360.0;
    while (static_cast<int>(cases.size()) < count) {
        // Through a point of the block from somewhere on the way to it.
        const double turn = kTau * unit(random);
        const glm::dvec3 rd(std::cos(down) * std::cos(turn), std::sin(down),
                            std::cos(down) * std::sin(turn));
        const double x = kHalf * (2.0 * unit(random) - 1.0), z = kHalf * (2.0 * unit(random) - 1.0);
        const glm::dvec3 ro(x, land.height(x, z) + 0.05 + 12.0 * unit(random), z);
        cases.push_back({.a = glm::vec4(glm::vec3(ro), 0), .b = glm::vec4(glm::vec3(rd), 0)});
    }
    return cases;
}
const std::string kRayText =
    "vec2 rayed(vec3 ro, vec3 rd) {\n"
    "    vec3 face; float end = blockSpan(ro, rd, face).y;\n"
    "    return vec2(hitLand(ro, rd, 0.0, end), float(landTurns));\n}\n"
    "float stepped(vec3 ro, vec3 rd) {\n"
    "    vec3 face; return stepLand(ro, rd, 0.0, blockSpan(ro, rd, face).y);\n}\n";

// Bars, at -20, -5 and -1.5 degrees: at most 0.5 % of the hits more than 5 cm off, at most 0.5 %
// hit or miss against the truth, at most 32 evaluations a ray, at most 0.1 % out of steps. The
// truth takes 16,384 steps in double through the same heights, then bisects.
TEST_F(Terrain, RaysMeetLandWhereTheyShould) {
    const Land land;
    for (const double degrees : {-20.0, -5.0, -1.5, 3.0}) {
        const auto cases = rays_over_land(degrees, 2000, land);
        const auto got = probe(terrain_text(kRayText), "rayed(a.xyz, b.xyz)", cases);
        const auto dense = probe(terrain_text(kRayText), "stepped(a.xyz, b.xyz)", cases);
        int wrong = 0, flipped = 0, capped = 0, dense_off = 0;
        double evaluations = 0.0;
        for (std::size_t i = 0; i < cases.size(); ++i) {
            const glm::dvec3 ro(cases[i].a), rd(cases[i].b);
            double end = 200.0;
            for (const int axis : {0, 2})
                if (rd[axis] != 0.0)
                    end = std::min(end, ((rd[axis] > 0.0 ? kHalf : -kHalf) - ro[axis]) / rd[axis]);
            const auto above = [&](double t) {
                return ro.y + t * rd.y - land.height(ro.x + t * rd.x, ro.z + t * rd.z);
            };
            double lo = 0.0, hi = -1.0;
            for (int k = 1; k <= 16384 && hi < 0.0; ++k) {
                const double t = end * k / 16384.0;
                (above(t) <= 0.0 ? hi : lo) = t;
            }
            for (int k = 0; k < 50 && hi > 0.0; ++k)
                (above(0.5 * (lo + hi)) > 0.0 ? lo : hi) = 0.5 * (lo + hi);
            evaluations += got[i].y;
            capped += got[i].y >= 128.0f;
            const bool met = got[i].x < 1e6f;
            flipped += met != (hi > 0.0);
            wrong += met && hi > 0.0 && std::abs(got[i].x - hi) > 0.05;
            dense_off +=
                (dense[i].x < 1e6f) != (hi > 0.0) || (hi > 0.0 && std::abs(dense[i].x - hi) > 0.05);
        }
        const double percent = 100.0 / static_cast<double>(cases.size());
        fmt::print(
            "{:5.1f} degrees: {:.2f} % wrong, {:.2f} % hit or miss, {:.1f} evaluations, "
            "{:.2f} % capped; in steps {:.2f} % off\n",
            degrees, wrong * percent, flipped * percent, evaluations * percent / 100.0,
            capped * percent, dense_off * percent);
        EXPECT_LE(wrong * percent, 0.5);
        EXPECT_LE(flipped * percent, 0.5);
        EXPECT_LE(evaluations * percent / 100.0, 32.0);
        EXPECT_LE(capped * percent, 0.1);
        EXPECT_LE(dense_off * percent, 1.0) << "the reference of the scene's own";
    }
}

// The map's share of the sun's disc against 400 rays spread over it (whose own share is within some
// 0.003), where land and water lie. Columns may be searched by halves because a ray to the sky
// passes where a lower one of its column does, but for the roundings at a surface that is touched.
TEST_F(Terrain, SunlightIsThatOfAllRaysToTheDisc) {
    const std::string body = R"(
    ivec2 texel = 10 * ivec2(p);
    vec4 g = texelFetch(land, texel, 0), lit = texelFetch(lightMap, texel, 0);
    vec2 at = vec2(texel) / kPerCell - kHalf;
    bool wet = g.z < waterLevel;
    vec3 face, ro = vec3(at.x, g.z, at.y) + 0.04 * normalize(vec3(-g.x, 1.0, -g.y));
    if (wet) ro = vec3(at.x, waterLevel, at.y);
    ro.xz = clamp(ro.xz, -kHalf, kHalf);
    vec3 sun = sunDirection(), u = normalize(cross(sun, vec3(0, 1, 0))), v = cross(u, sun);
    float all = 0.0, upset = 0.0;
    for (int k = 0; k < 400; ++k) {
        float a = 2.0 * kPi * kGolden * float(k);
        float r = tan(radians(sunSize) * sqrt((float(k) + 0.5) / 400.0));
        vec3 rd = normalize(sun + r * (u * cos(a) + v * sin(a)));
        rd.y = max(rd.y, 1e-3);
        all += step(kFar, hitLand(ro, rd, 0.0, blockSpan(ro, rd, face).y)) / 400.0;
    }
    float lower = 0.0;
    for (int k = 0; k < 3 * kSunRows; ++k) {
        vec3 rd = sunRay(kPi * float(k / kSunRows + 1) / 4.0, k % kSunRows);
        float clear = step(kFar, hitLand(ro, rd, 0.0, blockSpan(ro, rd, face).y));
        if (k % kSunRows > 0 && clear < lower) ++upset;
        lower = clear;
    }
    c = vec4(wet ? lit.y : lit.x, all, upset, 1.0);
)";
    struct Look {
        const char* tweaks;
        double bar;  // RMSE of the share, half more than was measured
    };
    for (const Look& look : {Look{"", 0.005},
                             {"sunHeight = 3\nsunSize = 3\n", 0.027},
                             {"sunHeight = 60\nsunSize = 3\ntrees = 1\nrelief = 1.6\n", 0.009},
                             {"shadowSamples = 64\n", 0.0015}}) {
        const auto pixels =
            drawn(with_picture(kTerrainFile, body),
                  {.size = {51, 51}, .preset = fmt::format("[tweaks]\n{}", look.tweaks)});
        double sum = 0.0, upset = 0.0, half = 0.0;
        for (const glm::vec4& pixel : pixels) {
            sum += std::pow(pixel.x - pixel.y, 2.0);
            upset += pixel.z;
            half += pixel.y > 0.002f && pixel.y < 0.998f;
        }
        const auto count = static_cast<double>(pixels.size());
        const double off = std::sqrt(sum / count);
        fmt::print("{:.4f}, {} of {} out of order, {} in half shade\n", off, upset, 24.0 * count,
                   half);
        EXPECT_LE(off, look.bar) << look.tweaks;
        EXPECT_LE(upset, 1e-4 * 24.0 * count) << look.tweaks;
        EXPECT_GE(half, 20.0) << look.tweaks;
    }
}

// Whoever aims from outside at a point inside land or water must meet something at that point or
// before: from above, from the side, from below, and near edges and corners.
TEST_F(Terrain, TheBlockIsClosed) {
    const Land land;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    int rays = 0, leaks = 0;
    std::array<int, 6> kinds{};
    for (int batch = 0; batch < 6; ++batch) {
        std::vector<ProbeCase> cases;
        std::vector<double> far;
        while (cases.size() < 16384) {
            // Half of the points in a thin skin: at the sides, at the bottom, under the surface.
            const auto place = [&](double low, double high) {
                const double u = unit(random), skin = 1e-3 * unit(random);
                const int where = static_cast<int>(6.0 * unit(random));
                return where == 0 ? low + skin : where == 1 ? high - skin : low + (high - low) * u;
            };
            const double x = place(-kHalf, kHalf), z = place(-kHalf, kHalf);
            const double y = place(kBase, std::max(land.height(x, z), 0.0));
            const double turn = kTau * unit(random), up = 2.0 * unit(random) - 1.0;
            const double level = std::sqrt(1.0 - up * up), away = 90.0 + 500.0 * unit(random);
            const glm::dvec3 out(level * std::cos(turn), up, level * std::sin(turn));
            const glm::vec3 ro = glm::vec3(glm::dvec3(x, y, z) + away * out);
            const glm::dvec3 to = glm::dvec3(x, y, z) - glm::dvec3(ro);
            cases.push_back({.a = glm::vec4(ro, 0), .b = glm::vec4(glm::vec3(normalize(to)), 0)});
            far.push_back(length(to));
        }
        const auto got = probe(
            terrain_text("vec2 met(vec3 ro, vec3 rd) {\n"
                         "    Hit h = intersect(ro, rd); return vec2(h.t, float(h.id));\n}\n"),
            "met(a.xyz, b.xyz)", cases);
        for (std::size_t i = 0; i < cases.size(); ++i) {
            ++rays;
            ++kinds[static_cast<std::size_t>(got[i].y)];
            // A float ray passes its target by some 1e-4 m: a point in the skin may be missed.
            const bool met = got[i].y > 0.5f && got[i].x <= far[i] + 0.02;
            if (!met) {
                ++leaks;
                fmt::print(
                    "  missed: from {:.9g} {:.9g} {:.9g} along {:.9g} {:.9g} {:.9g}: {} {}\n",
                    cases[i].a.x, cases[i].a.y, cases[i].a.z, cases[i].b.x, cases[i].b.y,
                    cases[i].b.z, got[i].x - far[i], got[i].y);
            }
        }
    }
    fmt::print("{} rays: land {}, walls {}, bottom {}, water {}, its sides {}; missed {}\n", rays,
               kinds[1], kinds[2], kinds[3], kinds[4], kinds[5], leaks);
    for (std::size_t kind = 1; kind < kinds.size(); ++kind) EXPECT_GT(kinds[kind], 200);
    EXPECT_LE(leaks, rays / 20000) << "rays that graze an edge within their own rounding";
}

// ---- Water ----

// Bar: 1e-4 in at most 16 steps, for losses of 0.1 to 1000 1/m; a closed form takes none.
TEST_F(Terrain, LightInWaterIsIntegratedExactly) {
    std::vector<ProbeCase> cases;
    for (int i = 0; i < 4000; ++i)
        cases.push_back(
            {.a = {std::pow(10.0f, -7.0f + 11.0f * static_cast<float>(i) / 4000.0f), 0, 0, 0}});
    cases.push_back({});
    const auto got = probe(terrain_text(""), "meanTransmittance(a.x)", cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const double x = cases[i].a.x, truth = x > 0.0 ? -std::expm1(-x) / x : 1.0;
        ASSERT_NEAR(got[i].x / truth, 1.0, 1e-5) << x;
    }
}

// Of pixels where the sun is mirrored, as wide as the mouse says, cm.
Glitter lake_glitter() {
    return {with_picture(
                kTerrainFile,
                "    vec2 at = vec2(10.0, 14.0) + (p - 16.0) * 0.68;\n"
                "    vec3 sun = sunDirection();\n"
                "    vec3 rd = normalize(vec3(-sun.x, -sun.y, -sun.z) * vec3(-1.0, 1.0, -1.0)\n"
                "        + 0.08 * vec3(p.y / 16.0 - 1.0, 0.0, p.x / 16.0 - 1.0));\n"
                "    float w = iMouse.x / 100.0, light = 0.0, all = 0.0, got = lakeGlitter(at, rd, "
                "w);\n"
                "    vec2 slope, ahead = normalize(rd.xz), aside = vec2(-ahead.y, ahead.x);\n"
                "    for (int j = 0; j < 16; ++j)\n"
                "        for (int i = 0; i < 16; ++i) {\n"
                "            vec2 u = (vec2(i, j) + 0.5) / 16.0 - 0.5;\n"
                "            vec2 q = at + w * (u.x * aside + u.y / -rd.y * ahead);\n"
                "            vec3 calm = vec3(kCalmSpread, kCalmSpread, 0.0);\n"
                "            Sea one = Sea(0.0, waveSlope(q), calm, 0.0);\n"
                "            float area = shownSlope(rd, one, slope);\n"
                "            light += area * seaGlitter(rd, one, area);\n"
                "            all += area;\n"
                "        }\n"
                "    c = vec4(got, light / all, 0.0, 1.0);\n"),
            {32, 32}};
}

// Bars: error over mean at most 0.4, the mean within 5 %, with the waves and the sun of each
// preset. A pixel of 0.2 m is one 320 m off, of 720 rows; waves as steep as those of `glitter` bend
// within a texel of 0.2 m, so for them it holds from two texels on.
TEST_F(Terrain, GlitterIsFilteredFarOff) {
    struct Look {
        std::string name, tweaks;
        std::vector<double> pixels;  // m
    };
    const std::array<Look, 4> looks = {
        Look{"default", "", {0.2, 0.4, 1.6}},
        Look{"waves of 0.3 m", "waveHeight = 0.3\n", {0.2, 0.4, 0.8, 1.6}},
        Look{"evening",
             "waveHeight = 0.3\nsunHeight = 6.5\nsunAngle = -78.0\nsunSize = 1.2\n",
             {0.2, 0.4, 0.8, 1.6}},
        Look{"glitter",
             "waveHeight = 0.45\nwaveLength = 3.6\nsunHeight = 25.0\nsunAngle = 12.0\n"
             "sunSize = 0.5\nglitterSamples = 32\n",
             {0.4, 0.8, 1.6}}};
    Glitter glitter = lake_glitter();
    for (const Look& look : looks) {
        for (const double w : look.pixels) {
            const Glitter::Errors errors = glitter.errors(look.tweaks, 100.0 * w, 5.0);
            fmt::print("{}, pixel of {:.1f} m: error/mean {:.3f}, mean {:+.1f} %\n", look.name, w,
                       errors.spread, 100.0 * errors.mean);
            EXPECT_LE(errors.spread, 0.4) << look.name << ", pixel of " << w << " m";
            EXPECT_NEAR(errors.mean, 0.0, 0.05) << look.name << ", pixel of " << w << " m";
        }
    }
}

// The same over 160 looks, led to where the mean is most off. The bar is for waves up to a tenth of
// their length; between that and a seventh, where they break (Stokes 1880), the search found the
// mean up to 9 % off under the smallest sun, and a tenth is held. Left out: waves shorter than 3 m,
// whose last octave is two texels long; and suns below 8 degrees, whose light a few crests send,
// which the 16 parts of a pixel miss. A look's own 1024 pixels know their mean to a 32nd of their
// spread, which is allowed for thrice; one look in ten may have a spread of over 0.4.
TEST_F(Terrain, GlitterIsFilteredWhateverTheTweaks) {
    Glitter glitter = lake_glitter();
    Bar mean("Q20 terrain: glitter's mean off, beyond what its pixels tell, %", 5.0);
    Bar steep("Q20 terrain: the same of waves near breaking, %", 10.0);
    int wide = 0;
    search_worst(7, 160, {&mean, &steep}, [&](Dials& dials) {
        const double length = dials.between_logs(3.0, 24.0);
        const double height = std::min(1.5, length / 7.0) * dials.share();
        const double angle = dials.between(-180.0, 180.0), up = dials.between_logs(8.0, 85.0);
        const std::string look = fmt::format(
            "waveHeight = {:.3f}\nwaveLength = {:.2f}\nsunAngle = {:.1f}\nsunHeight = {:.1f}\n"
            "sunSize = {:.2f}\n",
            height, length, angle, up, dials.between_logs(0.1, 3.0));
        const double width = dials.between_logs(0.4, 1.6), time = dials.between(0.0, 1000.0);
        const Glitter::Errors errors = glitter.errors(look, 100.0 * width, time);
        wide += errors.spread > 0.4;
        (height > 0.1 * length ? steep : mean)
            .see(100.0 * (std::abs(errors.mean) - 3.0 * errors.spread / 32.0),
                 fmt::format("{}pixel of {:.2f} m, {:.1f} s", look, width, time));
    });
    EXPECT_LE(wide, 16);
}

// ---- Reflections ----

// Without a blur there is no buffer to copy from; with hardly any the picture is the same.
TEST_F(Terrain, NothingIsCopiedWhereNothingBlurs) {
    const std::string text = fmt::format("#include \"{}\"\n", kTerrainFile);
    Player sharp(text, {.size = {96, 54}}),
        hardly(text, {.size = {96, 54}, .preset = "[tweaks]\ntiltShift = 1e-6\n"});
    const auto passes = [](const Player& player) {
        return player.renderer().graph().passes.size();
    };
    EXPECT_EQ(passes(sharp) + 1, passes(hardly));
    sharp.draw(0);
    hardly.draw(0);
    EXPECT_EQ(sharp.floats(), hardly.floats());
}

// ---- Limits ----

TEST_F(Terrain, IsFiniteWhereTweaksEnd) {
    const std::array<std::string, 6> looks = {
        "relief = 0.0\nwaveHeight = 0.0\nclouds = 0.0\nsunHeight = 1.0\n",
        "relief = 1.6\nruggedness = 2.0\ntrees = 1.0\nsnowLine = -5.0\nrockLine = -5.0\n"
        "waveHeight = 1.5\nwaveLength = 2.0\nclouds = 1.0\nsunHeight = 85.0\n",
        "waterLevel = -16.0\ncameraRise = -88.0\ncameraDistance = 20.0\n",
        "waterLevel = 12.0\nwaterTint = \"#ffffff\"\nmurk = 2.0\ncameraRise = 0.0\nbends = 8\n",
        "waterLevel = 12.0\nwaterTint = \"#000000\"\ncameraRise = -30.0\nreflections = "
        "\"traced\"\n",
        "cameraDistance = 20.0\ncameraRise = 1.0\ntarget = [50.0, -50.0, 50.0]\ntiltShift = 0.05\n"
        "lensSamples = 8\nlandscape = 999\nborder = \"fade\"\n"};
    for (const std::string& look : looks) {
        Player player(terrain_text(""),
                      {.size = {64, 36}, .preset = "[tweaks]\nshadowSamples = 1\n" + look});
        for (const double time : {0.0, 31557600.0}) {
            Frame frame = player.frame(0);
            frame.time = time;
            player.draw(frame);
            for (const float value : player.floats())
                ASSERT_TRUE(value >= 0.0f && value <= 1.01f) << look << time;
        }
    }
}

}  // namespace
}  // namespace glint::terrain_test
