// The pool's simulation against a kernel and a closed form of its own, at every rate and for long.
#include "water.h"
#include "worst_case.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <random>

namespace glint::pond_test {
namespace {

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

// The wave equation in double: heights, their speeds half a step earlier, squared wave speeds at
// the faces of each cell (west, east, south, north).
struct Pond {
    int width = 0, length = 0;
    double dt = 0.0, damping = 0.0;
    std::vector<double> h{}, v{};
    std::vector<float> faces{};

    std::size_t at(int x, int z) const {
        return static_cast<std::size_t>(std::clamp(z, 0, length - 1) * width +
                                        std::clamp(x, 0, width - 1));
    }
    // push: m2/s, of which the water gains its downhill flow.
    template <class Push>
    void step(Push push) {
        const double cell = 2 * kHalfWidth / width, kept = std::exp(-damping * dt);
        const std::vector<double> now = h;
        const auto push_at = [&](int x, int z) {
            return push(((x + 0.5) / width - 0.5) * 2 * kHalfWidth,
                        ((z + 0.5) / length - 0.5) * 2 * kHalfLength);
        };
        for (int z = 0; z < length; ++z) {
            for (int x = 0; x < width; ++x) {
                const std::size_t i = at(x, z);
                const std::array<glm::ivec2, 4> round = {
                    {{x - 1, z}, {x + 1, z}, {x, z - 1}, {x, z + 1}}};
                double flux = 0.0, kick = 0.0, mean = 0.0, open = 0.0;
                for (std::size_t k = 0; k < 4; ++k) {
                    const std::size_t j = at(round[k].x, round[k].y);
                    const double c2 = faces[4 * i + k];
                    open += c2;
                    flux += c2 * (now[j] - now[i]);
                    if (c2 > 0.0) kick += push_at(round[k].x, round[k].y) - push_at(x, z);
                    mean += 0.25 * now[j];
                }
                v[i] = kept * v[i] + (dt * 0.5 * (1 + kept) * flux + kick) / (cell * cell);
                h[i] = now[i] + dt * v[i];
                if (open <= 0.0) h[i] = mean, v[i] = 0.0;
            }
        }
    }
};

// Squared speeds at the faces of each cell (west, east, south, north), as the scene's bed has them.
std::vector<float> faces_of(const std::string& text, const std::string& preset, glm::ivec2 cells) {
    const auto drawn = [&](const char* name) {
        Player bed(text, {.preset = preset, .pass = name});
        bed.still(0.0);
        return bed.floats();
    };
    const std::vector<float> east = drawn("bedEast"), north = drawn("bedNorth");
    const auto width = static_cast<std::size_t>(cells.x);
    std::vector<float> faces(4 * east.size(), 0.0f);
    for (std::size_t i = 0; i < east.size(); ++i) {
        if (i % width > 0) faces[4 * i] = east[i - 1];
        faces[4 * i + 1] = east[i];
        if (i >= width) faces[4 * i + 2] = north[i - width];
        faces[4 * i + 3] = north[i];
    }
    return faces;
}

// Rings run at `waveSpeed` c over deep water, and slower on the stairs: c^2 tanh(g d / c^2) over a
// depth d. Each of them is 22 cm high; the first stands 5 cm out of the water.
TEST_F(Water, RingsAreSlowerOnTheStairs) {
    std::vector<ProbeCase> cases;
    for (int i = 0; i < 5; ++i)
        cases.push_back({.a = {4.0f - 0.42f * (static_cast<float>(i) + 0.5f), 1.6f, 0, 0}});
    const std::string fast = with_defaults(water_text(), {{"waveSpeed", "3"}, {"depth", "2"}});
    const auto squared = probe(fast, "squaredSpeed(a.xy)", cases);
    for (int i = 0; i < 5; ++i) {
        const double down = i == 4 ? 2.0 : std::max(0.22 * i - 0.05, 0.0);
        EXPECT_NEAR(squared[static_cast<std::size_t>(i)].x, 9.0 * std::tanh(9.81 * down / 9.0),
                    1e-4);
    }
}

// The real pass in the real scene, with columns, ball, steps and rain, against the kernel above.
TEST_F(Water, TheSimulationIsTheWaveEquationOfTheKernel) {
    const std::string preset = "[tweaks]\nrain = 30\ndamping = 0.6\nwaveSpeed = 2.5\n";
    constexpr int kWidth = 256, kLength = 384, kSteps = 240;
    Pond pond{.width = kWidth, .length = kLength, .dt = 1.0 / 240, .damping = 0.6};
    pond.h.assign(kWidth * kLength, 0.0);
    pond.v = pond.h;
    pond.faces = faces_of(water_text(), preset, {kWidth, kLength});
    int drops = 0, solid = 0;
    for (std::size_t i = 0; i < pond.faces.size(); i += 4)
        solid += *std::max_element(&pond.faces[i], &pond.faces[i] + 4) <= 0.0f;
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
            const double q = std::min((dx * dx + dz * dz) / (size * size), 80.0);
            return 0.9 * (0.3 + 0.9 * s.y) * 0.25 * size * size * std::exp(-q);
        });
    }
    Player player(water_text(), {.preset = preset, .pass = "pond"});
    player.still(1.0);
    const std::vector<float> heights = player.floats();
    double error = 0.0, size = 0.0;
    for (std::size_t i = 0; i < pond.h.size(); ++i) {
        error += std::pow(heights[i] - pond.h[i], 2.0);
        size += std::pow(pond.h[i], 2.0);
    }
    EXPECT_GT(drops, 15);
    fmt::print("{} drops, {:.2e} of {:.2e} m\n", drops, std::sqrt(error / kWidth / kLength),
               std::sqrt(size / kWidth / kLength));
    EXPECT_LE(std::sqrt(error / size), 1e-4) << "240 steps in float";
}

// ---- What there is stays ------------------------------------------------------------------------

// Water and motion in the pool after a time, over the cells that hold water.
struct Contents {
    double mean = 0.0;     // m, of the heights
    double highest = 0.0;  // m
    double energy = 0.0;   // m4/s2 over gravity's: what the steps keep where nothing is lost
};

struct Pool {
    int scale = 1;  // fewer cells and steps
    std::string preset{};
    glm::ivec2 size{256 / scale, 384 / scale};
    std::string text = with_cells(
        replaced(water_text(), "step=1/240", fmt::format("step=1/{}", 240 / scale)), size);
    std::vector<float> faces = faces_of(text, preset, size);
    Player player{text, {.size = {160, 80}, .preset = preset, .pass = "pond"}};

    Contents at(double time) {
        player.still(time);
        return contents();
    }
    Contents contents() {
        const std::vector<float> heights = player.floats();
        const std::vector<float> went_east = player.renderer().read_floats(1);
        const std::vector<float> went_north = player.renderer().read_floats(2);
        const double cell = 2 * kHalfWidth / size.x, rate2 = std::pow(cell * 240.0 / scale, 2.0);
        const auto index = [&](int x, int z) { return static_cast<std::size_t>(z * size.x + x); };
        Contents sum;
        double cells = 0.0;
        for (int z = 0; z < size.y; ++z) {
            for (int x = 0; x < size.x; ++x) {
                const std::size_t i = index(x, z);
                const double west = faces[4 * i], east = faces[4 * i + 1], south = faces[4 * i + 2],
                             north = faces[4 * i + 3];
                if (west + east + south + north <= 0.0) continue;
                const double h = heights[i], to_east = went_east[i], to_north = went_north[i];
                const double from_west = x > 0 ? went_east[index(x - 1, z)] : 0.0;
                const double from_south = z > 0 ? went_north[index(x, z - 1)] : 0.0;
                const double before = h - (from_west - to_east + from_south - to_north);
                sum.mean += h;
                sum.highest = std::max(sum.highest, std::abs(h));
                sum.energy += 0.5 * h * before;
                if (east > 0.0) sum.energy += 0.5 * rate2 * to_east * to_east / east;
                if (north > 0.0) sum.energy += 0.5 * rate2 * to_north * to_north / north;
                cells += 1.0;
            }
        }
        sum.mean /= cells;
        sum.energy *= cell * cell;
        return sum;
    }
};

// Ends of the ranges, alone and together, with a hand that drags through walls and columns.
struct Extreme {
    const char *name, *tweaks;
};
constexpr std::array<Extreme, 6> kExtremes = {{
    {"slow", "rain = 60\ndropSize = 0.5\ndropForce = 3\nwaveSpeed = 0.2\ndamping = 0.05\n"},
    {"fast", "rain = 60\ndropSize = 0.5\ndropForce = 3\nwaveSpeed = 3.75\ndamping = 0.05\n"},
    {"rain", "rain = 60\n"},
    {"damped", "rain = 60\ndropSize = 0.5\ndropForce = 3\nwaveSpeed = 3.75\ndamping = 5\n"},
    {"small", "rain = 60\ndropSize = 0.09\ndropForce = 3\nwaveSpeed = 3.75\ndamping = 0.05\n"},
    {"empty",
     "rain = 60\ndropForce = 3\ndepth = 0.8\ncolumns = false\nsteps = false\n"
     "mirrorBall = false\n"},
}};
std::string touched(std::string tweaks) {
    return "[tweaks]\nmouse = \"touch\"\n" + tweaks +
           "[[events]]\nt = 0.3\nmouse = [0.1, 0.3]\ndown = true\n"
           "[[events]]\nt = 0.6\nmouse = [0.5, 0.1]\n"
           "[[events]]\nt = 0.9\nmouse = [0.95, 0.35]\n"
           "[[events]]\nt = 1.3\nmouse = [0.3, 0.45]\n"
           "[[events]]\nt = 2.1\nmouse = [0.6, 0.2]\ndown = false\n";
}

// Drops that a wall or a column cuts, and a hand drawn along, move water and add none. What float
// rounds off goes up as often as down: over 1e4 cells and more its mean stays far below the bar.
void expect_full_pools(std::span<const Extreme> extremes, int scale, double time) {
    for (const Extreme& extreme : extremes) {
        SCOPED_TRACE(extreme.name);
        Pool pool{.scale = scale, .preset = touched(extreme.tweaks)};
        const Contents then = pool.at(time);
        fmt::print("{}: mean {:.1e} m, highest {:.3f} m\n", extreme.name, then.mean, then.highest);
        EXPECT_LE(std::abs(then.mean), 1e-6);
        EXPECT_GT(then.highest, 1e-3) << "it does rain";
        EXPECT_LE(then.highest, 0.3 + 1e-6) << "the ceiling";
    }
}
TEST_F(Water, ThePoolNeitherSinksNorRises) {
    expect_full_pools(std::span(kExtremes).first(2), 4, 10.0);
}
TEST_F(Water, ThePoolIsFullAfterTenMinutes) {
    expect_full_pools(std::span(kExtremes).first(3), 4, 600.0);
}
TEST_F(Water, ThePoolIsFullAfterTenOtherMinutes) {
    expect_full_pools(std::span(kExtremes).last(3), 4, 600.0);
}

// Bars of Q16 over tweaks by chance: nothing is lost or rises, and frames do not matter.
TEST_F(Water, ThePoolIsFullAndTheSameAtEveryFrameRateWhateverTheCase) {
    Bar mean("Q16 water: mean height after 20 s, m", 1e-6);
    Bar highest("Q16 water: highest, m", 0.3 + 1e-6);
    Bar apart("Q16 water: 30 and 240 beside 60 frames a second, m", 0.0);
    search_worst(6, 40, {&mean, &highest, &apart}, [&](Dials& dials) {
        std::string tweaks;
        const auto add = [&](const char* name, double low, double high) {
            tweaks += fmt::format("{} = {:.3g}\n", name, dials.between_logs(low, high));
        };
        add("rain", 1, 60);
        add("dropSize", 0.09, 0.5);
        add("dropForce", 0.1, 3);
        add("waveSpeed", 0.2, 3.75);
        add("damping", 0.05, 5);
        add("depth", 0.8, 4);
        Pool pool{.scale = 4, .preset = touched(tweaks)};
        const Contents then = pool.at(20.0);
        mean.see(std::abs(then.mean), tweaks);
        highest.see(then.highest, tweaks);
        const std::string alone = "[tweaks]\n" + tweaks;
        std::vector<float> first;
        for (const double fps : {60.0, 30.0, 240.0}) {
            Player player(pool.text,
                          {.size = {160, 80}, .preset = alone, .pass = "pond", .fps = fps});
            player.still(2.0);
            const std::vector<float> heights = player.floats();
            if (first.empty()) first = heights;
            double most = 0.0;
            for (std::size_t i = 0; i < heights.size(); ++i)
                most = std::max(most, std::abs(double{heights[i]} - first[i]));
            apart.see(most, tweaks);
        }
    });
}

// Once the hand is gone, and with no rain, the motion dies away, from one frame to the next.
TEST_F(Water, NothingButDropsAndTheHandPutsEnergyIn) {
    for (const Extreme& extreme : std::span(kExtremes).first(2)) {
        SCOPED_TRACE(extreme.name);
        const std::string tweaks = replaced(extreme.tweaks, "rain = 60", "rain = 0");
        Pool pool{.scale = 4, .preset = touched(tweaks)};
        double before = pool.at(2.2).energy;
        const double first = before;
        EXPECT_GT(first, 0.0);
        for (int frame = 133; frame < 240; ++frame) {
            pool.player.draw(frame);
            const double now = pool.contents().energy;
            EXPECT_LE(now, before + 1e-6 * first) << frame;  // float's rounding
            EXPECT_GE(now, 0.0) << frame;
            before = now;
        }
        EXPECT_LT(before, first);
    }
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
    return with_cells(replaced(text, "step=1/240", fmt::format("step=1/{}", 240 / scale)),
                      {256 / scale, 384 / scale});
}
const std::string kPressOnce =
    "[[events]]\nt = 0.1005\nmouse = [0.45, 0.3]\ndown = true\n"
    "[[events]]\nt = 0.2\nmouse = [0.45, 0.3]\ndown = false\n";
constexpr glm::ivec2 kPressSize(160, 80);

glm::dvec2 place_of_press() {
    Player player(coarser(1), {.size = kPressSize, .preset = kPressOnce, .pass = "pushes"});
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
        const std::vector<float> heights = player.floats();
        const int width = 256 / scale, length = 384 / scale, stride = 8 / scale;
        const std::vector<double> exact = press.heights(width, length, stride, kTime);
        double error = 0.0, size = 0.0;
        std::size_t i = 0;
        for (int z = stride / 2; z < length; z += stride) {
            for (int x = stride / 2; x < width; x += stride, ++i) {
                error += std::pow(heights[static_cast<std::size_t>(z * width + x)] - exact[i], 2);
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
        with_cells(replaced(with_defaults(coarser(1), {{"waveSpeed", "3.75"}, {"damping", "0.05"}}),
                            "step=1/240", "step=1/30"),
                   {32, 48});
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
        most = std::max(most, static_cast<double>(highest(time)));
    }
    EXPECT_GT(most, 0.01);
    EXPECT_LT(most, 0.3) << "the ceiling is not what holds it";
    player.renderer().reset();
    EXPECT_LE(highest(1e5 / 30.0), most);
    for (const std::size_t faces : {1u, 2u})
        for (const float crossed : player.renderer().read_floats(faces))
            ASSERT_LE(std::abs(crossed), 0.3f);
}

// A texel that went bad, by whatever mishap, does not spread.
TEST_F(Water, ANotANumberInThePondIsGoneAtOnce) {
    for (const char* bad :
         {"uintBitsToFloat(0x7fc00000u)", "uintBitsToFloat(0x7f800000u)", "1e30"}) {
        SCOPED_TRACE(bad);
        const std::string text =
            replaced(coarser(4), "    high = here + (crossing",
                     fmt::format("    if (iFrame == 20 && c == ivec2(7, 40)) {{\n"
                                 "        high = wentEast = wentNorth = vec4({});\n"
                                 "        return;\n    }}\n"
                                 "    high = here + (crossing",
                                 bad));
        Player player(text, {.size = kPressSize, .preset = kPressOnce, .pass = "pond"});
        player.still(21.0 / 60.0);
        EXPECT_FALSE(std::abs(player.pixel(7, 40).x) < 1e9f) << "it is there";
        player.still(23.0 / 60.0);
        for (const std::size_t output : {0u, 1u, 2u})
            for (const float value : player.renderer().read_floats(output))
                ASSERT_LT(std::abs(value), 10.0f);
    }
}

}  // namespace
}  // namespace glint::pond_test
