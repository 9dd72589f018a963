// Time, stills and the window itself, by keys: what is seen, what is written, and what `glint
// still` writes are the same.
#include "live.h"
#include "media/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <thread>

namespace glint::window::transport_test {
namespace {

using namespace std::chrono_literals;

// Bands of 40 pixels: time in 1/10000 s, frame.
constexpr const char* kClock = R"(
vec4 code(int v) { return vec4(vec3((v >> 16) & 255, (v >> 8) & 255, v & 255) / 255.0, 1.0); }
void mainImage(out vec4 c, in vec2 p) {
    int band = int(iResolution.y - p.y) / 40;
    c = code(band == 0 ? int(round(iTime * 1e4)) : iFrame);
    if (p.x > 8.0) c = vec4(fract(p / 97.0 + iTime), 0.5 + 0.5 * sin(iTime * 3.0 + p.x / 50.0), 1.0);
}
)";

// A simulation by steps, and a buffer that feeds back each frame and counts frames.
constexpr const char* kSimulation = R"(
uniform sampler2D waves; //@ pass mainWaves size=64x64 step=1/120
uniform sampler2D trail; //@ pass mainTrail size=64x64
void mainWaves(out vec4 c, in vec2 p) {
    vec4 before = texelFetch(waves, ivec2(p), 0);
    c = vec4(before.xy * 0.99 + vec2(sin(iTime * 2.0 + p.x), cos(iTime + p.y)) * 0.01, iTime, 1.0);
}
void mainTrail(out vec4 c, in vec2 p) {
    c = mix(texelFetch(trail, ivec2(p), 0), vec4(fract(p / 64.0 + iTime), float(iFrame) / 4096.0, 1.0), 0.05);
}
void mainImage(out vec4 c, in vec2 p) {
    vec2 uv = p / iResolution.xy;
    c = vec4(0.5 + texture(waves, uv).xy, texture(trail, uv).xz.x, 1.0) + texture(trail, uv).zzzz;
}
)";

class Transport : public Window {
protected:
    void SetUp() override {
        screen_size_ = {1400, 800};
        Window::SetUp();
    }
    int number(int band) const {
        const Colour colour = screen_->pixel({3, band * 40 + 20});
        return colour.r << 16 | colour.g << 8 | colour.b;
    }
    int time() const { return number(0); }  // in 1/10000 s
    int frame() const { return number(1); }
    void pause() {
        screen_->tap("Control_L+space");
        settle();
    }
    // The still that F12 writes.
    fs::path take_still(int number) {
        const fs::path file = folder_->path() / fmt::format("scene-{:04}.png", number);
        screen_->tap("F12");
        EXPECT_TRUE(eventually([&] { return fs::exists(file); })) << glint_->errors();
        return file;
    }
    void expect_same(const fs::path& taken, const std::vector<std::string>& more = {}) {
        std::vector<std::string> arguments = {"--size", "1280x720", "--time",
                                              text_in(taken, "glint:time")};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Image ours = read_image(taken);
        const Image expected = read_image(still(arguments));
        ASSERT_EQ(ours.size, expected.size);
        const auto different = std::inner_product(
            ours.pixels.begin(), ours.pixels.end(), expected.pixels.begin(), 0, std::plus<>(),
            [](std::byte a, std::byte b) { return a == b ? 0 : 1; });
        EXPECT_EQ(different, 0) << "of " << ours.pixels.size() << " bytes, at "
                                << text_in(taken, "glint:time") << " s, frame "
                                << text_in(taken, "glint:frame");
    }
};

TEST_F(Transport, PauseKeepsTheInstantAndPlayGoesOnFromIt) {
    open(kClock);
    EXPECT_TRUE(eventually([&] { return time() > 5000; }));
    pause();
    const int paused = time();
    std::this_thread::sleep_for(1s);
    EXPECT_EQ(time(), paused);
    const auto before = std::chrono::steady_clock::now();
    screen_->tap("Control_L+space");
    EXPECT_TRUE(eventually([&] { return time() > paused; }));
    const int on = time() - paused;
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - before;
    EXPECT_LT(on, 1e4 * since.count() + 5000) << "it did not make up for the pause";
}

TEST_F(Transport, AStepIsASixtiethOfASecondAndOneFrame) {
    open(kClock);
    pause();
    for (int i = 0; i < 3; ++i) {
        const int before = time(), frame_before = frame();
        screen_->tap("Control_L+period");
        EXPECT_TRUE(eventually([&] { return frame() != frame_before; }));
        settle();
        EXPECT_NEAR(time() - before, 10000 / 60.0, 1.0);
        EXPECT_EQ(frame(), frame_before + 1);
    }
}

TEST_F(Transport, ResetGoesToTheFirstFrameAndStaysPaused) {
    open(kClock);
    EXPECT_TRUE(eventually([&] { return time() > 0; }));
    pause();
    ASSERT_GT(time(), 0);
    screen_->tap("Control_L+r");
    EXPECT_TRUE(eventually([&] { return time() == 0; }));
    settle();
    EXPECT_EQ(time(), 0);
    EXPECT_EQ(frame(), 0);
}

TEST_F(Transport, AStillIsWhatTheWindowShowsAndWhatTheOtherVerbWrites) {
    open(kClock);
    pause();
    screen_->tap("Tab");
    settle();
    const fs::path taken = take_still(1);
    const Image image = read_image(taken);
    ASSERT_EQ(image.size, glm::ivec2(1280, 720));
    // Without the rows below, where a word stands on how the panels come back.
    const auto differs = [&](const std::vector<std::uint32_t>& seen) {
        for (std::size_t i = 0; i < std::size_t{1280} * 640; ++i) {
            const std::size_t flipped = (719 - i / 1280) * 1280 + i % 1280;  // rows run bottom up
            const auto at = [&](std::size_t c) {
                return std::to_integer<std::uint32_t>(image.pixels[flipped * 3 + c]);
            };
            if (seen[i] != (at(0) << 16 | at(1) << 8 | at(2))) return true;
        }
        return false;
    };
    // The panels may go a frame or two after the still was written.
    EXPECT_TRUE(eventually([&] { return !differs(screen_->picture({0, 0}, {1280, 720})); }));
    const std::string still_frame = text_in(taken, "glint:frame");
    EXPECT_EQ(std::to_string(frame()), still_frame);
    // iFrame of a still counts from its time; the clock's bands show the one of the window.
    write(scene(), [] {
        std::string text = kClock;
        text.replace(text.find(": iFrame"), 8, ": 0");
        return text;
    }());
    ASSERT_TRUE(glint_->says(": shown", 2));
    settle();
    expect_same(take_still(2));
}

TEST_F(Transport, ASimulationThatIsSoughtIsWhatAStillSimulates) {
    open(kSimulation);
    pause();
    screen_->click({320, 693});  // on the scrub bar
    settle();
    const fs::path forward = take_still(1);
    EXPECT_GT(std::atof(text_in(forward, "glint:time").c_str()), 2.0);
    expect_same(forward);
    screen_->click({260, 693});
    settle();
    expect_same(take_still(2));
}

TEST_F(Transport, ASimulationThatWasPlayedGoesBackToWhatAStillSimulates) {
    open(R"(
uniform sampler2D waves; //@ pass mainWaves size=64x64 step=1/120
void mainWaves(out vec4 c, in vec2 p) {
    vec4 before = texelFetch(waves, ivec2(p), 0);
    c = vec4(before.xy * 0.99 + vec2(sin(iTime * 2.0 + p.x), cos(iTime + p.y)) * 0.01, iTime, 1.0);
}
void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5 + texture(waves, p / iResolution.xy).xy, 0, 1); }
)",
         {"--no-specialise"});
    std::this_thread::sleep_for(2500ms);  // states are kept on the way
    pause();
    for (const int x : {219, 212}) {  // on the scrub bar: 1.7 s, 1 s
        screen_->click({x, 693});
        settle();
        const fs::path taken = take_still(x == 219 ? 1 : 2);
        EXPECT_GT(std::atof(text_in(taken, "glint:time").c_str()), 0.5);
        expect_same(taken, {"--no-specialise"});
    }
}

TEST_F(Transport, AfterAResetASimulationStepsAsAStillDoes) {
    open(kSimulation);
    pause();
    screen_->tap("Control_L+r");
    settle();
    for (int i = 0; i < 5; ++i) {
        screen_->tap("Control_L+period");
        settle();
    }
    const fs::path taken = take_still(1);
    EXPECT_EQ(text_in(taken, "glint:frame"), "5");
    expect_same(taken);
}

TEST_F(Transport, TabHidesAllPanelsAndBringsThemBack) {
    open(flat({20, 30, 40}));
    const auto is_bare = [&] {
        const auto picture = screen_->picture({0, 0}, {1280, 720});
        return std::all_of(picture.begin(), picture.end(),
                           [](std::uint32_t pixel) { return pixel == 0x141e28; });
    };
    EXPECT_FALSE(is_bare());
    screen_->tap("Tab");
    EXPECT_TRUE(eventually(is_bare));
    screen_->tap("Tab");
    EXPECT_TRUE(eventually([&] { return !is_bare(); }));
}

TEST_F(Transport, FullScreenCoversTheScreenAndComesBack) {
    open(flat({20, 30, 40}));
    screen_->tap("Tab");
    screen_->tap("F11");
    EXPECT_TRUE(shows({20, 30, 40}, {1395, 795}));
    screen_->tap("F11");
    EXPECT_TRUE(eventually([&] { return screen_->window_size() == glm::ivec2(1280, 720); }));
    EXPECT_TRUE(shows({20, 30, 40}, {1275, 715}));
}

}  // namespace
}  // namespace glint::window::transport_test
