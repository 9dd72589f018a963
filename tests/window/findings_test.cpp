// A study and a check beside the window: they run to their end, their pictures come into the view,
// and nothing is left when they are cancelled or the window closes.
#include "live.h"

#include <fmt/format.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <iterator>
#include <optional>
#include <thread>

namespace glint::window::findings_test {
namespace {

using namespace std::chrono_literals;

// In the column on the left of a window of 1280x720: the button of the study and that of the check,
// and what they find, below.
constexpr glm::ivec2 kRunStudy{320, 100}, kRunCheck{48, 100};
constexpr glm::ivec2 kFoundCorner{24, 140}, kFoundSize{320, 500};
constexpr Colour kAccent{105, 178, 236}, kError{255, 128, 118}, kMagenta{255, 0, 255};

// The left margin tells the tweak's value; the picture converges with it.
std::string converging(int turns) {
    return fmt::format(
        "uniform int steps; //@ 8 [4, 64] log quality reference={1}\n"
        "void mainImage(out vec4 c, in vec2 p) {{\n"
        "    float x = p.x / iResolution.x, sum = 0.0;\n"
        "    for (int i = 0; i < steps * {0}; ++i) sum += sin(x * float(i) / float(steps));\n"
        "    c = vec4(vec3(abs(sum) / float(steps * {0})), 1);\n"
        "    if (p.x < 6.0) c = vec4(vec3(float(min(steps, 64)) / 255.0), 1);\n}}\n",
        turns, turns == 1 ? 1024 : 512);  // so good that 64 is far from its own error, or slow
}

class Findings : public Window {
protected:
    // The processes that do this verb for the window.
    std::vector<pid_t> at_work(std::string_view verb) const {
        std::vector<pid_t> list;
        for (const pid_t child : glint_->children()) {
            const std::string words = read(fmt::format("/proc/{}/cmdline", child));
            if (words.find(fmt::format("glint{0}{1}{0}", '\0', verb)) == 0) list.push_back(child);
        }
        return list;
    }
    bool begins(std::string_view verb) const {
        return eventually([&] { return !at_work(verb).empty(); });
    }
    bool ends(std::string_view verb, double seconds = kPatience) const {
        return eventually([&] { return at_work(verb).empty(); }, seconds);
    }

    int value() const { return screen_->pixel({3, 300}).r; }

    // Middles of all discs of this colour, from top to bottom.
    std::vector<glm::ivec2> discs(const Colour& colour) const {
        const auto pixels = screen_->picture(kFoundCorner, kFoundSize);
        const auto wanted =
            static_cast<std::uint32_t>((colour.r << 16) | (colour.g << 8) | colour.b);
        const auto is = [&](int x, int y) {
            return (pixels[static_cast<std::size_t>(y * kFoundSize.x + x)] & 0xffffff) == wanted;
        };
        std::vector<glm::ivec2> found;
        for (int y = 3; y + 3 < kFoundSize.y; ++y) {
            for (int x = 3; x + 3 < kFoundSize.x; ++x) {
                const bool disc =
                    is(x, y) && is(x - 3, y) && is(x + 3, y) && is(x, y - 3) && is(x, y + 3);
                const glm::ivec2 at = kFoundCorner + glm::ivec2(x, y);
                const bool is_new = found.empty() || std::abs(found.back().x - at.x) > 5 ||
                                    std::abs(found.back().y - at.y) > 5;
                if (disc && is_new) found.push_back(at);
            }
        }
        return found;
    }

    fs::path cache() const { return folder_->path() / "home/.cache/glint"; }
    // Those of windows whose studies have pictures.
    std::ptrdiff_t study_folders() const {
        return std::distance(fs::directory_iterator(cache() / "study"), {});
    }
};

TEST_F(Findings, AStudyRunsToItsEndAndAClickOnAPointAppliesItsValue) {
    open(converging(1));
    screen_->tap("Control_L+space");
    screen_->tap("Control_L+d");
    settle();
    EXPECT_EQ(value(), 8);
    screen_->click(kRunStudy);
    screen_->move({700, 400});
    ASSERT_TRUE(begins("study"));
    ASSERT_TRUE(ends("study"));
    settle();
    // Looked for anew each time: a window that is given no processor looks settled, and is not.
    const auto value_at = [&](bool lowest) {
        screen_->move({700, 400});
        const auto frontier = discs(kAccent);
        if (frontier.size() < 2) return 0;
        screen_->click(lowest ? frontier.back() : frontier.front());
        settle();
        return value();
    };
    EXPECT_TRUE(eventually([&] { return value_at(true) == 64; }))
        << "the lowest has the least error";
    EXPECT_TRUE(eventually([&] {
        const int fastest = value_at(false);
        return fastest > 0 && fastest < 16;
    })) << "4 is the fastest, or where times are uneven the next";
    screen_->move({700, 400});
    screen_->tap("Control_L+z");
    EXPECT_TRUE(eventually([&] { return value() == 64; })) << value();
    std::this_thread::sleep_for(50ms);  // two taps in a moment are the keyboard's own repetition
    screen_->tap("Control_L+z");
    EXPECT_TRUE(eventually([&] { return value() == 8; })) << value();
    EXPECT_EQ(study_folders(), 1);
    screen_->tap("Control_L+q");
    EXPECT_EQ(glint_->wait().code, 0);
    EXPECT_EQ(study_folders(), 0);
}

// Two tweaks at once; the left margin tells both.
TEST_F(Findings, AllQualityTweaksAreStudiedAndDraggedTogether) {
    open(
        "uniform int steps; //@ 8 [4, 64] log quality reference=1024\n"
        "uniform int rays;  //@ 8 [4, 64] log quality reference=1024\n"
        "float sum(int count, float x) {\n"
        "    float s = 0.0;\n"
        "    for (int i = 0; i < count; ++i) s += sin(x * float(i) / float(count));\n"
        "    return s / float(count);\n}\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    vec2 uv = p / iResolution.xy;\n"
        "    c = vec4(sum(steps, uv.x), sum(rays, uv.y), 0, 1);\n"
        "    if (p.x < 6.0) c = vec4(float(min(steps, 64)), float(min(rays, 64)), 0, 255) / "
        "255.0;\n"
        "}\n");
    screen_->tap("Control_L+space");
    screen_->tap("Control_L+d");
    settle();
    screen_->click({140, 100});  // "All quality tweaks"
    settle();
    screen_->click({66, 152});  // "All together"
    screen_->click(kRunStudy);
    screen_->move({700, 400});
    ASSERT_TRUE(begins("study"));
    ASSERT_TRUE(ends("study"));
    settle();
    const auto both = [&] { return screen_->pixel({3, 300}).r + screen_->pixel({3, 300}).g; };
    ASSERT_EQ(both(), 16);
    constexpr glm::ivec2 kFastest{24, 366}, kNearest{322, 366};  // below the diagram
    screen_->click(kNearest);
    EXPECT_TRUE(eventually([&] { return both() > 16; })) << both();
    screen_->drag(kNearest, kFastest);
    EXPECT_TRUE(eventually([&] { return both() < 16; })) << both();
    screen_->tap("Control_L+z");
    EXPECT_TRUE(eventually([&] { return both() > 16; })) << both() << ": a drag is one step";
}

// Each is ended in its own way, and all that it has started with it.
TEST_F(Findings, CancelAReloadAndTheEndOfTheWindowEndAStudy) {
    open(converging(40));
    screen_->tap("Control_L+space");
    screen_->tap("Control_L+d");
    settle();
    const auto run = [&] {
        screen_->click(kRunStudy);
        screen_->move({700, 400});
        ASSERT_TRUE(begins("study"));
    };
    run();
    std::this_thread::sleep_for(300ms);
    screen_->click(kRunStudy);  // which says Cancel now
    EXPECT_TRUE(ends("study", 20.0));
    run();
    write(scene(), converging(41));
    EXPECT_TRUE(ends("study", 20.0));
    settle();
    run();
    const std::vector<pid_t> last = at_work("study");
    glint_->signal(SIGKILL);
    glint_->wait();
    EXPECT_TRUE(eventually([&] { return ::kill(last.front(), 0) != 0; }));
}

TEST_F(Findings, AFailureOfACheckShowsItsFrame) {
    open(read(fs::path(GLINT_REPOSITORY) / "tests/scenes/planted_nan.frag"));
    screen_->tap("Control_L+space");
    screen_->tap("Control_L+k");
    settle();
    screen_->click(kRunCheck);
    screen_->move({700, 400});
    ASSERT_TRUE(begins("check"));
    std::optional<glm::ivec2> failure;
    // The word "fail" in red, below the count of all.
    ASSERT_TRUE(eventually([&] {
        const auto pixels = screen_->picture(kFoundCorner, kFoundSize);
        for (std::size_t i = 0; i < pixels.size() && !failure; ++i) {
            const auto red = static_cast<std::uint32_t>(kError.r << 16 | kError.g << 8 | kError.b);
            const auto at = static_cast<int>(i);
            if ((pixels[i] & 0xffffff) == red)
                failure = kFoundCorner + glm::ivec2(at % kFoundSize.x, at / kFoundSize.x);
        }
        return failure.has_value();
    }));
    screen_->click(*failure);
    screen_->move({1000, 690});
    // The wall is too high: there is no number in the lower half of the frame.
    EXPECT_TRUE(shows(kMagenta, {700, 600}));
    screen_->tap("Escape");
    EXPECT_TRUE(eventually([&] { return screen_->pixel({700, 600}) != kMagenta; }));
    const std::vector<pid_t> last = at_work("check");
    screen_->tap("Control_L+q");
    EXPECT_EQ(glint_->wait().code, 0);
    for (const pid_t process : last) EXPECT_NE(::kill(process, 0), 0);
}

}  // namespace
}  // namespace glint::window::findings_test
