// The keyboard in the panels: who has it, how it goes through them, and what it does there.
#include "screen.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace glint::keys_test {
namespace {

Tweak whole(const char* name, double initial, double min, double max) {
    Tweak tweak = number(name, initial, min, max);
    tweak.type = TweakType::int1;
    return tweak;
}

class Keys : public testing::Test {
protected:
    void frames(int count = 4) {
        for (int i = 0; i < count; ++i) screen.frame();
    }
    void press(ImGuiKey key, int times = 1) {
        for (int i = 0; i < times; ++i) screen.press(key);
        frames();
    }
    // As the window does for the shortcuts.
    void next_panel(int step = 1) {
        screen.settings.keys = true;
        screen.settings.next_panel = step;
        frames();
    }
    void search() {
        screen.settings.keys = screen.settings.search = true;
        frames();
    }
    static std::string panel() {
        return GImGui->NavWindow ? GImGui->NavWindow->RootWindow->Name : "none";
    }
    static bool is_at(ImGuiID id) { return GImGui->NavId == id && !GImGui->NavDisableHighlight; }
    double value(std::size_t index) const { return screen.tweaks.value(index)[0]; }

    Screen screen{
        {number("waves", 0.5, 0, 1), whole("steps", 500, 8, 1024), number("wind", 1, 0, 4)}};
};

TEST_F(Keys, BelongToTheSceneUntilTheyAreGivenAndAfterEsc) {
    screen.click(screen.find(screen.in_row(0, "label"))->GetCenter());
    press(ImGuiKey_DownArrow);
    EXPECT_TRUE(GImGui->NavDisableHighlight) << "the mouse in a panel takes no keys";
    next_panel();
    EXPECT_FALSE(GImGui->NavDisableHighlight);
    press(ImGuiKey_Escape);
    EXPECT_FALSE(screen.settings.keys);
    next_panel();
    screen.click({500, 400});
    EXPECT_FALSE(screen.settings.keys) << "a click on the picture";
}

TEST_F(Keys, GoThroughThePanelsInBothDirections) {
    next_panel();
    EXPECT_EQ(panel(), "Tweaks") << "the first that has no keys of its own";
    next_panel();
    EXPECT_EQ(panel(), "transport");
    next_panel();
    EXPECT_EQ(panel(), "bar");
    next_panel(-1);
    EXPECT_EQ(panel(), "transport");
    screen.settings.visible = false;
    frames();
    EXPECT_FALSE(screen.settings.keys) << "hidden panels have none";
}

TEST_F(Keys, GoFromTheToolsOfAPanelToItsRows) {
    next_panel();
    const ImGuiWindow* panel = Screen::window("Tweaks");
    ASSERT_TRUE(is_at(ImHashStr("undo", 0, panel->ID)));
    press(ImGuiKey_DownArrow);
    EXPECT_TRUE(is_at(screen.in_row(0, "label")));
    press(ImGuiKey_RightArrow);
    EXPECT_TRUE(is_at(screen.in_row(0, "##slider")));
    press(ImGuiKey_UpArrow);
    EXPECT_EQ(GImGui->NavWindow->RootWindow, panel);
    EXPECT_FALSE(is_at(screen.in_row(0, "##slider")));
}

TEST_F(Keys, TakeHoldOfASliderMoveItAndLetGo) {
    search();
    press(ImGuiKey_Enter);
    ASSERT_TRUE(is_at(screen.in_row(0, "##slider")));
    press(ImGuiKey_Space);
    press(ImGuiKey_RightArrow, 3);
    EXPECT_GT(value(0), 0.52);
    press(ImGuiKey_Space);
    const double moved = value(0);
    press(ImGuiKey_DownArrow);
    ASSERT_TRUE(is_at(screen.in_row(1, "##slider")));
    EXPECT_EQ(value(0), moved);
    press(ImGuiKey_Space);
    press(ImGuiKey_LeftArrow);
    EXPECT_LT(value(1), 500.0);
    EXPECT_EQ(value(1), std::round(value(1)));
    press(ImGuiKey_Escape);
    EXPECT_TRUE(screen.settings.keys) << "that Esc let go of the slider";
    press(ImGuiKey_Escape);
    EXPECT_FALSE(screen.settings.keys);
}

TEST_F(Keys, MoveAStepOfAnIntegerThatIsMoreThanAHundredthOfTheRange) {
    Tweak few = whole("few", 2, 0, 6);
    Screen other({few});
    other.settings.keys = other.settings.search = true;
    for (int i = 0; i < 4; ++i) other.frame();
    other.press(ImGuiKey_Enter);
    for (int i = 0; i < 4; ++i) other.frame();
    other.press(ImGuiKey_Space);
    other.press(ImGuiKey_RightArrow);
    EXPECT_EQ(other.tweaks.value(0)[0], 3.0);
    other.press(ImGuiKey_LeftArrow);
    other.press(ImGuiKey_LeftArrow);
    EXPECT_EQ(other.tweaks.value(0)[0], 1.0);
}

TEST_F(Keys, TypeAValueAndStandOnItsSliderAgain) {
    search();
    press(ImGuiKey_Enter);
    press(ImGuiKey_Enter);
    screen.type("0.25");
    press(ImGuiKey_Enter);
    EXPECT_EQ(value(0), 0.25);
    EXPECT_TRUE(is_at(screen.in_row(0, "##slider")));
}

TEST_F(Keys, OpenAMenuOnANameThatResetsInTwoSteps) {
    screen.tweaks.set_written(std::vector<TweakValue>{{0.75}, {500.0}, {1.0}});
    search();
    press(ImGuiKey_Enter);
    press(ImGuiKey_LeftArrow);
    ASSERT_TRUE(is_at(screen.in_row(0, "label")));
    press(ImGuiKey_Space);
    ASSERT_TRUE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup));
    press(ImGuiKey_Space);
    EXPECT_EQ(value(0), 0.75) << "the first entry: the file's";
    EXPECT_FALSE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup));
}

TEST_F(Keys, SearchFiltersAsTypedEnterGoesToTheFirstEscLeaves) {
    search();
    EXPECT_TRUE(ImGui::GetIO().WantTextInput);
    screen.type("win");
    frames();
    EXPECT_FALSE(screen.find(screen.in_row(0, "##slider")));
    ASSERT_TRUE(screen.find(screen.in_row(2, "##slider")));
    press(ImGuiKey_Enter);
    EXPECT_TRUE(is_at(screen.in_row(2, "##slider")));
    search();
    screen.type("steps");
    frames();
    EXPECT_TRUE(screen.find(screen.in_row(1, "##slider")));
    press(ImGuiKey_Escape);
    EXPECT_FALSE(screen.settings.keys);
    EXPECT_FALSE(ImGui::GetIO().WantTextInput);
    EXPECT_TRUE(screen.find(screen.in_row(2, "##slider"))) << "what was searched before";
}

TEST_F(Keys, ANameThatNothingHasKeepsThemInTheField) {
    search();
    screen.type("nothing");
    press(ImGuiKey_Enter);
    EXPECT_TRUE(screen.settings.keys);
    press(ImGuiKey_Escape);
    EXPECT_FALSE(screen.settings.keys);
}

}  // namespace
}  // namespace glint::keys_test
