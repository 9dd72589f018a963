// The words on the resolution in the transport bar, and those on what the first frame waits for.
#include "screen.h"

#include <gtest/gtest.h>

namespace glint::resolution_test {
namespace {

std::optional<ImRect> words(Screen& screen) {
    return screen.find(ImHashStr("###resolution", 0, screen.window("transport")->ID), "transport");
}

ImVec2 middle(const ImRect& rect) {
    return rect.GetCenter();
}

TEST(Resolution, NothingIsSaidOfAQuickScene) {
    Screen screen({});
    screen.facts.picture_size = screen.facts.full_size = {1280, 720};
    screen.facts.full_ms = screen.facts.frame_ms = 12.0;
    screen.frame();
    EXPECT_FALSE(words(screen));
}

TEST(Resolution, AClickOnTheWordsChoosesTheFullSizeAndAnotherGoesBack) {
    Screen screen({});
    screen.facts.picture_size = {480, 270};
    screen.facts.full_size = {1280, 720};
    screen.facts.full_ms = 300.0;
    screen.frame();
    const auto held = words(screen);
    ASSERT_TRUE(held);
    EXPECT_TRUE(screen.settings.hold_frame_rate);
    screen.click(middle(*held));
    EXPECT_FALSE(screen.settings.hold_frame_rate);
    screen.facts.picture_size = screen.facts.full_size;
    screen.wait();
    const auto full = words(screen);
    ASSERT_TRUE(full) << "a slow scene keeps its words, to go back by";
    screen.click(middle(*full));
    EXPECT_TRUE(screen.settings.hold_frame_rate);
}

// Each sample has another text, and a press and its release may fall on two of them.
TEST(Resolution, TheWordsCanBeClickedWhileTheyCount) {
    Screen screen({});
    screen.facts.picture_size = screen.facts.full_size = {1280, 720};
    screen.facts.refined = 12;
    screen.facts.refined_of = 64;
    screen.frame();
    const auto counted = words(screen);
    ASSERT_TRUE(counted);
    screen.move(middle(*counted));
    screen.button(true);
    screen.facts.refined = 13;
    screen.button(false);
    screen.frame();
    EXPECT_FALSE(screen.settings.hold_frame_rate);
}

TEST(Waiting, WordsAndAGroundStandWhereThereIsNoPictureAndGoWithIt) {
    Screen screen({});
    const auto drawn = [&] {
        screen.frame();
        return ImGui::GetBackgroundDrawList()->VtxBuffer.Size;
    };
    const int bare = drawn();
    screen.facts.scene = nullptr;
    screen.facts.file = "sea.toml";
    screen.facts.waits_for = "compiling image";
    screen.facts.waited = 2.3;
    const int ground = drawn();
    screen.facts.shows_picture = true;
    const int over_picture = drawn();
    EXPECT_GT(ground, over_picture);
    EXPECT_GT(over_picture, bare);
    screen.facts.scene = &screen.scene;
    screen.facts.waits_for.clear();
    EXPECT_EQ(drawn(), bare);
}

}  // namespace
}  // namespace glint::resolution_test
