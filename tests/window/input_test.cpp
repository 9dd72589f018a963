// Mouse and keys reach the scene as on Shadertoy, seen from the screen: the scene paints the
// numbers that it reads.
#include "live.h"

#include <chrono>
#include <thread>

namespace glint::window::input_test {
namespace {

using namespace std::chrono_literals;

// Bands of 40 pixels from the top, each a number as a colour: iMouse, the frame, the rows of the
// keyboard for A, and how often each was seen, counted in a buffer.
constexpr const char* kNumbers = R"(
uniform sampler2D keys;   //@ keyboard
uniform sampler2D counts; //@ pass mainCounts size=4x1
float row(int y, int code) { return texelFetch(keys, ivec2(code, y), 0).x; }
void mainCounts(out vec4 c, in vec2 p) {
    c = texelFetch(counts, ivec2(p), 0);
    if (p.x < 1.0) {
        c.x += float(iMouse.w > 0.0);          // frames of a press
        c.y += float(row(1, 65) > 0.5);        // frames in which A was pressed
        c.z += 1.0;                            // frames
        c.w = max(c.w, iMouse.z > 0.0 ? 1.0 : 0.0);
    }
}
vec4 code(float value) {
    int v = int(round(value)) + 8388608;
    return vec4(vec3((v >> 16) & 255, (v >> 8) & 255, v & 255) / 255.0, 1.0);
}
void mainImage(out vec4 c, in vec2 p) {
    int band = int(iResolution.y - p.y) / 40;
    vec4 seen = texelFetch(counts, ivec2(0), 0);
    c = vec4(0, 0, 0, 1);
    if (band < 4) c = code(iMouse[band]);
    else if (band == 4) c = code(float(iFrame));
    else if (band < 8) c = code(row(band - 5, 65) * 255.0);
    else if (band == 8) c = code(seen.x);
    else if (band == 9) c = code(seen.y);
    else if (band == 10) c = code(seen.z);
    else if (band == 11) c = code(iTime * 1e4);
    else if (band == 12) c = code(row(0, 38) * 255.0);
    else if (band == 13) c = code(iResolution.x);
    else if (band == 14) c = code(row(0, 17) * 255.0);
}
)";

enum Band {
    kX,
    kY,
    kZ,
    kW,
    kFrame,
    kHeld,
    kPressed,
    kToggled,
    kPresses,
    kKeyPresses,
    kFrames,
    kTime,
    kUp,
    kWidth,
    kControl
};

class Input : public Window {
protected:
    void SetUp() override {
        screen_size_ = {1400, 800};
        Window::SetUp();
    }
    void open_numbers(bool panels = false) {
        open(kNumbers);
        if (!panels) screen_->tap("Tab");
        pause();
    }
    void pause() {
        screen_->tap("Control_L+space");
        settle();
    }
    // Left of all panels.
    int number(Band band) const {
        const Colour colour = screen_->pixel({3, band * 40 + 20});
        return (colour.r << 16 | colour.g << 8 | colour.b) - 8388608;
    }
    testing::AssertionResult becomes(Band band, int value) const {
        if (eventually([&] { return number(band) == value; })) {
            return testing::AssertionSuccess();
        }
        return testing::AssertionFailure() << "it is " << number(band) << ", not " << value;
    }
};

TEST_F(Input, NothingIsKnownOfTheMouseBeforeAClick) {
    open_numbers();
    screen_->move({300, 300});
    settle();
    for (const Band band : {kX, kY, kZ, kW}) EXPECT_EQ(number(band), 0);
}

TEST_F(Input, TheSignsOfAClickFollowTheSite) {
    open_numbers();
    screen_->move({300, 200});
    screen_->button(true);
    EXPECT_TRUE(becomes(kZ, 300));
    EXPECT_TRUE(becomes(kX, 300));
    const int y = 720 - 200 - 1;  // of the middle of the pixel, rounded down
    EXPECT_TRUE(becomes(kY, y));
    EXPECT_TRUE(becomes(kW, y));  // the frame of the press, and time stands
    screen_->move({350, 180});
    EXPECT_TRUE(becomes(kX, 350));
    EXPECT_TRUE(becomes(kW, -y));
    EXPECT_EQ(number(kZ), 300);
    screen_->button(false);
    EXPECT_TRUE(becomes(kZ, -300));
    EXPECT_EQ(number(kX), 350);
    screen_->move({500, 300});
    settle();
    EXPECT_EQ(number(kX), 350);  // moves with the button up do not count
}

TEST_F(Input, AClickOfLessThanAFrameIsSeenInOneFrame) {
    open_numbers();
    for (int i = 1; i <= 5; ++i) {
        screen_->click({200 + i, 300});
        EXPECT_TRUE(becomes(kPresses, i));
        EXPECT_TRUE(becomes(kZ, -(200 + i)));
        std::this_thread::sleep_for(50ms);
    }
}

TEST_F(Input, ADragGoesOnOutsideTheWindow) {
    open_numbers();
    screen_->move({1200, 300});
    screen_->button(true);
    EXPECT_TRUE(becomes(kX, 1200));
    screen_->move({1350, 300});
    EXPECT_TRUE(becomes(kX, 1350));
    screen_->move({1300, 790});
    EXPECT_TRUE(becomes(kX, 1300));
    EXPECT_LT(number(kY), 0);
    screen_->button(false);
    EXPECT_TRUE(becomes(kZ, -1200));
}

TEST_F(Input, AHeldKeyIsPressedOnceAndTogglesOnce) {
    open_numbers();
    screen_->key("a", true);
    EXPECT_TRUE(becomes(kHeld, 255));
    EXPECT_TRUE(becomes(kToggled, 255));
    std::this_thread::sleep_for(900ms);  // the keyboard repeats by now
    EXPECT_EQ(number(kKeyPresses), 1);
    screen_->key("a", false);
    EXPECT_TRUE(becomes(kHeld, 0));
    EXPECT_EQ(number(kToggled), 255);
    screen_->tap("a");
    EXPECT_TRUE(becomes(kToggled, 0));
    EXPECT_TRUE(becomes(kKeyPresses, 2));
    EXPECT_TRUE(becomes(kHeld, 0));  // a frame after that of the press
    screen_->key("Up", true);
    EXPECT_TRUE(becomes(kUp, 255));
    screen_->key("Up", false);
    EXPECT_TRUE(becomes(kUp, 0));
}

TEST_F(Input, WhilePausedAnInputDrawsOneMoreFrameAndTimeStands) {
    open_numbers();
    const int frame = number(kFrame), frames = number(kFrames), time = number(kTime);
    screen_->key("a", true);
    EXPECT_TRUE(becomes(kHeld, 255));
    settle();
    EXPECT_EQ(number(kFrame), frame + 1);
    EXPECT_EQ(number(kFrames), frames + 1);
    EXPECT_EQ(number(kTime), time);
}

TEST_F(Input, HeldKeysComeUpWhenTheWindowLosesTheKeyboard) {
    open_numbers();
    screen_->key("a", true);
    EXPECT_TRUE(becomes(kHeld, 255));
    screen_->focus(false);
    EXPECT_TRUE(becomes(kHeld, 0));
    screen_->key("a", false);
    screen_->focus(true);
    screen_->tap("a");
    EXPECT_TRUE(becomes(kKeyPresses, 2));
    EXPECT_TRUE(becomes(kHeld, 0)) << "the release of the tap may be a frame later";
}

TEST_F(Input, ShortcutsDoNotReachTheScene) {
    open_numbers();
    screen_->tap("Control_L+g");
    screen_->tap("Control_L+a");  // no shortcut: the scene's
    EXPECT_TRUE(becomes(kKeyPresses, 1));
    EXPECT_TRUE(becomes(kControl, 0));
}

TEST_F(Input, AClickOnAPanelDoesNotReachTheSceneEvenWhenTheMouseWasElsewhereBefore) {
    open_numbers(true);
    for (int i = 0; i < 5; ++i) {
        screen_->move({500, 300});
        settle();
        screen_->click({1100, 30});  // at once: no frame lies between the move and the press
        settle();
        EXPECT_EQ(number(kPresses), 0);
    }
    screen_->click({500, 300});
    EXPECT_TRUE(becomes(kPresses, 1));
}

TEST_F(Input, WhatIsTypedIntoAFieldDoesNotReachTheScene) {
    open_numbers(true);
    screen_->tap("Control_L+Shift_L+s");  // asks for the path of a preset
    settle();
    screen_->type("aaa");
    settle();
    screen_->tap("Escape");
    EXPECT_TRUE(becomes(kKeyPresses, 0));  // the dialog, which dims the picture, has gone
    screen_->tap("a");
    EXPECT_TRUE(becomes(kKeyPresses, 1));
}

}  // namespace
}  // namespace glint::window::input_test
