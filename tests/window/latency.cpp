// How long a save takes to the changed screen, and where the time goes: prints, and judges nothing.
#include "live.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>
#include <sstream>
#include <thread>

namespace glint::window {
namespace {

using Clock = std::chrono::steady_clock;

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0 : values[values.size() / 2];
}

double p95(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values.empty() ? 0.0 : values[(values.size() - 1) * 95 / 100];
}

// "… read 0.2, trial 21.3, compile 4.0, first frame 7.1 ms" of the last reload.
double number_after(const std::string& line, const std::string& word) {
    const std::size_t at = line.find(word + " ");
    return at == std::string::npos ? 0.0
                                   : std::strtod(line.c_str() + at + word.size() + 1, nullptr);
}

struct Sums {
    std::map<std::string, std::vector<double>> parts;
    void add(const std::string& name, double ms) { parts[name].push_back(ms); }
    void print(const std::string& title) const {
        std::cout << title << '\n';
        for (const char* name :
             {"total", "notice and show", "read", "trial", "compile", "first frame"}) {
            const auto& values = parts.at(name);
            std::cout << fmt::format("  {:<16} median {:7.1f} ms   p95 {:7.1f} ms\n", name,
                                     median(values), p95(values));
        }
    }
};

std::string last_report(const Glint& glint) {
    const std::string all = glint.errors();
    const std::size_t at = all.rfind(": shown;");
    return at == std::string::npos ? "" : all.substr(at, all.find('\n', at) - at);
}

// Saves `text(i)` and waits for the colour of its top right corner, which no panel covers.
Colour a_new_one(int i) {
    return {i % 200 + 20, i / 200 + 20, 90};
}

template <class Text>
Sums measure(Screen& screen, Glint& glint, const fs::path& file, int count, glm::ivec2 at,
             Text text, Colour (*colour_of)(int) = a_new_one) {
    Sums sums;
    for (int i = 1; i <= count; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(20 + i * 7 % 40));
        const int shown = glint.count(": shown;");
        const Colour colour = colour_of(i);
        const std::string content = text(colour);
        const auto start = Clock::now();
        write(file, content);
        const bool seen = eventually([&] { return screen.pixel(at) == colour; }, 120.0);
        const double total =
            std::chrono::duration<double, std::milli>(Clock::now() - start).count();
        if (!seen) {
            std::cout << "save " << i << " was not seen\n" << glint.errors();
            std::exit(1);
        }
        glint.says(": shown;", shown + 1);
        const std::string report = last_report(glint);
        double parts = 0.0;
        for (const char* part : {"read", "trial", "compile", "first frame"}) {
            sums.add(part, number_after(report, part));
            parts += number_after(report, part);
        }
        sums.add("total", total);
        sums.add("notice and show", total - parts);
    }
    return sums;
}

void trivial(int count) {
    Folder folder;
    Screen screen;
    const fs::path file = folder.path() / "scene.frag";
    write(file, flat({1, 2, 3}));
    Glint glint(screen.name(), folder.path(), {file.string()});
    if (!glint.says(": shown")) std::exit(1);
    measure(screen, glint, file, count, {3, 300}, flat)
        .print(fmt::format("one colour at 1280x720, {} saves", count));
}

// Two texts in turn, which Mesa has seen before: the host and the draw alone.
void warm(int count) {
    Folder folder;
    Screen screen;
    const fs::path file = folder.path() / "scene.frag";
    const auto text = [](const Colour& colour) {
        return fmt::format(
            "void mainImage(out vec4 c, in vec2 p) {{\n    float x = p.x;\n"
            "    for (int i = 0; i < 50; ++i) x = sin(x + float(i));\n"
            "    c = p.x < 8.0 ? vec4(vec3({}, 20, 90) / 255.0, 1) : vec4(x);\n}}\n",
            colour.r % 2 + 20);
    };
    write(file, text({}));
    Glint glint(screen.name(), folder.path(), {file.string()});
    eventually([&] { return screen.window() != 0; });
    screen.resize_window({640, 360});
    if (!glint.says(": shown")) std::exit(1);
    const auto wanted = [](int i) { return Colour{(i + 1) % 2 + 20, 20, 90}; };
    measure(screen, glint, file, 4, {3, 180}, text, wanted);
    measure(screen, glint, file, count, {3, 180}, text, wanted)
        .print(fmt::format("50 sines a pixel at 640x360, Mesa's cache warm, {} saves", count));
}

// The picture's own corner is painted over; the rest of the scene is compiled and drawn as it is.
void christmas(int count) {
    Folder folder;
    Screen screen;
    const fs::path here = GLINT_REPOSITORY;
    fs::create_directories(folder.path() / "presets");
    fs::copy(here / "fragments", folder.path() / "fragments", fs::copy_options::recursive);
    fs::copy_file(here / "presets/christmas.toml", folder.path() / "presets/christmas.toml");
    const fs::path file = folder.path() / "fragments/christmas.frag";
    std::string original = read(file);
    const std::string entry = "void mainImage(";
    const std::size_t at = original.rfind(entry);
    if (at == std::string::npos) std::exit(1);
    original.replace(at, entry.size(), "void sceneImage(");
    const auto text = [&](const Colour& colour) {
        return original + fmt::format(
                              "\nvoid mainImage(out vec4 c, in vec2 p) {{\n"
                              "    sceneImage(c, p);\n"
                              "    if (p.x < 8.0) c = vec4(vec3({}, {}, {}) / 255.0, 1.0);\n}}\n",
                              colour.r, colour.g, colour.b);
    };
    write(file, text({1, 2, 3}));
    Glint glint(screen.name(), folder.path(),
                {(folder.path() / "presets/christmas.toml").string()});
    eventually([&] { return screen.window() != 0; });
    screen.resize_window({320, 180});
    if (!glint.says(": shown", 1, 120.0)) {
        std::cout << glint.errors();
        std::exit(1);
    }
    screen.tap("Control_L+space");
    measure(screen, glint, file, count, {3, 90}, text)
        .print(fmt::format("the Christmas preset at 320x180, {} saves", count));
}

}  // namespace
}  // namespace glint::window

int main(int argc, char** argv) {
    const std::string what = argc > 1 ? argv[1] : "all";
    if (what == "warm" || what == "all") glint::window::warm(60);
    if (what == "trivial" || what == "all")
        glint::window::trivial(argc > 2 ? std::atoi(argv[2]) : 200);
    if (what == "christmas" || what == "all")
        glint::window::christmas(argc > 2 ? std::atoi(argv[2]) : 30);
    return 0;
}
