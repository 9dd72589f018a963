// FLIP against what the papers say in words, and against the same formulas written out once more:
// in double, over the plane at once, pixel by pixel.
#include "measure/rows/flip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>

namespace glint {
namespace {

using Colour = std::array<double, 3>;

struct Picture {
    glm::ivec2 size;
    std::vector<float> rgba;
};

Picture painted(glm::ivec2 size, const std::function<Colour(int, int)>& colour) {
    Picture picture{size, {}};
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            for (const double c : colour(x, y)) picture.rgba.push_back(static_cast<float>(c));
            picture.rgba.push_back(1.0f);
        }
    }
    return picture;
}

Picture plain(Colour colour, glm::ivec2 size = {24, 16}) {
    return painted(size, [&](int, int) { return colour; });
}

// The same everywhere, from 0 to 1.
double noise(int x, int y, int seed) {
    auto h = static_cast<std::uint32_t>(x * 7919 + y * 104729 + seed * 15485863);
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return (h ^ (h >> 16)) / 4294967296.0;
}

Picture noisy(glm::ivec2 size, int seed, double scale = 1.0) {
    return painted(size, [&](int x, int y) {
        return Colour{scale * noise(x, y, seed), scale * noise(x, y, seed + 1),
                      scale * noise(x, y, seed + 2)};
    });
}

std::vector<float> map_of(const Picture& a, const Picture& b, const FlipOptions& options = {}) {
    return flip_map(a.rgba, b.rgba, a.size, options);
}

double flip(const Picture& a, const Picture& b, const FlipOptions& options = {}) {
    return mean(map_of(a, b, options));
}

// ---- The formulas of 2020 once more -------------------------------------------------------------

constexpr double kPi = std::numbers::pi;

double to_light(double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

// Rows of the matrix of sRGB; the white is the sum of its columns.
constexpr double kXyz[3][3] = {{0.4123865632529917, 0.3575914909206254, 0.1804504912035636},
                               {0.2126368216773238, 0.7151829818412507, 0.0721801964814254},
                               {0.0193306201524840, 0.1191971636402085, 0.9503725870054354}};
// Its inverse, as it is written in tables, to seven digits.
constexpr double kRgb[3][3] = {{3.2410032, -1.5373990, -0.4986159},
                               {-0.9692243, 1.8759300, 0.0415542},
                               {0.0556394, -0.2040112, 1.0571490}};

Colour times(const double (&m)[3][3], const Colour& v) {
    Colour result{};
    for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) result[i] += m[i][j] * v[j];
    return result;
}

Colour white() {
    return times(kXyz, {1, 1, 1});
}

Colour hunt_lab(const Colour& light) {
    Colour f = times(kXyz, light);
    for (std::size_t i = 0; i < 3; ++i) {
        const double t = f[i] / white()[i];
        f[i] = t > std::pow(6.0 / 29.0, 3.0) ? std::cbrt(t) : t * 841.0 / 108.0 + 4.0 / 29.0;
    }
    const double lightness = 116.0 * f[1] - 16.0;
    return {lightness, 0.01 * lightness * 500.0 * (f[0] - f[1]),
            0.01 * lightness * 200.0 * (f[1] - f[2])};
}

double hyab(const Colour& a, const Colour& b) {
    return std::abs(a[0] - b[0]) +
           std::sqrt((a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

using Field = std::vector<double>;
using Weight = std::function<double(int, int)>;

// Over the whole square at once; the last pixel goes on beyond the edge. Positive and negative
// weights are made to have the sums 1 and -1.
Field filtered(const Field& field, glm::ivec2 size, int radius, const Weight& weight) {
    double up = 0.0, down = 0.0;
    Field weights;
    for (int dy = -radius; dy <= radius; ++dy) {
        for (int dx = -radius; dx <= radius; ++dx) {
            weights.push_back(weight(dx, dy));
            (weights.back() > 0.0 ? up : down) += std::abs(weights.back());
        }
    }
    for (double& w : weights) w /= w > 0.0 ? up : down;
    Field result;
    for (int y = 0; y < size.y; ++y) {
        for (int x = 0; x < size.x; ++x) {
            double sum = 0.0;
            const double* w = weights.data();
            for (int dy = -radius; dy <= radius; ++dy) {
                const int row = std::clamp(y + dy, 0, size.y - 1) * size.x;
                for (int dx = -radius; dx <= radius; ++dx)
                    sum += *w++ * field.data()[row + std::clamp(x + dx, 0, size.x - 1)];
            }
            result.push_back(sum);
        }
    }
    return result;
}

struct Features {
    std::vector<Colour> colours;
    Field edges, points;
};

Features features(const Picture& picture, double per_degree) {
    std::array<Field, 3> opponent;
    for (std::size_t i = 0; i < picture.rgba.size(); i += 4) {
        Colour xyz{};
        for (std::size_t c = 0; c < 3; ++c)
            xyz[c] = to_light(std::clamp(double(picture.rgba[i + c]), 0.0, 1.0));
        xyz = times(kXyz, xyz);
        for (std::size_t c = 0; c < 3; ++c) xyz[c] /= white()[c];
        opponent[0].push_back(116.0 * xyz[1] - 16.0);
        opponent[1].push_back(500.0 * (xyz[0] - xyz[1]));
        opponent[2].push_back(200.0 * (xyz[1] - xyz[2]));
    }
    const int radius =
        static_cast<int>(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * kPi * kPi)) * per_degree));
    const auto gaussian = [&](double a, double b, int x, int y) {
        const double z = (x * x + y * y) / (per_degree * per_degree);
        return a * std::sqrt(kPi / b) * std::exp(-kPi * kPi * z / b);
    };
    const Field blurred[3] = {filtered(opponent[0], picture.size, radius,
                                       [&](int x, int y) { return gaussian(1.0, 0.0047, x, y); }),
                              filtered(opponent[1], picture.size, radius,
                                       [&](int x, int y) { return gaussian(1.0, 0.0053, x, y); }),
                              filtered(opponent[2], picture.size, radius, [&](int x, int y) {
                                  return gaussian(34.1, 0.04, x, y) + gaussian(13.5, 0.025, x, y);
                              })};
    Features result;
    Field luminance;
    for (std::size_t i = 0; i < opponent[0].size(); ++i) {
        const double y = (blurred[0][i] + 16.0) / 116.0;
        Colour light = {(y + blurred[1][i] / 500.0) * white()[0], y * white()[1],
                        (y - blurred[2][i] / 200.0) * white()[2]};
        light = times(kRgb, light);
        for (double& c : light) c = std::clamp(c, 0.0, 1.0);
        result.colours.push_back(hunt_lab(light));
        luminance.push_back((opponent[0][i] + 16.0) / 116.0);
    }
    const double sigma = 0.5 * 0.082 * per_degree;
    const int reach = static_cast<int>(std::ceil(3.0 * sigma));
    const auto g = [&](int x, int y) { return std::exp(-(x * x + y * y) / (2.0 * sigma * sigma)); };
    const auto size_of = [&](const Weight& weight) {
        const Field x = filtered(luminance, picture.size, reach, weight);
        const Field y = filtered(luminance, picture.size, reach,
                                 [&](int dx, int dy) { return weight(dy, dx); });
        Field both;
        for (std::size_t i = 0; i < x.size(); ++i) both.push_back(std::hypot(x[i], y[i]));
        return both;
    };
    result.edges = size_of([&](int x, int y) { return -x * g(x, y); });
    result.points =
        size_of([&](int x, int y) { return (x * x / (sigma * sigma) - 1.0) * g(x, y); });
    return result;
}

Field by_the_paper(const Picture& a, const Picture& b, double per_degree) {
    const Features of_a = features(a, per_degree), of_b = features(b, per_degree);
    const double most = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), 0.7);
    Field map;
    for (std::size_t i = 0; i < of_a.colours.size(); ++i) {
        const double d = std::pow(hyab(of_a.colours[i], of_b.colours[i]), 0.7);
        const double colour = d < 0.4 * most
                                  ? 0.95 / (0.4 * most) * d
                                  : 0.95 + (d - 0.4 * most) / (most - 0.4 * most) * (1.0 - 0.95);
        const double feature = std::max(std::abs(of_a.edges[i] - of_b.edges[i]),
                                        std::abs(of_a.points[i] - of_b.points[i]));
        map.push_back(std::pow(colour, 1.0 - std::pow(feature / std::sqrt(2.0), 0.5)));
    }
    return map;
}

// ---- What must hold -----------------------------------------------------------------------------

// Floats and products of two kernels against doubles and the plane at once: the square root in the
// features makes 1e-3 of the last digits of a float.
TEST(Flip, IsWhatThePaperWritesPixelByPixel) {
    const Picture a = noisy({31, 23}, 1);
    const Picture b = painted(a.size, [&](int x, int y) {
        return Colour{noise(x, y, 1) * 0.9, x / 31.0, y > 11 ? noise(x, y, 9) : 0.5};
    });
    for (const double per_degree : {67.02, 20.0, 100.0}) {
        const std::vector<float> map = map_of(a, b, {.pixels_per_degree = per_degree});
        const Field paper = by_the_paper(a, b, per_degree);
        ASSERT_EQ(map.size(), paper.size());
        double most = 0.0, sum = 0.0;
        for (std::size_t i = 0; i < map.size(); ++i) {
            most = std::max(most, std::abs(map[i] - paper[i]));
            sum += paper[i];
        }
        EXPECT_LT(most, 1e-3) << per_degree;
        EXPECT_NEAR(mean(map), sum / static_cast<double>(map.size()), 1e-5) << per_degree;
    }
}

TEST(Flip, OfEqualPicturesIsExactlyNothing) {
    const Picture picture = noisy({40, 30}, 1);
    for (const Values values : {Values::display, Values::light})
        for (const float v : map_of(picture, picture, {.values = values})) ASSERT_EQ(v, 0.0f);
}

// Whole pictures of one colour have no edges and nothing to blur: HyAB alone, by hand. Black and
// white are 100 apart, and the knee lies at 0.4 of 203.3^0.7.
TEST(Flip, OfWholeColoursIsTheirHyab) {
    const double most = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), 0.7);
    EXPECT_NEAR(most, 41.28, 0.01);
    const double black_white =
        0.95 + 0.05 * (std::pow(100.0, 0.7) - 0.4 * most) / (most - 0.4 * most);
    EXPECT_NEAR(black_white, 0.9674, 1e-4);
    EXPECT_NEAR(flip(plain({0, 0, 0}), plain({1, 1, 1})), black_white, 1e-5);
    EXPECT_NEAR(flip(plain({0, 1, 0}), plain({0, 0, 1})), 1.0, 1e-5) << "the largest there is";
    const double greys = 0.95 / (0.4 * most) *
                         std::pow(hyab(hunt_lab({to_light(0.5), to_light(0.5), to_light(0.5)}),
                                       hunt_lab({to_light(0.6), to_light(0.6), to_light(0.6)})),
                                  0.7);
    // The features of a plain picture are 1e-8 of rounding, of which the root is taken.
    EXPECT_NEAR(flip(plain({0.5, 0.5, 0.5}), plain({0.6, 0.6, 0.6})), greys, 2e-4);
}

TEST(Flip, IsFromNothingToOneWhateverIsCompared) {
    for (int seed = 0; seed < 5; ++seed) {
        const Picture a = noisy({33, 21}, seed * 10, 1.0 + seed);
        const Picture b = noisy({33, 21}, seed * 10 + 5, seed % 2 ? 100.0 : 1.0);
        for (const Values values : {Values::display, Values::light})
            for (const float v : map_of(a, b, {.values = values})) {
                ASSERT_GE(v, 0.0f);
                ASSERT_LE(v, 1.0f);
            }
    }
}

TEST(Flip, IsTheSameBothWays) {
    const Picture a = noisy({40, 30}, 1), b = noisy({40, 30}, 7);
    EXPECT_EQ(map_of(a, b), map_of(b, a));
}

TEST(Flip, GrowsWithContrast) {
    const auto step = [](double height) {
        return painted({40, 24}, [=](int x, int) {
            const double v = x < 20 ? 0.4 : 0.4 + height;
            return Colour{v, v, v};
        });
    };
    double before = 0.0;
    for (const double height : {0.01, 0.02, 0.05, 0.1, 0.2, 0.4, 0.6}) {
        const double found = flip(step(height), step(0.0));
        EXPECT_GT(found, before) << height;
        before = found;
    }
}

// A band moves by two pixels, or the same squares are strewn as single pixels of noise: RMSE sees
// no difference between the two, FLIP finds the edge that moved the worse.
TEST(Flip, AnEdgeThatMovesIsWorseThanAsMuchNoise) {
    const glm::ivec2 size{64, 64};
    const auto grey = [](double v) { return Colour{v, v, v}; };
    const auto band = [&](int from) {
        return painted(size, [=](int x, int) { return grey(x >= from ? 0.7 : 0.3); });
    };
    const Picture still = band(32), moved = band(34);
    // 2 of 64 columns differ by 0.4: so 1 pixel in 8 by 0.2, up or down.
    const Picture strewn = painted(size, [&](int x, int y) {
        const double off = noise(x, y, 3) < 0.125 ? (noise(x, y, 4) < 0.5 ? -0.2 : 0.2) : 0.0;
        return grey((x >= 32 ? 0.7 : 0.3) + off);
    });
    const auto squares = [&](const Picture& p) {
        double sum = 0.0;
        for (std::size_t i = 0; i < p.rgba.size(); ++i)
            sum += std::pow(double(p.rgba[i]) - still.rgba[i], 2.0);
        return sum;
    };
    EXPECT_NEAR(squares(strewn) / squares(moved), 1.0, 0.1);
    const auto most = [](const std::vector<float>& map) { return *std::ranges::max_element(map); };
    EXPECT_GT(most(map_of(moved, still)), 1.2f * most(map_of(strewn, still)));
    // From further away noise of single pixels blurs into nothing before the edge does.
    const double near = flip(strewn, still, {.pixels_per_degree = 67.02});
    const double far = flip(strewn, still, {.pixels_per_degree = 268.0});
    EXPECT_LT(far, 0.7 * near);
    EXPECT_GT(most(map_of(moved, still, {.pixels_per_degree = 268.0})), 0.1f);
}

// The picture is worked on in bands of 64 rows; and a part of it that is cut out with 10 pixels
// more on each side, as far as a pixel sees, has the same answers.
TEST(Flip, OfAPartIsAPartOfTheWhole) {
    const Picture a = noisy({50, 150}, 1), b = noisy({50, 150}, 2);
    const auto cut = [](const Picture& p, glm::ivec2 corner, glm::ivec2 size) {
        return painted(size, [&](int x, int y) {
            const float* rgb =
                &p.rgba[static_cast<std::size_t>(((corner.y + y) * p.size.x + corner.x + x) * 4)];
            return Colour{rgb[0], rgb[1], rgb[2]};
        });
    };
    const glm::ivec2 corner{8, 45}, size{36, 60};
    const std::vector<float> whole = map_of(a, b);
    const std::vector<float> part = map_of(cut(a, corner, size), cut(b, corner, size));
    for (int y = 10; y < size.y - 10; ++y)
        for (int x = 10; x < size.x - 10; ++x)
            ASSERT_EQ(part[static_cast<std::size_t>(y * size.x + x)],
                      whole[static_cast<std::size_t>((corner.y + y) * 50 + corner.x + x)])
                << x << " " << y;
}

TEST(Flip, APixelThatIsNotFiniteIsAsWrongAsCanBe) {
    Picture a = plain({0.5, 0.5, 0.5});
    const Picture b = a;
    a.rgba[4 * 100 + 1] = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> map = map_of(a, b);
    EXPECT_EQ(map[100], 1.0f);
    for (const float v : map) EXPECT_TRUE(v >= 0.0f && v <= 1.0f);
    EXPECT_EQ(flip({{0, 0}, {}}, {{0, 0}, {}}), 0.0);
}

TEST(Flip, ADegreeHasSixtySevenPixelsOnTheUsualScreen) {
    EXPECT_NEAR(pixels_per_degree(0.7, 0.7, 3840.0), FlipOptions().pixels_per_degree, 0.01);
}

// Where the film curve shows 0.85, as the root of a quadratic equation.
TEST(HdrFlip, LooksFromTheBrightestPixelToTheMedian) {
    const double t = 0.85;
    const double a = 0.36 * 2.51 - t * 0.36 * 2.43, b = 0.6 * 0.03 - t * 0.6 * 0.59, c = -t * 0.14;
    const double shown = (-b + std::sqrt(b * b - 4 * a * c)) / (2 * a);
    const Picture light = painted({16, 16}, [](int x, int y) {
        const double v = x == 3 && y == 3 ? 100.0 : 0.5;
        return Colour{v, v, v};
    });
    const std::vector<double> stops = flip_exposures(light.rgba);
    ASSERT_EQ(stops.size(), 8u) << "log2(200) is 7.6";
    EXPECT_NEAR(stops.front(), std::log2(shown / 100.0), 1e-6);
    EXPECT_NEAR(stops.back(), std::log2(shown / 0.5), 1e-6);
    EXPECT_EQ(flip_exposures(plain({0.3, 0.3, 0.3}).rgba).size(), 2u);
    EXPECT_EQ(flip_exposures(plain({0, 0, 0}).rgba).size(), 2u);
}

// What clamping hides: a sun of 20 or of 40 is the same white on a display.
TEST(HdrFlip, SeesWhatADisplayClips) {
    const Picture a = plain({20, 20, 20}), b = plain({40, 40, 40});
    EXPECT_EQ(flip(a, b), 0.0);
    EXPECT_GT(flip(a, b, {.values = Values::light}), 0.05);
    // A hundred times as much light of both is the same to an eye that has adapted.
    const auto scaled = [](double s) {
        return painted({32, 24}, [=](int x, int y) {
            return Colour{s * noise(x, y, 1), s * noise(x, y, 2), s * noise(x, y, 3)};
        });
    };
    const auto other = [](double s) {
        return painted({32, 24}, [=](int x, int y) {
            return Colour{s * noise(x, y, 1), s * noise(x, y, 5), s * noise(x, y, 3)};
        });
    };
    EXPECT_NEAR(flip(scaled(1.0), other(1.0), {.values = Values::light}),
                flip(scaled(100.0), other(100.0), {.values = Values::light}), 1e-4);
}

}  // namespace
}  // namespace glint
