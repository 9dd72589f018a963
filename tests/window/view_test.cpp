// The view of the passes panel: magnified, moved, and of what is no number.
#include "live.h"

namespace glint::window::view_test {
namespace {

// Red tells of the place in the picture, blue of a button that is down.
class Magnified : public Window {
protected:
    void SetUp() override {
        Window::SetUp();
        if (IsSkipped()) return;
        open(
            "void mainImage(out vec4 c, in vec2 p) {\n"
            "    c = vec4(0.2 + 0.6 * p.x / iResolution.x, 0.5, iMouse.z > 0.0 ? 1.0 : 0.0, "
            "1);\n}\n");
        screen_->tap("Control_L+space");
        screen_->tap("Control_L+t");
        settle();
        fitted_ = red();
        screen_->tap("Control_L+p");
        settle();
        wheel(4, 8);
        EXPECT_TRUE(eventually([&] { return red() > fitted_ + 5; })) << red();
    }
    void wheel(int button, int times) {
        screen_->move(kMiddle);
        for (int i = 0; i < times; ++i) {
            screen_->button(true, button);
            screen_->button(false, button);
        }
        settle();
    }
    int red() const { return screen_->pixel({kMiddle.x - 100, kMiddle.y}).r; }

    static constexpr glm::ivec2 kMiddle{640, 360};
    int fitted_ = 0;
};

TEST_F(Magnified, ItIsTheSceneAgainOnceThePanelIsClosed) {
    screen_->tap("Control_L+p");
    EXPECT_TRUE(eventually([&] { return red() == fitted_; })) << red() << ", not " << fitted_;
    screen_->move(kMiddle);
    screen_->button(true);
    EXPECT_TRUE(eventually([&] { return screen_->pixel(kMiddle).b == 255; })) << "it has the mouse";
    screen_->button(false);
}

TEST_F(Magnified, ItDoesNotLeaveTheWindowWhereverItIsDragged) {
    for (int i = 0; i < 5; ++i) screen_->drag({400, 360}, {900, 360});
    settle();
    EXPECT_EQ(screen_->pixel(kMiddle).g, 128) << screen_->pixel(kMiddle);
    wheel(5, 20);  // to all of it
    EXPECT_EQ(red(), fitted_);
    wheel(4, 8);
    EXPECT_EQ(screen_->pixel(kMiddle).g, 128) << screen_->pixel(kMiddle);
}

TEST_F(Window, OnePixelThatIsNoNumberLeavesThoseBesideItAlone) {
    open(
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    bool bad = ivec2(p) == ivec2(640, 719 - 360);\n"
        "    c = bad ? vec4(sqrt(-1.0 - p.x)) : vec4(0.8, 0.4, 0.2, 1);\n}\n");
    screen_->tap("Control_L+space");
    screen_->tap("Control_L+t");
    screen_->tap("Control_L+p");
    EXPECT_TRUE(shows({255, 0, 255}, {640, 360}));
    for (const glm::ivec2 beside : {glm::ivec2(639, 360), {641, 360}, {640, 359}, {640, 361}})
        EXPECT_EQ(screen_->pixel(beside), Colour(204, 102, 51)) << beside.x << ", " << beside.y;
}

}  // namespace
}  // namespace glint::window::view_test
