// An open scene without a window: what the driver has no room for is told, and all goes on.
#include "window/live/playground.h"

#include "../../render/fixture.h"
#include "base/words.h"

#include <fmt/format.h>

#include <thread>

namespace glint::playground_test {
namespace {

namespace fs = std::filesystem;

// As a driver says of a call that it refuses.
void complain() {
    glDebugMessageInsert(GL_DEBUG_SOURCE_APPLICATION, GL_DEBUG_TYPE_ERROR, 1,
                         GL_DEBUG_SEVERITY_HIGH, -1, "no memory");
}

class OpenScene : public GlTest {
protected:
    void SetUp() override {
        GlTest::SetUp();
        if (IsSkipped()) return;
        trial_.emplace(TrialOptions{.device = "", .program = GLINT_BINARY});
        playground_.emplace(*shared_context.context, *trial_, glm::ivec2(32, 18),
                            PlaygroundOptions{.device = "", .specialise = false});
    }
    // Goes on until this is so; false where it never is.
    bool follows_until(const std::function<bool()>& is_so) {
        for (int i = 0; i < 5'000 && !is_so(); ++i) {
            playground_->update();
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        return is_so();
    }
    static std::string text(const std::string& added) {
        return "uniform sampler2D s; //@ pass mainS size=4x4 step=1/60\n"
               "void mainS(out vec4 c, in vec2 p) { c = texelFetch(s, ivec2(p), 0) + " +
               added +
               "; }\n"
               "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(s, ivec2(0), 0); }\n";
    }

    TestFolder folder_;
    std::optional<Trial> trial_;
    std::optional<Playground> playground_;
};

// A scene that reads a picture which goes to the driver in pieces.
class LargePicture : public OpenScene {
protected:
    void SetUp() override {
        OpenScene::SetUp();
        if (IsSkipped()) return;
        write_image(folder_.path() / "large.png",
                    {.size = {kSide, kSide},
                     .channels = 3,
                     .type = ChannelType::u8,
                     .pixels = std::vector<std::byte>(3 * kSide * kSide, std::byte{127})});
        playground_->open(
            folder_.write("scene.frag",
                          "uniform sampler2D large; //@ image large.png filter=mipmap\n"
                          "void mainImage(out vec4 c, in vec2 p) { c = texture(large, p); }\n"));
    }
    bool is_told() const {
        return to_text(playground_->diagnostics()).find("no memory") != std::string::npos;
    }

    static constexpr int kSide = 5000;  // pixels
};

TEST_F(LargePicture, ThatTheDriverHasNoRoomForIsLeftOut) {
    ASSERT_TRUE(follows_until([&] { return playground_->is_open(); }))
        << to_text(playground_->diagnostics());
    complain();
    ASSERT_TRUE(follows_until([&] { return is_told(); }));
    EXPECT_FALSE(playground_->is_loading());
    complain();
    EXPECT_NO_THROW(playground_->update());
    take_complaint();
}

TEST_F(LargePicture, ThatTheDriverRefusesOnItsWayIsLeftOut) {
    const auto is_sent = [&] { return playground_->is_open() && playground_->is_sending(); };
    ASSERT_TRUE(follows_until(is_sent));
    complain();
    EXPECT_NO_THROW(playground_->update());
    EXPECT_TRUE(is_told()) << to_text(playground_->diagnostics());
    EXPECT_FALSE(playground_->is_loading());
    take_complaint();
}

// The trial has that much to do that a small file is read meanwhile.
std::string slow_to_compile(std::string text) {
    std::string numbers = "0.0";
    for (int i = 1; i < 2000; ++i) numbers += fmt::format(", {}.0", i);
    replace_all(text, "c = ", "float v[] = float[](" + numbers + "); c = v[int(p.x)] * ");
    return text;
}

// The text that is tried names it on another line than the one in place.
TEST_F(OpenScene, AFileThatCameBackWhileATextIsTriedIsNotCalledMissing) {
    const fs::path picture = folder_.path() / "paint.png", away = folder_.path() / "away.png";
    write_image(picture, {.size = {1, 1},
                          .channels = 3,
                          .type = ChannelType::u8,
                          .pixels = std::vector<std::byte>(3, std::byte{127})});
    const std::string paint =
        "uniform sampler2D paint; //@ image paint.png\n"
        "void mainImage(out vec4 c, in vec2 p) { c = texture(paint, p); }\n";
    playground_->open(folder_.write("scene.frag", paint));
    const auto count_follows = [&](std::size_t count) {
        return follows_until([&] {
            playground_->draw(0.0);
            return !playground_->is_loading() && playground_->report_count() > 0 &&
                   playground_->diagnostics().size() == count;
        });
    };
    ASSERT_TRUE(follows_until([&] { return playground_->is_open(); }));
    ASSERT_TRUE(count_follows(0)) << to_text(playground_->diagnostics());
    fs::rename(picture, away);
    ASSERT_TRUE(count_follows(1));
    folder_.write("scene.frag", "\n" + slow_to_compile(paint));
    ASSERT_TRUE(follows_until([&] { return playground_->is_loading(); }));
    EXPECT_EQ(playground_->diagnostics().size(), 1u) << "told with the new text, too";
    fs::rename(away, picture);
    EXPECT_TRUE(count_follows(0)) << to_text(playground_->diagnostics());
}

// What a replay goes on from hangs on text, values, events and inputs, and on nothing else that a
// preset says.
TEST_F(OpenScene, KeepsItsStatesOverASaveOfWhatTheyDoNotHangOn) {
    const fs::path scene = folder_.write("sim.frag", text("0.01"));
    const fs::path look = folder_.write("look.toml", "scene = \"sim.frag\"\n");
    playground_->open(look);
    ASSERT_TRUE(follows_until([&] { return playground_->is_open(); }));
    for (int i = 0; i < 80; ++i) playground_->draw(0.02);
    const std::vector<double> kept = playground_->kept_states();
    ASSERT_FALSE(kept.empty());
    const auto saves = [&](const fs::path& file, const std::string& words) {
        const std::size_t before = playground_->report_count();
        folder_.write(file.filename().string(), words);
        return follows_until([&] {
            playground_->draw(0.0);
            return playground_->report_count() > before;
        });
    };
    ASSERT_TRUE(saves(look, "scene = \"sim.frag\"\ntitle = \"waves\"\ntime = 0.5\n"));
    EXPECT_EQ(playground_->preset()->title, "waves");
    EXPECT_EQ(playground_->kept_states(), kept);
    ASSERT_TRUE(saves(scene, text("0.02")));
    EXPECT_TRUE(playground_->kept_states().empty());
}

// A scene whose two buffers, of which one is stepped, count presses of Space and clicks.
class CountedInput : public OpenScene {
protected:
    using What = TimeEdit::What;
    struct Counts {
        int presses = 0, clicks = 0, held = 0;
        bool operator==(const Counts&) const = default;
    };
    void open_at(const std::string& time) {
        folder_.write(
            "count.frag",
            "uniform sampler2D keys; //@ keyboard\n"
            "uniform sampler2D stepped; //@ pass mainStepped step=1/60 size=1x1 format=rgba32f\n"
            "uniform sampler2D framed; //@ pass mainFramed size=1x1 format=rgba32f\n"
            "vec4 counted(vec4 c) {\n"
            "    return vec4(c.x + texelFetch(keys, ivec2(32, 1), 0).r, c.y + (iMouse.w > 0.0 ? "
            "1.0 : 0.0), texelFetch(keys, ivec2(32, 0), 0).r, 0);\n}\n"
            "void mainStepped(out vec4 c, in vec2 p) { c = counted(texelFetch(stepped, ivec2(0), "
            "0)); }\n"
            "void mainFramed(out vec4 c, in vec2 p) { c = counted(texelFetch(framed, ivec2(0), "
            "0)); "
            "}\n"
            "void mainImage(out vec4 c, in vec2 p) {\n"
            "    c = texelFetch(stepped, ivec2(0), 0) + texelFetch(framed, ivec2(0), 0);\n}\n");
        playground_->open(folder_.write(
            "count.toml", "scene = \"count.frag\"\ntime = " + time +
                              "\nevents = [\n"
                              "    { t = 0.0, key = \"space\", down = true },\n"
                              "    { t = 0.2, key = \"space\", down = false },\n"
                              "    { t = 0.5, key = \"space\", down = true },\n"
                              "    { t = 0.6, key = \"space\", down = false },\n"
                              "    { t = 0.7, mouse = [0.5, 0.5], down = true },\n"
                              "    { t = 0.8, mouse = [0.5, 0.5], down = false },\n]\n"));
        EXPECT_TRUE(follows_until([&] { return playground_->is_open(); }));
        playground_->apply(What::pause);
        rest();
    }
    void rest() {
        for (int i = 0; i < 1000 && (i < 2 || playground_->wants_frame()); ++i)
            playground_->draw(0.0);
    }
    void seek(double time) {
        playground_->apply({.what = What::seek, .number = time, .loop = {}});
        rest();
    }
    void step(int count) {
        for (int i = 0; i < count; ++i) {
            playground_->apply(What::step);
            rest();
        }
    }
    Counts counts(std::size_t index) {
        const glm::vec4 c = playground_->renderer()->read_pixel(index, 0, {0, 0});
        return {static_cast<int>(c.x), static_cast<int>(c.y), static_cast<int>(c.z)};
    }
    void expect(const Counts& wanted, const char* when) {
        for (const std::size_t index : {0u, 1u})
            EXPECT_EQ(counts(index), wanted)
                << when << ", buffer " << index << " at " << playground_->instant().time << ": "
                << counts(index).presses << " " << counts(index).clicks << " "
                << counts(index).held;
    }
};

TEST_F(CountedInput, NothingIsPressedAnewAfterAJump) {
    open_at("0");
    for (const double time : {1.41, 1.4, 0.55, 1.41}) {
        seek(time);
        const bool is_late = time > 0.8;
        expect({2, is_late ? 1 : 0, is_late ? 0 : 1}, "after a jump");
        step(2);
        expect({2, is_late ? 1 : 0, is_late ? 0 : 1}, "after two steps more");
    }
}

TEST_F(CountedInput, NothingIsPressedAnewWhereAPresetBeginsLate) {
    open_at("1.41");
    expect({2, 1, 0}, "opened");
    step(2);
    expect({2, 1, 0}, "after two steps more");
}

TEST_F(CountedInput, ThePresetsEventsGoOnStepByStep) {
    open_at("0");
    step(10);
    expect({1, 0, 1}, "the event at 0");
    step(50);
    expect({2, 1, 0}, "all of them");
}

TEST_F(CountedInput, ARestartPressesNothingThatAPersonDidBefore) {
    folder_.write("bare.toml", "scene = \"count.frag\"\n");
    open_at("0");
    playground_->open(folder_.path() / "bare.toml");
    ASSERT_TRUE(follows_until([&] { return playground_->preset()->events.empty(); }));
    playground_->apply(What::pause);
    rest();
    for (const bool down : {true, false}) {
        playground_->key(32, down);
        step(2);
    }
    expect({1, 0, 0}, "a person's press");
    playground_->apply(What::reset);
    rest();
    step(2);
    expect({}, "after the restart");
}

}  // namespace
}  // namespace glint::playground_test
