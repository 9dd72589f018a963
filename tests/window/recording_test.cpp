// The boat, driven by real keys: what was recorded replays to the same picture in a still.
#include "image/image.h"
#include "live.h"

#include <chrono>
#include <functional>
#include <numeric>
#include <thread>

namespace glint::window {
namespace {

using namespace std::chrono_literals;

// A number that a PNG of glint says of itself.
std::string number_in(const fs::path& png, const std::string& key) {
    const std::string bytes = read(png);
    const std::size_t at = bytes.find(key + '\0');
    if (at == std::string::npos) return {};
    const std::size_t begin = at + key.size() + 1;
    return bytes.substr(begin, bytes.find_first_not_of("0123456789.e+-", begin) - begin);
}

class Recording : public Window {};

TEST_F(Recording, ABoatThatIsDrivenByKeysIsReplayedToTheSamePicture) {
    const fs::path preset = folder_->path() / "drive.toml";
    write(preset, "scene = \"" GLINT_REPOSITORY "/fragments/boat.frag\"\n");
    start({preset.string()});
    ASSERT_TRUE(glint_->says(": shown", 1, 120.0)) << glint_->errors();
    screen_->resize_window({320, 180});  // many frames a second, also on two cores
    settle();
    screen_->tap("Control_L+space");
    settle();
    screen_->tap("Control_L+r");
    settle();
    screen_->tap("F9");
    settle();
    screen_->key("Up", true);
    screen_->tap("Control_L+space");
    std::this_thread::sleep_for(1500ms);
    screen_->key("Left", true);
    std::this_thread::sleep_for(1s);
    screen_->key("Left", false);
    std::this_thread::sleep_for(500ms);
    screen_->tap("Control_L+space");
    settle();
    const fs::path taken = folder_->path() / "drive-0001.png";
    screen_->tap("F12");
    ASSERT_TRUE(eventually([&] { return fs::exists(taken); })) << glint_->errors();
    screen_->tap("F9");
    settle();
    screen_->tap("Control_L+s");
    ASSERT_TRUE(eventually([&] { return read(preset).find("left") != std::string::npos; }))
        << read(preset);

    const Image seen = read_image(taken);
    ASSERT_EQ(seen.size, glm::ivec2(320, 180));
    const std::string time = number_in(taken, "glint:time");
    const fs::path again = folder_->path() / "again.png";
    Glint still(
        screen_->name(), folder_->path(),
        {"still", preset.string(), "-o", again.string(), "--size", "320x180", "--time", time});
    ASSERT_EQ(still.wait(60.0).code, 0) << still.errors();
    const Image replayed = read_image(again);
    ASSERT_EQ(replayed.size, seen.size);
    const auto different =
        std::inner_product(seen.pixels.begin(), seen.pixels.end(), replayed.pixels.begin(), 0,
                           std::plus<>(), [](std::byte a, std::byte b) { return a == b ? 0 : 1; });
    EXPECT_EQ(different, 0) << "of " << seen.pixels.size() << " bytes, at " << time << " s of\n"
                            << read(preset);

    // The keys did something: without them it is another picture.
    const fs::path idle = folder_->path() / "idle.png";
    Glint without(screen_->name(), folder_->path(),
                  {"still", GLINT_REPOSITORY "/fragments/boat.frag", "-o", idle.string(), "--size",
                   "320x180", "--time", time});
    ASSERT_EQ(without.wait(60.0).code, 0) << without.errors();
    EXPECT_NE(read_image(idle).pixels, seen.pixels);
}

}  // namespace
}  // namespace glint::window
