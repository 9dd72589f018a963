// Refraction, the Fresnel share and the display curve of the laboratory, against long double.
//
// Bars. Directions are finite for every index and angle, also in total reflection; with equal
// indices nothing bends (1e-6 rad, the rounding of a unit vector is 1e-7). Reflected and
// transmitted light sum to what came, within 1e-6. The display curve stays within 0 and 1, never
// falls, and knows NaN and Inf.
#include "intersections.h"
#include "worst_case.h"

#include <array>

namespace glint::refraction_test {
namespace {

using Refraction = GlTest;

const std::string kChristmas = "#include \"" GLINT_REPOSITORY "/fragments/christmas.frag\"\n";

double angle_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

struct Ray {
    glm::vec3 rd, nor;
    float eta;  // index before over index behind
};
// To a surface anyhow in space, at so many radians from it.
Ray ray_at(Random& random, double lift, double eta) {
    const glm::dvec3 nor = random.direction();
    const glm::dvec3 side = glm::normalize(glm::cross(nor, random.direction()));
    const glm::dvec3 rd = std::cos(lift) * side - std::sin(lift) * nor;
    return {glm::vec3(rd), glm::vec3(nor), static_cast<float>(eta)};
}
constexpr double kRight = 0.5 * std::numbers::pi;
// Indices between `least` and 1 / `least`.
std::vector<Ray> rays(double least) {
    Random random{std::mt19937(31)};
    std::vector<Ray> all;
    while (all.size() < 65536) {
        // Angles from straight down to grazing, many of them within a degree of it.
        const double lift = std::pow(10.0, random.uniform(-6.0, 0.0)) * kRight;
        all.push_back(
            ray_at(random, lift, std::exp(random.uniform(std::log(least), -std::log(least)))));
    }
    all.push_back({{0, -1, 0}, {0, 1, 0}, 1.5f});
    all.push_back({{1, 0, 0}, {0, 1, 0}, 1.5f});
    all.push_back({{1, 0, 0}, {0, 1, 0}, 1.0f});
    return all;
}
std::vector<ProbeCase> cases_of(const std::vector<Ray>& all) {
    std::vector<ProbeCase> cases;
    for (const Ray& ray : all) {
        cases.push_back(
            {.a = glm::vec4(ray.rd, 0), .b = glm::vec4(ray.nor, 0), .c = {ray.eta, 0, 0, 0}});
    }
    return cases;
}

// The share that the built-in functions leave without a number.
double expect_to_bend_rightly(const std::vector<Ray>& all, Bar& bar, std::string_view where) {
    const auto bent = probe_all(kAnalytic, "refractExactly(a.xyz, b.xyz, c.x)", cases_of(all));
    const auto built_in = probe_all("", "normalize(refract(a.xyz, b.xyz, c.x))", cases_of(all));
    double worst = 0.0;
    std::size_t not_numbers = 0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        const glm::vec3 got(bent[i]);
        EXPECT_NEAR(glm::length(got), 1.0f, 1e-6f) << i;  // fails for what is no number, too
        if (!std::isfinite(built_in[i].x)) ++not_numbers;
        const Real3 rd(all[i].rd), nor(all[i].nor);
        const Real eta = all[i].eta,
                   cosine = -glm::dot(rd, nor) / (glm::length(rd) * glm::length(nor));
        const Real k = 1.0L - eta * eta * (1.0L - cosine * cosine);
        // At the critical angle a rounding of the inputs turns the way out by its square root.
        if (k < 0.01L) continue;
        const Real3 truth =
            eta * glm::normalize(rd) + (eta * cosine - std::sqrt(k)) * glm::normalize(nor);
        worst = std::max(worst, angle_between(glm::dvec3(got), glm::dvec3(truth)));
    }
    bar.see(worst, where);
    return static_cast<double>(not_numbers) / static_cast<double>(all.size());
}

TEST_F(Refraction, IsFiniteAndRightAtEveryAngleAndIndex) {
    Bar bar("Q7 analytic: directions, rad", 5e-6);
    EXPECT_GT(expect_to_bend_rightly(rays(0.4), bar, "indices 0.4 to 2.5"), 0.1)
        << "the built-in way fails in total reflection";
}
// Rays near one angle and one ratio of the indices, which comes to within 1e-7 of 1.
TEST_F(Refraction, IsRightWhateverTheCase) {
    Bar bar("Q7 analytic: directions, rad", 5e-6);
    search_worst(3, 64, {&bar}, [&](Dials& dials) {
        Random random{std::mt19937(dials.number)};
        const double lift = dials.between_logs(1e-6, 1.0) * kRight;
        const double apart = dials.between_logs(1e-7, std::log(4.0));
        const double eta = std::exp(dials.share() < 0.5 ? -apart : apart);
        std::vector<Ray> all;
        while (all.size() < 8192)
            all.push_back(ray_at(random, std::min(lift * random.uniform(0.95, 1.05), kRight),
                                 eta * random.uniform(0.99, 1.01)));
        expect_to_bend_rightly(
            all, bar, fmt::format("indices {:.8g}, {:.4g} degrees up", eta, lift / kRight * 90.0));
    });
}

// Where the cosine, which is near 1, decides by its last digits whether anything gets through.
TEST_F(Refraction, IsRightNearTheCriticalAngleOfADenseGlass) {
    Bar bar("Q7 analytic: directions, rad", 5e-6);
    Random random{std::mt19937(7)};
    std::vector<Ray> all;
    while (all.size() < 65536)
        all.push_back(
            ray_at(random, 1.339 * random.uniform(0.95, 1.05), 4.0 * random.uniform(0.99, 1.01)));
    expect_to_bend_rightly(all, bar, "indices 4, 76.72 degrees up");
}

TEST_F(Refraction, EqualIndicesDoNotBend) {
    Bar bar("Q7 analytic: bend at equal indices, rad", 1e-6);
    const auto all = rays(1.0);
    const auto bent = probe_all(kAnalytic, "refractExactly(a.xyz, b.xyz, c.x)", cases_of(all));
    const auto built_in = probe_all("", "refract(a.xyz, b.xyz, c.x)", cases_of(all));
    double worst = 0.0, worst_built_in = 0.0;
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (all[i].eta != 1.0f) continue;
        worst = std::max(worst, angle_between(glm::dvec3(bent[i]), glm::dvec3(all[i].rd)));
        worst_built_in =
            std::max(worst_built_in, angle_between(glm::dvec3(built_in[i]), glm::dvec3(all[i].rd)));
    }
    bar.see(worst, "");
    EXPECT_GE(worst_built_in, 1e-5) << "the built-in function bends, or these rays prove nothing";
}

// What gets through, from the amplitudes of both polarisations (Born and Wolf, 1.5.2).
Real transmitted(Real cosine, Real eta) {  // eta: index behind over index before
    const Real sine2 = (1.0L - cosine * cosine) / (eta * eta);
    if (sine2 >= 1.0L) return 0.0L;
    const Real beyond = std::sqrt(1.0L - sine2);
    const Real ts = 2.0L * cosine / (cosine + eta * beyond);
    const Real tp = 2.0L * cosine / (eta * cosine + beyond);
    return cosine == 0.0L ? 0.0L : 0.5L * (ts * ts + tp * tp) * eta * beyond / cosine;
}
// Cases of a cosine and a ratio of indices.
void expect_to_sum_to_one(const std::string& scene, const std::vector<ProbeCase>& cases, Bar& bar) {
    const auto reflected = probe_all(scene, "fresnel(a.x, a.y)", cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        ASSERT_GE(reflected[i].x, 0.0f);
        ASSERT_LE(reflected[i].x, 1.0f);
        const Real cosine = cases[i].a.x, eta = cases[i].a.y;
        // At the critical angle R leaves 1 like a root: a rounding of the cosine moves it further.
        const Real rounding = std::abs(transmitted(cosine * (1.0L + 1.2e-7L), eta) -
                                       transmitted(cosine * (1.0L - 1.2e-7L), eta));
        const Real sum = Real{reflected[i].x} + transmitted(cosine, eta) - 1.0L;
        bar.see(static_cast<double>(std::abs(sum) - rounding),
                fmt::format("cosine {:.7g}, indices {:.7g}", cases[i].a.x, cases[i].a.y));
    }
}
constexpr double kMostLost = 1e-6;
constexpr const char* kLost = "Q7 {}: |R + T - 1|";
TEST_F(Refraction, ReflectedAndTransmittedLightSumToOne) {
    std::vector<ProbeCase> cases;
    for (int i = 0; i <= 255; ++i) {
        for (int j = 0; j <= 255; ++j) {
            const double cosine = std::pow(static_cast<double>(i) / 255.0, 2.0);
            const double eta = 0.4 * std::pow(2.5 / 0.4, static_cast<double>(j) / 255.0);
            cases.push_back({.a = {static_cast<float>(cosine), static_cast<float>(eta), 0, 0}});
        }
    }
    for (int i = 0; i <= 255; ++i)
        cases.push_back({.a = {static_cast<float>(i) / 255.0f, 1, 0, 0}});
    for (const auto& [name, scene] :
         {std::pair("analytic", kAnalytic), {"christmas", kChristmas}}) {
        Bar lost(fmt::format(fmt::runtime(kLost), name), kMostLost);
        expect_to_sum_to_one(scene, cases, lost);
    }
}
TEST_F(Refraction, LightSumsToOneWhateverTheCase) {
    Bar lost(fmt::format(fmt::runtime(kLost), "analytic"), kMostLost);
    search_worst(2, 64, {&lost}, [&](Dials& dials) {
        Random random{std::mt19937(dials.number)};
        const double cosine = dials.between_logs(1e-6, 1.0);
        const double eta = dials.between_logs(0.4, 2.5);
        std::vector<ProbeCase> cases;
        while (cases.size() < 8192)
            cases.push_back({.a = {std::min(cosine * random.uniform(0.95, 1.05), 1.0),
                                   eta * random.uniform(0.99, 1.01), 0, 0}});
        expect_to_sum_to_one(kAnalytic, cases, lost);
    });
}

TEST_F(Refraction, TheDisplayCurveIsWithinZeroAndOneAndNeverFalls) {
    const float inf = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<ProbeCase> cases;
    for (const float x : {nan, -inf, -1e30f, -1.0f, -1e-30f, 0.0f})
        cases.push_back({.a = glm::vec4(x)});
    const std::size_t dark = cases.size();
    for (int i = 0; i < 16000; ++i) {
        const float x = std::pow(10.0f, -9.0f + 47.0f * static_cast<float>(i) / 16000.0f);
        cases.push_back({.a = glm::vec4(x)});
    }
    cases.push_back({.a = glm::vec4(inf)});
    for (const std::string& scene : {kAnalytic, kChristmas}) {
        const auto shown = probe(scene, "display(a.xyz)", cases);
        for (std::size_t i = 0; i < cases.size(); ++i) {
            ASSERT_TRUE(shown[i].x >= 0.0f && shown[i].x <= 1.0f) << cases[i].a.x;
            if (i < dark) {
                ASSERT_EQ(shown[i].x, 0.0f) << cases[i].a.x;
            } else {  // a rounding of exp and pow is far below the step between 8-bit colours
                ASSERT_GE(shown[i].x, shown[i - 1].x - 1e-6f) << cases[i].a.x;
            }
        }
        EXPECT_NEAR(shown.back().x, 1.0f, 1e-6f) << "infinity is white";
        EXPECT_GT(shown[dark + 8000].x, shown[dark + 3000].x);
        // A coloured light with one channel at infinity or NaN stays a colour.
        const std::vector<ProbeCase> mixed = {{.a = {inf, 1, 0, 0}}, {.a = {nan, 1, 0, 0}}};
        for (const glm::vec4& c : probe(scene, "display(a.xyz)", mixed)) {
            for (int k = 0; k < 3; ++k) EXPECT_TRUE(c[k] >= 0.0f && c[k] <= 1.0f);
        }
    }
}

// A colour that gets brighter never shows darker, nor a channel out of range: 64 colours round one.
TEST_F(Refraction, TheDisplayCurveNeverFallsWhateverTheCase) {
    Bar range("Q18 all: beyond 0 or 1", 0.0), fall("Q18 all: luminance lost by more light", 2e-6);
    constexpr std::size_t kSteps = 256;
    search_worst(3, 48, {&range, &fall}, [&](Dials& dials) {
        Random random{std::mt19937(dials.number)};
        glm::dvec3 colour;
        for (int k = 0; k < 3; ++k) colour[k] = dials.between_logs(1e-4, 1.0);
        std::vector<ProbeCase> cases;
        for (int one = 0; one < 64; ++one) {
            glm::dvec3 light = colour;
            for (int k = 0; k < 3; ++k) light[k] *= random.uniform(0.9, 1.1);
            if (one % 4 == 0) light[one % 3] = 0.0;
            for (std::size_t i = 0; i < kSteps; ++i) {
                const double factor = std::pow(10.0, -5.0 + 14.0 * static_cast<double>(i) / kSteps);
                cases.push_back({.a = glm::vec4(glm::vec3(light * factor), 0)});
            }
        }
        const auto shown = probe_all(kAnalytic, "display(a.xyz)", cases);
        double last = 0.0;
        for (std::size_t i = 0; i < cases.size(); ++i) {
            const glm::vec4& light = cases[i].a;
            const std::string where =
                fmt::format("light {:.3g} {:.3g} {:.3g}", light.x, light.y, light.z);
            const glm::dvec3 c(shown[i]);
            for (int k = 0; k < 3; ++k) range.see(std::max(c[k] - 1.0, -c[k]), where);
            const double luminance = glm::dot(c, glm::dvec3(0.2126, 0.7152, 0.0722));
            if (i % kSteps != 0) fall.see(last - luminance, where);
            last = luminance;
        }
    });
}

}  // namespace
}  // namespace glint::refraction_test
