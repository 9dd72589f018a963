// What goes wrong outside leaves the window standing, or ends it with a sentence and a code.
#include "live.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace glint::window::survival_test {
namespace {

using namespace std::chrono_literals;

constexpr glm::ivec2 kMargin{3, 300};

class Survival : public Window {
protected:
    // The window still follows saves.
    void expect_alive(const Colour& colour) {
        write(scene(), flat(colour));
        EXPECT_TRUE(shows(colour, kMargin)) << glint_->errors();
        EXPECT_TRUE(glint_->runs());
    }
};

// One loop alone Mesa's software renderer ends by itself, after 65,535 rounds; two take it hours.
TEST_F(Survival, ALoopThatNeverEndsIsNamedAndThePictureBeforeStays) {
    open(flat({10, 20, 30}));
    write(scene(),
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = vec4(p.x, 0, 0, 1);\n"
          "    for (;;) {\n"
          "        for (int i = 0; i < 65000; ++i) c.x += sin(c.x + float(i));\n"
          "        if (c.x > 1e9) break;\n"
          "    }\n"
          "}\n");
    ASSERT_TRUE(glint_->says("not shown")) << glint_->errors();
    ASSERT_TRUE(glint_->says("does this loop ever end?")) << "the reasons are told behind it";
    EXPECT_TRUE(shows({10, 20, 30}, kMargin));
    EXPECT_EQ(glint_->count("scene.frag:3:"), 1) << glint_->errors();
    EXPECT_EQ(glint_->count("does this loop ever end?"), 1) << glint_->errors();
    expect_alive({11, 20, 30});
}

TEST_F(Survival, ATypoAtTheStartIsShownAndMended) {
    write(scene(), "void mainImage(out vec4 c, in vec2 p) { c = vec4(1) }\n");
    start({scene().string()});
    ASSERT_TRUE(glint_->says("scene.frag:1:53: error"));
    EXPECT_TRUE(glint_->says("not shown, 1 error;"));
    expect_alive({40, 41, 42});
}

TEST_F(Survival, APresetWithATypoIsShownAndMended) {
    write(scene(), flat({50, 60, 70}));
    const fs::path preset = folder_->path() / "look.toml";
    write(preset, "scene = \"scene.frag\n");
    start({preset.string()});
    ASSERT_TRUE(glint_->says("look.toml:1:"));
    write(preset, "scene = \"scene.frag\"\n");
    EXPECT_TRUE(shows({50, 60, 70}, kMargin)) << glint_->errors();
}

TEST_F(Survival, APipeInPlaceOfWhatIsRememberedOfPanelsHoldsNobodyUp) {
    const fs::path places = folder_->path() / "home/.config/glint/panels.ini";
    fs::create_directories(places.parent_path());
    ASSERT_EQ(::mkfifo(places.c_str(), 0600), 0);
    open(flat({50, 60, 70}));
    expect_alive({10, 20, 30});
}

TEST_F(Survival, ADeletedSceneStaysOnTheScreenAndMayComeBack) {
    open(flat({90, 91, 92}));
    fs::remove(scene());
    ASSERT_TRUE(glint_->says("not shown"));
    std::this_thread::sleep_for(300ms);
    EXPECT_TRUE(shows({90, 91, 92}, kMargin, 0.0));
    expect_alive({93, 94, 95});
}

TEST_F(Survival, WhenTheTrialIsKilledAnotherOneTakesItsPlace) {
    open(flat({1, 2, 3}));
    for (int i = 0; i < 5; ++i) {
        for (const pid_t child : glint_->children()) ::kill(child, SIGKILL);
        expect_alive({100 + i, 2, 3});
        // A sketch may be on the screen before the trial is done, which would be killed at work.
        ASSERT_TRUE(glint_->says(": shown;", i + 2)) << glint_->errors();
    }
    EXPECT_EQ(glint_->count("error:"), 0) << glint_->errors();
}

// Where software draws, video memory is the process's own, which can be limited.
TEST_F(Survival, WithoutVideoMemoryThePictureBeforeStays) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the address sanitizer reserves terabytes of the address space";
#endif
    open(flat({1, 2, 3}));
    const rlim_t some = rlim_t{2} << 30;
    const rlimit limit{.rlim_cur = some, .rlim_max = RLIM_INFINITY};
    ASSERT_EQ(prlimit(glint_->id(), RLIMIT_AS, &limit, nullptr), 0);
    write(scene(),
          "uniform sampler2D a; //@ pass mainA size=8192x8192\n"
          "uniform sampler2D b; //@ pass mainB size=8192x8192\n"
          "void mainA(out vec4 c, in vec2 p) { c = vec4(1); }\n"
          "void mainB(out vec4 c, in vec2 p) { c = vec4(1); }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(a, ivec2(p), 0)\n"
          "    * texelFetch(b, ivec2(p), 0); }\n");
    EXPECT_TRUE(glint_->says("for which this driver has no room"));
    EXPECT_TRUE(shows({1, 2, 3}, {3, 300}));
    expect_alive({4, 5, 6});
}

// A pass behind a switch that is off costs constants nothing; programs with uniforms need its
// buffers.
class LittleRoom : public Survival {
protected:
    void open_within(rlim_t bytes, const std::vector<std::string>& arguments = {}) {
        rlimit before{};
        ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
        const rlimit some{.rlim_cur = bytes, .rlim_max = before.rlim_max};
        ASSERT_EQ(::setrlimit(RLIMIT_AS, &some), 0);  // the program inherits it
        open(kText, arguments);
        ASSERT_EQ(::setrlimit(RLIMIT_AS, &before), 0);
    }
    static constexpr rlim_t kRoom = rlim_t{2} << 30;
    static constexpr const char* kText =
        "uniform float a; //@ 0.5 [0, 1]\n"
        "uniform bool extra; //@ off\n"
        "uniform sampler2D b0; //@ pass mainBig size=8192x8192\n"
        "uniform sampler2D b1; //@ pass mainBig size=8192x8192\n"
        "uniform sampler2D b2; //@ pass mainBig size=8192x8192\n"
        "void mainBig(out vec4 o0, out vec4 o1, out vec4 o2, in vec2 p) {\n"
        "    o0 = o1 = o2 = vec4(a);\n"
        "}\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    c = vec4(a, 0.2, 0.2, 1);\n"
        "    if (extra) c += texelFetch(b0, ivec2(p), 0) + texelFetch(b2, ivec2(p), 0);\n"
        "}\n";
};

TEST_F(LittleRoom, WhereConstantsAloneFitThePictureOfASliderWaitsForThose) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the address sanitizer reserves terabytes of the address space";
#endif
    open_within(kRoom, {"--tweak", "a=0.4"});
    EXPECT_TRUE(shows({102, 51, 51}, kMargin)) << glint_->errors();
    screen_->tap("Control_L+z");
    EXPECT_TRUE(shows({128, 51, 51}, kMargin)) << glint_->errors();
    EXPECT_TRUE(glint_->runs()) << glint_->errors();
}

TEST_F(LittleRoom, WhereConstantsAloneFitAnotherNumberInTheFileIsShownByThose) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the address sanitizer reserves terabytes of the address space";
#endif
    open_within(kRoom);
    settle();  // programs with uniforms are at standby
    std::string text = kText;
    text.replace(text.find("0.2, 0.2"), 8, "0.4, 0.2");
    write(scene(), text);
    EXPECT_TRUE(shows({128, 102, 51}, kMargin, 10.0)) << glint_->errors();
}

TEST_F(Survival, WhenTheDisplayGoesTheProgramEndsWithASentence) {
    open(flat({1, 2, 3}));
    std::this_thread::sleep_for(500ms);
    screen_->kill();
    const Glint::End end = glint_->wait();
    EXPECT_EQ(end.signal, 0);
    EXPECT_EQ(end.code, 1);
    EXPECT_NE(glint_->errors().find("The display is gone"), std::string::npos) << glint_->errors();
    const fs::path marks = folder_->path() / "home/.local/state/glint/open";
    EXPECT_TRUE(fs::is_empty(marks)) << "a logout is no crash: the next start is not paused";
    glint_.reset();
}

TEST_F(Survival, AfterACrashTheSceneIsOfferedPaused) {
    const char* const moving =
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(fract(iTime), 0.5, 0.5, 1); }\n";
    open(moving);
    glint_->signal(SIGKILL);
    glint_->wait();
    fs::remove(folder_->path() / "stderr.txt");
    open(moving);
    std::this_thread::sleep_for(5s);  // the notice has gone
    const Colour before = screen_->pixel(kMargin);
    std::this_thread::sleep_for(300ms);
    EXPECT_EQ(screen_->pixel(kMargin), before);
    screen_->tap("Control_L+space");
    EXPECT_TRUE(eventually([&] { return screen_->pixel(kMargin) != before; }));
    screen_->tap("Control_L+q");
    EXPECT_EQ(glint_->wait().code, 0);
    fs::remove(folder_->path() / "stderr.txt");
    open(moving);
    const Colour now = screen_->pixel(kMargin);
    EXPECT_TRUE(eventually([&] { return screen_->pixel(kMargin) != now; }));
}

TEST_F(Survival, ASecondWindowOnTheSameSceneIsNoCrash) {
    const char* const moving =
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(fract(iTime), 0.5, 0.5, 1); }\n";
    open(moving);
    Screen other;
    Glint second(other.name(), folder_->path(), {scene().string()});
    ASSERT_TRUE(glint_->says("scene.frag: shown", 2));
    const Colour now = other.pixel(kMargin);
    EXPECT_TRUE(eventually([&] { return other.pixel(kMargin) != now; }));
}

TEST_F(Survival, AnySizeOfTheWindowIsDrawn) {
    open(flat({7, 8, 9}));
    for (const glm::ivec2 size :
         {glm::ivec2{1, 1}, {2, 700}, {1200, 1}, {17, 13}, {200, 100}, {1280, 720}}) {
        screen_->resize_window(size);
        std::this_thread::sleep_for(100ms);
        ASSERT_TRUE(glint_->runs());
    }
    EXPECT_TRUE(shows({7, 8, 9}, kMargin));
    expect_alive({8, 8, 9});
}

// Ctrl+S in a preset that never came to the screen would put another scene's values there.
TEST_F(Survival, WhatWasNeverShownIsNotSavedOver) {
    const fs::path preset = folder_->path() / "look.toml";
    write(scene(), "uniform float level; //@ 0.5 [0, 1]\n" + flat({1, 2, 3}));
    write(preset, "scene = \"scene.frag\"\n[tweaks]\nlevel = 0.25\n");
    start({preset.string()});
    ASSERT_TRUE(shows({1, 2, 3}, kMargin));
    const std::string broken = "scene = \"scene.frag\"\n[tweaks]\nlevel = \n";
    write(preset, broken);
    ASSERT_TRUE(glint_->says("look.toml:3:"));
    screen_->tap("Control_L+s");
    std::this_thread::sleep_for(500ms);
    EXPECT_EQ(read(preset), broken);
}

}  // namespace
}  // namespace glint::window::survival_test
