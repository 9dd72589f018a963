// `step=1/240`: the state at a time does not depend on the frames in which it was reached.
#include "fixture.h"

#include <algorithm>
#include <cmath>

namespace glint::conformance_steps_test {
namespace {

using Steps = GlTest;

// A damped pendulum, and what each step saw: its count, its length and its time.
const std::string kPendulum =
    "uniform sampler2D state; //@ pass mainState size=1x1 step=1/240\n"
    "uniform sampler2D seen; //@ pass mainState\n"
    "void mainState(out vec4 c, out vec4 s, vec2 p) {\n"
    "    vec4 old = texelFetch(state, ivec2(0), 0);\n"
    "    if (iFrame == 0) old = vec4(1, 0, 0, 0);\n"
    "    float v = old.y - iTimeDelta * (9.0 * sin(old.x) + 0.3 * old.y);\n"
    "    c = vec4(old.x + iTimeDelta * v, v, old.z + iTimeDelta, old.w + 1.0);\n"
    "    s = vec4(iFrame, iTimeDelta, iTime, iFrameRate);\n"
    "}\n"
    "void mainImage(out vec4 c, vec2 p) { c = texelFetch(state, ivec2(0), 0) + "
    "texelFetch(seen, ivec2(0), 0); }\n";

std::vector<float> state_at(double time, double fps, const char* pass) {
    Player player(kPendulum, {.pass = pass, .fps = fps});
    player.still(time);
    return player.floats();
}

TEST_F(Steps, TheStateAtATimeIsTheSameAtEveryFrameRate) {
    for (const double time : {0.5, 1.0, 1.37}) {
        const std::vector<float> expected = state_at(time, 60, "state");
        EXPECT_EQ(expected[3], static_cast<float>(std::floor(time * 240 + 1e-6)));
        for (const double fps : {10.0, 23.976, 30.0, 50.0, 144.0, 240.0, 1000.0}) {
            SCOPED_TRACE(fmt::format("at {} s and {} Hz", time, fps));
            EXPECT_EQ(state_at(time, fps, "state"), expected);
        }
    }
}

TEST_F(Steps, TheStateAtATimeIsTheSameAtAnIrregularRate) {
    const std::vector<float> expected = state_at(1.0, 60, "state");
    Player player(kPendulum, {.pass = "state"});
    double time = 0.0;
    for (int k = 0; time < 1.0; ++k) {
        Frame frame;
        frame.frame = k;
        frame.time = time;
        player.draw(frame);
        time += 0.001 + 0.02 * std::fmod(k * 0.618, 1.0);
    }
    Frame last;
    last.time = 1.0;
    player.draw(last);
    EXPECT_EQ(player.floats(), expected);
}

TEST_F(Steps, AStepIsAFrameOfItsOwnLength) {
    const std::vector<float> seen = state_at(1.0, 60, "seen");
    EXPECT_EQ(seen, (std::vector<float>{239, 1.0f / 240.0f, 1.0f, 240.0f}));
}

TEST_F(Steps, TheRemainderCarriesOver) {
    Player player(kPendulum, {.pass = "state"});
    struct {
        double time;
        float steps;
    } const cases[] = {
        {0.0, 0},     {0.004, 0}, {0.0042, 1},      {0.0083, 1},           {0.00834, 2},
        {0.00835, 2}, {0.1, 24},  {7.0 / 60.0, 28}, {7.0 / 60 + 1e-9, 28}, {8.0 / 60 - 1e-5, 31}};
    for (const auto& c : cases) {
        SCOPED_TRACE(c.time);
        Frame frame;
        frame.time = c.time;
        player.draw(frame);
        EXPECT_EQ(player.pixel(0, 0).w, c.steps);
    }
}

TEST_F(Steps, AStepOfOneThirdNeverDriftsFromItsFraction) {
    Player player(
        "uniform sampler2D n; //@ pass mainN size=1x1 step=1/3\n"
        "void mainN(out vec4 c, vec2 p) { c = texelFetch(n, ivec2(0), 0) + 1.0; }\n"
        "void mainImage(out vec4 c, vec2 p) { c = texelFetch(n, ivec2(0), 0); }\n");
    for (int k = 0; k <= 3000; k += 3) {
        Frame frame;
        frame.time = k / 9.0;
        player.draw(frame);
        EXPECT_EQ(player.colour().x, static_cast<float>(k / 3)) << k;
        if (testing::Test::HasFailure()) return;
    }
}

TEST_F(Steps, ALiveFrameCatchesUpAQuarterSecondAtMost) {
    Player player(kPendulum, {.pass = "state"});
    struct {
        double time;
        float steps;
    } const cases[] = {{0.1, 24}, {5.1, 84}, {5.2, 108}, {5.44, 165}, {5.7, 225}};
    for (const auto& c : cases) {
        SCOPED_TRACE(c.time);
        Frame frame;
        frame.time = c.time;
        frame.longest_catch_up = 0.25;
        player.draw(frame);
        EXPECT_EQ(player.pixel(0, 0).w, c.steps);
    }
}

TEST_F(Steps, AStepThatIsLongerThanWhatIsCaughtUpRunsLiveAsWell) {
    Player player(
        "uniform sampler2D n; //@ pass mainN size=1x1 step=1/3\n"
        "void mainN(out vec4 c, vec2 p) { c = texelFetch(n, ivec2(0), 0) + 1.0; }\n"
        "void mainImage(out vec4 c, vec2 p) { c = texelFetch(n, ivec2(0), 0); }\n");
    for (int k = 0; k <= 120; ++k) {
        Frame frame;
        frame.time = k / 60.0;
        frame.longest_catch_up = 0.25;
        player.draw(frame);
        EXPECT_EQ(player.colour().x, static_cast<float>(k / 20)) << k;
    }
}

TEST_F(Steps, AnExportCatchesUpEverything) {
    Player player(kPendulum, {.pass = "state"});
    Frame frame;
    frame.time = 3.0;
    player.draw(frame);
    EXPECT_EQ(player.pixel(0, 0).w, 720.0f);
}

TEST_F(Steps, TheFrameStillReadsTheInputOfItsOwnTime) {
    const std::string events = "[[events]]\nt = 0.05\nkey = \"a\"\ndown = true\n";
    Player player(
        "uniform sampler2D keys; //@ keyboard\n"
        "uniform sampler2D n; //@ pass mainN size=1x1 step=1/100\n"
        "void mainN(out vec4 c, vec2 p) {\n"
        "    c = texelFetch(n, ivec2(0), 0);\n"
        "    c += vec4(texelFetch(keys, ivec2(65, 0), 0).x, texelFetch(keys, ivec2(65, 1), 0).x, "
        "0, "
        "0);\n"
        "}\n"
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    c = vec4(texelFetch(n, ivec2(0), 0).xy, texelFetch(keys, ivec2(65, 1), 0).x, 1);\n"
        "}\n",
        {.preset = events, .fps = 10});
    player.draw_frames(0, 2);
    EXPECT_EQ(player.colour(), glm::vec3(6, 1, 1))
        << "held in steps 5 to 10, pressed in one of them, and new to the frame";
    player.draw(2);
    EXPECT_EQ(player.colour(), glm::vec3(16, 1, 0));
}

// A click and a key, counted by the steps at whatever rate the frames come.
TEST_F(Steps, SeeEveryEventOnceAtItsOwnTime) {
    std::string events;
    for (int i = 0; i < 40; ++i) {
        // Some exactly on a step's end, some between.
        events += fmt::format("[[events]]\nt = {}\nkey = \"space\"\ndown = {}\n",
                              (i * 7 + 3 + (i % 3 == 0 ? 0.4 : 0.0)) / 240.0, i % 2 == 0);
    }
    events += "[[events]]\nt = 0.75\nmouse = [0.5, 0.5]\ndown = true\n";
    const std::string text =
        "uniform sampler2D keys; //@ keyboard\n"
        "uniform sampler2D n; //@ pass mainN size=1x1 step=1/240\n"
        "void mainN(out vec4 c, vec2 p) {\n"
        "    c = texelFetch(n, ivec2(0), 0);\n"
        "    c.x += texelFetch(keys, ivec2(32, 1), 0).x;\n"
        "    c.y += texelFetch(keys, ivec2(32, 0), 0).x * float(iFrame);\n"
        "    if (iMouse.w > 0.0) c.zw = vec2(iFrame, c.w + 1.0);\n"
        "}\n"
        "void mainImage(out vec4 c, vec2 p) { c = texelFetch(n, ivec2(0), 0); }\n";
    glm::vec4 first{0};
    for (const double fps : {24.0, 60.0, 144.0}) {
        SCOPED_TRACE(fps);
        Player player(text, {.preset = events, .pass = "n", .fps = fps});
        player.still(1.5);
        const glm::vec4 counted = player.pixel(0, 0);
        EXPECT_EQ(counted.x, 20.0f) << "presses";
        EXPECT_EQ(counted.z, 179.0f) << "the step that ends at 0.75 s";
        EXPECT_EQ(counted.w, 1.0f) << "one step in which the button went down";
        if (first == glm::vec4(0)) first = counted;
        EXPECT_EQ(counted, first);
    }
}

// Two simulations that feed each other advance together, step by step.
TEST_F(Steps, PassesThatReadEachOtherStayInStep) {
    const std::string text =
        "uniform sampler2D a; //@ pass mainA size=1x1 step=1/100\n"
        "uniform sampler2D b; //@ pass mainB size=1x1 step=1/100\n"
        "void mainA(out vec4 c, vec2 p) { c = texelFetch(b, ivec2(0), 0) + vec4(1, 0, 0, 0); }\n"
        "void mainB(out vec4 c, vec2 p) { c = texelFetch(a, ivec2(0), 0).yxzw + vec4(0, 0, 1, 0); "
        "}\n"
        "void mainImage(out vec4 c, vec2 p) { c = texelFetch(a, ivec2(0), 0); }\n";
    float x = 0, y = 0, z = 0;  // what b holds
    for (int step = 0; step < 100; ++step) {
        const float old_y = y;
        y = x + 1;
        x = old_y;
        z += 1;
    }
    for (const double fps : {7.0, 60.0, 200.0}) {
        SCOPED_TRACE(fps);
        Player player(text, {.pass = "b", .fps = fps});
        player.still(1.0);
        EXPECT_EQ(player.pixel(0, 0), glm::vec4(x, y, z, 0));
    }
}

TEST_F(Steps, OfDifferentLengthsRunSideBySide) {
    Player player(
        "uniform sampler2D a; //@ pass mainA size=1x1 step=1/240\n"
        "uniform sampler2D b; //@ pass mainB size=1x1 step=0.1\n"
        "void mainA(out vec4 c, vec2 p) { c = texelFetch(a, ivec2(0), 0) + 1.0; }\n"
        "void mainB(out vec4 c, vec2 p) { c = texelFetch(b, ivec2(0), 0) + 1.0; }\n"
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    c = vec4(texelFetch(a, ivec2(0), 0).x, texelFetch(b, ivec2(0), 0).x, 0, 1);\n"
        "}\n");
    player.still(1.0);
    EXPECT_EQ(player.colour(), glm::vec3(240, 10, 0));
}

TEST_F(Steps, AStepShorterThanAFrameShowsOnlyItsLastState) {
    Player player(
        "uniform sampler2D a; //@ pass mainA size=1x1 step=1/240\n"
        "uniform sampler2D b; //@ pass mainB size=1x1\n"
        "void mainA(out vec4 c, vec2 p) { c = texelFetch(a, ivec2(0), 0) + 1.0; }\n"
        "void mainB(out vec4 c, vec2 p) { c = texelFetch(a, ivec2(0), 0); }\n"
        "void mainImage(out vec4 c, vec2 p) { c = texelFetch(b, ivec2(0), 0); }\n");
    int drawn = 0;
    player.renderer().after_pass = [&](std::size_t index) {
        if (index == player.graph_index("b")) ++drawn;
    };
    player.draw_frames(0, 5);
    EXPECT_EQ(player.colour(), glm::vec3(16));
    EXPECT_EQ(drawn, 5);
}

}  // namespace
}  // namespace glint::conformance_steps_test
