// Screens of another scale, files from elsewhere, a frame rate that is to be held.
#include "live.h"

#include <chrono>
#include <thread>

namespace glint::window::manners_test {
namespace {

using namespace std::chrono_literals;

class Manners : public Window {};

TEST_F(Manners, AFileThatIsDroppedOnTheWindowIsOpened) {
    open(flat({1, 2, 3}));
    const fs::path other = folder_->path() / "other scene.frag";
    write(other, flat({90, 80, 70}));
    EXPECT_TRUE(screen_->drop(folder_->path() / "other%20scene.frag"));
    EXPECT_TRUE(shows({90, 80, 70}, {3, 300})) << glint_->errors();
    EXPECT_TRUE(eventually([&] { return screen_->title() == "other scene - Glint"; }));
    // It is the one that is followed now.
    write(other, flat({91, 80, 70}));
    EXPECT_TRUE(shows({91, 80, 70}, {3, 300})) << glint_->errors();
}

TEST_F(Manners, AShadertoyThatIsDroppedBecomesASceneBesideIt) {
    open(flat({1, 2, 3}));
    const auto shader = [](int red) {
        return R"([{"renderpass": [{"type": "image", "name": "Image", "inputs": [], "outputs": [],
            "code": "void mainImage(out vec4 c, in vec2 p) { c = vec4()" +
               std::to_string(red) + R"(, 80, 70, 255) / 255.0; }"}]}])";
    };
    write(folder_->path() / "toy.json", shader(90));
    EXPECT_TRUE(screen_->drop(folder_->path() / "toy.json"));
    EXPECT_TRUE(shows({90, 80, 70}, {3, 300})) << glint_->errors();
    EXPECT_TRUE(eventually([&] { return screen_->title() == "toy - Glint"; }));
    // It may have been worked on since.
    write(folder_->path() / "toy.frag", flat({91, 80, 70}));
    EXPECT_TRUE(shows({91, 80, 70}, {3, 300})) << glint_->errors();
    EXPECT_TRUE(screen_->drop(folder_->path() / "toy.json"));
    std::this_thread::sleep_for(500ms);
    EXPECT_TRUE(shows({91, 80, 70}, {3, 300})) << glint_->errors();
    // What is no shader leaves the scene as it is.
    write(folder_->path() / "broken.json", "{");
    EXPECT_TRUE(screen_->drop(folder_->path() / "broken.json"));
    EXPECT_TRUE(glint_->says("this is no JSON")) << glint_->errors();
    EXPECT_TRUE(shows({91, 80, 70}, {3, 300}));
}

TEST_F(Manners, WhatIsNoSceneTakesNoScenesPlace) {
    open(flat({90, 80, 70}));
    write(folder_->path() / "photo.png", std::string("\x89PNG\0\0", 6));
    for (const char* name : {"photo.png", "gone.frag"}) {
        EXPECT_TRUE(screen_->drop(folder_->path() / name));
        std::this_thread::sleep_for(300ms);
    }
    EXPECT_TRUE(shows({90, 80, 70}, {3, 300})) << glint_->errors();
    EXPECT_EQ(screen_->title(), "scene - Glint");
    EXPECT_EQ(glint_->errors().find("error"), std::string::npos) << glint_->errors();
}

TEST_F(Manners, AHeldFrameRateLowersTheResolutionAndLettingGoRestoresIt) {
    // One colour where the picture is as fine as the window, another where it is coarser.
    open(
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    float x = iTime;\n"
        "    for (int i = 0; i < 300; ++i) x = sin(x + p.x);\n"
        "    c = vec4(iResolution.x < 1280.0, 0.2, 0.4 + 1e-6 * x, 1);\n}\n");
    EXPECT_TRUE(shows({0, 51, 102}, {3, 300}));
    screen_->click({459, 23});  // the picture's menu
    std::this_thread::sleep_for(1s);
    screen_->click({471, 120});
    EXPECT_TRUE(shows({255, 51, 102}, {3, 300}));
    screen_->click({471, 120});
    EXPECT_TRUE(shows({0, 51, 102}, {3, 300}));
}

class ScreenWithoutGlx : public Window {
protected:
    ScreenWithoutGlx() { screen_has_glx_ = false; }
};

TEST_F(ScreenWithoutGlx, TheWindowShowsThePictureByEgl) {
    open(flat({200, 30, 20}));
    EXPECT_TRUE(shows({200, 30, 20}));
    write(scene(), flat({20, 200, 30}));
    EXPECT_TRUE(shows({20, 200, 30}));
    screen_->tap("Control_L+q");
    EXPECT_EQ(glint_->wait().code, 0);
}

class LargeScreen : public Window {
protected:
    LargeScreen() { screen_size_ = {2560, 1440}; }
};

TEST_F(LargeScreen, AtTwiceTheScaleWindowPanelsAndMouseAreTwiceAsLarge) {
    screen_->set_content_scale(2);
    open(
        "uniform float value; //@ 0.25 [0, 1]\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    c = vec4(p.x / iResolution.x, value, iMouse.x / iResolution.x, 1);\n}\n");
    EXPECT_EQ(screen_->window_size(), screen_size_);
    screen_->drag({2 * 1085, 2 * 89}, {2 * 1190, 2 * 89});
    EXPECT_TRUE(eventually([&] { return screen_->pixel({6, 600}).g > 130; }));
    screen_->click({1280, 720});
    EXPECT_TRUE(eventually(
        [&] {
            return screen_->pixel({6, 600}).b == 128;
        },
        10.0))
        << screen_->pixel({6, 600});
}

}  // namespace
}  // namespace glint::window::manners_test
