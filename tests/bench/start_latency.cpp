// From the start of the process to the first picture, to the first true frame, and from a key to
// the changed panel meanwhile: measures, and judges nothing.
//
//     start_latency [REPETITIONS [SCENE...]]
//
// Each scene's main preset on a screen of its own, 1280x800, with the driver's cache empty and
// full. One run before those that count leaves its picture behind, as for a person who was here
// before.
#include "../window/live.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <set>
#include <thread>

namespace glint::window {
namespace {

using Clock = std::chrono::steady_clock;

constexpr glm::ivec2 kScreen{1280, 800};
constexpr double kLongest = 120.0;  // s

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

// Rows of the empty screen, of the bare window and of the ground have one colour each.
bool shows_a_picture(const Screen& screen) {
    for (const int y : {200, 420, 600}) {
        const std::vector<std::uint32_t> row = screen.picture({80, y}, {600, 1});
        if (std::set<std::uint32_t>(row.begin(), row.end()).size() > 8) return true;
    }
    return false;
}

struct Times {
    std::vector<double> picture, frame, panel;  // ms
};

// The transport bar goes and comes; its left end has a colour of its own.
std::optional<double> key_to_panel(Screen& screen) {
    constexpr glm::ivec2 kBar{700, 700};
    const std::vector<std::uint32_t> before = screen.picture({kBar.x, kBar.y}, {8, 8});
    const auto start = Clock::now();
    screen.tap("Control_L+b");
    const bool seen = eventually(
        [&] {
            return screen.picture({kBar.x, kBar.y}, {8, 8}) != before;
        },
        5.0);
    return seen ? std::optional(ms_since(start)) : std::nullopt;
}

class Starts {
public:
    explicit Starts(const std::string& scene)
        : preset_((repository() / "presets" / (scene + ".toml")).string()) {}

    // `times`: null for a run that does not count. Keys are pressed in runs of their own.
    void run(bool cold, bool with_keys, Times* times) {
        const fs::path shaders = folder_.path() / "shaders";
        // A driver that has kept nothing is a new one, of which no trial is known.
        if (cold) fs::remove_all(shaders);
        if (cold) fs::remove_all(folder_.path() / "home/.cache/glint/trials");
        fs::create_directories(shaders);
        Screen screen(kScreen);
        const auto start = Clock::now();
        Glint glint(screen.name(), folder_.path(), {preset_}, shader_cache(shaders));
        const auto is_drawn = [&] { return glint.count(": shown") > runs_; };
        // Not as often as tests look: the screen that answers is on the same processors.
        while (!shows_a_picture(screen) && ms_since(start) < kLongest * 1e3)
            std::this_thread::sleep_for(std::chrono::milliseconds(4));
        if (times && !with_keys) times->picture.push_back(ms_since(start));
        while (with_keys && !is_drawn() && ms_since(start) < kLongest * 1e3) {
            const std::optional<double> took = key_to_panel(screen);
            if (took && times && !is_drawn()) times->panel.push_back(*took);
            std::this_thread::sleep_for(std::chrono::milliseconds(60));
        }
        if (!eventually(is_drawn, kLongest)) std::exit(1);
        ++runs_;
        if (times && !with_keys) times->frame.push_back(ms_since(start));
        std::this_thread::sleep_for(std::chrono::milliseconds(300));  // its picture is kept
        glint.signal(SIGTERM);
        glint.wait();
    }

private:
    Folder folder_;
    std::string preset_;
    int runs_ = 0;  // all say so in one file
};

void measure(const std::string& scene, int repetitions) {
    Starts starts(scene);
    Times cold, warm;
    starts.run(true, false, nullptr);
    for (int i = 0; i < repetitions; ++i) starts.run(false, false, &warm);
    for (int i = 0; i < repetitions; ++i) starts.run(true, false, &cold);
    for (int i = 0; i < std::max(repetitions / 5, 1); ++i) starts.run(true, true, &cold);
    std::cout << fmt::format(
                     "{{\"scene\": \"{}\", \"warm_picture\": [{:.1f}], \"warm_frame\": [{:.1f}], "
                     "\"cold_picture\": [{:.1f}], \"cold_frame\": [{:.1f}], \"cold_panel\": "
                     "[{:.1f}]}}\n",
                     scene, fmt::join(warm.picture, ", "), fmt::join(warm.frame, ", "),
                     fmt::join(cold.picture, ", "), fmt::join(cold.frame, ", "),
                     fmt::join(cold.panel, ", "))
              << std::flush;
}

}  // namespace
}  // namespace glint::window

int main(int argc, char** argv) {
    const int repetitions = argc > 1 ? std::atoi(argv[1]) : 20;
    if (repetitions < 1) {
        std::cerr << "start_latency [REPETITIONS [SCENE...]]\n";
        return 2;
    }
    std::vector<std::string> scenes(argv + std::min(argc, 2), argv + argc);
    if (scenes.empty())
        scenes = {"analytic", "boat", "caustics", "christmas", "deep_ocean",
                  "magic",    "sea",  "terrain",  "water"};
    for (const std::string& scene : scenes) glint::window::measure(scene, repetitions);
    return 0;
}
