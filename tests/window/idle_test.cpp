// A window that has nothing to do does nothing.
#include "live.h"

#include <fmt/format.h>

#include <chrono>
#include <iostream>
#include <thread>

namespace glint::window::idle_test {
namespace {

// s; a hundredth of it is three ticks of the clock that counts.
constexpr double kWatched = 3.0;

class Idle : public Window {
protected:
    // At most so many percent of one core, all processes of glint together, over kWatched. The
    // first of forty that does: on a busy machine the last program, the process that takes the
    // place of one that hung, or a picture that gathers samples takes its time, but comes to an
    // end.
    testing::AssertionResult uses_at_most(double percent, const char* when) const {
        double used = 0.0;
        for (int i = 0; i < 40; ++i) {
            const double before = glint_->cpu_seconds();
            std::this_thread::sleep_for(std::chrono::duration<double>(kWatched));
            used = 100.0 * (glint_->cpu_seconds() - before) / kWatched;
            std::cout << fmt::format("{}: {:.2f} % of one core\n", when, used);
            if (used <= percent) return testing::AssertionSuccess();
        }
        return testing::AssertionFailure() << when << ": " << used << " % of one core; it said:\n"
                                           << glint_->errors();
    }
    // The tweaks have rested, the specialised program is there.
    static void wait_for_rest() { std::this_thread::sleep_for(std::chrono::seconds(2)); }
};

constexpr const char* kMoving =
    "uniform float level; //@ 0.5 [0, 1]\n"
    "void mainImage(out vec4 c, in vec2 p) { c = vec4(fract(iTime), level, p.x, 1); }\n";

constexpr const char* kHanging =
    "void mainImage(out vec4 c, in vec2 p) {\n"
    "    float a = p.x;\n"
    "    for (int i = 0; i < 1000000000; ++i) {\n"
    "        for (int k = 0; k < 8; ++k)\n"
    "            a = sin(a * 1.1 + exp(cos(a + float(k)))) + pow(abs(a), 0.3);\n"
    "        if (a > 100.0) break;\n"
    "    }\n"
    "    c = vec4(a);\n"
    "}\n";

TEST_F(Idle, PausedAndUntouchedItUsesAtMostAHundredthOfACore) {
    open(kMoving);
    screen_->tap("Control_L+space");
    for (const char* panel : {"Control_L+p", "Control_L+d", "Control_L+k"}) screen_->tap(panel);
    wait_for_rest();
    EXPECT_TRUE(uses_at_most(1.0, "paused"));
}

// Nothing is held at standby then; a process that nobody hears would wake the window for ever.
TEST_F(Idle, PausedWithoutConstantsItUsesNoMore) {
    open(kMoving, {"--no-specialise"});
    screen_->tap("Control_L+space");
    wait_for_rest();
    EXPECT_TRUE(uses_at_most(1.0, "paused, tweaks as uniforms"));
    EXPECT_EQ(glint_->children().size(), 1u) << "one process tries what is saved";
}

TEST_F(Idle, ASceneThatDependsOnNothingUsesAtMostAHundredthOfACoreWhileItPlays) {
    open(flat({10, 20, 30}));
    screen_->tap("Tab");
    wait_for_rest();
    EXPECT_TRUE(shows({10, 20, 30}, {640, 690}));  // the word on how they come back has gone
    EXPECT_TRUE(uses_at_most(1.0, "playing, nothing moves, panels hidden"));
    // The clock in the transport bar moves, and is drawn for that.
    screen_->tap("Tab");
    wait_for_rest();
    EXPECT_TRUE(uses_at_most(30.0, "playing, nothing moves but the clock"));
}

TEST_F(Idle, MinimisedItDrawsNothingAndGoesOnAfterwards) {
    open(kMoving);
    wait_for_rest();
    screen_->minimise(true);
    wait_for_rest();
    EXPECT_TRUE(uses_at_most(1.0, "minimised and playing"));
    write(scene(), flat({77, 66, 55}));
    screen_->minimise(false);
    EXPECT_TRUE(shows({77, 66, 55}, {3, 300}));
}

TEST_F(Idle, AnErrorOnTheScreenCostsNothing) {
    open(kMoving);
    screen_->tap("Control_L+space");
    write(scene(), "void mainImage(out vec4 c, in vec2 p) { c = }\n");
    ASSERT_TRUE(glint_->says("error:"));
    wait_for_rest();
    EXPECT_TRUE(uses_at_most(1.0, "paused with an error"));
}

// Nothing is held at standby yet: the process that would make it ready says so, and nobody asks.
TEST_F(Idle, ASceneThatIsWrongFromTheStartCostsNothing) {
    write(scene(), "void mainImage(out vec4 c, in vec2 p) { c = }\n");
    start({scene().string()});
    ASSERT_TRUE(glint_->says("error:"));
    wait_for_rest();
    EXPECT_TRUE(uses_at_most(1.0, "nothing was ever right"));
}

TEST_F(Idle, NothingOpenCostsNothing) {
    fs::create_directory(folder_->path() / "empty");
    start({(folder_->path() / "empty").string()});
    wait_for_rest();
    EXPECT_TRUE(uses_at_most(1.0, "a folder without scenes"));
}

// Nobody sees the browser: its picture is not drawn.
TEST_F(Idle, ASceneBesideItThatHangsCostsNothing) {
    write(folder_->path() / "beside.frag", kHanging);
    open(kMoving);
    screen_->tap("Control_L+space");
    wait_for_rest();
    EXPECT_TRUE(uses_at_most(1.0, "paused, a hanging scene in its folder"));
}

// The process that takes the place of the one that hung says that it is ready, and nobody has
// asked.
TEST_F(Idle, AHangThatWasRefusedCostsNothing) {
    environment_ = kOnOneCore;
    open(kMoving);
    screen_->tap("Control_L+space");
    wait_for_rest();
    write(scene(), kHanging);
    // Its first frame was waited for, or small parts of it told how long it takes.
    ASSERT_TRUE(glint_->says("not shown"));
    wait_for_rest();
    EXPECT_TRUE(uses_at_most(1.0, "paused, after a hang"));
}

}  // namespace
}  // namespace glint::window::idle_test
