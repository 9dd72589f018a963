// What samplers read besides buffers (images, noise, the keyboard, nothing), and how they read it.
#include "fixture.h"
#include "media/image.h"
#include "render/channels.h"

#include <array>
#include <cstdint>

namespace glint::conformance_samplers_test {
namespace {

using Samplers = GlTest;

// PNG files for the scene's folder, as rows from the bottom up.
std::string png(glm::ivec2 size, int channels, const std::vector<int>& values) {
    Image image{.size = size, .channels = channels, .type = ChannelType::u8, .pixels = {}};
    for (const int value : values) image.pixels.push_back(static_cast<std::byte>(value));
    const TestFolder folder;
    write_image(folder.path() / "image.png", image);
    std::ifstream in(folder.path() / "image.png", std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(Samplers, AnImageStandsUprightUnlessVflipIsOff) {
    const File image{"image.png", png({2, 2}, 3,
                                      {10, 20, 30, 40, 50, 60,  // the bottom row
                                       70, 80, 90, 100, 110, 120})};
    struct {
        const char* option;
        glm::vec3 bottom_left, top_right;
    } const cases[] = {{"", {10, 20, 30}, {100, 110, 120}},
                       {"vflip=on", {10, 20, 30}, {100, 110, 120}},
                       {"vflip=off", {70, 80, 90}, {40, 50, 60}}};
    for (const auto& c : cases) {
        SCOPED_TRACE(c.option);
        Player player(fmt::format("uniform sampler2D wood; //@ image image.png {}\n"
                                  "void mainImage(out vec4 c, vec2 p) {{\n"
                                  "    c = floor(texelFetch(wood, ivec2(p), 0) * 255.0 + 0.5);\n"
                                  "}}\n",
                                  c.option),
                      {.size = {2, 2}, .files = {image}});
        player.draw(0);
        EXPECT_EQ(player.colour(0, 0), c.bottom_left);
        EXPECT_EQ(player.colour(1, 1), c.top_right);
    }
}

TEST_F(Samplers, AnImageLoadsAsBytesWithoutConversionOrPremultiplication) {
    Player player(
        "uniform sampler2D a; //@ pass mainA size=2x1\n"
        "uniform sampler2D wood; //@ image image.png filter=nearest\n"
        "void mainA(out vec4 c, vec2 p) { c = texelFetch(wood, ivec2(p), 0) * 255.0; }\n"
        "void mainImage(out vec4 c, vec2 p) { c = texelFetch(a, ivec2(0), 0); }\n",
        {.files = {{"image.png", png({2, 1}, 4, {102, 188, 13, 128, 200, 1, 254, 0})}},
         .pass = "a"});
    player.draw(0);
    for (int i = 0; i < 4; ++i) {
        // A driver turns bytes into floats with an error of half a last digit, times 255.
        const std::array left{102, 188, 13, 128}, right{200, 1, 254, 0};
        EXPECT_NEAR(player.pixel(0, 0)[i], left[static_cast<std::size_t>(i)], 2e-5);
        EXPECT_NEAR(player.pixel(1, 0)[i], right[static_cast<std::size_t>(i)], 2e-5);
    }
}

TEST_F(Samplers, AnImageKnowsItsSizeAndIsMipmappedAndRepeated) {
    Player player(
        "uniform sampler2D iChannel2; //@ image image.png\n"
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    c = vec4(iChannelResolution[2], 1);\n"
        "    if (p.x > 1.0) c = textureLod(iChannel2, vec2(0.5), 1.0) * 255.0;\n"
        "    if (p.x > 2.0) c = texture(iChannel2, vec2(1.25, -0.5)) * 255.0;\n"
        "}\n",
        {.files = {{"image.png", png({2, 1}, 3, {10, 20, 30, 50, 60, 70})}}});
    player.draw(0);
    EXPECT_EQ(player.colour(0), glm::vec3(2, 1, 1));
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(player.colour(1)[i], 30 + 10 * i, 0.51) << "the mean, kept as a byte";
        EXPECT_NEAR(player.colour(2)[i], 10 + 10 * i, 0.3)
            << "the first texel, one picture on; drivers filter bytes with 8 bits of fraction";
    }
}

TEST_F(Samplers, APresetBindsImagesToChannels) {
    Player player("void mainImage(out vec4 c, vec2 p) { c = texture(iChannel3, p) * 255.0; }",
                  {.preset = "[channels]\niChannel3 = { image = \"image.png\" }",
                   .files = {{"image.png", png({1, 1}, 3, {51, 102, 153})}}});
    player.draw(0);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(player.colour()[i], 51 * (i + 1), 2e-5);
}

// Written from the paper (Jarzynski and Olano 2020, listing of pcg3d), apart from the host's code.
std::array<std::uint32_t, 3> pcg3d(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    std::array<std::uint32_t, 3> v{x, y, z};
    for (auto& c : v) c = c * 1664525u + 1013904223u;
    const auto mix = [&v] {
        v[0] += v[1] * v[2];
        v[1] += v[2] * v[0];
        v[2] += v[0] * v[1];
    };
    mix();
    for (auto& c : v) c ^= c >> 16;
    mix();
    return v;
}

TEST_F(Samplers, NoiseIsPcg3dOfTheTexel) {
    Player player(
        "uniform sampler2D a; //@ pass mainA size=16x8\n"
        "uniform sampler2D n; //@ noise rgba 16x8\n"
        "void mainA(out vec4 c, vec2 p) { c = round(texelFetch(n, ivec2(p), 0) * 255.0); }\n"
        "void mainImage(out vec4 c, vec2 p) { c = texelFetch(a, ivec2(0), 0); }\n",
        {.pass = "a"});
    player.draw(0);
    for (std::uint32_t y = 0; y < 8; ++y) {
        for (std::uint32_t x = 0; x < 16; ++x) {
            const auto h = pcg3d(x, y, 0);
            const glm::vec4 read = player.pixel(static_cast<int>(x), static_cast<int>(y));
            for (std::size_t i = 0; i < 3; ++i)
                EXPECT_EQ(read[static_cast<int>(i)], static_cast<float>(h[i] >> 24));
            EXPECT_EQ(read.w, static_cast<float>((h[0] ^ h[1] ^ h[2]) >> 12 & 255u));
        }
    }
}

TEST_F(Samplers, NoiseHasTheSameBytesOnEveryMachine) {
    const auto bytes = noise_bytes({256, 256, 1}, 4);
    ASSERT_EQ(bytes.size(), 256u * 256u * 4u);
    const auto byte = [&](std::size_t i) { return std::to_integer<int>(bytes[i]); };
    // pcg3d(0, 0, 0) by hand: 1013904223 three times, and on from there.
    const auto h = pcg3d(0, 0, 0);
    EXPECT_EQ(byte(0), static_cast<int>(h[0] >> 24));
    double sum = 0.0;
    for (std::size_t i = 0; i < bytes.size(); ++i) sum += byte(i);
    EXPECT_NEAR(sum / static_cast<double>(bytes.size()), 127.5, 0.6)
        << "four standard errors of the mean of 65536 texels of four channels";
}

TEST_F(Samplers, NoiseHasAsManyChannelsAsItsNameSays) {
    const auto h = pcg3d(1, 0, 0);
    const auto value = [&](std::size_t i) { return static_cast<float>(h[i] >> 24); };
    struct {
        const char* channels;
        glm::vec3 expected;
    } const cases[] = {{"r", {value(0), 0, 0}},
                       {"rg", {value(0), value(1), 0}},
                       {"rgb", {value(0), value(1), value(2)}},
                       {"rgba", {value(0), value(1), value(2)}}};
    for (const auto& c : cases) {
        SCOPED_TRACE(c.channels);
        Player player(
            fmt::format("uniform sampler2D n; //@ noise {} 4\n"
                        "void mainImage(out vec4 c, vec2 p) {{\n"
                        "    c = round(texelFetch(n, ivec2(1, 0), 0) * 255.0);\n"
                        "}}\n",
                        c.channels));
        player.draw(0);
        EXPECT_EQ(player.colour(), c.expected);
    }
}

TEST_F(Samplers, VolumesOfNoiseAreReadByTheSceneAndByPresets) {
    const auto h = pcg3d(3, 2, 1);
    const glm::vec3 expected(static_cast<float>(h[0] >> 24), static_cast<float>(h[1] >> 24),
                             static_cast<float>(h[2] >> 24));
    const std::string show =
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    c = round(texelFetch(iChannel0, ivec3(3, 2, 1), 0) * 255.0);\n"
        "    if (p.x > 1.0) c = round(textureLod(iChannel0, vec3(3.5, 2.5, 1.5) / 4.0, 0.0) * "
        "255.0);\n"
        "}\n";
    Player declared("uniform sampler3D iChannel0; //@ noise rgba 4x4x4\n" + show);
    Player preset(show, {.preset = "[channels]\niChannel0 = { noise = \"rgba 4x4x4\" }"});
    Player both("uniform sampler3D iChannel0;\n" + show,
                {.preset = "[channels]\niChannel0 = { noise = \"rgba 4x4x4\" }"});
    for (Player* player : {&declared, &preset, &both}) {
        player->draw(0);
        EXPECT_EQ(player->colour(0), expected);
        EXPECT_EQ(player->colour(1), expected);
    }
}

TEST_F(Samplers, APresetBindsACubeToAChannel) {
    Player player(
        "uniform samplerCube sky; //@ pass mainSky size=4 format=rgba32f\n"
        "void mainSky(out vec4 c, in vec2 p, in vec3 ro, in vec3 rd) { c = vec4(sign(rd), 1); }\n"
        "#ifdef PASS_image\n"
        "void mainImage(out vec4 c, vec2 p) { c = texture(iChannel1, vec3(1, -0.9, 0.9)); }\n"
        "#endif\n",
        {.preset = "[channels]\niChannel1 = { buffer = \"sky\" }"});
    player.draw(0);
    for (int i = 0; i < 3; ++i) {
        EXPECT_NEAR(player.colour()[i], i == 1 ? -1 : 1, 1e-6)
            << "the weights of a filter sum to 1";
    }
}

TEST_F(Samplers, WrapTellsWhatLiesOutsideThePicture) {
    // A ramp 0 1 2 3; read at texel centres, so that filters give exact values.
    struct {
        const char* wrap;
        float below, above, far;  // at texels -1, 4 and 9
    } const cases[] = {{"clamp", 0, 3, 3}, {"repeat", 3, 0, 1}, {"mirror", 0, 3, 1}};
    for (const auto& c : cases) {
        for (const char* filter : {"nearest", "linear", "mipmap"}) {
            SCOPED_TRACE(fmt::format("{} {}", c.wrap, filter));
            Player player(
                fmt::format("uniform sampler2D a; //@ pass mainA size=4x1 wrap={} filter={}\n"
                            "void mainA(out vec4 c, vec2 p) {{ c = vec4(floor(p.x)); }}\n"
                            "void mainImage(out vec4 c, vec2 p) {{\n"
                            "    vec2 t = vec2(-0.5, 4.5) / 4.0;\n"
                            "    c = vec4(textureLod(a, t.xx, 0.0).x, textureLod(a, t.yy, 0.0).x,\n"
                            "             textureLod(a, vec2(9.5 / 4.0, 0.5), 0.0).x, 1);\n"
                            "}}\n",
                            c.wrap, filter));
            player.draw(0);
            EXPECT_EQ(player.colour(), glm::vec3(c.below, c.above, c.far));
        }
    }
}

TEST_F(Samplers, TheKeyboardShowsWhatIsHeldPressedNowAndToggled) {
    const std::string events = R"(
[[events]]
t = 0.1
key = "a"
down = true
[[events]]
t = 0.15
key = "a"
down = true
[[events]]
t = 0.2
key = "a"
down = false
[[events]]
t = 0.3
key = "a"
down = true
[[events]]
t = 0.4
key = "left"
down = true
[[events]]
t = 0.41
key = "left"
down = false
)";
    Player player(
        "uniform sampler2D keys; //@ keyboard\n"
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    int code = p.x < 1.0 ? 65 : p.x < 2.0 ? 37 : 64;\n"
        "    c = vec4(texelFetch(keys, ivec2(code, 0), 0).x, texelFetch(keys, ivec2(code, 1), "
        "0).x,\n"
        "             texture(keys, vec2((float(code) + 0.5) / 256.0, 2.5 / 3.0)).x, 1);\n"
        "}\n",
        {.preset = events, .fps = 20});
    struct {
        int frame;  // of a twentieth of a second
        glm::vec3 a, left;
    } const cases[] = {
        {1, {0, 0, 0}, {0, 0, 0}}, {2, {1, 1, 1}, {0, 0, 0}},  // pressed
        {3, {1, 0, 1}, {0, 0, 0}},                             // auto-repeat does not count
        {4, {0, 0, 1}, {0, 0, 0}},                             // released
        {5, {0, 0, 1}, {0, 0, 0}}, {6, {1, 1, 0}, {0, 0, 0}},  // pressed again
        {7, {1, 0, 0}, {0, 0, 0}}, {8, {1, 0, 0}, {1, 1, 1}}, {9, {1, 0, 0}, {0, 0, 1}},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.frame);
        player.draw(c.frame);
        EXPECT_EQ(player.colour(0), c.a);
        EXPECT_EQ(player.colour(1), c.left);
        EXPECT_EQ(player.colour(2), glm::vec3(0)) << "no other key";
    }
}

// Samplers that are not told otherwise all share the first unit, and would read what stands there.
TEST_F(Samplers, WhatNothingFillsReadsZeroBesideOthers) {
    const std::string bound =
        "uniform sampler2D n; //@ noise rgba 4\n"
        "uniform samplerCube sky; //@ pass mainSky size=4\n"
        "void mainSky(out vec4 c, in vec2 p, in vec3 ro, in vec3 rd) { c = vec4(1); }\n";
    struct {
        const char* declaration;
        const char* read;
    } const cases[] = {
        {"", "texture(iChannel0, vec2(0.5))"},
        {"", "texelFetch(iChannel3, ivec2(0), 0)"},
        {"uniform sampler2D iChannel0;", "texture(iChannel0, vec2(0.5))"},
        {"uniform samplerCube iChannel0;", "texture(iChannel0, vec3(1))"},
        {"uniform sampler3D iChannel0;", "texture(iChannel0, vec3(1))"},
        {"uniform sampler2D alone;", "texture(alone, vec2(0.5))"},
        {"uniform samplerCube alone;", "texture(alone, vec3(1))"},
        {"uniform sampler3D alone;", "texture(alone, vec3(0.5))"},
        {"uniform sampler2D alone[2];", "texture(alone[0], p) + texture(alone[1], p)"},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(fmt::format("{} {}", c.declaration, c.read));
        Player player(
            fmt::format("{}{}\n"
                        "void mainImage(out vec4 c, vec2 p) {{\n"
                        "    c = texture(n, p) + texture(sky, vec3(p, 1));\n"
                        "    if (p.x > 1.0) c = {};\n"
                        "}}\n",
                        bound, c.declaration, c.read));
        player.draw(0);
        EXPECT_GT(player.colour(0).x, 0.0f);
        EXPECT_EQ(player.colour(1), glm::vec3(0));
        shared_context.context->finish();
    }
}

TEST_F(Samplers, SamplersOfTypesThatNothingFillsDoNotDisturbTheOthers) {
    for (const char* type : {"isampler2D", "usampler3D", "sampler2DArray", "isamplerCube"}) {
        SCOPED_TRACE(type);
        Player player(
            fmt::format("uniform highp {} alone;\n"
                        "uniform sampler2D n; //@ noise rgba 4\n"
                        "void mainImage(out vec4 c, vec2 p) {{\n"
                        "    c = vec4(textureSize(alone, 0).x) + texelFetch(n, ivec2(p), 0);\n"
                        "}}\n",
                        type));
        player.draw(0);
        EXPECT_GT(player.colour().x, 0.0f);
        shared_context.context->finish();
    }
}

}  // namespace
}  // namespace glint::conformance_samplers_test
