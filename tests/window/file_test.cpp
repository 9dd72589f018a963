// The first minute with a preset: saving, saving as, reverting, locks, and who has the keyboard.
#include "live.h"

#include <chrono>
#include <csignal>
#include <regex>
#include <string>
#include <thread>

namespace glint::window::file_test {
namespace {

constexpr glm::ivec2 kMargin{3, 300};

constexpr const char* kLook = R"(# mine
scene = "scene.frag"
title = "Dusk"   # as I like it
[tweaks]
level = 0.2      # not too much
)";

class File : public Window {
protected:
    // Two tweaks are red and green of the picture; blue counts frames.
    void open_look(std::string_view text = kLook) {
        write(scene(),
              "uniform float level; //@ 0 [0, 1]\n"
              "uniform float other; //@ 0.2 [0, 1]\n"
              "void mainImage(out vec4 c, in vec2 p) {\n"
              "    c = vec4(level, other, float(min(iFrame, 60)) / 60.0, 1);\n}\n");
        write(look(), text);
        start({look().string()});
        ASSERT_TRUE(glint_->says(": shown")) << glint_->errors();
        ASSERT_TRUE(eventually([&] { return pixel() == Colour(51, 51, 255); }));
    }
    fs::path look() const { return folder_->path() / "look.toml"; }
    Colour pixel() const { return screen_->pixel(kMargin); }
    bool becomes_unsaved(bool unsaved) const {
        return eventually([&] { return screen_->title().ends_with(" * - Glint") == unsaved; });
    }
    // The first key opens a dialog; then key by key, each when what the one before has brought is
    // there.
    void answer(const std::vector<std::string>& keys) {
        screen_->tap(keys.front());
        EXPECT_TRUE(eventually([&] { return pixel().b < 255; })) << "a dialog dims the picture";
        for (std::size_t i = 1; i < keys.size(); ++i) {
            settle();
            screen_->tap(keys[i]);
        }
    }
    Colour change() {
        screen_->tap("Control_L+g");
        // By chance one of both may stay as it was, in one of 256 times.
        EXPECT_TRUE(eventually([&] { return pixel() != Colour(51, 51, 255); }));
        EXPECT_TRUE(becomes_unsaved(true));
        return pixel();
    }
};

TEST_F(File, IsSavedWithItsCommentsAndWithoutTheTimeAndRevertedUndoably) {
    open_look();
    const Colour changed = change();
    screen_->tap("Control_L+Shift_L+r");
    EXPECT_TRUE(becomes_unsaved(false));
    EXPECT_TRUE(eventually([&] { return pixel() == Colour(51, 51, 255); }));
    EXPECT_EQ(read(look()), kLook);
    screen_->tap("Control_L+z");
    EXPECT_TRUE(eventually([&] { return pixel() == changed; }));
    EXPECT_TRUE(becomes_unsaved(true));
    screen_->tap("Control_L+s");
    EXPECT_TRUE(becomes_unsaved(false));
    const std::string saved = read(look());
    EXPECT_TRUE(saved.starts_with("# mine\n")) << saved;
    EXPECT_NE(saved.find("# not too much\n"), std::string::npos) << saved;
    EXPECT_NE(saved.find("other = 0."), std::string::npos) << saved;
    EXPECT_EQ(saved.find("time"), std::string::npos) << saved;
}

// As while a frame takes long: what a person does meanwhile arrives all at once.
TEST_F(File, KeysCountInTheirOrderHoweverLongAFrameTakes) {
    open_look();
    change();
    const auto at_once = [&](const std::vector<std::string>& keys) {
        ::kill(glint_->id(), SIGSTOP);
        for (const std::string& key : keys) {
            screen_->tap(key);
            // GLFW takes a key that comes again within 20 ms for the keyboard's repetition.
            std::this_thread::sleep_for(std::chrono::milliseconds(30));
        }
        ::kill(glint_->id(), SIGCONT);
    };
    at_once({"Control_L+q", "Right", "Right", "Right", "Return"});  // to Save, Discard, Cancel
    settle();
    at_once({"Control_L+Shift_L+s", "End", "BackSpace", "BackSpace", "BackSpace", "BackSpace",
             "BackSpace", "BackSpace", "b", "BackSpace", "a", "Return"});
    EXPECT_TRUE(eventually([&] { return fs::exists(folder_->path() / "look-a.toml"); }));
    EXPECT_EQ(read(look()), kLook);
}

TEST_F(File, TheTimeIsWrittenWhereAPersonAsksForItAndRounded) {
    open_look();
    screen_->tap("Control_L+space");  // or nothing would come to rest
    const fs::path copy = folder_->path() / "look-2.toml";
    answer({"Control_L+Shift_L+s", "Down", "space", "Down", "Return"});
    ASSERT_TRUE(eventually([&] { return fs::exists(copy); })) << glint_->errors();
    const std::string saved = read(copy);
    EXPECT_TRUE(std::regex_search(saved, std::regex("\ntime = [0-9]+(\\.[0-9]{1,3})?\n"))) << saved;
    EXPECT_EQ(read(look()), kLook);
}

TEST_F(File, SaveAsGoesOnWithUndoLocksAndTheFrame) {
    open_look(std::string("locked = [\"level\"]\n") + kLook);
    const Colour changed = change();
    EXPECT_EQ(changed.r, 51) << "it is locked";
    screen_->tap("Control_L+Shift_L+s");
    const fs::path copy = folder_->path() / "look-2.toml";
    ASSERT_TRUE(eventually([&] {
        screen_->tap("Return");
        return eventually([&] { return fs::exists(copy); }, 0.2);
    }));
    EXPECT_TRUE(becomes_unsaved(false));
    EXPECT_NE(read(copy).find("locked = [\"level\"]"), std::string::npos) << read(copy);
    ASSERT_TRUE(glint_->says(": shown", 2)) << glint_->errors();
    EXPECT_EQ(pixel(), changed) << "frames are counted on";
    screen_->tap("Control_L+z");
    EXPECT_TRUE(eventually([&] { return pixel() == Colour(51, 51, 255); }));
    EXPECT_TRUE(becomes_unsaved(true));
    screen_->tap("Control_L+g");
    EXPECT_TRUE(eventually([&] { return pixel().g != 51; }));
    EXPECT_EQ(pixel().r, 51) << "locked as before";
    screen_->tap("Control_L+s");
    EXPECT_TRUE(becomes_unsaved(false));
    EXPECT_EQ(read(look()), std::string("locked = [\"level\"]\n") + kLook) << "the first stays";
}

TEST_F(File, SaveAsGoesOnAlsoWhileTheTextHasAnError) {
    open_look();
    const std::string text = read(scene());
    write(scene(), "x" + text);
    ASSERT_TRUE(glint_->says(": not shown")) << glint_->errors();
    const fs::path copy = folder_->path() / "look-2.toml";
    screen_->tap("Control_L+Shift_L+s");
    ASSERT_TRUE(eventually([&] {
        screen_->tap("Return");
        return eventually([&] { return fs::exists(copy); }, 0.2);
    }));
    EXPECT_TRUE(becomes_unsaved(false));
    const Colour changed = change();
    write(scene(), text + "\n");
    ASSERT_TRUE(eventually([&] { return glint_->count(": shown") >= 2; })) << glint_->errors();
    EXPECT_TRUE(eventually([&] { return pixel() == changed; }));
    EXPECT_TRUE(becomes_unsaved(true));
    screen_->tap("Control_L+s");
    EXPECT_TRUE(becomes_unsaved(false));
    EXPECT_NE(read(copy).find("other = "), std::string::npos) << read(copy);
    EXPECT_EQ(read(look()), kLook);
}

TEST_F(File, OfAnotherSceneIsReplacedByACopyOfWhatIsOpen) {
    const fs::path other = folder_->path() / "look-2.toml";
    open_look();
    screen_->tap("Control_L+space");
    settle();
    screen_->tap("Control_L+Shift_L+s");
    settle();
    write(other, "scene = \"other.frag\"\ntitle = \"Theirs\"\n[tweaks]\nfog = 0.7  # theirs\n");
    screen_->tap("Return");
    EXPECT_TRUE(eventually([&] { return read(other).starts_with("# mine\n"); })) << read(other);
    EXPECT_EQ(read(other).find("fog"), std::string::npos) << read(other);
    EXPECT_EQ(glint_->count("warning"), 0) << glint_->errors();
}

TEST_F(File, ThatWasChangedMeanwhileIsNotSavedOverUnasked) {
    open_look();
    change();
    const std::string theirs = std::string(kLook) + "other = 0.9\n";
    glint_->signal(SIGSTOP);
    write(look(), theirs);
    screen_->tap("Control_L+s");
    glint_->signal(SIGCONT);
    EXPECT_TRUE(eventually([&] { return pixel().b < 255; })) << "the question dims the picture";
    EXPECT_EQ(read(look()), theirs);
    screen_->tap("Escape");
    EXPECT_TRUE(eventually([&] { return pixel().b == 255; }));
    EXPECT_EQ(read(look()), theirs);
    EXPECT_TRUE(eventually([&] { return pixel().g == 230; })) << "it is read, and stands here";
}

TEST_F(File, AQuestionIsAnsweredByTheArrowKeysAndReturn) {
    open_look();
    change();
    screen_->tap("Control_L+space");             // or nothing would come to rest
    answer({"Control_L+q", "Right", "Return"});  // discard, not save, which Return is else
    EXPECT_EQ(glint_->wait().code, 0);
    EXPECT_EQ(read(look()), kLook);
}

TEST_F(File, ChanceLeavesAloneWhatSaysNorandomTheCameraAndQuality) {
    open(
        "uniform float free; //@ 0.2 [0, 1]\n"
        "uniform float same; //@ 0.2 [0, 1] norandom\n"
        "uniform float eye; //@ 0.2 [0, 1] group=Camera\n"
        "uniform int steps; //@ 3 [1, 9] quality\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    c = vec4(free, same, 0.5 * eye + 0.05 * float(steps), 1);\n}\n");
    const Colour before = pixel();
    ASSERT_EQ(before.g, 51);
    for (int i = 0; i < 3; ++i) {
        const int red = pixel().r;
        screen_->tap("Control_L+g");
        ASSERT_TRUE(eventually([&] { return pixel().r != red; }));
        EXPECT_EQ(pixel(), Colour(pixel().r, before.g, before.b));
    }
}

// The row of its first tweak, in a window of 1280x720.
TEST_F(File, ATypedValueIsClampedAndResetsGoToThePresetsThenToTheTexts) {
    open_look();
    screen_->tap("Control_L+space");
    settle();
    screen_->key("Control_L", true);
    screen_->click({1120, 89});
    screen_->key("Control_L", false);  // before the next frame
    settle();
    screen_->type("9");
    screen_->tap("Return");
    EXPECT_TRUE(eventually([&] { return pixel().r == 255; })) << pixel();
    EXPECT_TRUE(becomes_unsaved(true));
    for (const int red : {51, 0}) {
        settle();
        screen_->click({960, 89});
        screen_->click({960, 89});
        EXPECT_TRUE(eventually([&] { return pixel().r == red; })) << pixel();
    }
}

// What stands in the field counts, whatever is asked for next.
TEST_F(File, AValueThatIsBeingTypedIsSaved) {
    open_look();
    screen_->tap("Control_L+space");
    settle();
    screen_->key("Control_L", true);
    screen_->click({1120, 89});
    screen_->key("Control_L", false);
    settle();
    screen_->type("1");
    screen_->tap("Control_L+s");
    EXPECT_TRUE(eventually([&] { return pixel().r == 255; })) << pixel();
    EXPECT_TRUE(eventually([&] { return read(look()) != kLook; }));
    EXPECT_TRUE(becomes_unsaved(false));
}

TEST_F(File, AColourOfTooFewDigitsIsNone) {
    open(
        "uniform vec3 tint; //@ #336699\n"
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(tint, 1); }\n");
    const Colour before{51, 102, 153};
    ASSERT_TRUE(eventually([&] { return pixel() == before; })) << pixel();
    screen_->tap("Control_L+space");
    settle();
    screen_->click({1160, 89});
    screen_->tap("Control_L+a");
    screen_->type("12");
    screen_->tap("Return");
    settle();
    EXPECT_EQ(pixel(), before);
    screen_->click({1160, 89});
    screen_->tap("Control_L+a");
    screen_->type("102030");
    screen_->tap("Return");
    EXPECT_TRUE(eventually([&] { return pixel() == Colour{16, 32, 48}; })) << pixel();
}

// F6 among letters goes on to the next panel, whose arrows the scene does not see.
TEST_F(File, F6LeavesAFieldOfText) {
    open(
        "uniform float level; //@ 0.2 [0, 1]\n"
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(level, 0, 0, 1); }\n");
    screen_->tap("Control_L+space");
    screen_->tap("Control_L+f");
    settle();
    screen_->type("level");
    screen_->tap("F6");
    settle();
    screen_->tap("F6");
    settle();
    screen_->type("x");  // into no field: the row stays
    screen_->tap("Control_L+f");
    settle();
    screen_->tap("Return");
    settle();
    screen_->tap("space");
    settle();
    screen_->tap("Right");
    EXPECT_TRUE(eventually([&] { return pixel().r > 51; })) << pixel();
}

TEST_F(File, ThePanelsHaveTheKeysFromF6OrCtrlFToEsc) {
    open(
        "uniform sampler2D keys; //@ keyboard\n"
        "uniform float level; //@ 0.2 [0, 1]\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    c = vec4(texelFetch(keys, ivec2(39, 0), 0).r, level, 0, 1);\n}\n");
    const auto reaches_the_scene = [&] {
        screen_->key("Right", true);
        const bool is_red = eventually([&] { return pixel().r == 255; }, 0.5);
        screen_->key("Right", false);
        EXPECT_TRUE(eventually([&] { return pixel().r == 0; }));
        return is_red;
    };
    screen_->tap("Control_L+space");  // or the clock in the bar would never settle
    EXPECT_TRUE(eventually(reaches_the_scene));
    for (const char* chord : {"F6", "Control_L+f"}) {
        SCOPED_TRACE(chord);
        screen_->tap(chord);
        EXPECT_FALSE(reaches_the_scene());
        screen_->tap("Escape");
        settle();
        EXPECT_TRUE(eventually(reaches_the_scene));
    }
    screen_->tap("Control_L+f");
    settle();
    screen_->tap("Return");  // on the first slider
    settle();
    screen_->tap("space");
    settle();
    screen_->tap("Right");
    EXPECT_TRUE(eventually([&] { return pixel().g > 51; }));
    EXPECT_EQ(pixel().r, 0);
}

}  // namespace
}  // namespace glint::window::file_test
