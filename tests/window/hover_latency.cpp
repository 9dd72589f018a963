// How long a shipped scene's values take from the mouse to the source panel:
//
//     window_hover_latency GLINT SCENE COUNT
//
// A copy of the scene and its preset is open, paused, in a window of 640x360, with a driver that
// has kept nothing. `first` is from the panel's key to the first value, with all that is compiled
// for it; `hover` from a move of the mouse to the value at the pixel that is then under it. The
// preset watches the pixel's own coordinates, so that there is another value for every pixel.
// While it pauses the picture refines. Prints one line of JSON, with how many moves told nothing
// new in 20 s (`silent`), and judges nothing.
#include "glsl/reading.h"
#include "live.h"
#include "scene/scene_text.h"

#include <fmt/format.h>
#include <glm/common.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <optional>
#include <thread>

namespace glint::window {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr glm::ivec2 kSize{640, 360};
// Where the source panel stands, and the picture beside it with no other panel: over a panel the
// mouse asks for no other pixel.
constexpr glm::ivec2 kPanel{10, 50}, kPanelSize{286, 226};
constexpr glm::ivec2 kFree{310, 60}, kFreeSize{320, 210};
constexpr std::uint32_t kValueInk = 105 << 16 | 178 << 8 | 236;  // of a value's text

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

[[noreturn]] void fail(const std::string& why) {
    std::cerr << why << '\n';
    std::exit(1);
}

// `watch = ["p@1051"]`, of the pixel's coordinates in mainImage.
std::string watch_of(const std::string& text) {
    const Reading reading = read_glsl(text, known_of_scene());
    const auto mains = reading.functions_named("mainImage");
    if (mains.empty()) fail("no mainImage");
    const Function& main = reading.functions[mains.back()];
    const Declaration& place = reading.declarations[main.parameters.back()];
    const auto brace = static_cast<std::ptrdiff_t>(reading.tokens[main.body.begin].begin);
    return fmt::format("watch = [\"{}@{}\"]\n", reading.word(place.names.front().name),
                       std::count(text.begin(), text.begin() + brace, '\n') + 1);
}

struct Bench {
    Bench(std::string program, std::string scene) : name(std::move(scene)) {
        ::setenv("GLINT_BENCHED", program.c_str(), 1);
        const fs::path here = GLINT_REPOSITORY, own = folder.path();
        fs::create_directories(own / "fragments");
        fs::create_directories(own / "presets");
        const fs::path text = own / "fragments" / (name + ".frag");
        const fs::path preset = own / "presets" / (name + ".toml");
        fs::copy_file(here / "fragments" / (name + ".frag"), text);
        write(preset, watch_of(read(text)) + read(here / "presets" / (name + ".toml")));
        glint.emplace(screen.name(), own, std::vector<std::string>{preset.string()},
                      shader_cache(own / "shaders"));
        if (!eventually([&] { return screen.window() != 0; }, 60.0)) fail("no window");
        screen.resize_window(kSize);
        if (!glint->says(": shown", 1, 300.0)) fail(glint->errors());
        screen.tap("Control_L+space");
        screen.tap("Control_L+t");
        screen.move(kFree);
    }

    // Which pixels of the panel are a value's.
    std::vector<bool> values() const {
        std::vector<bool> ink;
        for (const std::uint32_t pixel : screen.picture(kPanel, kPanelSize))
            ink.push_back((pixel & 0xffffff) == kValueInk);
        return ink;
    }
    static bool has_any(const std::vector<bool>& ink) {
        return std::ranges::find(ink, true) != ink.end();
    }

    void run(int count) {
        auto start = Clock::now();
        screen.tap("Control_L+i");
        if (!eventually([&] { return has_any(values()); }, 300.0)) fail("no value is told");
        first = ms_since(start);
        for (int i = 1; i <= count; ++i) {
            std::this_thread::sleep_for(500ms);  // as a person looks at it
            const auto before = values();
            // Evenly all over it (Roberts 2018), so that moves are long and no two the same.
            const glm::dvec2 at = glm::fract(double(i) * glm::dvec2(0.7548776662, 0.5698402910));
            start = Clock::now();
            screen.move(kFree + glm::ivec2(at * glm::dvec2(kFreeSize)));
            if (eventually([&] { return values() != before; }, 20.0))
                hovers.push_back(ms_since(start));
            else
                ++silent;
        }
    }

    void print() const {
        std::cout << fmt::format("{{\"first\": [{:.1f}], \"hover\": [{:.1f}], \"silent\": {}}}\n",
                                 first, fmt::join(hovers, ", "), silent);
    }

    Folder folder;
    Screen screen;
    std::string name;
    std::optional<Glint> glint;
    double first = 0.0;
    std::vector<double> hovers;
    int silent = 0;
};

}  // namespace
}  // namespace glint::window

int main(int argc, char** argv) {
    if (argc != 4) glint::window::fail("window_hover_latency GLINT SCENE COUNT");
    glint::window::Bench bench(argv[1], argv[2]);
    bench.run(std::atoi(argv[3]));
    bench.print();
    return 0;
}
