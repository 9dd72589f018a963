// What stands over all panels until it is answered, and what is told where they are hidden.
#include "base/temporary_folder.h"
#include "screen.h"

#include <gtest/gtest.h>

namespace glint::dialogs_test {
namespace {

class Dialogs : public ::testing::Test {
protected:
    void ask(Question question, const char* file = "look.toml") {
        screen.settings.visible = false;  // they stand there, panels or not
        screen.facts.file = folder.path() / file;
        screen.facts.question = question;
        for (int i = 0; i < 4; ++i) screen.frame();
    }
    // Presses the button of the dialog whose text is this.
    void press(const char* button) {
        const ImGuiWindow* dialog = Screen::window("question");
        ASSERT_TRUE(dialog);
        const auto place = screen.find(ImHashStr(button, 0, dialog->ID), "question");
        ASSERT_TRUE(place) << button;
        screen.click(place->GetCenter());
    }
    std::optional<Answer> answer() const { return screen.wishes.answer; }

    const TemporaryFolder folder;
    Screen screen{{}};
};

TEST_F(Dialogs, WhatIsNotSavedIsSavedDiscardedOrStays) {
    const std::pair<const char*, Answer> kButtons[] = {
        {"Save", Answer::save}, {"Discard", Answer::discard}, {"Cancel", Answer::cancel}};
    for (const auto& [button, meaning] : kButtons) {
        SCOPED_TRACE(button);
        screen.wishes = {};
        ask(Question::leave);
        press(button);
        EXPECT_EQ(answer(), meaning);
        ask(Question::none);
        EXPECT_FALSE(Screen::window("question"));
    }
}

TEST_F(Dialogs, EnterSavesAndEscStays) {
    ask(Question::leave);
    screen.press(ImGuiKey_Enter);
    EXPECT_EQ(answer(), Answer::save);
    ask(Question::none);
    ask(Question::leave);
    screen.press(ImGuiKey_Escape);
    EXPECT_EQ(answer(), Answer::cancel);
}

TEST_F(Dialogs, ASceneWithoutAPresetIsAskedForAPathAndCancellingAsksAgain) {
    ask(Question::leave, "scene.frag");
    screen.press(ImGuiKey_Enter);
    for (int i = 0; i < 3; ++i) screen.frame();
    EXPECT_FALSE(answer());
    EXPECT_TRUE(Screen::window("Save as"));
    EXPECT_FALSE(Screen::window("question"));
    screen.press(ImGuiKey_Escape);
    for (int i = 0; i < 3; ++i) screen.frame();
    EXPECT_FALSE(Screen::window("Save as"));
    EXPECT_TRUE(Screen::window("question"));
    EXPECT_FALSE(answer());
    screen.press(ImGuiKey_Enter);
    for (int i = 0; i < 3; ++i) screen.frame();
    screen.press(ImGuiKey_Enter);
    ASSERT_TRUE(screen.wishes.save_as);
    EXPECT_EQ(screen.wishes.save_as->filename(), "scene.toml");
}

TEST_F(Dialogs, TheProposedNameIsSelectedEachTimeAndOnlyAFolderThatIsThereTaken) {
    for (const std::string name : {"first.toml", "second.toml"}) {
        screen.facts.file = folder.path() / "look.toml";
        screen.settings.save_as = true;
        for (int i = 0; i < 4; ++i) screen.frame();
        screen.type((folder.path() / "missing" / name).c_str());
        screen.press(ImGuiKey_Enter);
        for (int i = 0; i < 3; ++i) screen.frame();
        EXPECT_FALSE(screen.wishes.save_as);
        ASSERT_TRUE(Screen::window("Save as")) << "what was typed is not lost";
        screen.press(ImGuiKey_Escape);
        for (int i = 0; i < 3; ++i) screen.frame();
        screen.settings.save_as = true;
        for (int i = 0; i < 4; ++i) screen.frame();
        screen.type((folder.path() / name).c_str());
        screen.press(ImGuiKey_Enter);
        ASSERT_TRUE(screen.wishes.save_as);
        EXPECT_EQ(*screen.wishes.save_as, folder.path() / name);
        screen.wishes = {};
        for (int i = 0; i < 3; ++i) screen.frame();
    }
}

TEST_F(Dialogs, WorkOfTheLastRunIsRestoredOrDiscarded) {
    ask(Question::restore);
    screen.press(ImGuiKey_Escape);  // decides nothing
    EXPECT_FALSE(answer());
    press("Restore");
    EXPECT_EQ(answer(), Answer::restore);
    ask(Question::none);
    ask(Question::restore);
    press("Discard");
    EXPECT_EQ(answer(), Answer::discard);
}

TEST_F(Dialogs, StandInAnySize) {
    for (const ImVec2 size : {ImVec2{0, 0}, {1, 1}, {40, 30}, {200, 2000}, {2000, 60}}) {
        ImGui::GetIO().DisplaySize = size;
        for (const Question question : {Question::leave, Question::none, Question::restore})
            ask(question);
        screen.settings.save_as = true;
        for (int i = 0; i < 4; ++i) screen.frame();
    }
}

TEST(Hidden, AnErrorIsOneLineWhereThePanelsAreHidden) {
    Screen screen({});
    const Diagnostics diagnostics{{Severity::error, {"a.frag", 3, 1}, std::string(3000, 'x')}};
    const auto drawn = [&] {
        screen.frame();
        return ImGui::GetForegroundDrawList()->VtxBuffer.Size > 0;
    };
    screen.settings.visible = false;
    EXPECT_FALSE(drawn());
    screen.facts.diagnostics = diagnostics;
    EXPECT_TRUE(drawn());
    const ImDrawList& list = *ImGui::GetForegroundDrawList();
    float bottom = 0.0f, right = 0.0f;
    bool is_red = false;
    for (const ImDrawVert& vertex : list.VtxBuffer) {
        bottom = std::max(bottom, vertex.pos.y);
        right = std::max(right, vertex.pos.x);
        is_red = is_red || vertex.col == colours::kError;
    }
    EXPECT_TRUE(is_red);
    EXPECT_LT(bottom, 3.0f * ImGui::GetTextLineHeight());
    EXPECT_LE(right, ImGui::GetIO().DisplaySize.x);
    screen.settings.visible = true;
    EXPECT_FALSE(drawn()) << "the panels tell it themselves";
}

TEST(Notice, IsReadWholeInANarrowWindow) {
    Screen screen({}, {320, 180});
    std::string words;
    for (int i = 0; i < 20; ++i) words += "some word ";
    screen.facts.notice = words;
    for (int i = 0; i < 4; ++i) screen.frame();
    const ImGuiWindow* notice = Screen::window("notice");
    ASSERT_TRUE(notice);
    EXPECT_GE(notice->Pos.x, 0.0f);
    EXPECT_LE(notice->Rect().Max.x, 320.0f);
    EXPECT_GT(notice->Size.y, 3.0f * ImGui::GetTextLineHeight());
}

TEST(Bar, TellsOnHoveringTheTitleThatItIsNotSaved) {
    Screen screen({});
    screen.facts.title = "A look";
    screen.facts.file = "look.toml";
    screen.facts.unsaved = true;
    for (int i = 0; i < 3; ++i) screen.frame();
    const ImGuiWindow* bar = Screen::window("bar");
    ASSERT_TRUE(bar);
    screen.move({bar->Pos.x + 20, bar->Pos.y + 0.5f * bar->Size.y});
    EXPECT_FALSE(Screen::window("##Tooltip"));
    EXPECT_TRUE(screen.interface.is_moving()) << "frames are wanted until it is there";
    for (int i = 0; i < 30; ++i) screen.frame();
    EXPECT_TRUE(Screen::window("##Tooltip"));
}

TEST(Bar, SaysThatTheAspectIsFreeAndGoesBackByAClick) {
    Screen screen({});
    screen.facts.frame_size = {640, 360};
    const auto width = [&] {
        for (int i = 0; i < 4; ++i) screen.frame();
        return Screen::window("bar")->Size.x;
    };
    const float kept = width();
    screen.settings.free_aspect = true;
    EXPECT_GT(width(), kept + 40.0f);
    const ImGuiWindow* bar = Screen::window("bar");
    screen.click({bar->Pos.x + bar->Size.x - 30, bar->Pos.y + 0.5f * bar->Size.y});
    EXPECT_FALSE(screen.settings.free_aspect);
    EXPECT_EQ(width(), kept);
}

TEST(Popups, AreClosedByEsc) {
    Screen screen({});
    const ImGuiWindow* bar = Screen::window("bar");
    ASSERT_TRUE(bar);
    const auto button = screen.find(ImHashStr("screen", 0, bar->ID), "bar");
    ASSERT_TRUE(button);
    screen.click(button->GetCenter());
    for (int i = 0; i < 3; ++i) screen.frame();
    EXPECT_TRUE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup));
    screen.press(ImGuiKey_Escape);
    EXPECT_FALSE(ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopup));
}

}  // namespace
}  // namespace glint::dialogs_test
