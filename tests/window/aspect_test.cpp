// The picture keeps a preset's aspect, and what is saved is what was seen.
#include "live.h"

namespace glint::window::aspect_test {
namespace {

class Aspect : public Window {
protected:
    static constexpr Colour kBar{18, 18, 20};
    // Red tells where the mouse is, green how wide the picture is, in sixteenths of 1280 pixels.
    void open_square(const std::vector<std::string>& more = {}) {
        write(scene(),
              "void mainImage(out vec4 c, in vec2 p) {\n"
              "    c = vec4(iMouse.x / iResolution.x, iResolution.x / 1280.0,\n"
              "             iMouse.y / iResolution.y, 1);\n}\n");
        write(look(), "scene = \"scene.frag\"\nsize = [640, 640]\n");
        std::vector<std::string> all = {look().string()};
        all.insert(all.end(), more.begin(), more.end());
        start(all);
        ASSERT_TRUE(glint_->says(": shown")) << glint_->errors();
    }
    fs::path look() const { return folder_->path() / "look.toml"; }
};

TEST_F(Aspect, OfAPresetIsTheWindowsAndBarsKeepIt) {
    open_square();
    screen_->tap("Tab");
    EXPECT_EQ(screen_->window_size(), glm::ivec2(640, 640));
    EXPECT_TRUE(shows({0, 128, 0}, {3, 3}));
    screen_->resize_window({1280, 640});
    EXPECT_TRUE(shows(kBar, {317, 300}));
    EXPECT_TRUE(shows({0, 128, 0}, {323, 300}));
    EXPECT_TRUE(shows({0, 128, 0}, {957, 300}));
    EXPECT_TRUE(shows(kBar, {963, 300}));
    screen_->click({100, 320});  // on a bar: not the scene's
    screen_->click({480, 480});
    EXPECT_TRUE(eventually([&] {
        return screen_->pixel({323, 300}) == Colour{64, 128, 63};  // at the middles of pixels
    })) << screen_->pixel({323, 300});
    EXPECT_NE(read(look()).find("size = [640, 640]"), std::string::npos) << read(look());
    screen_->tap("Control_L+Shift_L+f");
    EXPECT_TRUE(eventually([&] { return screen_->pixel({3, 300}).g == 255; }));
    screen_->tap("Control_L+s");
    EXPECT_TRUE(eventually([&] {
        return read(look()).find("size = [1280, 640]") != std::string::npos;
    })) << read(look());
}

TEST_F(Aspect, OfTheCommandLineWinsAndASceneWithoutOneIsFree) {
    open_square({"--size", "600x300"});
    EXPECT_EQ(screen_->window_size(), glm::ivec2(600, 300));
    EXPECT_TRUE(eventually([&] { return screen_->pixel({3, 297}).g == 120; }));
    glint_.reset();
    write(look(), "scene = \"scene.frag\"\n");
    start({look().string()});
    screen_->resize_window({640, 640});
    EXPECT_TRUE(eventually([&] { return screen_->pixel({3, 637}).g == 128; }));
}

TEST_F(Aspect, TheLineOfAWipeStandsOnThePictureAlone) {
    write(scene(),
          "uniform float level; //@ 0.2 [0, 1]\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(level, 0.2, 0.3, 1); }\n");
    write(look(), "scene = \"scene.frag\"\nsize = [1280, 360]\n");
    start({look().string()});
    ASSERT_TRUE(glint_->says(": shown")) << glint_->errors();
    screen_->resize_window({1280, 720});
    EXPECT_TRUE(shows(kBar, {640, 3}));
    EXPECT_TRUE(shows({51, 51, 76}, {640, 250}));
    screen_->click({1249, 61});  // the wipe of the tweaks panel
    EXPECT_TRUE(shows({255, 255, 255}, {640, 250}));
    EXPECT_TRUE(shows(kBar, {640, 3}));
}

TEST_F(Aspect, AWindowIsNoLargerThanTheScreenAndEscLeavesFullScreen) {
    write(scene(), flat({20, 30, 40}));
    write(look(), "scene = \"scene.frag\"\nsize = [4000, 4000]\n");
    start({look().string()});
    ASSERT_TRUE(glint_->says(": shown")) << glint_->errors();
    EXPECT_EQ(screen_->window_size(), glm::ivec2(720, 720));
    screen_->tap("F11");
    EXPECT_TRUE(eventually([&] { return screen_->window_size() == screen_size_; }));
    EXPECT_TRUE(shows(kBar, {3, 600}));
    screen_->tap("Escape");
    EXPECT_TRUE(eventually([&] { return screen_->window_size() == glm::ivec2(720, 720); }));
}

}  // namespace
}  // namespace glint::window::aspect_test
