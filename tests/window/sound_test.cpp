// The sound of a scene while it runs: on a device of ALSA's that writes to a file, and where there
// is none.
#include "live.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <utility>

namespace glint::window::sound_test {
namespace {

// The picture is green; the sound counts: left is the sample's number modulo a prime, so that no
// block (8192 samples) is like another.
constexpr int kCounted = 30011;
const std::string kCounts =
    "void mainImage(out vec4 c, vec2 p) { c = vec4(0, 1, 0, 1); }\n"
    "vec2 mainSound(int samp, float time) { return vec2(float(samp % 30011) / 32768.0, 0.25); }\n";

// Where kCounts sounds in full, sample follows sample; where the device's clock and ours are
// brought together, by up to 1 % more or less. Round a hole that a busy machine leaves, one call of
// 512 samples fades from one place into another; a shorter break is a click.
struct Order {
    std::size_t in_order = 0, faded = 0;
    std::vector<std::size_t> clicks;  // samples since the first
};

Order order_of(const std::vector<float>& pairs) {
    constexpr std::size_t kFade = 400;  // what of a fade is told from samples in order, at least
    Order order;
    std::size_t broken = 0;
    for (std::size_t i = 0; i + 3 < pairs.size(); i += 2) {
        const bool full =
            std::abs(pairs[i + 1] - 0.25f) < 1e-6f && std::abs(pairs[i + 3] - 0.25f) < 1e-6f;
        const float from = pairs[i] * 32768.0f, to = pairs[i + 2] * 32768.0f;
        if (from > kCounted - 3 || to < 3.0f) continue;  // it begins anew, perhaps in between
        if (full && std::abs(to - from - 1.0f) >= 0.02f) {
            ++broken;
            continue;
        }
        if (broken >= kFade)
            order.faded += broken;
        else if (broken > 0)
            order.clicks.push_back(i / 2);
        broken = 0;
        if (full) ++order.in_order;
    }
    return order;
}

class LiveSoundTest : public Window {
protected:
    void SetUp() override {
        Window::SetUp();
        write(config(),
              "pcm.null { type null }\n"
              "pcm.!default { type file slave.pcm \"null\" format \"raw\" file \"" +
                  heard_file().string() + "\" }\n");
        ::setenv("ALSA_CONFIG_PATH", config().c_str(), 1);
    }
    void TearDown() override {
        ::unsetenv("ALSA_CONFIG_PATH");
        Window::TearDown();
    }

    fs::path config() const { return folder_->path() / "asound.conf"; }
    fs::path heard_file() const { return folder_->path() / "heard.raw"; }

    // Pairs of floats.
    std::vector<float> heard() const {
        const std::string bytes = read(heard_file());
        std::vector<float> values(bytes.size() / sizeof(float));
        std::copy_n(bytes.data(), values.size() * sizeof(float),
                    reinterpret_cast<char*>(values.data()));  // memcpy refuses what is empty
        return values;
    }

    bool hears(std::size_t pairs) const {
        return eventually([&] { return heard().size() >= 2 * pairs; });
    }
    // The processes that play a sound for the window, whatever others it has at the moment.
    std::vector<pid_t> voices() const {
        std::vector<pid_t> list = glint_->children();
        std::erase_if(list, [](pid_t child) {
            const std::string line = read("/proc/" + std::to_string(child) + "/cmdline");
            return line.find(std::string("\0voice", 6)) == std::string::npos;
        });
        return list;
    }
    // Right is 0.25 where a scene of these sounds in full, and 0 once it has faded.
    bool falls_silent() const {
        return eventually([&] {
            const std::vector<float> pairs = heard();
            return !pairs.empty() && pairs.back() == 0.0f;
        });
    }
};

TEST_F(LiveSoundTest, ASceneIsHeardInOrder) {
    open(kCounts);
    ASSERT_TRUE(hears(3 * 44100)) << glint_->errors();
    Order order;
    ASSERT_TRUE(eventually([&] {
        order = order_of(heard());
        return order.in_order > 2 * 44100;
    })) << glint_->errors();
    // A device that a busy machine leaves waiting drops samples; blocks in a wrong order, ten.
    EXPECT_LE(order.clicks.size(), 3u)
        << order.clicks.size() << " clicks, the first after " << order.clicks.front()
        << " samples; " << order.in_order << " samples in order, " << order.faded << " faded";
    EXPECT_EQ(glint_->errors().find("ALSA"), std::string::npos);
    EXPECT_EQ(glint_->errors().find("jack"), std::string::npos);
}

TEST_F(LiveSoundTest, APauseIsSilentAndAsksTheDeviceForNothing) {
    open(kCounts);
    ASSERT_TRUE(hears(44100));
    screen_->tap("Control_L+space");
    ASSERT_TRUE(falls_silent());
    const std::size_t then = heard().size();
    ::sleep(1);
    EXPECT_EQ(heard().size(), then);
    EXPECT_EQ(heard()[then - 2], 0.0f) << "left has faded, too";
}

// What was written when time stopped is what is heard at that time: a pause keeps the frame, whose
// still tells its time.
TEST_F(LiveSoundTest, SoundAndPictureAreInStep) {
    open(
        "void mainImage(out vec4 c, vec2 p) { c = vec4(0, fract(iTime), 0, 1); }\n"
        "vec2 mainSound(int samp, float time) { return vec2(float(samp) / 4194304.0, 0.25); }\n");
    ASSERT_TRUE(hears(2 * 44100));
    const auto size = fs::file_size(heard_file());
    ASSERT_TRUE(eventually([&] { return fs::file_size(heard_file()) > size; }));
    const auto before = std::chrono::steady_clock::now();
    screen_->tap("Control_L+space");
    ASSERT_TRUE(falls_silent());
    const std::chrono::duration<double> way = std::chrono::steady_clock::now() - before;
    screen_->tap("F12");
    const fs::path picture = folder_->path() / "scene-0001.png";
    ASSERT_TRUE(eventually([&] { return fs::exists(picture); })) << glint_->errors();
    const std::string png = read(picture), key = "glint:time";
    const std::size_t at = png.find(key);
    ASSERT_NE(at, std::string::npos);
    const double time = std::atof(png.c_str() + png.find_first_not_of('\0', at + key.size()));
    const std::vector<float> pairs = heard();
    std::size_t last = pairs.size() / 2;
    while (last > 0 && pairs[2 * last - 1] != 0.25f) --last;  // before it fades
    ASSERT_GT(last, 0u);
    const double sounded = pairs[2 * last - 2] * 4194304.0 / 44100.0;
    EXPECT_NEAR(sounded, time, 0.2 + way.count())
        << "s; a frame, the device's latency, by which it is written ahead, and the way of the "
           "pause, which on a busy machine takes its time";
}

TEST_F(LiveSoundTest, ASaveIsHeard) {
    open(kCounts);
    ASSERT_TRUE(hears(22050));
    write(scene(),
          "void mainImage(out vec4 c, vec2 p) { c = vec4(0, 0, 1, 1); }\n"
          "vec2 mainSound(int samp, float time) { return vec2(-0.5, 0.25); }\n");
    ASSERT_TRUE(shows({0, 0, 255}));
    EXPECT_TRUE(eventually([&] {
        const std::vector<float> pairs = heard();
        return pairs[pairs.size() - 2] == -0.5f;
    }));
}

TEST_F(LiveSoundTest, AnErrorOfTheSoundAloneIsListedAndThePictureGoesOn) {
    open(flat({0, 255, 0}));
    write(scene(), flat({0, 0, 255}) +
                       "#ifdef PASS_sound\n"
                       "vec2 mainSound(int samp, float time) { return nothing; }\n"
                       "#endif\n");
    EXPECT_TRUE(shows({0, 0, 255}, {3, 300}));
    EXPECT_TRUE(glint_->says("scene.frag:3:47: error: ")) << glint_->errors();
    write(scene(), kCounts);
    EXPECT_TRUE(hears(4410)) << "mended";
}

TEST_F(LiveSoundTest, WithoutADeviceThereIsNoErrorAndTheSceneRuns) {
    ::setenv("ALSA_CONFIG_PATH", "/dev/null", 1);
    open(kCounts);
    EXPECT_TRUE(shows({0, 255, 0}));
    ::sleep(1);
    EXPECT_TRUE(glint_->runs());
    EXPECT_EQ(glint_->errors().find("ALSA"), std::string::npos) << glint_->errors();
    EXPECT_EQ(glint_->errors().find("error"), std::string::npos) << glint_->errors();
}

TEST_F(LiveSoundTest, TheSceneRunsOnWhenItsPlayerIsKilledAndTheNextSaveIsHeardAgain) {
    open(flat({0, 255, 0}));
    settle();
    write(scene(), kCounts);
    ASSERT_TRUE(hears(4410));
    const std::vector<pid_t> killed = voices();
    EXPECT_EQ(killed.size(), 1u);
    for (const pid_t voice : killed) ::kill(voice, SIGKILL);
    EXPECT_TRUE(eventually([&] { return voices().empty(); }));
    const std::size_t then = heard().size() / 2;
    write(scene(), kCounts + "// again\n");
    EXPECT_TRUE(hears(then + 22050)) << glint_->errors();
}

TEST_F(LiveSoundTest, WhenTheDeviceGoesTheNextSaveIsHeardOnTheOneThatIsThereThen) {
#ifdef __SANITIZE_ADDRESS__
    GTEST_SKIP() << "the address sanitizer lets nothing be loaded before itself";
#endif
    const fs::path gone = folder_->path() / "gone";
    environment_ = {{"LD_PRELOAD", GLINT_GONE_DEVICE}, {"GLINT_DEVICE_GONE", gone.string()}};
    open(kCounts);
    ASSERT_TRUE(hears(4410)) << glint_->errors();
    write(gone, "");
    std::uintmax_t size = 0;
    ASSERT_TRUE(eventually([&] {
        const std::uintmax_t before = std::exchange(size, fs::file_size(heard_file()));
        ::usleep(300'000);
        return size == before;
    }));
    fs::remove(gone);
    write(scene(), kCounts + "// again\n");
    EXPECT_TRUE(hears(size / (2 * sizeof(float)) + 22050)) << glint_->errors();
    EXPECT_EQ(voices().size(), 1u);
}

TEST_F(LiveSoundTest, ASceneWithoutSoundStartsNoProcessForOneAndLoadsNoLibraryOfIt) {
    open(flat({0, 255, 0}));
    settle();
    EXPECT_TRUE(voices().empty());
    EXPECT_FALSE(fs::exists(heard_file()));
    write(scene(), kCounts);
    ASSERT_TRUE(hears(4410));
    EXPECT_EQ(voices().size(), 1u);
    const std::string maps = read("/proc/" + std::to_string(glint_->id()) + "/maps");
    EXPECT_EQ(maps.find("portaudio"), std::string::npos) << "the window itself never loads it";
    EXPECT_EQ(maps.find("sndfile"), std::string::npos);
    write(scene(), flat({0, 0, 255}));
    ASSERT_TRUE(shows({0, 0, 255}));
    EXPECT_TRUE(eventually([&] { return voices().empty(); }));
}

}  // namespace
}  // namespace glint::window::sound_test
