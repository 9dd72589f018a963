// `--samples`: the mean of sub-pixel positions in linear light.
#include "render/average.h"

#include "../fragments/probe.h"

#include <cmath>
#include <set>

namespace glint::average_test {
namespace {

using Averaging = GlTest;

// IEC 61966-2-1, in double precision.
double decode(double c) {
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}
double encode(double c) {
    return c <= 0.0031308 ? c * 12.92 : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055;
}

// Two powers in float: 2.4 and its inverse amplify an error of a few last digits, and no more.
constexpr double kPowError = 2e-6;

TEST(SubPixelPosition, OneIsTheCentre) {
    EXPECT_EQ(sub_pixel_position(0, 1), glm::vec2(0));
}

TEST(SubPixelPosition, AnyCountIsCentredAndStratifiedInBothDirections) {
    for (const int count : {1, 2, 3, 4, 5, 7, 8, 12, 16, 17, 33, 37, 64, 100, 1000, 4096}) {
        SCOPED_TRACE(count);
        glm::dvec2 sum(0.0);
        std::set<int> columns, rows;
        for (int i = 0; i < count; ++i) {
            const glm::vec2 at = sub_pixel_position(i, count);
            EXPECT_LT(std::abs(at.x), 0.5f);
            EXPECT_LT(std::abs(at.y), 0.5f);
            sum += glm::dvec2(at);
            columns.insert(static_cast<int>((at.x + 0.5f) * static_cast<float>(count)));
            rows.insert(static_cast<int>((at.y + 0.5f) * static_cast<float>(count)));
        }
        EXPECT_NEAR(sum.x / count, 0.0, 3e-8) << "each position is rounded to float";
        EXPECT_NEAR(sum.y / count, 0.0, 3e-8);
        EXPECT_EQ(columns.size(), static_cast<std::size_t>(count));
        EXPECT_EQ(rows.size(), static_cast<std::size_t>(count));
    }
}

TEST(SubPixelPosition, APowerOfTwoIsTheHammersleySet) {
    const float eighths[] = {0, 4, 2, 6, 1, 5, 3, 7};
    for (int i = 0; i < 8; ++i) {
        EXPECT_EQ(sub_pixel_position(i, 8).y, (eighths[i] + 0.5f) / 8.0f - 0.5f) << i;
    }
}

TEST_F(Averaging, AFlatColourStaysItself) {
    Player player("void mainImage(out vec4 c, vec2 p) { c = vec4(floor(p.x) / 64.0 - 0.25); }",
                  {.size = {96, 1}, .samples = 5});
    player.draw(0);
    const std::vector<float> values = player.floats();
    for (std::size_t x = 0; x < 96; ++x) {
        const double expected = static_cast<double>(x) / 64.0 - 0.25;  // beyond 0 and 1 too
        EXPECT_NEAR(values[x * 4], expected, kPowError * std::max(1.0, std::abs(expected)));
    }
}

TEST_F(Averaging, AHalfCoveredPixelIsHalfAsBrightInLinearLight) {
    const std::string edge =
        "void mainImage(out vec4 c, vec2 p) { c = vec4(step(1.5, p.x), step(0.5, p.y), 1, 1); }";
    Player player(edge, {.size = {3, 1}, .samples = 16});
    player.draw(0);
    EXPECT_NEAR(player.colour(0).x, 0.0, kPowError);
    EXPECT_NEAR(player.colour(1).x, encode(0.5), kPowError);
    EXPECT_NEAR(player.colour(1).y, encode(0.5), kPowError);
    EXPECT_NEAR(player.colour(2).x, 1.0, kPowError);
    Player bytes(edge, {.size = {3, 1}, .samples = 16, .format = PixelFormat::rgba8});
    bytes.draw(0);
    EXPECT_EQ(std::round(bytes.colour(1).x * 255.0f), 188.0f) << "0.7354 of 255, not 128";
}

TEST_F(Averaging, TheMeanAgreesWithDoublePrecision) {
    for (const int samples : {2, 3, 16, 37}) {
        SCOPED_TRACE(samples);
        Player player(
            "void mainImage(out vec4 c, vec2 p) {\n"
            "    vec2 f = fract(p);\n"
            "    c = vec4(f, f.x * f.y, 1);\n"
            "}\n",
            {.samples = samples});
        player.draw(0);
        glm::dvec3 sum(0.0);
        for (int i = 0; i < samples; ++i) {
            const glm::dvec2 f = glm::dvec2(sub_pixel_position(i, samples)) + 0.5;
            sum += glm::dvec3(decode(f.x), decode(f.y), decode(f.x * f.y));
        }
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(player.colour(2, 1)[c], encode(sum[c] / samples), kPowError);
        }
    }
}

TEST_F(Averaging, AFileOfBytesClipsEachPositionAsADisplayWould) {
    const std::string lamp =
        "void mainImage(out vec4 c, vec2 p) { c = vec4(fract(p.x) < 0.5 ? 40.0 : 0.0); }";
    Player bytes(lamp, {.samples = 4, .format = PixelFormat::rgba8});
    bytes.draw(0);
    EXPECT_EQ(std::round(bytes.colour().x * 255.0f), 188.0f);
    Player floats(lamp, {.samples = 4});
    floats.draw(0);
    EXPECT_NEAR(floats.colour().x, encode(decode(40.0) / 2), 40 * kPowError) << "kept for an EXR";
}

TEST_F(Averaging, BuffersOfThePicturesOwnPixelsMoveWithItAndStateStandsStill) {
    Player player(
        "uniform sampler2D own; //@ pass mainOwn\n"
        "uniform sampler2D half_size; //@ pass mainHalf scale=0.5\n"
        "uniform sampler2D count; //@ pass mainCount\n"
        "void mainOwn(out vec4 c, vec2 p) { c = vec4(step(0.5, fract(p)), 0, 0); }\n"
        "void mainHalf(out vec4 c, vec2 p) { c = vec4(fract(p), 0, 0); }\n"
        "void mainCount(out vec4 c, vec2 p) { c = texelFetch(count, ivec2(p), 0) + vec4(1, "
        "fract(p), 0); }\n"
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    ivec2 i = ivec2(p);\n"
        "    c = vec4(texelFetch(own, i, 0).x, texelFetch(half_size, i / 2, 0).x,\n"
        "             texelFetch(count, i, 0).x / 10.0, 1);\n"
        "    if (p.x > 2.0) c.xy = texelFetch(count, i, 0).yz / 2.0;\n"
        "}\n",
        {.samples = 16});
    player.draw_frames(0, 2);
    EXPECT_NEAR(player.colour(0).x, encode(0.5), kPowError) << "half of it was covered";
    EXPECT_NEAR(player.colour(0).y, 0.5, kPowError) << "other pixels than the picture's stay";
    EXPECT_NEAR(player.colour(0).z, 0.2, kPowError) << "two frames, however many positions";
    EXPECT_NEAR(player.colour(3).x, 0.5, kPowError) << "state is drawn at the centre";
    EXPECT_NEAR(player.colour(3).y, 0.5, kPowError);
}

}  // namespace
}  // namespace glint::average_test
