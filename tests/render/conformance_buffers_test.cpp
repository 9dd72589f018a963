// Buffers: what they hold, in which order they are drawn, and what a reader sees of them.
#include "fixture.h"

#include <array>
#include <cmath>

namespace glint::conformance_buffers_test {
namespace {

using Buffers = GlTest;

const std::string kShowA =
    "void mainImage(out vec4 c, vec2 p) { c = texelFetch(a, ivec2(p), 0); }\n";

TEST_F(Buffers, AreZeroBeforeTheFirstFrame) {
    Player player(
        "uniform sampler2D a; //@ pass mainA\n"
        "uniform sampler2D b; //@ pass mainB\n"
        "void mainA(out vec4 c, vec2 p) { c = texelFetch(a, ivec2(p), 0) + texelFetch(b, ivec2(p), "
        "0); }\n"
        "void mainB(out vec4 c, vec2 p) { c = vec4(1); }\n" +
            kShowA,
        {.pass = "a"});
    player.draw(0);
    for (int x = 0; x < 4; ++x) EXPECT_EQ(player.pixel(x, 1), glm::vec4(0));
}

TEST_F(Buffers, HoldAllFourChannelsAsFloats) {
    Player player(
        "uniform sampler2D a; //@ pass mainA\n"
        "void mainA(out vec4 c, vec2 p) { c = vec4(1e30, -7.5, 1.0 / 3.0, -1e-30); }\n" +
            kShowA,
        {.pass = "a"});
    player.draw(0);
    EXPECT_EQ(player.pixel(0, 0), glm::vec4(1e30f, -7.5f, 1.0f / 3.0f, -1e-30f));
}

TEST_F(Buffers, FormatsRoundAndClampAsTheirNamesSay) {
    struct {
        const char* format;
        glm::vec4 expected;
        double tolerance;
    } const cases[] = {
        {"rgba8", {0, 1, 85.0f / 255.0f, 51.0f / 255.0f}, 6e-8},     // a driver multiplies by 1/255
        {"rgba16f", {-2.5, 7, 0.33325195f, 0.19995117f}, 0.000245},  // either neighbouring half
        {"rgba32f", {-2.5, 7, 1.0f / 3.0f, 0.2f}, 0.0},
        {"rg32f", {-2.5, 7, 0, 1}, 0.0},
        {"r32f", {-2.5, 0, 0, 1}, 0.0},
        {"rg16f", {-2.5, 7, 0, 1}, 0.0},
        {"r16f", {-2.5, 0, 0, 1}, 0.0},
        {"rg8", {0, 1, 0, 1}, 0.0},
        {"r8", {0, 0, 0, 1}, 0.0},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.format);
        Player player(
            fmt::format("uniform sampler2D a; //@ pass mainA format={}\n"
                        "void mainA(out vec4 c, vec2 p) {{ c = vec4(-2.5, 7, 1.0 / 3.0, 0.2); }}\n",
                        c.format) +
                kShowA,
            {.pass = "a"});
        player.draw(0);
        const glm::vec4 held = player.pixel(0, 0);
        for (int i = 0; i < 4; ++i) EXPECT_NEAR(held[i], c.expected[i], c.tolerance);
    }
}

// Of three texels a row, which no driver's default alignment of rows fits; read where they stand,
// through a filter, and one frame later.
TEST_F(Buffers, ChannelsThatTheyHaveNotReadAsZeroAndOne) {
    for (const auto& [format, expected] : {std::pair{"r8", glm::vec4(0.2f, 0, 0, 1)},
                                           {"rg8", {0.2f, 0.4f, 0, 1}},
                                           {"r16f", {0.2f, 0, 0, 1}},
                                           {"rg16f", {0.2f, 0.4f, 0, 1}},
                                           {"r32f", {0.2f, 0, 0, 1}},
                                           {"rg32f", {0.2f, 0.4f, 0, 1}}}) {
        SCOPED_TRACE(format);
        Player player(fmt::format(
            "uniform sampler2D a; //@ pass mainA size=3 format={}\n"
            "void mainA(out vec4 c, vec2 p) {{\n"
            "    c = iFrame == 0 ? vec4(0.2, 0.4, 0.6, 0.8) : texelFetch(a, ivec2(p), 0);\n"
            "}}\n"
            "void mainImage(out vec4 c, vec2 p) {{\n"
            "    vec4 still = texelFetch(a, ivec2(1), 0);\n"
            "    c = p.x < 1.0 ? still : p.x < 2.0 ? textureLod(a, vec2(0.4), 0.0)\n"
            "        : vec4(still.a);\n"
            "}}\n",
            format));
        for (int k = 0; k < 2; ++k) {
            player.draw(k);
            for (int i = 0; i < 3; ++i) {
                for (int x = 0; x < 2; ++x)
                    EXPECT_NEAR(player.colour(x)[i], expected[i], 2.5e-4) << k << x << i;
            }
            EXPECT_EQ(player.colour(2), glm::vec3(1));
        }
    }
}

// Each buffer holds what it saw of the others, as frame numbers.
TEST_F(Buffers, EarlierOnesShowThisFrameLaterOnesThePrevious) {
    Player player(
        "uniform sampler2D a; //@ pass mainA\n"
        "uniform sampler2D b; //@ pass mainB\n"
        "uniform sampler2D d; //@ pass mainD\n"
        "#define AT(s) texelFetch(s, ivec2(p), 0).w\n"
        "void mainA(out vec4 c, vec2 p) { c = vec4(AT(a), AT(b), AT(d), iFrame + 1); }\n"
        "void mainB(out vec4 c, vec2 p) { c = vec4(AT(a), AT(b), AT(d), iFrame + 1); }\n"
        "void mainD(out vec4 c, vec2 p) { c = vec4(AT(a), AT(b), AT(d), iFrame + 1); }\n"
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    int x = int(p.x);\n"
        "    c = x == 0 ? texelFetch(a, ivec2(0), 0) : x == 1 ? texelFetch(b, ivec2(0), 0)\n"
        "      : x == 2 ? texelFetch(d, ivec2(0), 0) : vec4(AT(a), AT(b), AT(d), 1);\n"
        "}\n");
    for (int k = 0; k < 5; ++k) {
        SCOPED_TRACE(k);
        player.draw(k);
        const auto now = static_cast<float>(k + 1), before = static_cast<float>(k);
        EXPECT_EQ(player.colour(0), glm::vec3(before, before, before));
        EXPECT_EQ(player.colour(1), glm::vec3(now, before, before));
        EXPECT_EQ(player.colour(2), glm::vec3(now, now, before));
        EXPECT_EQ(player.colour(3), glm::vec3(now, now, now));
    }
}

TEST_F(Buffers, RunInTheOrderOfTheirDeclarationsNotOfTheirFunctions) {
    Player player(
        "void mainB(out vec4, vec2);\n"
        "uniform sampler2D b; //@ pass mainB\n"
        "uniform sampler2D a; //@ pass mainA\n"
        "void mainA(out vec4 c, vec2 p) { c = texelFetch(b, ivec2(p), 0) * 10.0; }\n"
        "void mainB(out vec4 c, vec2 p) { c = vec4(iFrame + 1); }\n" +
        kShowA);
    player.draw(0);
    EXPECT_EQ(player.colour(), glm::vec3(10));
}

TEST_F(Buffers, ACounterCountsItsFrames) {
    Player player(
        "uniform sampler2D a; //@ pass mainA\n"
        "void mainA(out vec4 c, vec2 p) { c = texelFetch(a, ivec2(p), 0) + vec4(1, p, 0); }\n" +
            kShowA,
        {.pass = "a"});
    player.draw_frames(0, 10);
    EXPECT_EQ(player.pixel(3, 1), glm::vec4(10, 35, 15, 0));
}

TEST_F(Buffers, SeveralOutputsOfOnePassFillSeveralBuffers) {
    Player player(
        "uniform sampler2D a; //@ pass mainAB\n"
        "uniform sampler2D b; //@ pass mainAB\n"
        "void mainAB(out vec4 first, out vec4 second, in vec2 p) {\n"
        "    first = texelFetch(b, ivec2(p), 0) + 1.0;\n"
        "    second = texelFetch(a, ivec2(p), 0) * 2.0 + 1.0;\n"
        "}\n"
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    c = vec4(texelFetch(a, ivec2(p), 0).x, texelFetch(b, ivec2(p), 0).x, 0, 1);\n"
        "}\n");
    float a = 0, b = 0;
    for (int k = 0; k < 6; ++k) {
        player.draw(k);
        const float next = b + 1;
        b = a * 2 + 1;
        a = next;
        EXPECT_EQ(player.colour(3, 1), glm::vec3(a, b, 0)) << k;
    }
}

TEST_F(Buffers, SizeAndScaleSetTheirPixels) {
    struct {
        const char* options;
        glm::ivec2 expected;
    } const cases[] = {{"", {10, 7}},         {"size=3x5", {3, 5}},  {"size=16", {16, 16}},
                       {"scale=0.5", {5, 4}}, {"scale=2", {20, 14}}, {"scale=0.01", {1, 1}},
                       {"scale=0.25", {3, 2}}};
    for (const auto& c : cases) {
        SCOPED_TRACE(c.options);
        Player player(fmt::format("uniform sampler2D a; //@ pass mainA {}\n"
                                  "void mainA(out vec4 c, vec2 p) {{ c = vec4(p, 0, 0); }}\n"
                                  "void mainImage(out vec4 c, vec2 p) {{ c = texelFetch(a, "
                                  "textureSize(a, 0) - 1, 0); }}\n",
                                  c.options),
                      {.size = {10, 7}});
        player.draw(0);
        EXPECT_EQ(player.colour(), glm::vec3(glm::vec2(c.expected) - 0.5f, 0));
    }
}

// A pattern of position and time of birth; the pass only copies itself after frame 0.
const std::string kKeepsItself =
    "uniform sampler2D a; //@ pass mainA\n"
    "void mainA(out vec4 c, vec2 p) {\n"
    "    c = texelFetch(a, ivec2(p), 0);\n"
    "    if (iFrame == 0) c = vec4(p, 1, iTime);\n"
    "}\n";

TEST_F(Buffers, ResizeKeepsThemPixelForPixelFromTheBottomLeft) {
    Player player(kKeepsItself + kShowA, {.size = {6, 4}, .pass = "a"});
    player.draw_frames(0, 3);
    player.renderer().resize({9, 3});
    player.draw(3);
    for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 9; ++x) {
            const glm::vec4 kept(glm::vec2(x, y) + 0.5f, 1, 0);
            EXPECT_EQ(player.pixel(x, y), x < 6 ? kept : glm::vec4(0)) << x << ", " << y;
        }
    }
    player.renderer().resize({6, 4});
    player.draw(4);
    EXPECT_EQ(player.pixel(5, 2), glm::vec4(5.5, 2.5, 1, 0));
    EXPECT_EQ(player.pixel(5, 3), glm::vec4(0)) << "row 3 was cut off";
}

TEST_F(Buffers, TimeAndFrameRunOnThroughAResize) {
    Player player(
        "void mainImage(out vec4 c, vec2 p) { c = vec4(iFrame, iTime, iResolution.x, 1); }");
    player.draw_frames(0, 31);
    player.renderer().resize({8, 8});
    player.draw(31);
    EXPECT_EQ(player.colour(7, 7), glm::vec3(31, static_cast<float>(31 / 60.0), 8));
}

TEST_F(Buffers, ResizeDrawsTheNewPartOfAPictureThatNeverChanges) {
    Player player(
        "uniform sampler2D a; //@ pass mainA\n"
        "void mainA(out vec4 c, vec2 p) { c = vec4(p, 3, 4); }\n" +
        kShowA);
    player.draw(0);
    player.renderer().resize({8, 8});
    player.draw(1);
    EXPECT_EQ(player.colour(7, 7), glm::vec3(7.5, 7.5, 3));
}

TEST_F(Buffers, ABufferOfFixedSizeIsNotTouchedByAResize) {
    Player player(
        "uniform sampler2D a; //@ pass mainA size=4x2\n"
        "void mainA(out vec4 c, vec2 p) { c = texelFetch(a, ivec2(p), 0) + 1.0; }\n"
        "void mainImage(out vec4 c, vec2 p) { c = texelFetch(a, ivec2(0), 0); }\n");
    player.draw_frames(0, 3);
    player.renderer().resize({9, 9});
    player.draw(3);
    EXPECT_EQ(player.colour(8, 8), glm::vec3(4));
}

TEST_F(Buffers, ResetStartsAgainFromZero) {
    Player player(
        "uniform sampler2D a; //@ pass mainA\n"
        "uniform sampler2D b; //@ pass mainB\n"
        "void mainA(out vec4 c, vec2 p) { c = texelFetch(a, ivec2(p), 0) + 1.0; }\n"
        "void mainB(out vec4 c, vec2 p) { c = vec4(5); }\n"
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    c = texelFetch(a, ivec2(p), 0) + texelFetch(b, ivec2(p), 0);\n"
        "}\n");
    player.draw_frames(0, 4);
    EXPECT_EQ(player.colour(), glm::vec3(9));
    player.renderer().reset();
    player.draw_frames(0, 2);
    EXPECT_EQ(player.colour(), glm::vec3(7));
}

TEST_F(Buffers, AnyOneOfThemCanBeThePictureThatIsWanted) {
    const std::string text =
        "uniform sampler2D a; //@ pass mainA\n"
        "uniform sampler2D b; //@ pass mainB\n"
        "uniform sampler2D b2; //@ pass mainB\n"
        "void mainA(out vec4 c, vec2 p) { c = texelFetch(b, ivec2(p), 0) + vec4(1, 0, 0, 0.5); }\n"
        "void mainB(out vec4 c, out vec4 e, vec2 p) {\n"
        "    c = texelFetch(a, ivec2(p), 0) * 2.0;\n"
        "    e = vec4(iFrame, p, 7);\n"
        "}\n" +
        kShowA;
    struct {
        const char* pass;
        glm::vec4 expected;  // in the third frame
    } const cases[] = {{"a", {7, 0, 0, 3.5}},
                       {"b", {14, 0, 0, 7}},
                       {"b2", {2, 0.5, 0.5, 7}},
                       {"image", {7, 0, 0, 1}}};
    for (const auto& c : cases) {
        SCOPED_TRACE(c.pass);
        Player player(text, {.pass = c.pass});
        player.draw_frames(0, 3);
        EXPECT_EQ(player.pixel(0, 0), c.expected);
    }
}

// Text pasted from several tabs: each with a mainImage of its own, and names that clash.
TEST_F(Buffers, TabsStandApartByTheNameOfTheirPass) {
    Player player(
        "uniform sampler2D bufferA; //@ pass mainA\n"
        "uniform sampler2D bufferB; //@ pass mainB\n"
        "float shared_by_all(float x) { return x + 1.0; }\n"
        "#ifdef PASS_bufferA\n"
        "#define VALUE 2.0\n"
        "float f() { return VALUE; }\n"
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(shared_by_all(f())); }\n"
        "#endif\n"
        "#ifdef PASS_bufferB\n"
        "#define VALUE 20.0\n"
        "vec2 f() { return vec2(VALUE); }\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    c = f().xyyy * texelFetch(bufferA, ivec2(p), 0);\n"
        "}\n"
        "#endif\n"
        "#ifdef PASS_image\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    c = vec4(texelFetch(bufferA, ivec2(p), 0).x, texelFetch(bufferB, ivec2(p), 0).x, 0, "
        "1);\n"
        "}\n"
        "#endif\n");
    player.draw(0);
    EXPECT_EQ(player.colour(), glm::vec3(3, 60, 0));
}

TEST_F(Buffers, TwoReadersOfOneBufferFilterAndWrapAsTheyLike) {
    Player player(
        "uniform sampler2D a; //@ pass mainA size=2x1\n"
        "uniform sampler2D n; //@ buffer a filter=nearest wrap=repeat\n"
        "uniform sampler2D m; //@ buffer a filter=linear wrap=mirror\n"
        "void mainA(out vec4 c, vec2 p) { c = vec4(p.x < 1.0 ? 0.0 : 1.0); }\n"
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    float u[4] = float[4](0.375, 0.625, 1.125, 1.625);\n"
        "    vec2 uv = vec2(u[int(p.x)], 0.5);\n"
        "    c = vec4(texture(a, uv).x, texture(n, uv).x, texture(m, uv).x, 1);\n"
        "}\n");
    player.draw(0);
    EXPECT_EQ(player.colour(0), glm::vec3(0.25, 0, 0.25));
    EXPECT_EQ(player.colour(1), glm::vec3(0.75, 1, 0.75));
    EXPECT_EQ(player.colour(2), glm::vec3(1, 0, 1));
    EXPECT_EQ(player.colour(3), glm::vec3(1, 1, 0.25));
}

TEST_F(Buffers, MipmapsAreBuiltOnlyWhereAReaderAsksForThem) {
    const std::string text =
        "uniform sampler2D a; //@ pass mainA size=4x4\n"
        "uniform sampler2D b; //@ pass mainB size=4x4\n"
        "uniform sampler2D am; //@ buffer a filter=mipmap\n"
        "void mainA(out vec4 c, vec2 p) { c = vec4(floor(p), iFrame, 1); }\n"
        "void mainB(out vec4 c, vec2 p) { c = vec4(floor(p), iFrame, 1); }\n"
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    vec2 uv = vec2(0.75, 0.25);\n"
        "    c = int(p.x) < 3 ? textureLod(am, uv, floor(p.x)) : textureLod(b, uv, 2.0);\n"
        "}\n";
    Player player(text, {.specialise = false});
    EXPECT_TRUE(player.renderer().buffer(player.graph_index("a")).shape().mipmaps);
    EXPECT_FALSE(player.renderer().buffer(player.graph_index("b")).shape().mipmaps);
    player.draw_frames(0, 3);
    EXPECT_EQ(player.colour(0), glm::vec3(2.5, 0.5, 2)) << "between four texels of level 0";
    EXPECT_EQ(player.colour(1), glm::vec3(2.5, 0.5, 2)) << "the mean of those four";
    EXPECT_EQ(player.colour(2), glm::vec3(1.5, 1.5, 2)) << "the mean of all";
    EXPECT_EQ(player.colour(3), glm::vec3(2.5, 0.5, 2)) << "there is no level 2 to read";
}

// What is drawn for a direction must be what is read back for it.
TEST_F(Buffers, ACubeGivesBackWhatWasDrawnForADirection) {
    Player player(
        "uniform samplerCube sky; //@ pass mainSky size=64 format=rgba32f filter=nearest\n"
        "void mainSky(out vec4 c, in vec2 p, in vec3 ro, in vec3 rd) {\n"
        "    c = vec4(rd, dot(ro, ro) + abs(length(rd) - 1.0));\n"
        "}\n"
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    vec2 a = p / iResolution.xy * vec2(6.2831853, 3.14159265);\n"
        "    vec3 rd = vec3(cos(a.x) * sin(a.y), cos(a.y), sin(a.x) * sin(a.y));\n"
        "    c = vec4(distance(texture(sky, rd).xyz, rd), texture(sky, rd).w, 0, 1);\n"
        "}\n",
        {.size = {32, 16}});
    player.draw(0);
    const std::vector<float> values = player.floats();
    for (std::size_t i = 0; i < values.size(); i += 4) {
        EXPECT_LT(values[i], 0.023f) << "a texel of a face of 64 is at most 1.42 / 64 wide";
        EXPECT_LT(values[i + 1], 1e-6f) << "rayOri is 0, rayDir is a unit vector";
    }
}

TEST_F(Buffers, EveryFaceOfACubeLooksAlongItsAxis) {
    Player player(
        "uniform samplerCube sky; //@ pass mainCubemap size=3\n"
        "void mainCubemap(out vec4 c, in vec2 p, in vec3 ro, in vec3 rd) { c = vec4(rd, p.x); }\n"
        "void mainImage(out vec4 c, vec2 p) { c = texture(sky, vec3(1)); }\n",
        {.pass = "sky"});
    player.draw(0);
    const glm::vec3 axes[] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int face = 0; face < 6; ++face) {
        EXPECT_EQ(player.pixel(face * 3 + 1, 1), glm::vec4(axes[face], 1.5)) << face;
    }
}

TEST_F(Buffers, ACubeIsLargeAndHalfPreciseUnlessToldOtherwise) {
    const std::string text =
        "uniform samplerCube sky; //@ pass mainSky {}\n"
        "void mainSky(out vec4 c, in vec2 p, in vec3 ro, in vec3 rd) {{\n"
        "    c = texture(sky, rd) + vec4(1, 0, 0, 0);\n"
        "}}\n"
        "void mainImage(out vec4 c, vec2 p) {{ c = texture(sky, vec3(0, -1, 0)); }}\n";
    {
        Player player(fmt::format(fmt::runtime(text), ""));
        const BufferShape& shape = player.renderer().buffer(0).shape();
        EXPECT_EQ(shape.size, glm::ivec2(1024));
        EXPECT_EQ(shape.format, PixelFormat::rgba16f);
        EXPECT_TRUE(shape.feedback);
    }
    Player player(fmt::format(fmt::runtime(text), "size=4"));
    player.draw_frames(0, 5);
    EXPECT_EQ(player.colour(), glm::vec3(5, 0, 0)) << "it reads its own previous frame";
}

}  // namespace
}  // namespace glint::conformance_buffers_test
