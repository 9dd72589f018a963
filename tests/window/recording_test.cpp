// The boat, driven by real keys: what was recorded replays to the same picture in a still.
#include "live.h"
#include "media/image.h"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <functional>
#include <numeric>
#include <thread>

namespace glint::window::recording_test {
namespace {

using namespace std::chrono_literals;

class Recording : public Window {
protected:
    // The still that F12 writes, of the window as it stands: all that was done before has arrived.
    fs::path take_still() {
        const fs::path file = folder_->path() / fmt::format("drive-{:04}.png", ++stills_);
        screen_->tap("F12");
        EXPECT_TRUE(eventually([&] { return fs::exists(file); })) << glint_->errors();
        return file;
    }
    // By the other verb.
    Image still_of(const fs::path& file, const std::string& time) {
        const fs::path picture = folder_->path() / "still.png";
        Glint still(screen_->name(), folder_->path(),
                    {"still", file.string(), "-o", picture.string(), "--size", "192x108", "--time",
                     time, "--no-specialise"});
        EXPECT_EQ(still.wait(60.0).code, 0) << still.errors();
        return read_image(picture);
    }

private:
    int stills_ = 0;
};

TEST_F(Recording, ABoatThatIsDrivenByKeysIsReplayedToTheSamePicture) {
    const fs::path boat = GLINT_REPOSITORY "/fragments/boat.frag";
    const fs::path preset = folder_->path() / "drive.toml";
    write(preset, "scene = \"" + boat.string() + "\"\n");
    // The specialised program may differ in the last bit, and the window takes it up on the way.
    start({preset.string(), "--no-specialise"});
    ASSERT_TRUE(glint_->says(": shown", 1, 120.0)) << glint_->errors();
    screen_->resize_window({192, 108});
    screen_->tap("Control_L+space");
    screen_->tap("Control_L+r");
    // A still is of what the window shows: not yet of the first frame, where that is to come.
    ASSERT_TRUE(eventually([&] { return text_in(take_still(), "glint:time") == "0"; }));
    screen_->tap("F9");
    take_still();
    screen_->key("Up", true);
    screen_->tap("Control_L+space");
    std::this_thread::sleep_for(1500ms);
    screen_->key("Left", true);
    // Held up for longer than a live simulation catches up: time waits, as it is recorded.
    glint_->signal(SIGSTOP);
    std::this_thread::sleep_for(600ms);
    glint_->signal(SIGCONT);
    std::this_thread::sleep_for(1s);
    screen_->key("Left", false);
    std::this_thread::sleep_for(500ms);
    screen_->tap("Control_L+space");
    const fs::path taken = take_still();
    screen_->tap("F9");
    screen_->tap("Control_L+s");
    ASSERT_TRUE(eventually([&] { return read(preset).find("left") != std::string::npos; }))
        << read(preset);

    const std::string time = text_in(taken, "glint:time");
    const Image seen = read_image(taken);
    ASSERT_EQ(seen.size, glm::ivec2(192, 108));
    const Image replayed = still_of(preset, time);
    const auto different =
        std::inner_product(seen.pixels.begin(), seen.pixels.end(), replayed.pixels.begin(), 0,
                           std::plus<>(), [](std::byte a, std::byte b) { return a == b ? 0 : 1; });
    EXPECT_EQ(different, 0) << "of " << seen.pixels.size() << " bytes, at " << time << " s of\n"
                            << read(preset);
    EXPECT_NE(still_of(boat, time).pixels, seen.pixels) << "the keys did nothing";
}

TEST_F(Recording, APresetThatOpensAfterItsEventsShowsWhereTheyLed) {
    write(scene(),
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = vec4(iMouse.xy / iResolution.xy, iMouse.w > 0.0 ? 1.0 : 0.2, 1);\n}\n");
    const fs::path preset = folder_->path() / "look.toml";
    write(preset,
          "scene = \"scene.frag\"\ntime = 2.0\n"
          "[[events]]\nt = 0.5\nmouse = [0.75, 0.75]\ndown = true\n"
          "[[events]]\nt = 0.6\nmouse = [0.25, 0.75]\ndown = true\n");
    start({preset.string()});
    EXPECT_TRUE(shows({64, 191, 51}, {640, 300}));
}

TEST_F(Recording, TheFilesEventsStayAroundWhatIsRecordedAndNothingDoneIsNothing) {
    const fs::path scene = folder_->path() / "scene.frag", preset = folder_->path() / "keys.toml";
    write(scene,
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.2, 0.2, fract(iTime), 1); }\n");
    const std::string text =
        "scene = \"scene.frag\"\n"
        "[[events]]\nt = 0.0\nkey = \"up\"\ndown = true\n"
        "[[events]]\nt = 900.0\nkey = \"left\"\ndown = true\n";
    write(preset, text);
    start({preset.string()});
    ASSERT_TRUE(glint_->says(": shown")) << glint_->errors();
    const auto is_unsaved = [&] { return screen_->title().ends_with(" * - Glint"); };
    std::this_thread::sleep_for(300ms);
    screen_->tap("F9");
    std::this_thread::sleep_for(300ms);
    screen_->tap("F9");
    std::this_thread::sleep_for(300ms);
    EXPECT_FALSE(is_unsaved());
    screen_->tap("F9");
    std::this_thread::sleep_for(300ms);
    screen_->tap("Right");
    std::this_thread::sleep_for(300ms);
    screen_->tap("F9");
    ASSERT_TRUE(eventually(is_unsaved));
    screen_->tap("Control_L+s");
    ASSERT_TRUE(eventually([&] { return !is_unsaved(); }));
    const std::string saved = read(preset);
    for (const char* key : {"\"up\"", "\"right\"", "\"left\""})
        EXPECT_NE(saved.find(key), std::string::npos) << key << " in\n" << saved;
}

TEST_F(Recording, GoesOnWhereAQuitIsCancelled) {
    const fs::path preset = folder_->path() / "drive.toml";
    write(scene(),
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.2, 0.2, fract(iTime), 1); }\n");
    write(preset, "scene = \"scene.frag\"\n");
    start({preset.string()});
    ASSERT_TRUE(glint_->says(": shown")) << glint_->errors();
    // The question dims the picture.
    const auto is_asked = [&] { return screen_->pixel({3, 300}).r < 51; };
    screen_->tap("F9");
    screen_->tap("Right");  // unsaved once a frame has seen it
    EXPECT_TRUE(eventually([&] { return screen_->title().ends_with(" * - Glint"); }));
    screen_->tap("Control_L+q");
    EXPECT_TRUE(eventually(is_asked));
    screen_->tap("Escape");
    EXPECT_TRUE(eventually([&] { return !is_asked(); }));
    screen_->tap("Left");
    take_still();  // a frame has seen that, too
    screen_->tap("F9");
    screen_->tap("Control_L+s");
    EXPECT_TRUE(eventually([&] { return !screen_->title().ends_with(" * - Glint"); }));
    for (const char* key : {"\"right\"", "\"left\""})
        EXPECT_NE(read(preset).find(key), std::string::npos) << key << " in\n" << read(preset);
}

// Of what was done before only what the scene asks for leads to its pictures.
TEST_F(Recording, WhatIsHeldAtItsEndIsLetGoAndWhatNobodyReadsIsNotSaidAtItsStart) {
    const fs::path preset = folder_->path() / "held.toml";
    write(scene(),
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.2, 0.2, fract(iTime), 1); }\n");
    write(preset, "scene = \"scene.frag\"\n");
    start({preset.string()});
    ASSERT_TRUE(glint_->says(": shown")) << glint_->errors();
    const auto wait = [] { std::this_thread::sleep_for(200ms); };
    screen_->click({300, 400});
    screen_->tap("a");
    screen_->tap("Control_L+r");
    wait();
    screen_->tap("F9");
    wait();
    screen_->key("b", true);
    screen_->move({300, 400});
    screen_->button(true);
    wait();
    screen_->tap("F9");
    wait();
    screen_->button(false);
    screen_->key("b", false);
    screen_->tap("Control_L+s");
    ASSERT_TRUE(eventually([&] { return read(preset).find("mouse") != std::string::npos; }, 20.0));
    const std::string saved = read(preset);
    const auto count = [&](const std::string& words) {
        int found = 0;
        for (std::size_t at = 0; (at = saved.find(words, at)) != saved.npos; ++at) ++found;
        return found;
    };
    EXPECT_EQ(count("[[events]]"), 4) << saved;
    EXPECT_EQ(count("key = \"b\""), 2) << saved;
    EXPECT_EQ(count("down = false"), 2) << saved;
}

TEST_F(Recording, ThatEndsWhereTimeGoesBackIsThereToBeSaved) {
    const fs::path preset = folder_->path() / "back.toml";
    write(scene(),
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.2, 0.2, fract(iTime), 1); }\n");
    write(preset, "scene = \"scene.frag\"\n");
    start({preset.string()});
    ASSERT_TRUE(glint_->says(": shown")) << glint_->errors();
    std::this_thread::sleep_for(200ms);
    screen_->tap("F9");
    std::this_thread::sleep_for(200ms);
    screen_->tap("b");
    std::this_thread::sleep_for(200ms);
    screen_->tap("Control_L+r");
    std::this_thread::sleep_for(200ms);
    screen_->tap("Control_L+s");
    EXPECT_TRUE(eventually([&] { return read(preset).find("\"b\"") != std::string::npos; }, 20.0))
        << read(preset);
}

}  // namespace
}  // namespace glint::window::recording_test
