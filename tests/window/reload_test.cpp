// Saves of all kinds, mixed with errors, resizes and slider moves: the last content always ends on
// the screen.
#include "live.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <iostream>
#include <limits>
#include <thread>

namespace glint::window::reload_test {
namespace {

using namespace std::chrono_literals;

constexpr glm::ivec2 kMargin{3, 300};  // the border that no panel covers

class Reload : public Window {
protected:
    // Tells a save that was lost from a screen that is behind.
    std::string shown_instead() const {
        const Colour stands = screen_->pixel(kMargin);
        screen_->move({500, 400});
        std::this_thread::sleep_for(1s);
        const Colour moved = screen_->pixel(kMargin);
        return fmt::format(" shows {} {}, and after a move of the mouse {} {}", stands.r, stands.g,
                           moved.r, moved.g);
    }
};

// A flat colour, and above all panels a strip that shows the tweak.
std::string text_of(const Colour& colour) {
    return fmt::format(
        "uniform float level; //@ 0.25 [0, 1]\n"
        "void mainImage(out vec4 c, in vec2 p) {{\n"
        "    c = vec4(vec3({}, {}, {}) / 255.0, 1);\n"
        "    if (p.y > iResolution.y - 6.0) c = vec4(vec3(level), 1);\n"
        "}}\n",
        colour.r, colour.g, colour.b);
}

void write_bytes(int descriptor, std::string_view text) {
    if (::write(descriptor, text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
        throw std::runtime_error("cannot write");
    }
}

void in_place(const fs::path& file, std::string_view text) {
    const int descriptor = ::open(file.c_str(), O_WRONLY);
    write_bytes(descriptor, text);
    if (::ftruncate(descriptor, static_cast<off_t>(text.size())) != 0) std::abort();
    ::close(descriptor);
}

void truncate_and_write(const fs::path& file, std::string_view text) {
    write(file, text);
}

void rename_over(const fs::path& file, std::string_view text) {
    const fs::path beside = file.string() + "~";
    write(beside, text);
    fs::rename(beside, file);
}

void delete_and_create(const fs::path& file, std::string_view text) {
    fs::remove(file);
    write(file, text);
}

// The scene is a link from now on, and its target is somewhere else each time.
void through_a_link(const fs::path& file, std::string_view text) {
    static int number = 0;
    const fs::path folder = file.parent_path() / fmt::format("target{}", number++ % 3);
    fs::create_directories(folder);
    write(folder / "real.frag", text);
    const fs::path beside = file.string() + ".link";
    fs::remove(beside);
    fs::create_symlink(folder / "real.frag", beside);
    fs::rename(beside, file);
}

void twice_at_once(const fs::path& file, std::string_view text) {
    write(file, "void mainImage(out vec4 c, in vec2 p) { c = vec4(1, 0, 1, 1); }\n");
    write(file, text);
}

void in_two_chunks(const fs::path& file, std::string_view text) {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_TRUNC);
    write_bytes(descriptor, text.substr(0, text.size() / 2));
    std::this_thread::sleep_for(2ms);
    write_bytes(descriptor, text.substr(text.size() / 2));
    ::close(descriptor);
}

struct Style {
    const char* name;
    void (*save)(const fs::path&, std::string_view);
};

constexpr std::array kStyles = {
    Style{"in place", in_place},
    Style{"truncate and write", truncate_and_write},
    Style{"rename over", rename_over},
    Style{"delete and create", delete_and_create},
    Style{"through a symlink", through_a_link},
    Style{"twice within a millisecond", twice_at_once},
    Style{"in two chunks", in_two_chunks},
};

// All are told apart, also from those of the other tests.
Colour colour_of(int number) {
    return {number % 200 + 20, number / 200 + 20, 90};
}

// Drawn at once, and compiled for long.
std::string long_text(const Colour& colour) {
    std::string text = "void mainImage(out vec4 c, in vec2 p) {\n    float x = p.x;\n";
    for (int i = 0; i < 300; ++i)
        text += fmt::format("    x = sin(x * {}.5) + pow(abs(cos(x)), {}.25);\n", i, i % 7 + 1);
    return text + fmt::format("    c = vec4(vec3({}, {}, {}) / 255.0 + x * 1e-6, 1);\n}}\n",
                              colour.r, colour.g, colour.b);
}

TEST_F(Reload, ATextThatIsCompiledForLongIsSketchedFirst) {
    // A driver that has not seen it, however often the test is run.
    environment_ = shader_cache(folder_->path() / "driver");
    open(long_text({0, 200, 0}));
    ASSERT_TRUE(shows({0, 200, 0}, kMargin));
    EXPECT_EQ(glint_->count("sketched"), 0) << "there is no window's picture before the first";
    write(scene(), long_text({200, 0, 0}));
    EXPECT_TRUE(shows({200, 0, 0}, kMargin));
    EXPECT_TRUE(glint_->says(": shown;", 2));
    EXPECT_TRUE(shows({200, 0, 0}, kMargin));
    const std::string said = glint_->errors();
    EXPECT_EQ(glint_->count("sketched"), 1);
    EXPECT_EQ(glint_->count("sketched at 640x360"), 1) << "half as wide and high: " << said;
    EXPECT_LT(said.find("sketched"), said.rfind(": shown;")) << said;
}

TEST_F(Reload, EveryWayOfSavingEndsOnTheScreen) {
    open(text_of({1, 2, 3}));
    int number = 0;
    for (const Style& style : kStyles) {
        for (int i = 0; i < 2; ++i) {
            const Colour colour = colour_of(++number);
            style.save(scene(), text_of(colour));
            ASSERT_TRUE(shows(colour, kMargin)) << style.name << "\n" << glint_->errors();
        }
    }
}

// Some are fed to programs that are at hand, some are compiled, and these take over meanwhile.
TEST_F(Reload, NumbersAndLinesMayChangeInAnyOrderAndTheStateIsKept) {
    const auto text = [](int grey, int lines) {
        std::string all =
            "uniform float level; //@ 0.25 [0, 1]\n"
            "uniform sampler2D age; //@ pass mainAge size=1x1\n"
            "void mainAge(out vec4 c, in vec2 p) { c = texture(age, vec2(0.5)) + 1.0; }\n"
            "void mainImage(out vec4 c, in vec2 p) {\n";
        all += fmt::format("    c = vec4(vec3({:.6f}), 1);\n", grey / 255.0);
        for (int i = 0; i < lines; ++i) all += "    c.r += level * 0.0;\n";
        return all + "    if (texture(age, vec2(0.5)).x < 2.5) c = vec4(1, 0, 0, 1);\n}\n";
    };
    open(text(20, 0));
    ASSERT_TRUE(shows({20, 20, 20}, kMargin));
    for (int i = 1; i <= 12; ++i) {
        // Now and then there is time to make everything ready, or half of it.
        std::this_thread::sleep_for(i % 4 == 0 ? 1500ms : i % 3 == 0 ? 500ms : 20ms);
        const int grey = 20 + 10 * i;
        write(scene(), text(grey, i / 3));
        EXPECT_TRUE(eventually([&] {
            const Colour now = screen_->pixel(kMargin);
            EXPECT_EQ(now.r, now.g) << "red: it began again";
            return now == Colour{grey, grey, grey};
        })) << "save "
            << i << shown_instead();
    }
}

TEST_F(Reload, TheLastGoodPictureStaysUnderAnErrorAndGoesOnAfterwards) {
    open(text_of({10, 200, 30}));
    write(scene(), "void mainImage(out vec4 c, in vec2 p) {\n    c = vec4(1, 0, 0, 1)\n}\n");
    ASSERT_TRUE(glint_->says("scene.frag:2:25: error"));
    std::this_thread::sleep_for(300ms);
    EXPECT_TRUE(shows({10, 200, 30}, kMargin, 0.0));
    const auto in_the_middle = [&] { return screen_->picture({300, 100}, {300, 500}); };
    const auto with_errors = in_the_middle();
    write(scene(), text_of({11, 200, 30}));
    ASSERT_TRUE(shows({11, 200, 30}, kMargin));
    EXPECT_TRUE(eventually([&] { return in_the_middle() != with_errors; }));
    EXPECT_TRUE(shows({11, 200, 30}, {450, 300}));  // nothing is over the picture any more
    EXPECT_EQ(glint_->count("error:"), 1);
}

TEST_F(Reload, AnIncludeAnImageAndThePresetAreFollowedToo) {
    const fs::path folder = folder_->path();
    const auto paint = [&](int blue) {
        write(folder / "paint.frag", flat({0, 0, blue}));
        Glint process(screen_->name(), folder,
                      {"still", "paint.frag", "-o", "paint.png", "--size", "4x4"});
        EXPECT_EQ(process.wait(60.0).code, 0) << process.errors();
    };
    paint(100);
    write(folder / "part.glsl", "const vec3 kColour = vec3(10, 20, 30) / 255.0;\n");
    write(folder / "scene.frag",
          "#include \"part.glsl\"\n"
          "uniform float level; //@ 0.2 [0, 1]\n"
          "uniform sampler2D paint; //@ image paint.png\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = vec4(kColour.r, texture(paint, p / 99.0).b, level, 1);\n"
          "}\n");
    write(folder / "look.toml", "scene = \"scene.frag\"\n[tweaks]\nlevel = 0.6\n");
    start({(folder / "look.toml").string()});
    ASSERT_TRUE(shows({10, 100, 153}, kMargin)) << glint_->errors();
    write(folder / "part.glsl", "const vec3 kColour = vec3(40, 50, 60) / 255.0;\n");
    EXPECT_TRUE(shows({40, 100, 153}, kMargin));
    write(folder / "look.toml", "scene = \"scene.frag\"\n[tweaks]\nlevel = 0.8\n");
    EXPECT_TRUE(shows({40, 100, 204}, kMargin));
    paint(120);
    EXPECT_TRUE(shows({40, 120, 204}, kMargin)) << glint_->errors();
}

TEST_F(Reload, APictureThatIsMissingIsToldWithEachTextUntilItIsThereAgain) {
    const fs::path folder = folder_->path(), picture = folder / "paint.png";
    write(folder / "paint.frag", flat({0, 0, 100}));
    Glint process(screen_->name(), folder,
                  {"still", "paint.frag", "-o", "paint.png", "--size", "4x4"});
    EXPECT_EQ(process.wait(60.0).code, 0) << process.errors();
    fs::remove(folder / "stderr.txt");
    const auto text = [](int red) {
        return fmt::format(
            "uniform sampler2D paint; //@ image paint.png\n"
            "void mainImage(out vec4 c, in vec2 p) {{\n"
            "    c = vec4({}.0 / 255.0, 0.2, texture(paint, p / 99.0).b, 1);\n}}\n",
            red);
    };
    open(text(10));
    ASSERT_TRUE(shows({10, 51, 100}, kMargin)) << glint_->errors();
    fs::rename(picture, folder / "away.png");
    EXPECT_TRUE(glint_->says("error: Cannot read", 1, 20.0)) << glint_->errors();
    write(scene(), "\n" + text(20));
    EXPECT_TRUE(shows({20, 51, 100}, kMargin)) << "the picture before";
    EXPECT_TRUE(glint_->says("scene.frag:2:19: error: Cannot read", 1, 20.0)) << glint_->errors();
    const int shown = glint_->count("paint.png: shown");
    fs::rename(folder / "away.png", picture);
    EXPECT_TRUE(glint_->says("paint.png: shown", shown + 1, 20.0)) << glint_->errors();
    write(scene(), text(30));
    EXPECT_TRUE(shows({30, 51, 100}, kMargin));
    EXPECT_EQ(glint_->count("error: Cannot read"), 2) << glint_->errors();
}

TEST_F(Reload, ACubeAVolumeAndASoundAreFollowedAndAnotherInputOfThePresetToo) {
    const fs::path folder = folder_->path();
    const auto make = [&](int blue, const char* loudness) {
        write(folder / "make.frag",
              flat({0, 0, blue}) + fmt::format("vec2 mainSound(int samp, float time) {{ return "
                                               "vec2({}); }}\n",
                                               loudness));
        for (const std::vector<std::string>& words :
             {std::vector<std::string>{"still", "make.frag", "-o", "sky.png", "--size", "8x4"},
              {"sound", "make.frag", "-o", "song.wav", "--seconds", "3"}}) {
            Glint process(screen_->name(), folder, words);
            EXPECT_EQ(process.wait(60.0).code, 0) << process.errors();
        }
    };
    const auto volume = [&](const char* name, char grey) {
        write(folder / name, std::string("BIN\0\1\0\0\0\1\0\0\0\1\0\0\0\1\0\0\0", 20) + grey);
    };
    const auto look = [&](const char* file) {
        write(folder / "look.toml", fmt::format("scene = \"scene.frag\"\ntime = 1\n[channels]\n"
                                                "iChannel0 = {{ volume = \"{}\" }}\n",
                                                file));
    };
    make(100, "0.5");
    volume("a.bin", 10);
    volume("b.bin", 40);
    look("a.bin");
    write(folder / "scene.frag",
          "uniform sampler3D iChannel0;\n"
          "uniform samplerCube sky; //@ cube sky.png\n"
          "uniform sampler2D song; //@ sound song.wav\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    float loud = texelFetch(song, ivec2(0, 1), 0).r > 0.6 ? 0.8 : 0.6;\n"
          "    c = vec4(texture(iChannel0, vec3(0.5)).r, loud, texture(sky, vec3(0, 0, 1)).b, 1);\n"
          "}\n");
    start({(folder / "look.toml").string()});
    ASSERT_TRUE(shows({10, 204, 100}, kMargin)) << glint_->errors();
    make(120, "-0.5");
    EXPECT_TRUE(shows({10, 153, 120}, kMargin)) << glint_->errors();
    volume("a.bin", 20);
    EXPECT_TRUE(shows({20, 153, 120}, kMargin)) << glint_->errors();
    look("b.bin");
    EXPECT_TRUE(shows({40, 153, 120}, kMargin)) << glint_->errors();
    write(folder / "a.bin", "broken");
    write(folder / "b.bin", "broken");
    EXPECT_TRUE(glint_->says("too short for a volume")) << glint_->errors();
    EXPECT_TRUE(shows({40, 153, 120}, kMargin)) << "the last good one stays";
}

// Through a reload, with the constants written in once the tweaks rest, and back to uniforms while
// the slider moves.
TEST_F(Reload, NothingFlickersWhileProgramsAreExchanged) {
    open(text_of({33, 44, 55}));
    for (int i = 0; i < 3; ++i) {
        write(scene(), text_of({33, 44, 55}) + std::string(static_cast<std::size_t>(i), '\n'));
        const auto end = std::chrono::steady_clock::now() + 1500ms;
        while (std::chrono::steady_clock::now() < end) {
            ASSERT_EQ(screen_->pixel(kMargin), (Colour{33, 44, 55}));
        }
        screen_->move({1100, 90});
        screen_->button(true);
        for (int x = 1100; x < 1150; ++x) {
            screen_->move({x, 90});
            ASSERT_EQ(screen_->pixel(kMargin), (Colour{33, 44, 55}));
        }
        screen_->button(false);
    }
}

// The figures are printed; GLINT_SOAK=1000 asks for more than the case that ctest runs.
TEST_F(Reload, ASoakOfReloadsLosesNoSaveAndNoMemory) {
    const char* wanted = std::getenv("GLINT_SOAK");
    const int count = wanted ? std::atoi(wanted) : 120;
    // What is large is mapped for itself and given back when it goes. Left alone, the allocator
    // learns to take whole pictures from its heap, and a small thing above them keeps them all: up
    // to 45 MiB, by chance, beside other work.
    environment_ = {{"MALLOC_MMAP_THRESHOLD_", "262144"}};
    open(text_of(colour_of(0)));
    const std::array<glm::ivec2, 4> sizes = {
        glm::ivec2{1280, 720}, {900, 600}, {640, 480}, {331, 317}};
    Colour good = colour_of(0), level = screen_->pixel({3, 3});
    int errors = 0, resizes = 0, moves = 0;
    std::array<double, 4> least_mib;  // of each quarter, where the window has its first size
    least_mib.fill(std::numeric_limits<double>::infinity());
    for (int i = 1; i <= count; ++i) {
        const Style& style = kStyles[static_cast<std::size_t>(i) % kStyles.size()];
        if (i % 5 == 2) {
            const int refused = glint_->count("not shown");
            style.save(scene(),
                       fmt::format("// {}\nvoid mainImage(out vec4 c, in vec2 p) {{ c = }}\n", i));
            ++errors;
            // Not waited for each time, so that errors and good saves overtake each other.
            if (i % 2) {
                ASSERT_TRUE(glint_->says("not shown", refused + 1));
            }
            // Beside other work the first of two saves may be shown before the second.
            const Colour first{255, 0, 255}, now = screen_->pixel(kMargin);
            const bool is_first = style.save == twice_at_once && now == first;
            ASSERT_TRUE(now == good || is_first) << i << " " << style.name;
        }
        if (i % 10 == 4) {
            screen_->resize_window(sizes[static_cast<std::size_t>(++resizes) % sizes.size()]);
        }
        if (i % 12 == 7) {
            screen_->resize_window(sizes[0]);
            ASSERT_TRUE(eventually([&] { return screen_->window_size() == sizes[0]; }));
            screen_->drag({1100, 90}, {1100 + i % 100, 90});
            ++moves;
        }
        good = colour_of(i);
        style.save(scene(), text_of(good));
        ASSERT_TRUE(shows(good, kMargin)) << i << " " << style.name << shown_instead();
        ASSERT_TRUE(glint_->runs());
        if (i % 12 == 7) {
            double& least = least_mib[static_cast<std::size_t>((i - 1) * 4 / count)];
            least = std::min(least, glint_->resident_mib());
        }
    }
    std::cout << fmt::format(
        "{} reloads, {} errors, {} resizes, {} slider moves; least resident memory in each "
        "quarter: "
        "{:.1f} MiB\n",
        count, errors, resizes, moves, fmt::join(least_mib, ", "));
    EXPECT_TRUE(moves == 0 || screen_->pixel({3, 3}) != level);
    // A leak of one compiled scene (some 100 KiB in the driver) a reload would be 25 KiB * count in
    // each quarter: 3 MiB. Memory comes in pages of 2 MiB, one of which may arrive in each. The
    // first is left out, where what is allocated once arrives; on a busy machine a picture that is
    // kept, of 3.5 MiB, was seen to arrive later, in one step.
#ifndef __SANITIZE_ADDRESS__  // which keeps what was freed, to catch its use
    EXPECT_LT(std::min(least_mib[3] - least_mib[2], least_mib[2] - least_mib[1]), 2.5);
#endif
}

}  // namespace
}  // namespace glint::window::reload_test
