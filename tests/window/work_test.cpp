// Work that is not saved is lost by no way out: by none without a question, and by no crash.
#include "live.h"

#include <csignal>
#include <functional>
#include <thread>
#include <tuple>
#include <utility>

using namespace std::chrono_literals;

namespace glint::window::work_test {
namespace {

constexpr glm::ivec2 kMargin{3, 300};
constexpr glm::ivec2 kSetA{1180, 61}, kSetB{1203, 61};  // of the tweaks panel

class Work : public Window {
protected:
    // A preset whose tweak is the picture's red.
    void open_look(const std::vector<std::string>& more = {},
                   const std::string& blue = "fract(iTime * 0.7)") {
        write(scene(),
              "uniform float level; //@ 0 [0, 1]\n"
              "void mainImage(out vec4 c, in vec2 p) {\n"
              "    c = vec4(level, 0.2, " +
                  blue + ", 1);\n}\n");
        if (!fs::exists(look())) write(look(), "scene = \"scene.frag\"\n[tweaks]\nlevel = 0.2\n");
        fs::remove(folder_->path() / "stderr.txt");
        std::vector<std::string> all = {look().string()};
        all.insert(all.end(), more.begin(), more.end());
        start(all);
        ASSERT_TRUE(glint_->says(": shown")) << glint_->errors();
    }
    fs::path look() const { return folder_->path() / "look.toml"; }
    int red() const { return screen_->pixel(kMargin).r; }
    bool becomes_unsaved(bool unsaved) const {
        return eventually([&] { return screen_->title().ends_with(" * - Glint") == unsaved; });
    }
    // Moves the tweak; returns what red it has then.
    int change() {
        EXPECT_TRUE(eventually([&] { return red() == 51; })) << red();
        // By chance it may be what it is already.
        EXPECT_TRUE(eventually([&] {
            screen_->tap("Control_L+g");
            return eventually([&] { return red() != 51; }, 2.0);
        }));
        EXPECT_TRUE(becomes_unsaved(true));
        return red();
    }
    // In the sets A and B, to other values; returns what red they have.
    std::pair<int, int> change_both() {
        const int first = change();
        screen_->click(kSetB);
        int second = change();
        while (second == first) {  // by chance
            screen_->tap("Control_L+g");
            settle();
            second = red();
        }
        EXPECT_TRUE(eventually([&] { return levels_in(kept()) == 2; })) << kept();
        return {first, second};
    }
    static long levels_in(const std::string& presets) {
        long count = 0;
        for (std::size_t at = 0; (at = presets.find("level = ", at)) != presets.npos; ++at) ++count;
        return count;
    }
    // The dialogs dim the picture.
    bool asks() const {
        return eventually([&] { return screen_->pixel(kMargin).g < 45; });
    }
    bool asks_no_more() const {
        return eventually([&] { return screen_->pixel(kMargin).g == 51; });
    }
    // Dialogs take some frames to hear of keys.
    bool enter_until(const std::function<bool()>& is_true) const {
        return eventually([&] {
            screen_->tap("Return");
            return eventually(is_true, 0.2);
        });
    }
    std::string kept() const {
        std::string all;
        const fs::path state = folder_->path() / "home/.local/state/glint/unsaved";
        std::error_code error;
        for (const auto& entry : fs::recursive_directory_iterator(state, error)) {
            if (entry.path().filename() == "work.toml") all += read(entry.path());
        }
        return all;
    }
};

// The scene's buffer, offered for its empty channel, in a window of 1280x720.
constexpr glm::ivec2 kOfferedBuffer{313, 641};

TEST_F(Work, AClickFillsAnEmptyChannelAndACrashKeepsIt) {
    write(scene(),
          "uniform sampler2D trail; //@ pass mainTrail\n"
          "void mainTrail(out vec4 c, in vec2 p) { c = vec4(0.4); }\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = vec4(texture(iChannel0, p / iResolution.xy).r, 0.2, 0.3, 1);\n}\n");
    write(look(), "scene = \"scene.frag\"\n");
    start({look().string()});
    ASSERT_TRUE(glint_->says(":4:22: warning: nothing fills iChannel0")) << glint_->errors();
    EXPECT_TRUE(eventually([&] { return red() == 0; }));
    settle();
    screen_->click(kOfferedBuffer);
    EXPECT_TRUE(eventually([&] { return red() == 102; })) << red();
    EXPECT_TRUE(becomes_unsaved(true));
    EXPECT_TRUE(eventually([&] { return kept().find("trail") != std::string::npos; })) << kept();
    glint_->signal(SIGKILL);
    glint_->wait();
    start({look().string()});
    EXPECT_TRUE(enter_until([&] { return red() == 102; })) << red();
    screen_->tap("Control_L+s");
    EXPECT_TRUE(becomes_unsaved(false));
    EXPECT_NE(read(look()).find("iChannel0 = { buffer = \"trail\" }"), std::string::npos)
        << read(look());
    EXPECT_EQ(red(), 102);
}

TEST_F(Work, EveryWayOutAsksFirst) {
    open_look();
    change();
    const fs::path other = folder_->path() / "other.frag";
    write(other, flat({90, 80, 70}));
    screen_->tap("Tab");  // the question stands there with and without panels
    const std::function<void()> kWays[] = {[&] { screen_->tap("Control_L+q"); },
                                           [&] { screen_->close_window(); },
                                           [&] { EXPECT_TRUE(screen_->drop(other)); }};
    for (const auto& way : kWays) {
        way();
        EXPECT_TRUE(asks());
        screen_->tap("Escape");
        EXPECT_TRUE(asks_no_more());
        EXPECT_TRUE(glint_->runs());
    }
    const std::string before = read(look());
    screen_->close_window();
    EXPECT_TRUE(asks());
    screen_->tap("Return");
    EXPECT_EQ(glint_->wait().code, 0);
    EXPECT_NE(read(look()), before) << "Enter saves";
    EXPECT_EQ(kept(), "");
}

TEST_F(Work, ANewSceneIsWrittenOnceNothingIsInTheWay) {
    open_look();
    change();
    screen_->tap("Control_L+o");
    settle();
    screen_->click({48, 99});  // New…
    // A field's cursor blinks for ever, and nothing ever settles.
    const auto take_frames = [] { eventually([] { return false; }, 0.3); };
    EXPECT_TRUE(asks());  // what the new scene is called
    take_frames();
    screen_->tap("Return");  // and then what becomes of the change
    take_frames();
    screen_->tap("Escape");
    EXPECT_TRUE(asks_no_more());
    EXPECT_FALSE(fs::exists(folder_->path() / "new.frag"));
    EXPECT_TRUE(becomes_unsaved(true));
}

TEST_F(Work, WhatACrashInterruptsIsOfferedAtTheNextStart) {
    open_look();
    const int changed = change();
    ASSERT_TRUE(eventually([&] { return !kept().empty(); }));
    glint_->signal(SIGKILL);
    glint_->wait();
    open_look();
    EXPECT_TRUE(asks());
    screen_->tap("Control_L+q");  // without an answer
    EXPECT_TRUE(eventually([&] { return !glint_->runs(); }));
    open_look();
    EXPECT_TRUE(asks());
    screen_->tap("Return");
    EXPECT_TRUE(asks_no_more());
    EXPECT_TRUE(eventually([&] { return red() == changed; })) << red();
    EXPECT_TRUE(becomes_unsaved(true));
    EXPECT_NE(kept(), "");
    screen_->tap("Control_L+s");
    EXPECT_TRUE(becomes_unsaved(false));
    EXPECT_TRUE(eventually([&] { return kept().empty(); })) << kept();
}

TEST_F(Work, IsRestoredOverWhatTheFileSaysByThen) {
    write(scene(),
          "uniform float level; //@ 0 [0, 1]\nuniform float other; //@ 0.2 [0, 1]\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(level, other, 0.5, 1); }\n");
    const std::string says =
        "scene = \"scene.frag\"\nlocked = [\"other\"]\n[tweaks]\nlevel = 0.2\n";
    write(look(), says);
    start({look().string()});
    ASSERT_TRUE(glint_->says(": shown")) << glint_->errors();
    const int changed = change();
    ASSERT_TRUE(eventually([&] { return !kept().empty(); }));
    glint_->signal(SIGKILL);
    glint_->wait();
    write(look(), says + "other = 0.6\n");
    fs::remove(folder_->path() / "stderr.txt");
    start({look().string()});
    ASSERT_TRUE(glint_->says(": shown")) << glint_->errors();
    EXPECT_TRUE(enter_until([&] { return red() == changed; })) << red();
    EXPECT_TRUE(eventually([&] { return screen_->pixel(kMargin).g == 153; }));
    screen_->tap("Control_L+s");
    EXPECT_TRUE(becomes_unsaved(false));
    EXPECT_NE(read(look()).find("other = 0.6\n"), std::string::npos) << read(look());
}

TEST_F(Work, ASignalToEndIsNoCrashAndLosesNothing) {
    for (const int signal : {SIGTERM, SIGINT, SIGHUP}) {
        SCOPED_TRACE(signal);
        open_look();
        change();
        glint_->signal(signal);
        glint_->signal(signal);  // a terminal that is closed tells of it twice
        EXPECT_EQ(glint_->wait().signal, signal);
        EXPECT_NE(kept(), "");
        EXPECT_EQ(glint_->count("error"), 0) << glint_->errors();
        const fs::path marks = folder_->path() / "home/.local/state/glint/open";
        EXPECT_TRUE(fs::is_empty(marks)) << "the next start is not paused";
        fs::remove_all(folder_->path() / "home/.local/state/glint/unsaved");
    }
}

// As by another window of the same file, or by an editor.
TEST_F(Work, ThatTheFileOverrulesIsOfferedAtTheNextStart) {
    open_look();
    const int changed = change();
    ASSERT_TRUE(eventually([&] { return !kept().empty(); }));
    const int another = changed == 153 ? 102 : 153;  // by chance it is that one
    write(look(), "scene = \"scene.frag\"\n[tweaks]\nlevel = " + std::to_string(another / 255.0));
    EXPECT_TRUE(eventually([&] { return red() == another; })) << red();
    screen_->tap("Control_L+q");
    EXPECT_EQ(glint_->wait().code, 0);
    EXPECT_NE(kept(), "");
    open_look({}, "0.5");
    EXPECT_TRUE(asks());
    screen_->tap("Return");
    EXPECT_TRUE(eventually([&] { return red() == changed; })) << red();
}

TEST_F(Work, ThatTheFileOverrulesIsNoneOnceAnythingWasSaved) {
    open_look();
    const int changed = change();
    ASSERT_TRUE(eventually([&] { return !kept().empty(); }));
    const int another = changed == 153 ? 102 : 153;
    write(look(), "scene = \"scene.frag\"\n[tweaks]\nlevel = " + std::to_string(another / 255.0));
    EXPECT_TRUE(eventually([&] { return red() == another; })) << red();
    screen_->tap("Control_L+z");
    EXPECT_TRUE(eventually([&] { return red() == changed; })) << red();
    screen_->tap("Control_L+s");
    EXPECT_TRUE(becomes_unsaved(false));
    EXPECT_TRUE(eventually([&] { return kept().empty(); })) << kept();
}

TEST_F(Work, IsRestoredIntoATextThatHasOtherTweaksByThen) {
    open_look();
    const int changed = change();
    ASSERT_TRUE(eventually([&] { return !kept().empty(); }));
    glint_->signal(SIGKILL);
    glint_->wait();
    open_look();
    EXPECT_TRUE(asks());
    write(scene(), "uniform vec3 first; //@ #102030\n" + read(scene()));
    ASSERT_TRUE(glint_->says("scene.frag: shown"));
    screen_->tap("Return");
    EXPECT_TRUE(asks_no_more());
    EXPECT_TRUE(eventually([&] { return red() == changed; })) << red();
}

TEST_F(Work, StaysForLaterWhereTheTextHasNoTweakForIt) {
    open_look();
    change();
    ASSERT_TRUE(eventually([&] { return !kept().empty(); }));
    glint_->signal(SIGKILL);
    glint_->wait();
    const std::string text = read(scene()), work = kept();
    write(scene(), flat({51, 51, 51}));
    start({look().string()});
    ASSERT_TRUE(glint_->says("look.toml: shown", 2)) << glint_->errors();
    screen_->close_window();
    EXPECT_EQ(glint_->wait().code, 0);
    EXPECT_EQ(kept(), work);
    open_look();
    EXPECT_TRUE(asks());
}

// As a person deletes a folder, or an archive's temporary folder goes.
// Its tweak may come back in the next run.
TEST_F(Work, OfATweakThatHasGoneOutOfTheTextWaitsForTheNextRun) {
    open_look();
    const int moved = change();
    const std::string with = read(scene());
    write(scene(), flat({179, 51, 77}));
    EXPECT_TRUE(eventually([&] { return red() == 179; })) << red();
    EXPECT_TRUE(eventually([&] { return kept().find("level") != std::string::npos; })) << kept();
    screen_->tap("Control_L+q");
    glint_->wait();
    EXPECT_NE(kept().find("level"), std::string::npos) << kept();
    write(scene(), with);
    start({look().string()});
    EXPECT_TRUE(enter_until([&] { return red() == moved; })) << red();
}

TEST_F(Work, OfATweakThatHasComeBackIsAskedFor) {
    open_look();
    const int moved = change();
    const std::string with = read(scene());
    write(scene(), flat({179, 51, 77}));
    EXPECT_TRUE(eventually([&] { return red() == 179; })) << red();
    write(scene(), with);
    EXPECT_TRUE(eventually([&] { return red() == moved; })) << red();
    screen_->tap("Control_L+q");
    EXPECT_TRUE(asks());
    EXPECT_TRUE(glint_->runs());
}

TEST_F(Work, IsSavedWhereItsFileHasBeenDeleted) {
    open_look();
    change();
    fs::remove(look());
    EXPECT_TRUE(glint_->says(": not shown, 1 error")) << glint_->errors();
    screen_->tap("Control_L+s");
    EXPECT_TRUE(eventually([&] { return fs::exists(look()); }));
    EXPECT_TRUE(becomes_unsaved(false));
    EXPECT_NE(read(look()).find("level = "), std::string::npos) << read(look());
}

// As among installed examples, which belong to root.
TEST_F(Work, WhosePresetCannotBeWrittenIsSavedSomewhereElseAlsoOnTheWayOut) {
    const fs::path folder = folder_->path() / "examples";
    fs::create_directory(folder);
    write(folder / "look.toml", "scene = \"../scene.frag\"\n[tweaks]\nlevel = 0.2\n");
    write(scene(),
          "uniform float level; //@ 0.2 [0, 1]\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(level, 0.2, 0.3, 1); }\n");
    start({(folder / "look.toml").string()});
    ASSERT_TRUE(glint_->says(": shown")) << glint_->errors();
    change();
    fs::remove_all(folder);
    screen_->tap("Control_L+q");
    ASSERT_TRUE(asks());
    // Save; and, where that cannot be done, under the name that is proposed.
    EXPECT_TRUE(enter_until([&] { return !glint_->runs(); }));
    EXPECT_NE(read(folder_->path() / "look.toml").find("level"), std::string::npos);
}

TEST_F(Work, IsKeptWhereTheFolderThatTheProgramStandsInIsGone) {
    write(scene(),
          "uniform float level; //@ 0.2 [0, 1]\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(level, 0.2, 0.3, 1); }\n");
    start({"scene.frag"});
    ASSERT_TRUE(glint_->says(": shown")) << glint_->errors();
    fs::remove_all(folder_->path());
    change();
    EXPECT_TRUE(eventually([&] { return !kept().empty(); }));
    EXPECT_TRUE(glint_->runs());
}

TEST_F(Work, NamesThatNoFileCanHaveEndNothing) {
    const fs::path longest = folder_->path() / (std::string(250, 'x') + ".toml");
    write(scene(), flat({51, 51, 51}));
    write(longest, "scene = \"scene.frag\"\n");
    start({longest.string()});
    ASSERT_TRUE(glint_->says(": shown")) << glint_->errors();
    screen_->tap("F12");                  // …-0001.png
    screen_->tap("Control_L+Shift_L+s");  // …-2.toml
    ASSERT_TRUE(asks());
    EXPECT_TRUE(enter_until([&] { return screen_->pixel(kMargin).g == 51; }));
    EXPECT_TRUE(glint_->runs()) << glint_->errors();
}

TEST_F(Work, IsSavedAlsoWhereAPictureOfTheSceneIsBroken) {
    write(folder_->path() / "broken.png", "no picture");
    write(look(),
          "scene = \"scene.frag\"\n[tweaks]\nlevel = 0.2\n"
          "[channels]\niChannel0 = { image = \"broken.png\" }\n");
    open_look({}, "texture(iChannel0, p).b");
    ASSERT_TRUE(glint_->says("broken.png")) << glint_->errors();
    change();
    screen_->tap("Control_L+s");
    EXPECT_TRUE(becomes_unsaved(false));
}

TEST_F(Work, OnTheSceneBeforeIsAskedForWhereAFileThatWasDroppedCannotBeShown) {
    open_look();
    const fs::path photo = folder_->path() / "photo.png";
    write(photo, "no scene");
    EXPECT_TRUE(screen_->drop(photo));
    ASSERT_TRUE(glint_->says("photo.png: not shown")) << glint_->errors();
    change();
    screen_->close_window();
    EXPECT_TRUE(asks());
    EXPECT_TRUE(glint_->runs());
    // The name of a new preset is asked for, too.
    EXPECT_TRUE(enter_until([&] { return !glint_->runs(); }));
    EXPECT_NE(read(folder_->path() / "photo.toml").find("level"), std::string::npos);
}

TEST_F(Work, OnTheSceneBeforeIsSavedByItsOwnPresetWhereAnotherIsBroken) {
    write(look(), "# mine\nscene = \"scene.frag\"\ntime = 2.5\n[tweaks]\nlevel = 0.2\n");
    open_look();
    const fs::path broken = folder_->path() / "broken.toml";
    write(broken, "# not mine\nscene = \n");
    EXPECT_TRUE(screen_->drop(broken));
    ASSERT_TRUE(glint_->says("broken.toml: not shown")) << glint_->errors();
    change();
    std::this_thread::sleep_for(500ms);  // the programs of the new values are there, and time runs
    screen_->tap("Control_L+Shift_L+s");
    const fs::path copy = folder_->path() / "broken-2.toml";
    EXPECT_TRUE(enter_until([&] { return fs::exists(copy); })) << glint_->errors();
    EXPECT_TRUE(read(copy).starts_with("# mine\n")) << read(copy);
    EXPECT_NE(read(copy).find("time = 2.5\n"), std::string::npos) << read(copy);
}

TEST_F(Work, OnTheSceneBeforeIsOfferedByItsOwnFileWhereTheOtherIsRepaired) {
    open_look();
    const fs::path broken = folder_->path() / "broken.toml";
    write(broken, "scene = \n");
    EXPECT_TRUE(screen_->drop(broken));
    ASSERT_TRUE(glint_->says("broken.toml: not shown")) << glint_->errors();
    const int changed = change();
    EXPECT_TRUE(eventually([&] { return levels_in(kept()) == 1; })) << kept();
    screen_->tap("F12");
    EXPECT_TRUE(eventually([&] { return fs::exists(folder_->path() / "look-0001.png"); }));
    write(folder_->path() / "other.frag", flat({90, 51, 70}));
    write(broken, "scene = \"other.frag\"\n");
    EXPECT_TRUE(eventually([&] { return red() == 90; })) << red();
    EXPECT_TRUE(becomes_unsaved(false));
    EXPECT_EQ(levels_in(kept()), 1) << kept();
    EXPECT_TRUE(screen_->drop(look()));
    EXPECT_TRUE(eventually([&] { return red() != 90; }));
    EXPECT_TRUE(asks());
    EXPECT_TRUE(enter_until([&] { return red() == changed; })) << red();
}

// Flipping between A and B hides one of them, which is then asked for by name of what is seen.
TEST_F(Work, OfTheSetThatIsHiddenIsAskedForAndOutlivesACrash) {
    open_look();
    change();
    screen_->click(kSetB);
    EXPECT_TRUE(eventually([&] { return red() == 51; })) << red();
    EXPECT_TRUE(becomes_unsaved(false));
    EXPECT_NE(kept(), "");
    screen_->tap("Control_L+q");
    EXPECT_TRUE(becomes_unsaved(true)) << "it is shown, and asked for";
    EXPECT_TRUE(glint_->runs());
    EXPECT_TRUE(enter_until([&] { return !glint_->runs(); }));
    EXPECT_EQ(read(look()).find("level = 0.2\n"), std::string::npos) << read(look());
}

TEST_F(Work, OfBothSetsIsAskedForWhereThatOfOneIsDiscarded) {
    open_look();
    change_both();
    screen_->tap("Control_L+q");
    EXPECT_TRUE(asks());
    screen_->tap("Right");
    screen_->tap("Return");  // Discard
    EXPECT_TRUE(eventually([&] { return levels_in(kept()) == 1; })) << "that of the other set";
    EXPECT_TRUE(asks());
    EXPECT_TRUE(glint_->runs());
    EXPECT_TRUE(enter_until([&] { return !glint_->runs(); }));
    EXPECT_EQ(read(look()).find("level = 0.2\n"), std::string::npos) << read(look());
    EXPECT_EQ(kept(), "");
}

// Elsewhere, the work of the hidden set is unsaved still.
TEST_F(Work, OfTheHiddenSetOutlivesThatTheOtherIsSavedElsewhere) {
    open_look();
    change_both();
    screen_->tap("Control_L+Shift_L+s");
    const fs::path copy = folder_->path() / "look-2.toml";
    EXPECT_TRUE(enter_until([&] { return fs::exists(copy); })) << glint_->errors();
    EXPECT_TRUE(eventually([&] { return levels_in(kept()) == 1; })) << kept();
}

TEST_F(Work, OfBothSetsOutlivesACrash) {
    open_look();
    const auto [first, second] = change_both();
    glint_->signal(SIGKILL);
    glint_->wait();
    open_look();
    EXPECT_TRUE(enter_until([&] { return red() == first; })) << "the newest, then the other";
    EXPECT_TRUE(eventually([&] { return levels_in(kept()) == 2; })) << kept();
    EXPECT_TRUE(asks_no_more());
    settle();
    screen_->click(kSetA);
    EXPECT_TRUE(eventually([&] { return red() == second; })) << first << ", " << second;
}

TEST_F(Work, TheSetInWhichNobodyHasWorkedIsNoWorkOnceTheOtherIsSaved) {
    open_look();
    screen_->tap("Control_L+space");
    const int saved_red = change();
    screen_->tap("Control_L+s");
    ASSERT_TRUE(becomes_unsaved(false));
    const std::string saved = read(look());
    screen_->click(kSetB);
    EXPECT_TRUE(eventually([&] { return red() == 51; })) << "as the file was";
    screen_->click(kSetA);
    EXPECT_TRUE(eventually([&] { return red() == saved_red; })) << red();
    EXPECT_TRUE(becomes_unsaved(false));
    screen_->tap("Control_L+q");
    EXPECT_TRUE(eventually([&] { return !glint_->runs(); })) << "nothing is asked";
    EXPECT_EQ(read(look()), saved);
}

TEST_F(Work, IsSavedWhereTheFileSaysTheSameByAnotherHand) {
    open_look();
    screen_->tap("Control_L+space");
    change();
    screen_->tap("Control_L+s");
    ASSERT_TRUE(becomes_unsaved(false));
    const std::string saved = read(look());
    ASSERT_TRUE(glint_->says(": shown", 2));
    write(look(), "scene = \"scene.frag\"\n[tweaks]\nlevel = 0.2\n");
    ASSERT_TRUE(eventually([&] { return red() == 51; }));
    EXPECT_TRUE(becomes_unsaved(false)) << "the file has moved the tweak";
    screen_->tap("Control_L+z");
    EXPECT_TRUE(becomes_unsaved(true));
    write(look(), saved);
    EXPECT_TRUE(becomes_unsaved(false)) << "the file has come to the same";
}

TEST_F(Work, TweaksOfTheCommandLineAreUnsavedAndOutliveReloads) {
    open_look({"--tweak", "level=0.6"});
    EXPECT_TRUE(eventually([&] { return red() == 153; })) << red();
    EXPECT_TRUE(becomes_unsaved(true));
    write(scene(), read(scene()) + "// saved again\n");
    ASSERT_TRUE(glint_->says(": shown", 2));
    EXPECT_TRUE(eventually([&] { return red() == 153; }));
    screen_->tap("Control_L+z");
    EXPECT_TRUE(eventually([&] { return red() == 51; }));
}

TEST_F(Work, QualityOfTheCommandLineIsUnsavedToo) {
    write(look(), "scene = \"scene.frag\"\n[tweaks]\nlevel = 0.2\n[quality.near]\nlevel = 0.6\n");
    open_look({"--quality", "near"});
    EXPECT_TRUE(eventually([&] { return red() == 153; })) << red();
    EXPECT_TRUE(becomes_unsaved(true));
    screen_->tap("Control_L+z");
    EXPECT_TRUE(eventually([&] { return red() == 51; }));
}

// What a preset says of a tweak that its scene had not, or not yet.
TEST_F(Work, ATweakThatAppearsInTheSceneHasThePresetsValueAndLock) {
    const char* says =
        "scene = \"scene.frag\"\nlocked = [\"green\"]\n[tweaks]\ngreen = 0.6\nlevel = 0.2\n";
    write(look(), says);
    open_look();
    write(scene(),
          "uniform float level; //@ 0 [0, 1]\nuniform float green; //@ 0.1 [0, 1]\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(level, green, 1, 1); }\n");
    ASSERT_TRUE(glint_->says(": shown", 2)) << glint_->errors();
    EXPECT_TRUE(eventually([&] { return screen_->pixel(kMargin).g == 153; }));
    EXPECT_TRUE(becomes_unsaved(false));
    screen_->tap("Control_L+g");
    EXPECT_TRUE(eventually([&] { return red() != 51; }));
    EXPECT_EQ(screen_->pixel(kMargin).g, 153) << "it is locked";
}

TEST_F(Work, AValueOfTheCommandLineBeyondTheRangeIsClampedAndToldOnce) {
    open_look({"--tweak", "level=9"});
    EXPECT_TRUE(eventually([&] { return red() == 255; })) << red();
    EXPECT_EQ(glint_->count("level=9: outside its range, taken as 1"), 1) << glint_->errors();
}

TEST_F(Work, TheEditorOpensTheSceneWhereThereIsNoError) {
    const fs::path told = folder_->path() / "told";
    fs::create_directory(folder_->path() / "bin");
    write(folder_->path() / "bin/xdg-open", "#!/bin/sh\necho \"$1\" > '" + told.string() + "'\n");
    fs::permissions(folder_->path() / "bin/xdg-open", fs::perms::owner_all);
    open_look();
    screen_->tap("Control_L+e");
    EXPECT_TRUE(eventually([&] { return read(told) == scene().string() + "\n"; })) << read(told);
}

TEST_F(Work, WrongOptionsAreNoWindow) {
    write(scene(), flat({1, 2, 3}));
    for (const auto& [option, value, words] :
         {std::tuple{"--tweak", "none=1", "no tweak 'none'"}, {"--size", "12", "--size 12"}}) {
        start({"open", scene().string(), option, value});
        EXPECT_EQ(glint_->wait().code, 2);
        EXPECT_TRUE(glint_->says(words)) << glint_->errors();
    }
}

}  // namespace
}  // namespace glint::window::work_test
