// Save, Save as and Revert in the bar; what a typed value that is none becomes; time that panels
// ask for.
#include "base/temporary_folder.h"
#include "screen.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace glint::file_test {
namespace {

class File : public testing::Test {
protected:
    explicit File(ImVec2 size = {1280, 720}) : screen(tweaks(), size) {
        screen.facts.title = "A look";
        screen.facts.file = folder.path() / "look.toml";
        frames();
    }
    static std::vector<Tweak> tweaks() {
        Tweak tweak;
        tweak.name = "waves";
        tweak.min = 0.0;
        tweak.max = 4.0;
        tweak.initial = {1.0};
        return {tweak};
    }
    void frames() {
        for (int i = 0; i < 4; ++i) screen.frame();
    }
    // Whether there is such a thing in this window, which is clicked then.
    bool click(const char* what, const char* in = "bar") {
        const ImGuiWindow* window = Screen::window(in);
        const auto place = window ? screen.find(ImHashStr(what, 0, window->ID), in) : std::nullopt;
        if (place) screen.click(place->GetCenter());
        frames();
        return place.has_value();
    }

    const TemporaryFolder folder;
    Screen screen;
};

TEST_F(File, IsSavedSavedAsAndRevertedInTheBar) {
    EXPECT_TRUE(click("Save"));
    EXPECT_TRUE(screen.wishes.save);
    EXPECT_TRUE(click("Revert"));
    EXPECT_TRUE(screen.wishes.revert);
    EXPECT_TRUE(click("Save as\u2026"));
    EXPECT_TRUE(Screen::window("Save as"));
}

TEST_F(File, IsNotSavedWhereThereIsNothingToDo) {
    screen.facts.why_no_save = screen.facts.why_no_revert = "Nothing has changed.";
    frames();
    click("Save");
    click("Revert");
    EXPECT_FALSE(screen.wishes.save);
    EXPECT_FALSE(screen.wishes.revert);
}

TEST_F(File, SavingASceneAsksForThePresetsName) {
    screen.facts.file = "fragments/sea.frag";
    frames();
    EXPECT_TRUE(click("Save"));
    EXPECT_FALSE(screen.wishes.save);
    EXPECT_TRUE(Screen::window("Save as"));
}

TEST_F(File, TheTimeIsSavedWhereItIsTicked) {
    screen.transport.seek(12.34567);
    click("Save as\u2026");
    screen.press(ImGuiKey_Enter);
    ASSERT_TRUE(screen.wishes.start_time);
    EXPECT_FALSE(screen.wishes.start_time->seconds);
    frames();
    click("Save as\u2026");
    EXPECT_TRUE(click("###time", "Save as"));
    click("Save", "Save as");
    ASSERT_TRUE(screen.wishes.start_time);
    EXPECT_EQ(screen.wishes.start_time->seconds, 12.346);
}

TEST_F(File, ThatWasChangedMeanwhileIsSavedOverOnlyByAClick) {
    screen.facts.question = Question::overwrite;
    frames();
    screen.press(ImGuiKey_Enter);
    EXPECT_FALSE(screen.wishes.answer);
    EXPECT_TRUE(click("Save over it", "question"));
    EXPECT_EQ(screen.wishes.answer, Answer::save);
}

TEST_F(File, AWindowOfLittleWidthHasAMenuInstead) {
    Screen narrow(tweaks(), {640, 400});
    narrow.facts.file = "look.toml";
    narrow.facts.title = "A look with a title that is rather long";
    for (int i = 0; i < 4; ++i) narrow.frame();
    const ImGuiWindow* bar = Screen::window("bar");
    EXPECT_LE(bar->Rect().Max.x, 640.0f);
    const auto menu = narrow.find(ImHashStr("File", 0, bar->ID), "bar");
    ASSERT_TRUE(menu);
    narrow.click(menu->GetCenter());
    for (int i = 0; i < 4; ++i) narrow.frame();
    EXPECT_TRUE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup));
}

class Typed : public File {
protected:
    void type(const char* text) {
        ImGui::GetIO().KeyCtrl = true;
        screen.click(screen.find(screen.in_row(0, "##slider"))->GetCenter());
        ImGui::GetIO().KeyCtrl = false;
        frames();
        screen.type(text);
        screen.press(ImGuiKey_Enter);
        frames();
    }
    float room() const { return Screen::window("Tweaks/body")->ContentSize.y; }
};

TEST_F(Typed, BeyondTheRangeItIsClampedAndToldBelow) {
    const float before = room();
    type("9");
    EXPECT_EQ(screen.tweaks.value(0)[0], 4.0);
    EXPECT_GT(room(), before + 10.0f) << "words stand below the slider";
    screen.wait();
    type("2.5");
    EXPECT_EQ(screen.tweaks.value(0)[0], 2.5);
    EXPECT_EQ(room(), before) << "they are gone";
}

TEST_F(Typed, OfAValueThatWasResetSinceNothingIsSaid) {
    const float before = room();
    type("9");
    ASSERT_GT(room(), before + 10.0f);
    screen.tweaks.reset(0);
    screen.wait();
    EXPECT_EQ(room(), before);
}

TEST_F(Typed, WhatIsNoNumberChangesNothingAndIsTold) {
    const float before = room();
    type("much");
    EXPECT_EQ(screen.tweaks.value(0)[0], 1.0);
    EXPECT_GT(room(), before + 10.0f);
}

TEST(Time, IsAskedForByThePanelsAndMovedByItsOwnerAlone) {
    Screen screen({});
    const Transport before = screen.transport;
    ImGui::NewFrame();
    Wishes wishes =
        screen.interface.build(screen.facts, screen.tweaks, screen.transport, screen.settings);
    ImGui::Render();
    EXPECT_TRUE(wishes.time.empty());
    const ImGuiWindow* bar = Screen::window("transport");
    const auto play = screen.find(ImHashStr("play", 0, bar->ID), "transport");
    ASSERT_TRUE(play);
    EXPECT_EQ(screen.transport.playing(), before.playing());
    screen.click(play->GetCenter());
    EXPECT_TRUE(screen.transport.playing());
}

TEST(Browser, ToldWhatIsInView) {
    std::vector<BrowserEntry> entries;
    for (int i = 0; i < 40; ++i)
        entries.push_back({std::to_string(i) + (i % 2 ? ".toml" : ".frag"), "x", "All", 0, {}});
    Screen screen({});
    screen.facts.browser = entries;
    screen.settings.browser = true;
    for (int i = 0; i < 4; ++i) screen.frame();
    const Wishes wishes = screen.frame();
    ASSERT_FALSE(wishes.seen.empty());
    EXPECT_EQ(wishes.seen.front(), "0.frag");
    EXPECT_LT(wishes.seen.size(), 30u);
}

}  // namespace
}  // namespace glint::file_test
