// From the mouse to a value: prints, and judges nothing.
//
//     hover_latency [--markdown] [SCENE...]
//
// Each scene's main preset at 640x360, paused, with its values written in; the source panel's side
// of the window without its panels. At each of five places of the text forty lines are in view: the
// first answer there is compiled for, those at twenty pixels after it are not.
#include "gl/context.h"
#include "window/live/live_probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <random>
#include <string>
#include <thread>
#include <vector>

namespace glint {
namespace {

constexpr glm::ivec2 kSize{640, 360};
constexpr int kPlaces = 5, kPixels = 20, kLines = 40;
constexpr double kLongest = 120'000.0;  // ms

std::string quantile(std::vector<double> values, double share) {
    if (values.empty()) return "-";
    std::ranges::sort(values);
    const auto last = static_cast<double>(values.size() - 1);
    return fmt::format("{:.0f}", values[static_cast<std::size_t>(std::lround(last * share))]);
}

// So many lines from a random one on.
Span random_lines(const std::string& text, std::mt19937& random) {
    std::vector<std::size_t> begins = {0};
    for (std::size_t at = text.find('\n'); at + 1 < text.size(); at = text.find('\n', at + 1))
        begins.push_back(at + 1);
    const std::size_t first =
        random() % std::max<std::size_t>(begins.size() > kLines ? begins.size() - kLines : 1, 1);
    const std::size_t last = first + kLines;
    return {begins[first], last < begins.size() ? begins[last] : text.size()};
}

void wait_a_moment() {
    std::this_thread::sleep_for(std::chrono::microseconds(500));
}

// Until it is told; ms. Negative where it was not.
double answer_ms(Playground& playground, LiveProbe& probe, const ProbeQuestion& question) {
    const Stopwatch clock;
    while (clock.ms() < kLongest) {
        if (probe.follow(playground, question)) return clock.ms();
        wait_a_moment();
    }
    return -1.0;
}

bool open(Playground& playground, const std::string& preset) {
    playground.open(preset);
    const Stopwatch clock;
    while (clock.ms() < kLongest) {
        playground.update();
        playground.draw(0.0);
        if (playground.has_picture() && playground.replayed() >= 1.0) {
            playground.apply(TimeEdit::What::pause);
            return true;
        }
        wait_a_moment();
    }
    return false;
}

void measure(const std::string& scene, bool markdown) {
    const auto context = make_egl_context("");
    Playground playground(*context, kSize);
    if (!open(playground, std::string(GLINT_REPOSITORY) + "/presets/" + scene + ".toml")) return;
    LiveProbe probe("");
    std::mt19937 random(7);
    std::vector<double> first, hover, values;
    for (int place = 0; place < kPlaces; ++place) {
        ProbeQuestion question{.lines = random_lines(playground.preset()->scene.text, random)};
        for (int i = 0; i <= kPixels; ++i) {
            question.pixel =
                glm::ivec2(static_cast<int>(random() % 640u), static_cast<int>(random() % 360u));
            const double ms = answer_ms(playground, probe, question);
            if (ms >= 0.0) (i == 0 ? first : hover).push_back(ms);
        }
        ProbeFact fact;
        probe.tell(fact);
        if (!fact.problem.empty()) fmt::print(stderr, "{}: {}\n", scene, fact.problem);
        values.push_back(static_cast<double>(fact.values.size()));
    }
    fmt::print(
        fmt::runtime(markdown ? "| {} | {} | {} | {} | {} |\n" : "{:12} {:>8} {:>8} {:>8} {:>8}\n"),
        scene, quantile(hover, 0.5), quantile(hover, 0.95), quantile(first, 0.5),
        quantile(first, 1.0));
    std::fflush(stdout);
}

}  // namespace
}  // namespace glint

int main(int count, char** words) {
    std::vector<std::string> scenes(words + 1, words + count);
    const bool markdown = std::erase(scenes, "--markdown") > 0;
    if (scenes.empty())
        scenes = {"analytic", "boat", "caustics", "christmas", "deep_ocean",
                  "magic",    "sea",  "terrain",  "water"};
    if (markdown)
        fmt::print(
            "| scene | value, median | 95 % | first of other lines, median | longest |\n"
            "| --- | --- | --- | --- | --- |\n");
    else
        fmt::print("{:12} {:>8} {:>8} {:>8} {:>8}   ms\n", "scene", "median", "95 %", "compiled",
                   "longest");
    for (const std::string& scene : scenes) glint::measure(scene, markdown);
}
