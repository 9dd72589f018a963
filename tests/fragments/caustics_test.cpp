// The light on the floor in fragments/caustics.frag against photons traced in double precision.
#include "probe.h"
#include "worst_case.h"

#include <glm/geometric.hpp>
#include <glm/mat2x2.hpp>
#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <numbers>
#include <random>

namespace glint::caustics_test {
namespace {

using Caustics = GlTest;

constexpr double kTile = 4.5, kIorWater = 1.3345;  // as in the scene
constexpr int kMap = 256, kWaves = 12;             // texels a side; waves

struct Look {
    double depth = 2.2, slope = 0.09, length = 0.9, elevation = 55.0, azimuth = 0.0;
    double dispersion = 0.0;

    std::string tweaks(std::string_view more = "") const {
        return fmt::format(
            "[tweaks]\ndepth = {:.6g}\nwaveSlope = {:.6g}\nwaveLength = {:.6g}\n"
            "sunElevation = {:.6g}\nsunAngle = {:.6g}\ndispersion = {:.1f}\n{}",
            depth, slope, length, elevation, azimuth, dispersion, more);
    }
    glm::dvec3 sun() const {
        const double e = glm::radians(elevation), a = glm::radians(azimuth);
        return {std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e)};
    }
};
const Look kCalm = {.depth = 1.0, .slope = 0.02};
const Look kFolded;
const Look kDeep = {.depth = 5.0, .slope = 0.12, .length = 0.8, .elevation = 40.0};

const std::string kScene = "#include \"" GLINT_REPOSITORY "/fragments/caustics.frag\"\n";

// One buffer of the scene at time 0, RGBA.
std::vector<float> buffer(std::string_view pass, const std::string& preset, int settle = 0) {
    Player player(kScene, {.preset = preset, .pass = std::string(pass)});
    player.still(0.0, settle);
    return player.floats();
}

// The waves as the scene has them: what follows is computed from the same rounded numbers.
struct Wave {
    double nx, nz, slope, phase;  // whole waves in the tile; a k; cycles
};
std::vector<Wave> waves_of(const Look& look) {
    const std::vector<float> table = buffer("waves", look.tweaks());
    std::vector<Wave> waves;
    for (std::size_t i = 0; i < kWaves; ++i) {
        const double golden = 0.61803398874989f;  // GLSL multiplies floats
        const auto index = static_cast<double>(i * i);
        waves.push_back({table[4 * i], table[4 * i + 1], table[4 * i + 2],
                         std::fmod(static_cast<float>(golden * index), 1.0)});
    }
    return waves;
}

// Relative to what crosses flat water, and where it lands, in tiles from where it would then land.
struct Landing {
    glm::dvec2 at;
    double flux;
};
Landing land(const Look& look, glm::dvec2 start, double height, glm::dvec2 slope,
             double ior = kIorWater) {
    const auto transmitted = [&](double cos_i) {  // Fresnel by the two angles
        const double cos_t = std::sqrt(1.0 - (1.0 - cos_i * cos_i) / (kIorWater * kIorWater));
        const double s = (cos_i - kIorWater * cos_t) / (cos_i + kIorWater * cos_t);
        const double p = (kIorWater * cos_i - cos_t) / (kIorWater * cos_i + cos_t);
        return 1.0 - 0.5 * (s * s + p * p);
    };
    const auto refracted = [](glm::dvec3 in, glm::dvec3 normal, double n) {
        const double cos_i = -glm::dot(in, normal);
        const double cos_t = std::sqrt(1.0 - (1.0 - cos_i * cos_i) / (n * n));
        return in / n + (cos_i / n - cos_t) * normal;
    };
    const glm::dvec3 sun = look.sun(), level(0.0, 1.0, 0.0);
    const glm::dvec3 normal = glm::normalize(glm::dvec3(-slope.x, 1.0, -slope.y));
    const glm::dvec3 ray = refracted(-sun, normal, ior), flat = refracted(-sun, level, kIorWater);
    const glm::dvec2 lands =
        start * kTile + glm::dvec2(ray.x, ray.z) * (look.depth + height) / -ray.y;
    const double facing = glm::dot(sun, glm::dvec3(-slope.x, 1.0, -slope.y)) / sun.y;
    return {(lands - glm::dvec2(flat.x, flat.z) * look.depth / -flat.y) / kTile,
            facing * transmitted(glm::dot(sun, normal)) / transmitted(sun.y)};
}

// Height and slope of the water at a point given in tiles.
std::pair<double, glm::dvec2> water(const std::vector<Wave>& waves, glm::dvec2 u) {
    double height = 0.0;
    glm::dvec2 slope(0.0);
    for (const Wave& w : waves) {
        const double turn = 2.0 * std::numbers::pi;
        const double angle = turn * (w.nx * u.x + w.nz * u.y + w.phase);
        const glm::dvec2 k = turn / kTile * glm::dvec2(w.nx, w.nz);
        height += w.slope / glm::length(k) * std::sin(angle);
        slope += w.slope / glm::length(k) * std::cos(angle) * k;
    }
    return {height, slope};
}

using Map = std::vector<double>;  // kMap x kMap, relative to flat water

// Jittered photons, side x side of them, counted in texels. The waves' phases at the corners of the
// photons' cells come from tables, and turn by a small angle from there: e^ix to x^4 is good to
// 1e-8.
Map photons(const Look& look, const std::vector<Wave>& waves, int side, unsigned seed,
            double ior = kIorWater) {
    using Turn = std::complex<double>;
    const double turn = 2.0 * std::numbers::pi;
    std::vector<std::array<Turn, kWaves>> columns, rows;
    std::array<glm::dvec2, kWaves> steps;         // angle over one cell
    std::array<glm::dvec3, kWaves> amplitudes{};  // of height and slope
    for (int i = 0; i < side; ++i) {
        columns.emplace_back();
        rows.emplace_back();
        for (std::size_t w = 0; w < kWaves; ++w) {
            columns.back()[w] = std::polar(1.0, turn * waves[w].nx * i / side);
            rows.back()[w] = std::polar(1.0, turn * (waves[w].nz * i / side + waves[w].phase));
        }
    }
    for (std::size_t w = 0; w < kWaves; ++w) {
        const glm::dvec2 k = turn / kTile * glm::dvec2(waves[w].nx, waves[w].nz);
        steps[w] = k * kTile / static_cast<double>(side);
        amplitudes[w] = glm::dvec3(1.0, k) * (waves[w].slope / glm::length(k));
    }
    std::mt19937_64 random(seed);
    Map map(kMap * kMap, 0.0);
    const double share = static_cast<double>(kMap) * kMap / (static_cast<double>(side) * side);
    for (std::size_t j = 0; j < rows.size(); ++j) {
        for (std::size_t i = 0; i < columns.size(); ++i) {
            const std::uint64_t bits = random();
            const glm::dvec2 jitter = glm::dvec2(bits >> 32, bits & 0xffffffffu) / 4294967296.0;
            double height = 0.0;
            glm::dvec2 slope(0.0);
            for (std::size_t w = 0; w < kWaves; ++w) {
                const double x = glm::dot(steps[w], jitter), xx = x * x;
                const Turn phase = columns[i][w] * rows[j][w] *
                                   Turn(1.0 - 0.5 * xx * (1.0 - xx / 12.0), x * (1.0 - xx / 6.0));
                height += amplitudes[w].x * phase.imag();
                slope += phase.real() * glm::dvec2(amplitudes[w].y, amplitudes[w].z);
            }
            const glm::dvec2 u = (glm::dvec2(i, j) + jitter) / static_cast<double>(side);
            const Landing landing = land(look, u, height, slope, ior);
            const glm::dvec2 at = landing.at - glm::floor(landing.at);
            const auto x = static_cast<std::size_t>(at.x * kMap) % kMap;
            const auto y = static_cast<std::size_t>(at.y * kMap) % kMap;
            map[y * kMap + x] += landing.flux * share;
        }
    }
    return map;
}

// Calm water: the one point whose light lands in the middle of a texel's part, by Newton's steps
// with differences, and the flux over the determinant there; 2 x 2 parts a texel.
Map inverse(const Look& look, const std::vector<Wave>& waves) {
    constexpr int kParts = 2;
    const auto lands = [&](glm::dvec2 u) {
        const auto [height, slope] = water(waves, u);
        return land(look, u, height, slope);
    };
    Map map(kMap * kMap, 0.0);
    for (int y = 0; y < kMap * kParts; ++y) {
        for (int x = 0; x < kMap * kParts; ++x) {
            const glm::dvec2 wanted = (glm::dvec2(x, y) + 0.5) / static_cast<double>(kMap * kParts);
            glm::dvec2 u = wanted;
            double value = 0.0;
            for (int step = 0; step < 4; ++step) {
                const double h = 1e-5;
                const Landing here = lands(u);
                const glm::dmat2 j((lands(u + glm::dvec2(h, 0)).at - here.at) / h,
                                   (lands(u + glm::dvec2(0, h)).at - here.at) / h);
                value = here.flux / glm::determinant(j);
                u += glm::inverse(j) * (wanted - here.at);
            }
            map[static_cast<std::size_t>(y / kParts) * kMap +
                static_cast<std::size_t>(x / kParts)] += value / (kParts * kParts);
        }
    }
    return map;
}

struct Error {
    double rmse = 0.0, relative = 0.0,
           energy = 0.0;  // (x - r)^2 / (r^2 + 0.01); mean over mean - 1
};
Error compare(const std::vector<double>& map, const Map& reference) {
    Error error;
    double sum = 0.0, expected = 0.0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
        const double d = map[i] - reference[i];
        error.rmse += d * d;
        error.relative += d * d / (reference[i] * reference[i] + 0.01);
        sum += map[i];
        expected += reference[i];
    }
    const auto count = static_cast<double>(reference.size());
    return {std::sqrt(error.rmse / count), error.relative / count, sum / expected - 1.0};
}
Map channel(const std::vector<float>& pixels, std::size_t c) {
    Map map;
    for (std::size_t i = c; i < pixels.size(); i += 4) map.push_back(pixels[i]);
    return map;
}
Error of_method(const Look& look, const Map& reference, std::string_view tweaks, int settle = 0,
                std::size_t c = 1) {
    const Error error =
        compare(channel(buffer("caustics", look.tweaks(tweaks), settle), c), reference);
    std::string name(tweaks);
    for (char& letter : name) letter = letter == '\n' ? ' ' : letter;
    fmt::print("  {:44} settle {:3}: RMSE {:.2e}  relMSE {:.2e}  energy {:+.4f} %\n", name, settle,
               error.rmse, error.relative, error.energy * 100.0);
    return error;
}
void print_shortcuts(const Look& look, const Map& reference) {
    for (const char* method : {"vertical", "snell", "periodic"})
        of_method(look, reference, fmt::format("method = \"{}\"\n", method));
}

TEST_F(Caustics, FlatWaterLeavesTheLightAsItIs) {
    const Look flat = {.slope = 0.0, .dispersion = 2.0};
    for (const char* tweaks :
         {"method = \"vertical\"\n", "method = \"snell\"\n", "method = \"periodic\"\n",
          "method = \"photons\"\n", "method = \"area\"\nfolds = \"never\"\n",
          "method = \"area\"\nfolds = \"always\"\n"}) {
        for (const char* pass : {"caustics", "slices"}) {
            SCOPED_TRACE(fmt::format("{}{}", tweaks, pass));
            const std::vector<float> pixels = buffer(pass, flat.tweaks(tweaks));
            double worst = 0.0, sum = 0.0;
            for (std::size_t i = 0; i < pixels.size(); i += 4) {
                for (std::size_t c = 0; c < 3; ++c) {
                    worst = std::max(worst, std::abs(pixels[i + c] - 1.0));
                    sum += pixels[i + c];
                }
            }
            EXPECT_NEAR(sum / (0.75 * static_cast<double>(pixels.size())), 1.0, 1e-5);
            // A photon more or less in a texel is noise of the count, not of the light.
            if (std::string_view(tweaks).find("photons") == std::string_view::npos) {
                EXPECT_LE(worst, 1e-5);
            }
        }
    }
}

// Bars: calm water to a root mean square error of 1e-2 and 0.2 % of the energy. Both ways are a
// tenth of that; what remains of 1/|J| is the search, of the mesh its straight edges.
TEST_F(Caustics, CalmWaterIsAsBrightAsItsJacobianSays) {
    const std::vector<Wave> waves = waves_of(kCalm);
    const Map reference = inverse(kCalm, waves);
    const Error photon = compare(photons(kCalm, waves, 1024, 1), reference);
    fmt::print("calm water against Newton's inverse, from which photons differ by RMSE {:.1e}:\n",
               photon.rmse);
    EXPECT_LE(photon.rmse, 0.12) << "a million photons, 16 a texel: noise";
    EXPECT_NEAR(photon.energy, 0.0, 1e-4);
    for (const char* folds : {"automatic", "never", "always"}) {
        SCOPED_TRACE(folds);
        const Error error = of_method(kCalm, reference, fmt::format("folds = \"{}\"\n", folds));
        EXPECT_LE(error.rmse, 1e-2);
        EXPECT_NEAR(error.energy, 0.0, 2e-3);
    }
    print_shortcuts(kCalm, reference);
}

// Bars: folded light to a relative square error of 1e-2 and 1 % of the energy, with the cells that
// the scene has unless told otherwise. 64 and 128 are printed to show the order.
void compare_folded(const Look& look) {
    const std::vector<Wave> waves = waves_of(look);
    const Map first = photons(look, waves, 3072, 1), second = photons(look, waves, 3072, 2);
    Map reference;
    for (std::size_t i = 0; i < first.size(); ++i)
        reference.push_back(0.5 * (first[i] + second[i]));
    const Error self = compare(first, second);
    fmt::print("depth {} m against photons, whose halves differ by relMSE {:.1e}:\n", look.depth,
               self.relative);
    EXPECT_LE(self.relative / 4.0, 2e-3)
        << "the mean's own noise, a fifth of the bar, which counts "
           "against the scene";
    for (const char* cells : {"64", "128"})
        of_method(look, reference, fmt::format("cells = {}\n", cells));
    for (const char* tweaks : {"method = \"area\"\n", "cells = 256\n"}) {
        SCOPED_TRACE(tweaks);
        const Error error = of_method(look, reference, tweaks);
        EXPECT_LE(error.relative, 1e-2);
        EXPECT_NEAR(error.energy, 0.0, 1e-2);
    }
    double before = 1e9;
    for (const int settle : {0, 7, 63}) {
        const Error error = of_method(look, reference, "method = \"photons\"\n", settle);
        EXPECT_LE(error.relative, before / 4.0) << "photons converge";
        EXPECT_NEAR(error.energy, 0.0, 1e-2);
        before = error.relative;
    }
    of_method(look, reference, "folds = \"never\"\n");
    print_shortcuts(look, reference);
}

TEST_F(Caustics, FoldedLightIsCountedOnceForEverySheet) {
    compare_folded(kDeep);
}

// Water of the scene's own depth, which folds less.
TEST_F(Caustics, FoldedLightIsCountedOnceWhateverTheCase) {
    compare_folded(kFolded);
}

// Q14 over looks: calm ones against Newton's inverse, folded ones against photons.
TEST_F(Caustics, CalmWaterIsRightWhateverTheCase) {
    Bar rmse("Q14 caustics: calm water, RMSE", 1e-2), energy("Q14 caustics: calm, energy, %", 0.2);
    search_worst(5, 24, {&rmse, &energy}, [&](Dials& dials) {
        Look look = {.depth = dials.between_logs(0.5, 2.0),
                     .length = dials.between_logs(0.6, 1.8),
                     .elevation = dials.between(35.0, 85.0),
                     .azimuth = dials.between(-180.0, 180.0)};
        // As steep as still counts as calm: depth times curvature.
        look.slope = std::min(0.12, 0.02 * look.length / look.depth / 0.9) * dials.share();
        const Error error = of_method(look, inverse(look, waves_of(look)), "");
        const std::string where = look.tweaks();
        rmse.see(error.rmse, where);
        energy.see(100.0 * std::abs(error.energy), where);
    });
}
TEST_F(Caustics, FoldedLightIsRightWhateverTheCase) {
    Bar relative("Q14 caustics: folded light, relMSE", 1e-2);
    Bar energy("Q14 caustics: folded, energy, %", 1.0);
    search_worst(5, 24, {&relative, &energy}, [&](Dials& dials) {
        const Look look = {.depth = dials.between(1.5, 4.5),
                           .slope = dials.between(0.05, 0.12),
                           .length = dials.between(0.7, 1.5),
                           .elevation = dials.between(45.0, 85.0),
                           .azimuth = dials.between(-180.0, 180.0)};
        const Map reference = photons(look, waves_of(look), 4096, 7);
        const Error error = of_method(look, reference, "method = \"area\"\n");
        relative.see(error.relative, look.tweaks());
        energy.see(100.0 * std::abs(error.energy), look.tweaks());
    });
}

// Light that crosses the surface, relative to flat water: of rays side by side from the sun, each
// to the first wave that it meets.
double light_that_enters(const Look& look, const std::vector<Wave>& waves) {
    constexpr int kSide = 96;
    const glm::dvec3 sun = look.sun();
    const double away = std::hypot(sun.x, sun.z);
    const glm::dvec2 back = -glm::dvec2(sun.x, sun.z) / (away * kTile);
    double top = 0.0, sum = 0.0;
    for (const Wave& w : waves) {
        top += w.slope * kTile / (2.0 * std::numbers::pi * std::hypot(w.nx, w.nz));
    }
    std::mt19937 random(3);
    std::uniform_real_distribution<double> part(0.0, 1.0);
    for (int i = 0; i < kSide * kSide; ++i) {
        const glm::dvec2 start(i % kSide + part(random), i / kSide + part(random));
        const auto over = [&](double s) {  // of the ray over the water after s m, level
            return top - s * sun.y / away - water(waves, start / double{kSide} + s * back).first;
        };
        double above = 0.0, below = 0.02;
        for (; over(below) > 0.0; below += 0.02) above = below;
        for (int k = 0; k < 12; ++k) {
            const double middle = 0.5 * (above + below);
            (over(middle) > 0.0 ? above : below) = middle;
        }
        const glm::dvec2 at = start / double{kSide} + below * back;
        const auto [height, slope] = water(waves, at);
        const Landing landing = land(look, at, height, slope);
        // What crosses is spread over less of the surface where that faces the sun.
        sum += landing.flux / (1.0 - (sun.x * slope.x + sun.z * slope.y) / sun.y);
    }
    return sum / (kSide * kSide);
}

// Bar: 1 % of the energy, of waves that are steeper than the sun is high, too: the light that a
// crest takes is not sent from the trough behind it as well.
void expect_the_light_that_enters(const Look& look, const std::vector<std::string>& methods) {
    const double truth = light_that_enters(look, waves_of(look));
    for (const std::string& method : methods) {
        const std::vector<float> map =
            buffer("caustics", look.tweaks(fmt::format("method = \"{}\"\n", method)));
        double sum = 0.0;
        for (std::size_t i = 1; i < map.size(); i += 4) sum += map[i];
        sum /= kMap * kMap;
        fmt::print("sun {} degrees high, slope {}, {}: {:.4f} of {:.4f}\n", look.elevation,
                   look.slope, method, sum, truth);
        EXPECT_NEAR(sum / truth, 1.0, 0.01) << method;
    }
}
TEST_F(Caustics, WavesShadeEachOtherUnderTheLowestSun) {
    expect_the_light_that_enters({.slope = 0.3, .elevation = 15.0}, {"area"});
}
TEST_F(Caustics, WavesShadeEachOtherUnderAnyLowSun) {
    for (const double elevation : {15.0, 20.0, 30.0}) {
        for (const double slope : {0.15, 0.3}) {
            expect_the_light_that_enters(
                {.slope = slope, .elevation = elevation, .azimuth = 5.0 * elevation},
                {"area", "photons", "periodic"});
        }
    }
}

// Red and blue are traced with indices of their own; the scene keeps them in a buffer beside green.
TEST_F(Caustics, ColoursPartByTheirIndices) {
    const Look look = {.dispersion = 4.0};
    const std::vector<Wave> waves = waves_of(look);
    const double indices[] = {1.3317, 1.3345, 1.3384};
    for (std::size_t c = 0; c < 3; ++c) {
        SCOPED_TRACE(c);
        const double ior = kIorWater + look.dispersion * (indices[c] - kIorWater);
        const Map reference = photons(look, waves, 2048, 3, ior);
        const Error area = of_method(look, reference, "method = \"area\"\n", 0, c);
        EXPECT_LE(area.relative, 1e-2);
        const Error photon = of_method(look, reference, "method = \"photons\"\n", 31, c);
        EXPECT_LE(photon.relative, 1.5e-2) << "two million against four";
        EXPECT_NEAR(photon.energy, 0.0, 1e-3);
    }
}

// From below: the surface as its buffer has it is the surface as the waves have it. What the filter
// makes up between two texels is no roughness, which once cut the sun into squares.
TEST_F(Caustics, TheSunFromBelowHasNoneOfTheBuffersTexels) {
    std::ifstream file(GLINT_REPOSITORY "/fragments/caustics.frag");
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    std::string exact = text;
    constexpr std::string_view kFetch = "textureLod(surface, p.xz / kTile, lod)";
    for (std::size_t at = exact.find(kFetch); at != std::string::npos; at = exact.find(kFetch)) {
        exact.replace(at, kFetch.size(), "probe_surface(p.xz / kTile)");
    }
    ASSERT_NE(exact, text);
    exact.insert(exact.find("\nvec3 sunAbove()"),
                 "\nvec4 probe_surface(vec2 u) {\n    Water w = waterAt(u, true, 0);\n"
                 "    return vec4(w.height, w.slope, dot(w.slope, w.slope));\n}");
    const std::string preset =
        "[tweaks]\nwaveSlope = 0.09\nsunElevation = 60.0\nsunAngle = 0.0\nobjects = \"none\"\n"
        "cameraHeight = 0.1\ncameraDistance = 1.0\ntargetHeight = 2.2\nfocalLength = 60.0\n"
        "method = \"vertical\"\n";
    const auto picture = [&preset](const std::string& scene) {
        Player player(scene, {.size = {160, 90}, .preset = preset});
        player.still(0.0);
        return player.floats();
    };
    const std::vector<float> shown = picture(text), wanted = picture(exact);
    float worst = 0.0f;
    for (std::size_t i = 0; i < shown.size(); ++i) {
        worst = std::max(worst, std::abs(shown[i] - wanted[i]));
    }
    fmt::print("at most {:.3f} of the screen's white\n", worst);
    EXPECT_LE(worst, 0.01f) << "of straight lines between slopes 3.5 cm apart; squares were 0.039";
}

// A picture without light that is not there: what the power of a cosine over the sun's height was
// came to 1000 times the light of flat water under a low sun, and the floor to white.
TEST_F(Caustics, TheStyleOfVerticalLightHasTheLightOfFlatWaterInTheMean) {
    for (const double elevation : {15.0, 25.0, 50.0, 80.0}) {
        const std::vector<double> light = channel(
            buffer("caustics", Look{.elevation = elevation}.tweaks("method = \"vertical\"\n")), 0);
        const double mean =
            std::accumulate(light.begin(), light.end(), 0.0) / static_cast<double>(light.size());
        fmt::print("sun {} degrees high: {:.3f} in the mean, {:.1f} at most\n", elevation, mean,
                   std::ranges::max(light));
        EXPECT_NEAR(mean, 1.0, 0.3) << elevation;  // 0.3: crests beyond 60 are cut
    }
}

// 2^256 is no float. The search of `glint check` has found this corner of three tweaks.
TEST_F(Caustics, TheStyleOfVerticalLightIsFiniteUnderALowSun) {
    const std::string tweaks =
        Look{.elevation = 10.0, .azimuth = 0.0}.tweaks("method = \"vertical\"\ncontrast = 256.0\n");
    EXPECT_TRUE(std::ranges::all_of(channel(buffer("caustics", tweaks), 0),
                                    [](double v) { return std::isfinite(v); }));
}

// Where shafts are sampled, from pixel to pixel: every square of 4^k pixels has one of 4^k parts,
// so that neighbours' errors cancel; and no shift of the picture by a few pixels looks like it,
// which is what makes a net. (R2's lattice is at 0.79 of itself after four pixels, chance at 0.)
TEST_F(Caustics, ShaftsAreSampledEvenlyAndWithoutANet) {
    constexpr int kSide = 64;
    std::vector<ProbeCase> cases;
    for (int i = 0; i < kSide * kSide; ++i)
        cases.push_back({.a = glm::vec4(i % kSide, i / kSide, 0, 0)});
    const auto order = probe(kScene, "shuffledQuarters(ivec2(a.xy))", cases);
    for (const int side : {2, 4, 8, 16}) {
        std::vector<int> counts(kSide * kSide, 0);
        const int squares = kSide / side, parts = side * side;
        for (int i = 0; i < kSide * kSide; ++i) {
            const int square = i / kSide / side * squares + i % kSide / side;
            const int part =
                static_cast<int>(order[static_cast<std::size_t>(i)].x * static_cast<float>(parts));
            ++counts[static_cast<std::size_t>(square * parts + part)];
        }
        EXPECT_EQ(std::count(counts.begin(), counts.end(), 1), kSide * kSide) << side;
    }
    for (int y = 0; y <= 8; ++y) {
        for (int x = -8; x <= 8; ++x) {
            if (x * x + y * y < 9) continue;  // nearer ones shall differ
            double likeness = 0.0;
            for (int j = 0; j < kSide; ++j) {
                for (int i = 0; i < kSide; ++i) {
                    const int other = (j + y) % kSide * kSide + (i + x + kSide) % kSide;
                    likeness += (order[static_cast<std::size_t>(j * kSide + i)].x - 0.5) *
                                (order[static_cast<std::size_t>(other)].x - 0.5);
                }
            }
            EXPECT_LE(std::abs(likeness * 12.0 / (kSide * kSide)), 0.15) << x << ", " << y;
        }
    }
}

TEST_F(Caustics, AMethodDrawsOnlyItsOwnPasses) {
    struct {
        const char* method;
        std::vector<std::string> absent;
    } const cases[] = {
        {"vertical", {"landing", "cellBoxes", "blocks", "supers", "reach", "clock", "frames"}},
        {"snell", {"landing", "cellBoxes", "blocks", "supers", "reach", "clock", "frames"}},
        {"periodic", {"landing", "cellBoxes", "blocks", "supers", "reach", "clock"}},
        {"area", {"clock", "frames", "frameLanding", "frameCells", "frameReach"}},
        {"photons", {"frames", "frameLanding", "frameCells", "frameReach"}},
    };
    for (const auto& c : cases) {
        Player player(kScene, {.preset = fmt::format("[tweaks]\nmethod = \"{}\"\n", c.method)});
        for (const std::string& name : c.absent)
            EXPECT_THROW(player.graph_index(name), std::runtime_error) << c.method << " " << name;
        EXPECT_NO_THROW(player.graph_index("caustics"));
    }
    Player bare(kScene, {.preset = "[tweaks]\nshafts = 0.0\nobjects = \"none\"\n"});
    EXPECT_THROW(bare.graph_index("slices"), std::runtime_error) << "nothing shows them";
}

}  // namespace
}  // namespace glint::caustics_test
