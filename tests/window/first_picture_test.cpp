// What a person sees before the first frame, at which resolution the scene moves, and what becomes
// of it when nothing moves.
#include "live.h"
#include "media/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <set>

namespace glint::window::first_picture_test {
namespace {

// Tried for many seconds, in ever larger parts, and refused then: its frame would take twenty
// minutes.
constexpr const char* kHang = R"(
void mainImage(out vec4 c, in vec2 p) {
    float a = p.x;
    for (int i = 0; i < 1000000000; ++i) {
        for (int k = 0; k < 8; ++k)
            a = sin(a * 1.1 + exp(cos(a + float(k)))) + pow(abs(a), 0.3);
        if (a > 100.0) break;
    }
    c = vec4(a);
}
)";

// Refused after a second: its frame would take one minute.
constexpr const char* kHopeless = R"(
void mainImage(out vec4 c, in vec2 p) {
    float a = p.x;
    for (int i = 0; i < 1000000000; ++i) a = sin(a * 1.1 + float(i));
    c = vec4(a);
}
)";

// Green where it is drawn smaller than the window, red where it is not; far too slow for the
// latter.
constexpr const char* kSlow = R"(
void mainImage(out vec4 c, in vec2 p) {
    float x = p.x + iTime;
    for (int i = 0; i < 600; ++i) x = sin(x + float(i));
    c = vec4(vec3(iResolution.x < 1279.0 ? vec2(0, 1) : vec2(1, 0), x * 1e-6), 1);
}
)";

class FirstPicture : public Window {
protected:
    // As for a person: nothing has been chosen.
    FirstPicture() { counts_pixels_ = false; }
    void leave() {
        screen_->tap("Control_L+q");
        EXPECT_EQ(glint_->wait().code, 0);
    }
    // The one that F12 writes, of what is not green any more after a click.
    Image still_of_a_click(glm::ivec2 at) {
        screen_->click(at);
        EXPECT_TRUE(eventually([&] { return screen_->pixel({300, 300}).g < 100; }));
        screen_->tap("F12");
        const fs::path still = folder_->path() / "scene-0001.png";
        EXPECT_TRUE(eventually([&] { return fs::exists(still); }));
        return read_image(still);
    }
    void hang(const char* text = kHang) {
        write(scene(), text);
        environment_ = kOnOneCore;
    }
    ::testing::AssertionResult shows_green() const { return shows({0, 255, 0}, {20, 300}); }
    ::testing::AssertionResult shows_red() const { return shows({255, 0, 0}, {20, 300}); }
    bool is_black(glm::ivec2 at) const { return screen_->pixel(at) == Colour{0, 0, 0}; }
};

TEST_F(FirstPicture, WhatWasSeenHereLastStandsUntilTheSceneDraws) {
    open(flat({200, 30, 20}));
    ASSERT_TRUE(shows({200, 30, 20}));
    leave();
    hang();
    start({scene().string()});
    EXPECT_TRUE(shows({200, 30, 20}));
    EXPECT_EQ(glint_->count("scene.frag: "), 1) << "it is still tried, after the one before";
}

TEST_F(FirstPicture, WhatPassedHereBeforeIsNotTriedAgainUntilItsTextIsAnother) {
    open(flat({200, 30, 20}));
    for (const auto& [text, tried] :
         {std::pair(flat({200, 30, 20}), false), std::pair(flat({20, 30, 200}), true)}) {
        settle();
        leave();
        write(scene(), text);
        const int shown = glint_->count(": shown");
        const int untried = glint_->count("trial 0.0");
        start({scene().string()});
        ASSERT_TRUE(glint_->says(": shown", shown + 1)) << glint_->errors();
        EXPECT_EQ(glint_->count("trial 0.0") == untried, tried) << glint_->errors();
    }
}

TEST_F(FirstPicture, WithoutOneTheGroundIsNotBlackAndStaysSoWhereNothingCanBeShown) {
    hang(kHopeless);
    start({scene().string()});
    ASSERT_TRUE(eventually([&] { return !is_black({300, 300}); }));
    while (glint_->count("not shown") == 0 && glint_->runs()) {
        ASSERT_FALSE(is_black({300, 300})) << glint_->errors();
        settle();
    }
    settle();
    EXPECT_FALSE(is_black({300, 300}));
}

// The panels answer while the other process is at work.
TEST_F(FirstPicture, PanelsObeyWhileItIsCompiled) {
    hang();
    start({scene().string()});
    const Colour kPanel = {24, 26, 29};
    const auto bar = [&] {
        const Colour at = screen_->pixel({1000, 709});
        return std::abs(at.r - kPanel.r) + std::abs(at.b - kPanel.b) < 20;
    };
    ASSERT_TRUE(eventually(bar));
    screen_->tap("Control_L+b");
    EXPECT_TRUE(eventually([&] { return !bar(); }));
    EXPECT_EQ(glint_->count("scene.frag: "), 0) << "it is still tried";
}

TEST_F(FirstPicture, ASlowSceneIsSmallerFromItsFirstFrameOnAndAStillOfItIsNot) {
    open(kSlow);
    EXPECT_TRUE(shows_green());
    screen_->tap("F12");
    const fs::path still = folder_->path() / "scene-0001.png";
    ASSERT_TRUE(eventually([&] { return fs::exists(still); }));
    const Image image = read_image(still);
    EXPECT_EQ(image.size, glm::ivec2(1280, 720));
    EXPECT_EQ(std::to_integer<int>(image.pixels[0]), 255) << "red: drawn at the full size";
}

TEST_F(FirstPicture, APressIsAtItsPixelOfTheFullSizeInAStillOfASlowScene) {
    open(R"(
void mainImage(out vec4 c, in vec2 p) {
    float x = p.x + iTime;
    for (int i = 0; i < 600; ++i) x = sin(x + float(i));
    vec3 place = vec3(mod(iMouse.x, 256.0), floor(iMouse.x / 256.0), mod(iMouse.y, 256.0));
    c = vec4(iMouse.x > 0.0 ? place / 255.0 : vec3(0, 1, x * 1e-6), 1);
}
)");
    ASSERT_TRUE(shows_green());
    const Image image = still_of_a_click({701, 499});
    ASSERT_EQ(image.size, glm::ivec2(1280, 720));
    const auto byte = [&](std::size_t at) { return std::to_integer<int>(image.pixels[at]); };
    EXPECT_EQ(256 * byte(1) + byte(0), 701);
    EXPECT_NEAR(byte(2), 720 - 499, 1) << "the row that the pointer is in, or between two";
}

TEST_F(FirstPicture, ASimulationOfASlowSceneHasTheMouseWhereTheFullSizeHasIt) {
    open(R"(
uniform sampler2D screen; //@ pass mainScreen
uniform sampler2D memory; //@ pass mainMemory size=1x1 step=1/60
void mainScreen(out vec4 c, in vec2 p) { c = vec4(0); }
void mainMemory(out vec4 c, in vec2 p) {
    c = vec4(texelFetch(memory, ivec2(0), 0).xyz, 1);
    if (iMouse.x > 0.0) c.xy = iMouse.xy / vec2(textureSize(screen, 0));
}
void mainImage(out vec4 c, in vec2 p) {
    float x = p.x + iTime;
    for (int i = 0; i < 600; ++i) x = sin(x + float(i));
    float column = round(texelFetch(memory, ivec2(0), 0).x * 1280.0);
    vec3 place = vec3(mod(column, 256.0), floor(column / 256.0), 0.0);
    c = vec4(column > 0.0 ? place / 255.0 : vec3(0, 1, x * 1e-6), 1);
}
)");
    ASSERT_TRUE(shows_green());
    const Image image = still_of_a_click({701, 499});
    const auto byte = [&](std::size_t at) { return std::to_integer<int>(image.pixels[at]); };
    EXPECT_EQ(256 * byte(1) + byte(0), 701);
}

TEST_F(FirstPicture, TheWordsInTheTransportBarChooseTheFullSizeWhichIsRemembered) {
    open(kSlow);
    ASSERT_TRUE(shows_green());
    screen_->click({950, 692});  // "held at 38 %"
    EXPECT_TRUE(shows_red());
    leave();
    EXPECT_EQ(read(memory_of_resolutions()).substr(0, 5), "full ");
    start({scene().string()});
    ASSERT_TRUE(glint_->says(": shown"));
    EXPECT_TRUE(shows_red());
}

// 120x67.5 pixels, rounded, have another shape than the window.
TEST_F(FirstPicture, AShareThatIsRoundedFillsTheWindowToItsEdges) {
    write(memory_of_resolutions(), fmt::format("held plain 0.09375 {}\n", scene().string()));
    open(
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    c = vec4(0, 1, iResolution.xy == vec2(120, 68) ? 1 : 0, 1);\n}\n");
    for (const int x : {0, 1279}) EXPECT_TRUE(shows({0, 255, 255}, {x, 300}));
}

// Blue where the size was ever another one.
TEST_F(FirstPicture, BuffersOfThePicturesSizeKeepThatOfTheFirstFrame) {
    open(R"(
uniform sampler2D memory; //@ pass mainMemory
void mainMemory(out vec4 c, in vec2 p) {
    vec4 before = texelFetch(memory, ivec2(0), 0);
    c = vec4(iResolution.xy, before.z, iFrame);
    if (before.w > 0.0 && before.xy != iResolution.xy) c.z = 1.0;
}
void mainImage(out vec4 c, in vec2 p) {
    float x = p.x + iTime;
    for (int i = 0; i < 600; ++i) x = sin(x + float(i));
    vec4 seen = texelFetch(memory, ivec2(0), 0);
    c = vec4(vec3(0, iResolution.x < 1279.0 && seen.w > 30.0 ? 1 : 0, seen.z) + x * 1e-6, 1);
}
)");
    EXPECT_TRUE(shows_green());
}

TEST_F(FirstPicture, APausedPictureBecomesTheStillOf64SamplesAndThenCostsNothing) {
    open(R"(
void mainImage(out vec4 c, in vec2 p) {
    vec2 q = p * mat2(0.9, 0.3, -0.3, 0.9);
    c = vec4(step(length(fract(q / 23.0) - 0.5), 0.3), fract(p / 97.0), iTime > 1e9 ? 1 : 0);
}
)");
    screen_->tap("Control_L+space");
    screen_->tap("Tab");
    const Image wanted = read_image(still({"--size", "1280x720", "--samples", "64"}));
    constexpr int kRows = 640;  // below stand words
    // The samples are added in another order: the last digits of the sums.
    EXPECT_TRUE(eventually([&] { return largest_difference(wanted, kRows) <= 1; }))
        << largest_difference(wanted, kRows);
    const auto refines = [&] {
        const std::vector<pid_t> children = glint_->children();
        return std::ranges::any_of(children, [](pid_t child) {
            return read(fmt::format("/proc/{}/cmdline", child)).find("refine") != std::string::npos;
        });
    };
    EXPECT_TRUE(eventually([&] { return !refines(); })) << "the process that refines has ended";
}

}  // namespace
}  // namespace glint::window::first_picture_test
