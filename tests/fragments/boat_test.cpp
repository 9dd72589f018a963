// The boat: the float against closed forms, rays to sea and hull against long ones, keys, age.
#include "looks.h"

#include <glm/common.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <utility>

namespace glint::boat_test {
namespace {

using BoatScene = GlTest;

const std::string kBoatFile = std::string(GLINT_REPOSITORY) + "/fragments/boat.frag";
constexpr double kTau = 6.283185307179586;

// A storm, by tweaks that a preset may set.
const std::string kStorm =
    "longestWave = 26.0\nsteepness = 1.0\nchoppiness = 1.0\nripples = 1.5\ndepth = 30.0\n";

std::string scene_text(std::string_view more = {}) {
    return fmt::format("#include \"{}\"\n{}", kBoatFile, more);
}

// Every texel of a pass, after playing to a time, with lines of a preset.
std::vector<glm::vec4> texels(std::string_view text, const std::string& preset, double time,
                              glm::ivec2 size = {96, 54}, const std::string& pass = "image") {
    Player player(text, {.size = size, .preset = preset, .pass = pass});
    player.still(time);
    return pixels_of(player);
}

// A picture of our own in the scene's place; `body` writes c from the pixel p.
std::string boat_picture(std::string_view body) {
    return with_picture(kBoatFile, fmt::format("    loadWavelets();\n    loadBoat();\n{}", body));
}

// ---- The float ----

// One step of x'' + c x' + k x = k f, f from f0 to f1 on a line, by the exponential of the matrix
// of (x, x', f, f'): a Taylor series of the halved step, squared again. No formula is shared with
// the scene.
std::array<long double, 2> exponential_step(long double x, long double v, long double k,
                                            long double c, long double t, long double f0,
                                            long double f1) {
    using Matrix = std::array<std::array<long double, 4>, 4>;
    const auto times = [](const Matrix& a, const Matrix& b) {
        Matrix r{};
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j)
                for (std::size_t n = 0; n < 4; ++n) r[i][j] += a[i][n] * b[n][j];
        return r;
    };
    int halvings = 0;
    for (long double size = (k + c + 1) * t; size > 0.1L; size /= 2) ++halvings;
    const long double h = t / std::pow(2.0L, halvings);
    Matrix a{}, sum{}, term{};
    a[0][1] = h;
    a[1] = {-k * h, -c * h, k * h, 0};
    a[2][3] = h;
    for (std::size_t i = 0; i < 4; ++i) sum[i][i] = term[i][i] = 1;
    for (int n = 1; n <= 14; ++n) {
        term = times(term, a);
        for (auto& row : term)
            for (auto& value : row) value /= n;
        for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j) sum[i][j] += term[i][j];
    }
    for (int n = 0; n < halvings; ++n) sum = times(sum, sum);
    const std::array<long double, 4> s = {x, v, f0, (f1 - f0) / t};
    std::array<long double, 2> r{};
    for (std::size_t i = 0; i < 2; ++i)
        for (std::size_t j = 0; j < 4; ++j) r[i] += sum[i][j] * s[j];
    return r;
}

// Stiffness 1e-3 to 1e5 /s2, damping 0 to 1e3 /s, steps of 1/1000 to 1 s, critical damping among
// them: bounded, and right to some units of the last digit of what goes in.
TEST_F(BoatScene, OneStepOfTheFloatIsExactForAnyStiffnessDampingAndStep) {
    std::vector<ProbeCase> cases;
    for (int i = 0; i < 12000; ++i) {
        const auto part = [&](double by) { return std::fmod(0.5 + by * i, 1.0); };
        const auto k = static_cast<float>(std::pow(10.0, -3.0 + 8.0 * part(0.6180339887)));
        auto c = static_cast<float>(std::pow(10.0, -4.0 + 7.0 * part(0.7548776662)));
        if (i % 7 == 0) c = 0.0f;
        if (i % 7 == 1) c = std::min(2.0f * std::sqrt(k), 1000.0f);  // critical
        if (i % 7 == 2) c = std::min(2.0002f * std::sqrt(k), 1000.0f);
        const auto t = static_cast<float>(std::pow(10.0, -3.0 + 3.0 * part(0.5698402910)));
        cases.push_back(
            {.a = {2.0 * part(0.31) - 1.0, (2.0 * part(0.47) - 1.0) * std::sqrt(k), k, c},
             .b = {t, 2.0 * part(0.83) - 1.0, 2.0 * part(0.19) - 1.0, 0}});
    }
    const auto got = probe(scene_text(), "floatExactly(a.xy, a.z, a.w, b.x, b.y, b.z)", cases);
    // k t^2 = 1e5: the phase of 316 rad keeps 6e-8 of itself, 2e-5.
    Bar places("Q15 boat: one step, m", 1e-4),
        speeds("Q15 boat: one step, m/s over the rate", 1e-4);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const ProbeCase& one = cases[i];
        ASSERT_TRUE(std::isfinite(got[i].x) && std::isfinite(got[i].y));
        const auto r =
            exponential_step(one.a.x, one.a.y, one.a.z, one.a.w, one.b.x, one.b.y, one.b.z);
        // Its own scale: what it starts with, and for speeds that times the rate.
        const double rate = std::sqrt(static_cast<double>(one.a.z)) + 1.0;
        const double x = std::abs(got[i].x - static_cast<double>(r[0]));
        const double v = std::abs(got[i].y - static_cast<double>(r[1])) / rate;
        const std::string where = fmt::format(
            "stiffness {:.3g}, damping {:.3g}, a step of {:.3g} s", one.a.z, one.a.w, one.b.x);
        places.see(x, where);
        speeds.see(v, where);
    }
}

// The answer of the damped oscillator to three waves from rest at 2 m, in closed form.
struct Wave {
    double height, rate, phase;
};
constexpr std::array<Wave, 3> kWaves = {{{0.30, 1.1, 0.3}, {0.12, 2.3, 1.9}, {0.05, 4.1, 4.0}}};
double closed_form(double k, double c, double t) {
    using Complex = std::complex<double>;
    Complex steady = 0.0, start = 2.0, start_speed = 0.0;
    for (const Wave& w : kWaves) {
        const Complex s(0.0, w.rate), turn = std::polar(w.height, w.phase) * Complex(0.0, -1.0);
        const Complex answer = k / (s * s + c * s + k) * turn;
        start -= answer.real();
        start_speed -= (s * answer).real();
        steady += answer * std::exp(s * t);
    }
    const Complex root = std::sqrt(Complex(0.25 * c * c - k, 0.0));
    Complex slow = -0.5 * c + root;
    const Complex fast = -0.5 * c - root;
    if (std::abs(fast) > 0.0) slow = k / fast;  // without cancellation
    const Complex a = (start_speed - fast * start) / (slow - fast), b = start - a;
    return (steady + a * std::exp(slow * t) + b * std::exp(fast * t)).real();
}

// Bars: at 60 Hz at most 1e-4 m off over 20 s, for 2 to 1000 rad/s and damping ratios up to 50; 30
// and 240 Hz within 1 cm of each other; bounded with steps of 1e-4 to 1 s.
// Each float by its rate (rad/s) and damping ratio.
struct Q15 {
    Bar bounded{"Q15 boat: farthest that the float goes, m", 3.0};
    Bar right{"Q15 boat: off after 20 s at 60 Hz, m", 1e-4};
    Bar alike{"Q15 boat: 30 beside 240 Hz, m", 0.01};
};
void expect_to_follow_waves(const std::vector<std::pair<float, float>>& floats, Q15& bars) {
    const std::string play =
        "vec3 probed(float k, float c, float dt) {\n"
        "    vec2 s = vec2(2.0, 0.0);\n"
        "    float most = 0.0, now = 0.0, last = 0.0, older = 0.0;\n"
        "    int n = int(20.0 / dt + 0.5);\n"
        "    n = min(n, 20000);\n"  // 2 s of the shortest steps
        "    for (int i = 0; i <= n; ++i) {\n"
        "        float t = float(i) * dt;\n"
        "        now = 0.30 * sin(1.1 * t + 0.3) + 0.12 * sin(2.3 * t + 1.9)"
        " + 0.05 * sin(4.1 * t + 4.0);\n"
        "        if (i == 1) older = 2.0 * last - now;\n"
        "        if (i > 0) s = floatAlong(s, k, c, dt, older, last, now);\n"
        "        older = last;\n"
        "        last = now;\n"
        "        most = max(most, abs(s.x));\n"
        "    }\n"
        "    return vec3(s.x, most, float(n) * dt);\n"
        "}\n";
    const std::array<float, 6> steps = {1e-4f, 1.0f / 240, 1.0f / 60, 1.0f / 30, 0.25f, 1.0f};
    std::vector<ProbeCase> cases;
    for (const auto& [rate, ratio] : floats)
        for (const float step : steps)
            cases.push_back({.a = {rate * rate, 2.0f * ratio * rate, step, ratio}});
    const auto got = probe(scene_text(play), "probed(a.x, a.y, a.z)", cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const glm::vec4 one = cases[i].a;
        const std::string where =
            fmt::format("{:.4g} rad/s, damping ratio {:.4g}, steps of {:.3g} s", std::sqrt(one.x),
                        one.w, one.z);
        bars.bounded.see(got[i].y, where);
        EXPECT_LE(std::abs(got[i].x), 3.0f) << "the greatest may have passed over a NaN";
        const auto step = i % steps.size();
        // Undamped and stiff, a rounding of the phase never fades: only bounds are asked for.
        if (one.w == 0.0f) continue;
        if (step == 2)
            bars.right.see(std::abs(got[i].x - closed_form(one.x, one.y, got[i].z)), where);
        if (step == 3) bars.alike.see(std::abs(double{got[i].x} - got[i - 2].x), where);
    }
}
TEST_F(BoatScene, TheFloatFollowsWavesWhateverTheStep) {
    std::vector<std::pair<float, float>> floats;
    for (const float rate : {2.0f, 6.2832f, 20.0f, 100.0f, 400.0f, 1000.0f})
        for (const float ratio : {0.0f, 0.2f, 0.9f, 5.0f, 50.0f}) floats.emplace_back(rate, ratio);
    // Found by the search: slow beside the step, so that a rounding that is the same in each sums.
    floats.emplace_back(2.0f, 47.48f);
    Q15 bars;
    expect_to_follow_waves(floats, bars);
}
// 16 floats round one.
TEST_F(BoatScene, TheFloatFollowsWavesWhateverTheCase) {
    Q15 bars;
    search_worst(2, 80, {&bars.bounded, &bars.right, &bars.alike}, [&](Dials& dials) {
        const double rate = dials.between_logs(2.0, 1000.0);
        const double ratio = dials.between_logs(0.05, 50.0);
        std::vector<std::pair<float, float>> floats;
        for (int i = 0; i < 16; ++i) {
            const auto near = [&](double value, double by, double low, double high) {
                const double part = std::fmod(0.5 + by * i, 1.0);
                return static_cast<float>(std::clamp(value * std::pow(1.2, part - 0.5), low, high));
            };
            floats.emplace_back(near(rate, 0.6180339887, 2.0, 1000.0),
                                near(ratio, 0.7548776662, 0.05, 50.0));
        }
        expect_to_follow_waves(floats, bars);
    });
}

// ---- The sea ----

// The waves of a frame, from its buffer, in double precision.
struct Waves {
    std::array<double, 20> x{}, z{}, height{}, phase{};
    double crest = 0.0;
};
Waves waves_in(const std::vector<glm::vec4>& buffer, double choppiness) {
    Waves w;
    for (std::size_t i = 0; i < 20; ++i) {
        const auto g = static_cast<std::size_t>(i / 4 * 4);
        const auto c = static_cast<glm::length_t>(i % 4);
        w.x[i] = buffer[g][c];
        w.z[i] = buffer[g + 1][c];
        w.height[i] = buffer[g + 2][c];
        w.phase[i] = buffer[g + 3][c];
    }
    w.crest = 0.25 * choppiness;
    return w;
}
Waves waves_of(const std::string& tweaks, double choppiness) {
    return waves_in(texels(scene_text(), tweaks, 5.0, {8, 8}, "wavelets"), choppiness);
}
double height_of(const Waves& w, double x, double z, std::size_t count) {
    double h = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
        const double c = std::cos(w.x[i] * x + w.z[i] * z + w.phase[i]);
        h += w.height[i] * (c + w.crest * (2.0 * c * c - 1.0));
    }
    return h;
}

// A height field has no folds, but steep sums look like cliffs: at the tweaks' most, the slopes of
// the long waves must sum to at most 0.95.
double steepest(const Waves& w) {
    double shape = 0.0, sum = 0.0;
    for (int i = 0; i < 1000; ++i) {
        const double x = kTau * i / 1000.0;
        shape = std::max(shape, std::sin(x) + 2.0 * w.crest * std::sin(2.0 * x));
    }
    for (std::size_t i = 0; i < 8; ++i) sum += w.height[i] * std::hypot(w.x[i], w.z[i]) * shape;
    return sum;
}
TEST_F(BoatScene, SlopesOfTheLongWavesSumToLessThanOne) {
    for (const std::string length : {"1.5", "4.5", "40.0"}) {
        const std::string tweaks =
            "[tweaks]\nsteepness = 1.0\nchoppiness = 1.0\nlongestWave = " + length + "\n";
        const double sum = steepest(waves_of(tweaks, 1.0));
        fmt::print("{} m: {:.3f}\n", length, sum);
        EXPECT_LE(sum, 0.95);
        EXPECT_GE(sum, 0.85) << "the tweak's 1 is meant to be a gale";
    }
}
TEST_F(BoatScene, SlopesSumToLessThanOneWhateverTheCase) {
    Bar sum("Q12 boat: sum of the long waves' slopes", 0.95);
    Player player(scene_text(), {.size = {8, 8}, .pass = "wavelets", .specialise = false});
    const std::vector<std::string> names = {"longestWave", "steepness", "windAngle",
                                            "depth",       "animation", "choppiness"};
    search_worst(numbers_of(player.preset.scene, names) + 1, 200, {&sum}, [&](Dials& dials) {
        const std::string look = look_at(player.preset.scene, names, dials);
        const double choppiness = std::stod(look.substr(look.rfind('=') + 1));
        set_look(player, look);
        Frame frame = player.frame(0);
        frame.time = dials.between(0.0, 1e5);
        frame.longest_catch_up = 0.25;  // s, of what is simulated beside
        player.draw(frame);
        sum.see(steepest(waves_in(pixels_of(player), choppiness)),
                fmt::format("{} at {:.1f} s", look, frame.time));
    });
}

// All repeats after 480 m: a wave vector that does not fit would make a seam.
TEST_F(BoatScene, EveryWaveFitsTheWorld) {
    const Waves w = waves_of("[tweaks]\nwindAngle = 33.0\n", 0.5);
    for (std::size_t i = 0; i < 20; ++i) {
        for (const double k : {w.x[i], w.z[i]}) {
            const double turns = k * 480.0 / kTau;
            EXPECT_NEAR(turns, std::round(turns), 1e-6 * std::abs(turns) + 1e-6);
        }
    }
}

// Bars, at -20, -5 and -1.5 degrees: at most 0.5 % of the hits more than 5 cm off, at most 0.5 %
// hit or miss against the truth, at most 32 evaluations a ray, at most 0.1 % out of steps.
TEST_F(BoatScene, RaysMeetTheSeaWhereTheyShould) {
    struct Case {
        std::string name, tweaks;
        double choppiness, eye;
    };
    const std::vector<Case> cases = {{"bay", "[tweaks]\n", 0.5, 2.6},
                                     {"gale", "[tweaks]\n" + kStorm, 1.0, 6.0}};
    for (const Case& one : cases) {
        const Waves w = waves_of(one.tweaks, one.choppiness);
        double top = 0.0;
        for (std::size_t i = 0; i < 8; ++i) top += w.height[i] * (1.0 + w.crest);
        for (const double degrees : {-20.0, -5.0, -1.5}) {
            const float down = static_cast<float>(std::sin(degrees * kTau / 360.0));
            const float level = static_cast<float>(std::cos(degrees * kTau / 360.0));
            const std::string ray = fmt::format(
                "    float i = p.x - 0.5 + 64.0 * (p.y - 0.5), turn = 2.399963 * i;\n"
                "    vec3 ro = vec3(0.037 * i, {:.9f}, -0.021 * i);\n"
                "    vec3 rd = vec3({:.9f} * cos(turn), {:.9f}, {:.9f} * sin(turn));\n",
                one.eye, level, down, level);
            const auto hits = texels(boat_picture(ray + "    c = vec4(hitWaves(ro, rd, 0.0, kFar), "
                                                        "float(seaEvaluations), 0.0, 1.0);\n"),
                                     one.tweaks, 5.0, {64, 16});
            int wrong = 0, flipped = 0, capped = 0;
            double evaluations = 0.0;
            for (std::size_t i = 0; i < hits.size(); ++i) {
                const auto n = static_cast<float>(i);
                const glm::dvec3 ro(0.037f * n, one.eye, -0.021f * n);
                const double turn = 2.399963f * n;
                const glm::dvec3 rd(level * std::cos(turn), down, level * std::sin(turn));
                const auto above = [&](double t) {
                    return ro.y + t * rd.y - height_of(w, ro.x + t * rd.x, ro.z + t * rd.z, 8);
                };
                const double first = std::max((top - ro.y) / rd.y, 0.0);
                const double last = (-top - ro.y) / rd.y;
                const int steps = 4096;
                double lo = first, hi = -1.0;
                for (int k = 1; k <= steps && hi < 0.0; ++k) {
                    const double t = first + (last - first) * k / steps;
                    if (above(t) <= 0.0)
                        hi = t;
                    else
                        lo = t;
                }
                for (int k = 0; k < 40; ++k)
                    (above(0.5 * (lo + hi)) > 0.0 ? lo : hi) = 0.5 * (lo + hi);
                evaluations += hits[i].y;
                capped += hits[i].y >= 96.0f;
                if (hits[i].x < 0.0f)
                    ++flipped;
                else
                    wrong += std::abs(hits[i].x - hi) > 0.05;
            }
            const double percent = 100.0 / static_cast<double>(hits.size());
            const double mean = evaluations / static_cast<double>(hits.size()) + 4.0;
            fmt::print(
                "{}, {:5.1f} degrees: {:.2f} % wrong, {:.2f} % hit or miss, {:.1f} evaluations, "
                "{:.2f} % out of steps\n",
                one.name, degrees, wrong * percent, flipped * percent, mean, capped * percent);
            EXPECT_LE(wrong * percent, 0.5);
            EXPECT_LE(flipped * percent, 0.5);
            EXPECT_LE(mean, 32.0) << "with 4 to finish";
            EXPECT_LE(capped * percent, 0.1);
        }
    }
}

// ---- The boat ----

// Rays march her bound: a ball as large as the field says must not reach into her, or they may step
// through. Points in the ball, from half its radius on, by chance.
TEST_F(BoatScene, HerFieldIsNeverMoreThanTheDistance) {
    const auto got = texels(
        boat_picture(
            "    float worst = 0.0;\n"
            "    int part;\n"
            "    for (int k = 0; k < 16; ++k) {\n"
            "        vec3 a = random3(ivec3(ivec2(p), k));\n"
            "        vec3 q = vec3(-1.9, -0.6, -2.7) + a * vec3(3.8, 5.0, 5.2);\n"
            "        float f = boatField(q, part);\n"
            "        for (int j = 0; j < 64 && f > 0.0; ++j) {\n"
            "            vec3 b = random3(ivec3(ivec2(p), 16 * j + k + 100));\n"
            "            vec3 e = normalize(b - 0.5) * f * (0.5 + 0.5 * fract(7.0 * b.x));\n"
            "            if (boatField(q + e, part) < 0.0) worst = max(worst, f / length(e));\n"
            "        }\n"
            "    }\n"
            "    c = vec4(worst);\n"),
        "", 1.0, {64, 64});
    double worst = 0.0;
    int steep = 0;
    for (const glm::vec4& pixel : got) {
        worst = std::max(worst, static_cast<double>(pixel.x));
        steep += pixel.x > 0.0f;
    }
    fmt::print("too far by a factor of {:.3f} at most; in {} of {}\n", worst, steep,
               got.size() * 16);
    EXPECT_LE(worst, 1.1);
    EXPECT_LE(steep, 20);
}

// Rays from all round against steps of 2 mm.
TEST_F(BoatScene, RaysMeetTheBoatWhereTheyShould) {
    const std::string ray =
        "    vec3 r = random3(ivec3(ivec2(p), 1)), s = random3(ivec3(ivec2(p), 2));\n"
        "    float turn = 2.0 * kPi * r.x;\n"
        "    vec3 ro = vec3(6.0 * cos(turn), 0.3 + 3.0 * r.y, 6.0 * sin(turn));\n"
        "    vec3 to = vec3(1.6, 3.0, 3.6) * (s - vec3(0.5, 0.12, 0.5));\n"
        "    vec3 rd = normalize(gAxes * to + vec3(0.0, gHeave, 0.0) - ro);\n";
    const auto marched = texels(boat_picture(ray + "    Hit h = hitBoat(ro, rd, 0.0, kFar);\n"
                                                   "    c = vec4(h.t, h.part, 0.0, 1.0);\n"),
                                "", 1.0, {64, 40});
    const auto walked =
        texels(boat_picture(ray + "    vec3 o = toBoat(ro), d = rd * gAxes;\n"
                                  "    vec2 span = boatSpan(o, d, 0.0);\n"
                                  "    float t = span.x;\n"
                                  "    bool met = false;\n"
                                  "    for (int k = 0; k < 4500 && !met && t < span.y; ++k) {\n"
                                  "        int part;\n"
                                  "        met = boatField(o + t * d, part) < 4e-4;\n"
                                  "        if (!met) t += 0.002;\n"
                                  "    }\n"
                                  "    c = vec4(met ? t : kFar);\n"),
               "", 1.0, {64, 40});
    int flipped = 0, wrong = 0, hits = 0;
    for (std::size_t i = 0; i < marched.size(); ++i) {
        const bool met = marched[i].x < 1e6f, truly = walked[i].x < 1e6f;
        flipped += met != truly;
        hits += truly;
        if (met && truly) wrong += std::abs(marched[i].x - walked[i].x) > 0.02f;
    }
    const double percent = 100.0 / static_cast<double>(marched.size());
    fmt::print("{} hits: {:.2f} % hit or miss, {:.2f} % over 2 cm off\n", hits, flipped * percent,
               wrong * percent);
    EXPECT_GT(hits, 600);
    EXPECT_LE(flipped * percent, 0.5);
    EXPECT_LE(wrong * percent, 0.5);
}

std::string event(double t, std::string_view key, bool down) {
    return fmt::format("[[events]]\nt = {}\nkey = \"{}\"\ndown = {}\n", t, key, down);
}

TEST_F(BoatScene, GoesWhereTheKeysTellHer) {
    const auto state = [](const std::string& events, double time) {
        return texels(scene_text(), events, time, {8, 8}, "boat");
    };
    const std::string ahead = event(0.0, "up", true);
    // Full speed 3 m/s, reached as 1 - exp(-0.55 t).
    auto s = state(ahead, 4.0);
    const double speed = 3.0 * (1.0 - std::exp(-0.55 * 4.0));
    EXPECT_NEAR(s[0].w, speed, 0.02);
    EXPECT_NEAR(s[0].y, -(3.0 * 4.0 - speed / 0.55), 0.05) << "straight ahead is -z";
    EXPECT_NEAR(s[0].x, 0.0, 1e-4);
    EXPECT_NEAR(s[0].z, 0.0, 1e-5);
    const double heading_right = state(ahead + event(1.0, "right", true), 4.0)[0].z;
    const double heading_left = state(ahead + event(1.0, "left", true), 4.0)[0].z;
    EXPECT_GT(heading_right, 0.3);
    EXPECT_NEAR(heading_left, -heading_right, 1e-4);
    EXPECT_GT(state(ahead + event(1.0, "right", true), 4.0)[0].x, 0.3);
    const auto back = state(event(0.0, "down", true), 4.0);
    EXPECT_LT(back[0].w, -0.5);
    EXPECT_GT(back[0].y, 0.5);
    const auto coasting = state(ahead + event(2.0, "up", false), 6.0);
    EXPECT_GT(coasting[0].w, 0.05) << "she has way on";
    EXPECT_LT(coasting[0].w, 0.4 * speed);
}

// Where the sea is lost after 60 m the sky is not blue: overhead one looks through 150 m of fog.
TEST_F(BoatScene, FogHidesTheSkyAsWellAsTheSea) {
    const auto bluest = [](const char* visibility) {
        double most = 0.0;
        for (const glm::vec4& sky : texels(
                 scene_text(), fmt::format("[tweaks]\nvisibility = {}\nclouds = 0.0\n", visibility),
                 0.0, {8, 8}, "sky"))
            most = std::max(most, static_cast<double>(sky.z / sky.x));
        return most;
    };
    EXPECT_GT(bluest("9000.0"), 3.0) << "a clear day";
    EXPECT_LT(bluest("60.0"), 1.3);
    for (const glm::vec4& sky :
         texels(scene_text(), "[tweaks]\nvisibility = 60.0\n", 0.0, {8, 8}, "sky"))
        EXPECT_LT(sky.w, 0.1f) << "nor does one see the sun's disc";
}

// Before her first step she lies as that begins: heeled, where the sail is set.
TEST_F(BoatScene, TheFirstFrameIsNoLeap) {
    Player player(scene_text(), {.size = {32, 18}, .pass = "poses"});
    std::vector<glm::vec4> before, now;
    for (int k = 0; k < 2; ++k) {
        player.draw(k);
        before = std::exchange(now, pixels_of(player));
    }
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (glm::length_t i = 0; i < 3; ++i)
            EXPECT_NEAR(before[axis][i], now[axis][i], 0.01) << axis << ", it was 0.077";
}

// A drag over a quarter of the picture, to the right of its middle, is a quarter turn back.
TEST_F(BoatScene, TheMouseTurnsTheCameraByTheShareOfThePictureThatItIsDragged) {
    const auto eye = [](const std::string& preset) {
        return texels(scene_text(), preset, 0.1, {96, 54}, "poses")[3];
    };
    const glm::vec4 turned =
        eye("[tweaks]\ncameraAngle = 30.0\n" +
            std::string("[[events]]\nt = 0\nmouse = [0.75, 0.5]\ndown = true\n"));
    const glm::vec4 same = eye("[tweaks]\ncameraAngle = -60.0\n");
    for (glm::length_t i = 0; i < 3; ++i) EXPECT_NEAR(turned[i], same[i], 0.02);
}

// Beyond 240 m she comes in on the other side of the world's square of 480 m.
TEST_F(BoatScene, KeepsHerPlaceInTheWorldHoweverFarSheGoes) {
    const auto far = texels(scene_text(), "[tweaks]\ntopSpeed = 7.0\n" + event(0.0, "up", true),
                            60.0, {8, 8}, "boat");
    const double sailed = 7.0 * (60.0 - 1.0 / 0.55);
    EXPECT_NEAR(far[0].y, 480.0 - sailed, 0.2) << "14,400 sums in float";
    for (const glm::vec4& texel : far)
        for (glm::length_t i = 0; i < 4; ++i) EXPECT_TRUE(std::isfinite(texel[i]));
}

// The float itself, in the scene: exact and explicit agree in easy waters, and only the exact one
// stays with the sea where it is stiff.
TEST_F(BoatScene, OnlyTheExactFloatStaysWithTheSeaWhenItIsStiff) {
    const auto heave = [](const std::string& tweaks) {
        const auto s = texels(scene_text(), "[tweaks]\n" + tweaks, 3.0, {8, 8}, "boat");
        return std::array<float, 2>{s[2].x, s[2].z};
    };
    const auto exact = heave(""), rough = heave("integrator = \"explicit\"\n");
    EXPECT_NEAR(exact[0], rough[0], 2e-3);
    for (const std::string hard : {"stiffness = 100000.0\n", "damping = 1000.0\n",
                                   "stiffness = 100000.0\ndamping = 1000.0\n"}) {
        const auto stiff = heave(hard);
        EXPECT_LE(std::abs(stiff[0] - stiff[1]), 0.1f) << hard;
        EXPECT_LE(std::abs(stiff[1]), 1.0f) << hard;
    }
    const auto lost = heave("integrator = \"explicit\"\nstiffness = 100000.0\n");
    EXPECT_GT(std::abs(lost[0] - lost[1]), 0.5f) << "explicit steps leave the sea";
}

// The foam in her wake is churned up by her hull, which a fast boat draws over a cell more quickly.
TEST_F(BoatScene, AFasterBoatLeavesNoThinnerFoam) {
    const auto whitest = [](double top_speed) {
        const std::string preset =
            fmt::format("[tweaks]\ntopSpeed = {:.1f}\n", top_speed) + event(0.0, "up", true);
        float most = 0.0f;
        for (const glm::vec4& cells : texels(scene_text(), preset, 6.0, {8, 8}, "wakeFoam"))
            most = std::max({most, cells.x, cells.y, cells.z, cells.w});
        return most;
    };
    EXPECT_GE(whitest(7.0), 0.9f * whitest(3.5));
}

// Full speed in circles. The scene's ceiling is 0.4 m: by default it is not what holds the wake,
// and the wildest wake dies down once she stops.
TEST_F(BoatScene, TheWakeStaysBounded) {
    const auto most = [](const std::string& preset, double time) {
        glm::vec2 found(0.0f);
        for (const char* buffer : {"wake", "wakeRise", "wakeFoam"}) {
            float largest = 0.0f;
            for (const glm::vec4& cells : texels(scene_text(), preset, time, {8, 8}, buffer)) {
                EXPECT_TRUE(std::isfinite(cells.x + cells.y + cells.z + cells.w));
                const glm::vec4 size = glm::abs(cells);
                largest = std::max({largest, size.x, size.y, size.z, size.w});
            }
            if (buffer == std::string_view("wake")) found.x = largest;
            if (buffer == std::string_view("wakeFoam")) found.y = largest;
        }
        fmt::print("highest {:.3f} m, whitest {:.2f}\n", found.x, found.y);
        return found;
    };
    const std::string circles = event(0.0, "up", true) + event(2.0, "left", true);
    const glm::vec2 usual = most(circles, 5.0);
    EXPECT_GT(usual.x, 0.02f);
    EXPECT_LT(usual.x, 0.3f);
    EXPECT_GT(usual.y, 0.3f);
    const std::string wild = "[tweaks]\ntopSpeed = 7.0\nwakeStrength = 3.0\nfoam = 1.0\n";
    EXPECT_LT(most(wild + circles + event(3.0, "up", false), 10.0).x, 0.1f);
}

}  // namespace
}  // namespace glint::boat_test
