// The window while nothing is open, and the dialog that makes a new scene.
#include "../../base/test_folder.h"
#include "screen.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace glint::start_page_test {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kTemplates[] = {"shadertoy", "raymarch", "sound"};

class StartPage : public testing::Test {
protected:
    StartPage() {
        screen.facts.scene = nullptr;
        screen.facts.browser = entries_;
        screen.facts.templates = kTemplates;
        screen.facts.folder = folder_;
        frames();
    }
    void frames() {
        for (int i = 0; i < 4; ++i) screen.frame();
    }
    void press(const char* button, const char* in) {
        const ImGuiWindow* window = Screen::window(in);
        ASSERT_TRUE(window) << in;
        const auto place = screen.find(ImHashStr(button, 0, window->ID), in);
        ASSERT_TRUE(place) << button;
        screen.click(place->GetCenter());
        frames();
    }

    TestFolder made_;
    fs::path folder_ = made_.path();
    const std::vector<BrowserEntry> entries_ = {{"/far/rings.toml", "rings", "Recent", 0, {}},
                                                {"/here/boat.toml", "boat", "Examples", 0, {}},
                                                {"/here/sea.toml", "sea", "Examples", 0, {}},
                                                {"mine.frag", "mine", "", 0, {}}};
    Screen screen{{}};
};

TEST_F(StartPage, StandsInsteadOfThePanelsWhileNothingIsOpen) {
    EXPECT_TRUE(Screen::window("start"));
    for (const char* panel : {"Tweaks", "Browser", "transport"})
        EXPECT_FALSE(Screen::window(panel)) << panel;
    screen.facts.file = "mine.frag";
    frames();
    EXPECT_FALSE(Screen::window("start"));
    EXPECT_TRUE(Screen::window("Tweaks"));
}

TEST_F(StartPage, AClickOnACardOpensItsFile) {
    const ImGuiWindow* body = Screen::window("start/body");
    ASSERT_TRUE(body);
    for (int i = 0; i < 4; ++i) {
        const ImGuiID id = ImHashStr("card", 0, ImHashData(&i, sizeof i, body->ID));
        const auto place = screen.find(id, "start/body");
        ASSERT_TRUE(place) << i;
        screen.click(place->GetCenter());
        EXPECT_EQ(screen.wishes.open, entries_[static_cast<std::size_t>(i)].file);
    }
}

TEST_F(StartPage, StandsInAnySize) {
    for (const ImVec2 size : {ImVec2{0, 0}, {1, 1}, {40, 30}, {200, 2000}, {2000, 60}}) {
        ImGui::GetIO().DisplaySize = size;
        frames();
    }
}

TEST_F(StartPage, NewAsksForANameThatIsFreeAndATemplate) {
    std::ofstream(folder_ / "new.frag") << "mine";
    press("New scene\u2026", "start");
    ASSERT_TRUE(Screen::window("New scene"));
    press("raymarch", "New scene");
    press("Create", "New scene");
    ASSERT_TRUE(screen.wishes.new_scene);
    EXPECT_EQ(screen.wishes.new_scene->file, folder_ / "new-2.frag");
    EXPECT_EQ(screen.wishes.new_scene->from, "raymarch");
    EXPECT_FALSE(Screen::window("New scene"));
}

TEST_F(StartPage, NewNeverTakesANameThatIsThere) {
    press("New scene\u2026", "start");
    std::ofstream(folder_ / "new.frag") << "mine";
    frames();
    screen.press(ImGuiKey_Enter);
    frames();
    EXPECT_FALSE(screen.wishes.new_scene);
    EXPECT_TRUE(Screen::window("New scene"));
    screen.press(ImGuiKey_Escape);
    frames();
    EXPECT_FALSE(Screen::window("New scene"));
}

}  // namespace
}  // namespace glint::start_page_test
