// Every built-in uniform, frame by frame.
#include "fixture.h"

#include <cmath>
#include <limits>

namespace glint::conformance_uniforms_test {
namespace {

using Uniforms = GlTest;

TEST_F(Uniforms, HaveTheirValuesInEveryFrameOfASequence) {
    const auto at_60 = [](int k) { return static_cast<float>(k / 60.0); };
    const float delta = static_cast<float>(90 / 60.0 - 89 / 60.0);
    struct {
        const char* expression;
        int frame;
        glm::vec3 expected;
    } const cases[] = {
        {"iResolution, 1", 0, {4, 2, 1}},
        {"vec3(iTime), 1", 0, {0, 0, 0}},
        {"vec3(iTime), 1", 90, glm::vec3(at_60(90))},
        {"vec3(iTimeDelta), 1", 0, glm::vec3(1.0f / 60.0f)},
        {"vec3(iTimeDelta), 1", 90, glm::vec3(delta)},
        {"vec3(iFrameRate), 1", 0, {60, 60, 60}},
        {"vec3(round(iFrameRate)), 1", 90, {60, 60, 60}},
        {"vec3(iFrame), 1", 0, {0, 0, 0}},
        {"vec3(iFrame), 1", 90, {90, 90, 90}},
        {"vec3(iSampleRate), 1", 0, {44100, 44100, 44100}},
        {"vec3(iMouse), 1", 5, {0, 0, 0}},
        {"iMouse.www, 1", 5, {0, 0, 0}},
        {"iChannelTime[0], iChannelTime[2], iChannelTime[3], 1", 90, {0, 0, 0}},
        {"iChannelResolution[0] + iChannelResolution[3], 1", 0, {0, 0, 0}},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(fmt::format("{} in frame {}", c.expression, c.frame));
        EXPECT_EQ(colour_of(c.expression, c.frame), c.expected);
    }
}

TEST_F(Uniforms, TheFirstTimeDeltaIsASixtiethAtAnyRate) {
    for (const double fps : {24.0, 30.0, 144.0}) {
        EXPECT_EQ(colour_of("vec3(iTimeDelta), 1", 0, {.fps = fps}), glm::vec3(1.0f / 60.0f));
        EXPECT_NEAR(colour_of("vec3(iTimeDelta), 1", 7, {.fps = fps}).x, 1.0 / fps, 1e-7)
            << "the difference of two times, each rounded to float once";
        EXPECT_NEAR(colour_of("vec3(iFrameRate), 1", 7, {.fps = fps}).x, fps, 1e-4);
    }
}

TEST_F(Uniforms, ResolutionIsTheBuffersOwn) {
    Player player(
        "uniform sampler2D a; //@ pass mainA size=8x16\n"
        "void mainA(out vec4 c, vec2 p) { c = vec4(iResolution, 1); }\n"
        "void mainImage(out vec4 c, vec2 p) { c = texelFetch(a, ivec2(0), 0); }");
    player.draw(0);
    EXPECT_EQ(player.colour(), glm::vec3(8, 16, 1));
}

TEST_F(Uniforms, DateHasMonthsFromZeroAndCrossesMidnight) {
    const std::string eve = "date = 2024-02-29T23:59:59.5";
    struct {
        int frame;
        glm::vec4 expected;
    } const cases[] = {{0, {2024, 1, 29, 86399.5}}, {30, {2024, 2, 1, 0}}, {60, {2024, 2, 1, 0.5}}};
    for (const auto& c : cases) {
        EXPECT_EQ(colour_of("iDate.xyz, 1", c.frame, {.preset = eve}), glm::vec3(c.expected));
        EXPECT_EQ(colour_of("iDate.www, 1", c.frame, {.preset = eve}), glm::vec3(c.expected.w));
    }
    EXPECT_EQ(colour_of("iDate.xyz, 1", 0), glm::vec3(2000, 0, 1)) << "exports have a fixed start";
}

// xy moves only while the button is down; z is negative once released; w is positive only in the
// frame of the press.
TEST_F(Uniforms, MouseSignsFollowTheButton) {
    const std::string events = R"(
[[events]]
t = 0.05
mouse = [0.5, 0.5]
down = true
[[events]]
t = 0.08
mouse = [0.75, 0.24]
down = true
[[events]]
t = 0.12
mouse = [0.9, 0.9]
down = false
[[events]]
t = 0.15
mouse = [0.1, 0.1]
down = false
[[events]]
t = 0.2
mouse = [0.29, 0.3]
down = true
)";
    struct {
        int frame;  // at 100 Hz
        glm::vec4 expected;
    } const cases[] = {
        {0, {0, 0, 0, 0}},        // before any click
        {4, {0, 0, 0, 0}},        // just before it
        {5, {50, 10, 50, 10}},    // the frame of the press
        {6, {50, 10, 50, -10}},   // held
        {8, {75, 4, 50, -10}},    // dragged; 0.24 of 20 pixels is within pixel 4
        {12, {75, 4, -50, -10}},  // released: the release moves nothing
        {16, {75, 4, -50, -10}},  // moved without the button
        {20, {29, 6, 29, 6}},     // pressed again, on pixel 29 of 100
        {21, {29, 6, 29, -6}},
    };
    Player player(
        "uniform sampler2D a; //@ pass mainA size=1x1\n"
        "void mainA(out vec4 c, vec2 p) { c = iMouse; }\n"
        "void mainImage(out vec4 c, vec2 p) { c = texelFetch(a, ivec2(0), 0); }",
        {.size = {100, 20}, .preset = events, .pass = "a", .fps = 100});
    for (const auto& c : cases) {
        SCOPED_TRACE(c.frame);
        player.draw(c.frame);
        EXPECT_EQ(player.pixel(0, 0), c.expected);
    }
}

TEST_F(Uniforms, APressAndReleaseWithinOneFrameIsStillSeen) {
    Player player("void mainImage(out vec4 c, vec2 p) { c = vec4(iMouse.xzw, 1); }",
                  {.size = {100, 20},
                   .preset = "[[events]]\nt = 0.011\nmouse = [0.5, 0.5]\ndown = true\n"
                             "[[events]]\nt = 0.012\nmouse = [0.5, 0.5]\ndown = false\n",
                   .fps = 60});
    player.draw(1);
    EXPECT_EQ(player.colour(), glm::vec3(50, -50, 10));
    player.draw(2);
    EXPECT_EQ(player.colour(), glm::vec3(50, -50, -10));
}

TEST_F(Uniforms, TickIsExactAtAnyTime) {
    // Four bytes as four exact floats.
    Player player(
        "uniform sampler2D a; //@ pass mainA size=1x1\n"
        "void mainA(out vec4 c, vec2 p) { c = vec4((uvec4(iTick) >> uvec4(24, 16, 8, 0)) & 255u); "
        "}\n"
        "void mainImage(out vec4 c, vec2 p) { c = texelFetch(a, ivec2(0), 0); }",
        {.pass = "a"});
    constexpr double kYear = 365.25 * 86400.0;
    struct {
        double time;
        std::uint32_t expected;
    } const cases[] = {
        {0.0, 0u},
        {1.0 / 65536, 1u},
        {1.9999 / 65536, 1u},
        {1.0, 65536u},
        {65535.0 + 65535.0 / 65536, 0xffffffffu},
        {65536.0, 0u},
        {65536.0 + 5.0 / 65536, 5u},
        {kYear + 3.0 / 65536,
         static_cast<std::uint32_t>(static_cast<std::uint64_t>(kYear * 65536) & 0xffffffffu) + 3u},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.time);
        Frame frame;
        frame.time = c.time;
        player.draw(frame);
        const glm::vec4 bytes = player.pixel(0, 0);
        const auto byte = [&](int i) { return static_cast<std::uint32_t>(bytes[i]); };
        EXPECT_EQ(byte(0) << 24 | byte(1) << 16 | byte(2) << 8 | byte(3), c.expected);
    }
}

TEST_F(Uniforms, AWaveOfTicksLooksTheSameAfterAYear) {
    // 0.75 Hz is a multiple of 1/65536 Hz, so its phase repeats exactly every 65536 s.
    Player player(
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    float phase = float(uint(0.75 * 65536.0) * iTick) / 4294967296.0;\n"
        "    c = vec4(phase, sin(6.283185307 * phase), cos(6.283185307 * phase), 1);\n"
        "}");
    for (const double time : {0.0, 0.1, 17.3, 60000.0}) {
        Frame frame;
        frame.time = std::floor(time * 65536) / 65536;
        player.draw(frame);
        const glm::vec3 first = player.colour();
        EXPECT_NEAR(first.x, std::fmod(0.75 * frame.time, 1.0), 6e-8)
            << "half a float's last digit";
        frame.time += 482 * 65536.0;  // a little over a year
        player.draw(frame);
        EXPECT_EQ(player.colour(), first) << time;
    }
}

TEST_F(Uniforms, ChannelResolutionTellsWhatIsBound) {
    struct {
        const char* what;
        const char* declaration;
        const char* channels;
        glm::vec3 expected;
    } const cases[] = {
        {"nothing", "", "", {0, 0, 0}},
        {"noise", "uniform sampler2D iChannel1; //@ noise rgba 16x8", "", {16, 8, 1}},
        {"a preset's noise", "", "iChannel1 = { noise = \"r 16x8\" }", {16, 8, 1}},
        {"a volume", "uniform sampler3D iChannel1; //@ noise r 8x4x2", "", {8, 4, 2}},
        {"a preset's volume", "", "iChannel1 = { noise = \"r 8x4x2\" }", {8, 4, 2}},
        {"the keyboard", "uniform sampler2D iChannel1; //@ keyboard", "", {256, 3, 1}},
        {"a preset's keyboard", "", "iChannel1 = { keyboard = true }", {256, 3, 1}},
        {"a buffer", "uniform sampler2D iChannel1; //@ pass mainA", "", {4, 2, 1}},
        {"a buffer of its own size",
         "uniform sampler2D iChannel1; //@ pass mainA size=32x8",
         "",
         {32, 8, 1}},
        {"a preset's buffer",
         "uniform sampler2D a; //@ pass mainA scale=0.5",
         "iChannel1 = { buffer = \"a\" }",
         {2, 1, 1}},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.what);
        Player player(
            fmt::format("{}\nvoid mainA(out vec4 c, vec2 p) {{ c = vec4(0); }}\n"
                        "void mainImage(out vec4 c, vec2 p) {{ c = vec4(iChannelResolution[1], 1); "
                        "}}",
                        c.declaration),
            {.preset = c.channels[0] ? std::string("[channels]\n") + c.channels : ""});
        player.draw(0);
        EXPECT_EQ(player.colour(), c.expected);
    }
}

}  // namespace
}  // namespace glint::conformance_uniforms_test
