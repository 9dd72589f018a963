// How long an edit of a shipped scene, and the first move of its sliders, take
// to the screen:
//
//     window_save_latency GLINT SCENE COUNT
//
// A copy of the scene and its preset is open, paused, in a window of 320x180,
// with a driver that has kept nothing. Each edit waits until the window has
// nothing left to do, as it has when a person thinks, and is one that the
// driver has never seen. Pictures that stand still are not refined: that would
// be waited for, and ends with any edit. Prints one line of JSON, and judges nothing.
#include "glsl/numbers.h"
#include "glsl/reading.h"
#include "live.h"
#include "scene/scene_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <map>
#include <optional>
#include <ranges>
#include <thread>

namespace glint::window {
namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

constexpr glm::ivec2 kSize{320, 180};
constexpr glm::ivec2 kPlace{80, 20}, kPart{160, 120};  // of the picture, where no notice stands

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

[[noreturn]] void fail(const std::string& why) {
    std::cerr << why << '\n';
    std::exit(1);
}

// A place in a text where a number stands, or where a statement may.
struct Place {
    std::size_t begin = 0, end = 0;
};

bool is_free_number(const Token& token) {
    const std::string_view text = token.text;
    if (token.kind != TokenKind::number || token.use != kNone || text.starts_with("0x"))
        return false;
    if (text.find('.') == text.npos || text.find_first_of("eEfF") != text.npos) return false;
    const double value = std::strtod(std::string(text).c_str(), nullptr);
    return value != 0.0 && value != 1.0;
}

// Where the edits of a scene go.
struct Places {
    std::optional<Place> in_main, in_helper;
    std::size_t end_of_main = 0;  // before its closing brace
    std::string colour;           // the name of its first parameter
};

class Finder {
public:
    explicit Finder(const std::string& text) : reading_(read_glsl(text, known_of_scene())) {}

    Places find() const {
        Places places;
        const auto mains = reading_.functions_named("mainImage");
        if (mains.empty()) fail("no mainImage");
        const Function& main = reading_.functions[mains.back()];
        const std::vector<bool> reached = reading_.reached_from({"mainImage"});
        places.in_main = number_in(main);
        places.end_of_main = reading_.tokens[main.body.end - 1].begin;
        places.colour =
            reading_.word(reading_.declarations[main.parameters.front()].names.front().name);
        // The longest of those that it calls, however deep.
        std::uint32_t longest = 0;
        for (std::uint32_t i = 0; i < reading_.functions.size(); ++i) {
            const Function& one = reading_.functions[i];
            const bool is_main = std::ranges::find(mains, i) != mains.end();
            const auto place = number_in(one);
            if (!reached[i] || is_main || !place || one.body.size() < longest) continue;
            longest = one.body.size();
            places.in_helper = place;
        }
        return places;
    }

private:
    std::optional<Place> number_in(const Function& function) const {
        for (std::uint32_t at = function.body.begin; at < function.body.end; ++at) {
            const Token& token = reading_.tokens[at];
            const bool is_argument_of_pow = at > 0 && reading_.tokens[at - 1].is(",");
            if (is_free_number(token) && !is_argument_of_pow && !is_constant(at))
                return Place{token.begin, token.end};
        }
        return std::nullopt;
    }
    bool is_constant(std::uint32_t at) const {
        return std::ranges::any_of(reading_.declarations, [&](const Declaration& one) {
            return one.is_const && one.tokens.begin <= at && at < one.tokens.end;
        });
    }
    Reading reading_;
};

// A number that differs by its share of a thousandth: the more often, the more.
std::string changed_number(const std::string& text, Place place, int times) {
    const double value =
        std::strtod(text.substr(place.begin, place.end - place.begin).c_str(), nullptr);
    return fmt::format("{:.7f}", value * (1.0 + 0.0005 * times));
}

// Whether a quarter of the pixels differ by a tenth of the range: a picture that stood still had
// been refined, which any move ends before there is a new one.
bool is_another(const std::vector<std::uint32_t>& a, const std::vector<std::uint32_t>& b) {
    const auto differs = [](std::uint32_t p, std::uint32_t q) {
        for (int shift = 0; shift < 24; shift += 8)
            if (std::abs(static_cast<int>(p >> shift & 255) - static_cast<int>(q >> shift & 255)) >
                25)
                return true;
        return false;
    };
    std::size_t count = 0;
    for (std::size_t i = 0; i < a.size(); ++i) count += differs(a[i], b[i]);
    return 4 * count > a.size();
}

struct Bench {
    Bench(std::string program, std::string scene, int count)
        : name(std::move(scene)), rounds(count) {
        ::setenv("GLINT_BENCHED", program.c_str(), 1);
        const fs::path here = repository();
        // Alone: the window draws small pictures of what else lies there.
        for (const std::string& part :
             {"fragments/" + name + ".frag", "presets/" + name + ".toml"}) {
            fs::create_directories((folder.path() / part).parent_path());
            fs::copy_file(here / part, folder.path() / part);
        }
        file = folder.path() / "fragments" / (name + ".frag");
        original = read(file);
        places = Finder(original).find();
        const fs::path preset = folder.path() / "presets" / (name + ".toml");
        const fs::path resolution = folder.path() / "home/.local/state/glint/resolution";
        fs::create_directories(resolution.parent_path());
        write(resolution, "held plain 0 " + fs::canonical(preset).string() + "\n");
        glint.emplace(
            screen.name(), folder.path(), std::vector<std::string>{preset.string()},
            // Its own: the one that tests share may hold these very edits, from another call.
            shader_cache(folder.path() / "shaders"));
        if (!eventually([&] { return screen.window() != 0; }, 60.0))
            fail("no window: " + glint->errors());
        screen.resize_window(kSize);
        if (!glint->says(": shown", 1, 300.0)) fail(glint->errors());
        screen.tap("Control_L+space");
        screen.tap("Tab");  // the picture alone
        wait_until_quiet();
    }

    // No process of the window has used a processor for half a second.
    void wait_until_quiet() {
        double before = glint->cpu_seconds();
        for (int quiet = 0; quiet < 5;) {
            std::this_thread::sleep_for(100ms);
            const double now = glint->cpu_seconds();
            quiet = now - before < 0.015 ? quiet + 1 : 0;
            before = now;
        }
    }

    void save(const char* kind, const std::string& text) {
        wait_until_quiet();
        const int shown = glint->count(": shown;"), sketched = glint->count(": sketched");
        const auto start = Clock::now();
        write(file, text);
        const auto is_seen = [&] {
            return glint->count(": sketched") > sketched || glint->count(": shown;") > shown;
        };
        if (!eventually(is_seen, 300.0)) fail(glint->errors());
        add(kind, ms_since(start));
        if (!glint->says(": shown;", shown + 1, 300.0)) fail(glint->errors());
        add(kind + std::string("_for_good"), ms_since(start));
    }

    // All sliders at once, by the key that rolls a random look; and back.
    void move(const char* chord) {
        wait_until_quiet();
        const auto before = screen.picture(kPlace, kPart);
        const auto start = Clock::now();
        screen.tap(chord);
        const bool seen =
            eventually([&] { return is_another(screen.picture(kPlace, kPart), before); }, 3.0);
        if (seen) add("slider", ms_since(start));
    }

    // From a key to the panels, while a save that differs by a line is compiled and shown.
    void panels_during(const std::string& text) {
        wait_until_quiet();
        const int shown = glint->count(": shown;");
        write(file, text);
        std::this_thread::sleep_for(30ms);
        for (int i = 0; i < 8; ++i) {
            const auto bar = [&] { return screen.picture({0, 0}, {kSize.x, 12}); };
            const auto before = bar();
            const auto start = Clock::now();
            screen.tap("Tab");
            if (eventually([&] { return bar() != before; }, 30.0)) add("panel", ms_since(start));
            std::this_thread::sleep_for(60ms);
        }
        glint->says(": shown;", shown + 1, 300.0);
    }

    // The text with all edits so far.
    std::string edited() const {
        std::map<std::size_t, std::pair<std::size_t, std::string>> edits;  // begin, end, text
        const auto change = [&](const std::optional<Place>& place, int often) {
            if (place && often > 0)
                edits[place->begin] = {place->end, changed_number(original, *place, often)};
        };
        change(places.in_main, main_edits);
        change(places.in_helper, helper_edits);
        std::string more;
        for (int i = 0; i < lines; ++i)
            more += fmt::format("    {}.x += {:.7f};\n", places.colour, 1e-5 * (i + 1));
        edits[places.end_of_main] = {places.end_of_main, more};
        std::string text = original;
        for (const auto& [begin, edit] : edits | std::views::reverse)
            text.replace(begin, edit.first - begin, edit.second);
        return text;
    }

    // Each edit is made to the one before.
    void run() {
        constexpr int kPanels = 4;  // rounds for one look at the panels, which takes eight
        for (int i = 0; i < rounds; ++i) {
            if (places.in_main) save("main", (++main_edits, edited()));
            if (places.in_helper) save("helper", (++helper_edits, edited()));
            move("Control_L+g");
            move("Control_L+z");
            save("line", (++lines, edited()));
            if (i % kPanels == 0) panels_during((++lines, edited()));
        }
    }

    void add(const std::string& kind, double ms) { times[kind].push_back(ms); }

    void print() const {
        std::string text = fmt::format("{{\"scene\": \"{}\"", name);
        for (const auto& [kind, values] : times)
            text += fmt::format(", \"{}\": [{:.1f}]", kind, fmt::join(values, ", "));
        std::cout << text << "}\n";
    }

    Folder folder;
    Screen screen;
    std::string name;
    int rounds;
    fs::path file;
    std::string original;
    Places places;
    int main_edits = 0, helper_edits = 0, lines = 0;
    std::optional<Glint> glint;
    std::map<std::string, std::vector<double>> times;
};

}  // namespace
}  // namespace glint::window

int main(int argc, char** argv) {
    if (argc != 4) glint::window::fail("window_save_latency GLINT SCENE COUNT");
    glint::window::Bench bench(argv[1], argv[2], std::atoi(argv[3]));
    bench.run();
    bench.print();
    return 0;
}
