// What a check plans: which cases in which order, who may begin, how long a frame is waited for.
#include "../base/test_folder.h"
#include "../render/fixture.h"
#include "measure/check/budget.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <thread>

namespace glint::check_plan_test {
namespace {

TEST(FrameWait, IsBoundedByTheSecondsThatAreLeftAndByTheHang) {
    EXPECT_EQ(frame_wait_seconds(60.0, 110.0, 100.0), 60.0);
    EXPECT_EQ(frame_wait_seconds(60.0, 110.0, 25.0), 25.0);
    EXPECT_EQ(frame_wait_seconds(60.0, 10.0, 10.0), 10.0);
    EXPECT_EQ(frame_wait_seconds(60.0, 10.0, 0.001), 10.0);  // the last frame has its chance
    EXPECT_EQ(frame_wait_seconds(1.0, 10.0, 10.0), 1.0);
    EXPECT_EQ(frame_wait_seconds(60.0, 0.0, 0.0), 60.0);  // no limit
}

// What others do meanwhile is no work of the check.
TEST_F(GlTest, WorkIsWhatTheProcessorsSpendWhereTheyDraw) {
    const Context& context = *shared_context.context;
    if (!context.is_software()) GTEST_SKIP() << "a GPU draws";
    const WorkClock work(context);
    const Stopwatch wall;
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
    EXPECT_LT(work.ms(), 0.5 * wall.ms());
}

Case of_group(std::size_t group, Case::Tweaks tweaks = Case::Tweaks::none) {
    return {.name = "", .run = {}, .tweaks = tweaks, .group = group};
}

TEST(CheckSeconds, AGroupGetsThreeTenthsOfWhatIsLeftWhenItBegins) {
    SharedSeconds seconds({.seconds = 100.0});
    EXPECT_FALSE(seconds.is_over(of_group(0), 0.0));
    EXPECT_FALSE(seconds.is_over(of_group(0), 30e3));
    EXPECT_TRUE(seconds.is_over(of_group(0), 30e3 + 1));
    EXPECT_FALSE(seconds.is_over(of_group(1), 40e3)) << "the next one has its own";
    EXPECT_FALSE(seconds.is_over(of_group(1), 58e3));
    EXPECT_TRUE(seconds.is_over(of_group(1), 58e3 + 1));
}

TEST(CheckSeconds, NobodyBeginsWhenAllSecondsAreOver) {
    SharedSeconds seconds({.seconds = 100.0});
    EXPECT_FALSE(seconds.is_over(of_group(3), 100e3));
    EXPECT_TRUE(seconds.is_over(of_group(3), 100e3 + 1));
    EXPECT_TRUE(seconds.is_over(of_group(4), 200e3));
}

TEST(CheckSeconds, RandomTweaksThatWereAskedForHaveAllThatIsLeft) {
    const Case random = of_group(5, Case::Tweaks::random);
    SharedSeconds usual({.seconds = 100.0});
    EXPECT_FALSE(usual.is_over(random, 0.0));
    EXPECT_TRUE(usual.is_over(random, 31e3));
    SharedSeconds asked({.random = 500, .seconds = 100.0});
    EXPECT_FALSE(asked.is_over(random, 0.0));
    EXPECT_FALSE(asked.is_over(random, 99e3));
    EXPECT_TRUE(asked.is_over(random, 101e3));
}

TEST(CheckSeconds, HasNoEndWithoutALimit) {
    SharedSeconds seconds({.seconds = 0.0});
    EXPECT_FALSE(seconds.is_over(of_group(0), 1e12));
}

class CheckPlan : public GlTest {
protected:
    std::vector<Case> plan(std::string_view scene, const Effort& effort = {}) {
        const TestFolder folder;
        ViewOptions view;
        view.file = folder.write("scene.frag", scene);
        view.size = "8x4";
        const CheckSubject subject(view, open_preset(view), *shared_context.context);
        return all_cases(subject, effort);
    }

    static bool has(const std::vector<Case>& cases, std::string_view begin) {
        return std::ranges::any_of(cases,
                                   [&](const Case& one) { return one.name.starts_with(begin); });
    }
};

constexpr const char* kStill = "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5); }\n";
constexpr const char* kSimulation =
    "uniform float gain; //@ 0.5 [0, 1]\n"
    "uniform sampler2D state; //@ pass mainState\n"
    "void mainState(out vec4 c, in vec2 p) {\n"
    "    c = gain * texelFetch(state, ivec2(p), 0) + iTime + iMouse.x;\n"
    "}\n"
    "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(state, ivec2(p), 0); }\n";

TEST_F(CheckPlan, ASceneThatStandsStillHasNoCasesOfTweaksMouseOrMotion) {
    const std::vector<Case> cases = plan(kStill);
    EXPECT_TRUE(has(cases, "size"));
    for (const char* begin : {"mouse", "tweak", "random", "long run", "frames of mixed", "NaN"})
        EXPECT_FALSE(has(cases, begin)) << begin;
}

TEST_F(CheckPlan, ASimulationHasThemAllWithTheLongOnesLast) {
    const std::vector<Case> cases = plan(kSimulation);
    std::vector<std::string> names;
    for (const Case& one : cases) names.push_back(one.name);
    for (const char* begin : {"size", "mouse", "tweak gain=1", "age", "NaN in state",
                              "frames of mixed", "long run", "random tweaks"})
        EXPECT_TRUE(has(cases, begin)) << begin << " of " << testing::PrintToString(names);
    EXPECT_TRUE(cases.back().name.starts_with("random tweaks")) << cases.back().name;
    EXPECT_TRUE(std::ranges::is_sorted(cases, {}, &Case::group));
    std::ranges::sort(names);
    EXPECT_EQ(std::ranges::adjacent_find(names), names.end()) << "--case tells them apart";
}

TEST_F(CheckPlan, TheEffortSaysHowManyAreRandomAndWhetherBuffersArePoisoned) {
    const std::vector<Case> cases = plan(kSimulation, {.random = 5, .inject = 0});
    EXPECT_EQ(std::ranges::count_if(
                  cases, [](const Case& one) { return one.tweaks == Case::Tweaks::random; }),
              5);
    EXPECT_FALSE(has(cases, "NaN"));
}

}  // namespace
}  // namespace glint::check_plan_test
