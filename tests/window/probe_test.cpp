// Why is this pixel so? The source beside the picture, under a real mouse.
#include "live.h"

#include <fmt/format.h>

#include <optional>

namespace glint::window::probe_test {
namespace {

constexpr Colour kAccent{105, 178, 236};
// In the column on the left of a window of 1280x720: below the panel's tools.
constexpr glm::ivec2 kLinesCorner{24, 200}, kLinesSize{530, 420};

class Source : public Window {
protected:
    // A colour that no value has, and one value that runs from 0 at the left to 1 at the right.
    void open_slope(double slope = 1.0) {
        open(text(slope));
        screen_->tap("Control_L+space");
        screen_->tap("Control_L+t");
        screen_->tap("Control_L+i");
        settle();
    }
    static std::string text(double slope) {
        return fmt::format(
            "void mainImage(out vec4 c, in vec2 p) {{\n"
            "    float slope = {:.2f} * p.x / iResolution.x;\n"
            "    c = vec4(0.8, 0.1, 0.1, 1.0) + 0.0 * slope;\n}}\n",
            slope);
    }
    std::vector<pid_t> processes() const {
        std::vector<pid_t> list;
        for (const pid_t child : glint_->children())
            if (read(fmt::format("/proc/{}/cmdline", child)).find("probing") != std::string::npos)
                list.push_back(child);
        return list;
    }
    // The first value beside the text: a place in it; none where nothing is told.
    std::optional<glm::ivec2> told() const {
        const auto pixels = screen_->picture(kLinesCorner, kLinesSize);
        constexpr std::uint32_t kWanted = kAccent.r << 16 | kAccent.g << 8 | kAccent.b;
        for (std::size_t i = 0; i < pixels.size(); ++i)
            if ((pixels[i] & 0xffffff) == kWanted)
                return kLinesCorner + glm::ivec2(static_cast<int>(i) % kLinesSize.x,
                                                 static_cast<int>(i) / kLinesSize.x);
        return {};
    }
    bool tells() const {
        return eventually([&] { return told().has_value(); });
    }
    std::vector<std::uint32_t> lines() const { return screen_->picture(kLinesCorner, kLinesSize); }
    static int gray(const Colour& colour) {
        return colour.r == colour.g && colour.g == colour.b ? colour.r : -1;
    }
};

TEST_F(Source, LinesTellTheirValuesUnderTheMouseAndAClickPinsAPixel) {
    open_slope();
    screen_->move({700, 400});
    ASSERT_TRUE(tells());
    settle();
    const auto at_first = lines();
    screen_->move({900, 400});
    EXPECT_TRUE(eventually([&] { return lines() != at_first; })) << "another pixel, another value";
    settle();
    const auto pinned = lines();
    screen_->click({900, 400});
    screen_->move({700, 400});
    settle();
    EXPECT_EQ(lines(), pinned) << "the mouse goes, the pixel stays";
    screen_->tap("Escape");
    EXPECT_TRUE(eventually([&] { return lines() == at_first; })) << "let go";
}

TEST_F(Source, ThePixelUnderTheMouseIsTheOneThatIsSeenThere) {
    open(
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    float here = floor(p.y) == 719.0 - 400.0 ? 0.25 : 0.75;\n"
        "    c = vec4(0.8, 0.1, 0.1, 1.0) + 0.0 * here;\n}\n");
    screen_->tap("Control_L+space");
    screen_->tap("Control_L+t");
    screen_->tap("Control_L+i");
    settle();
    screen_->move({900, 399});
    ASSERT_TRUE(tells());
    settle();
    const auto above = lines();
    screen_->move({900, 400});
    EXPECT_TRUE(eventually([&] { return lines() != above; })) << "the 401st row from the top";
    screen_->move({900, 401});
    EXPECT_TRUE(eventually([&] { return lines() == above; }));
}

TEST_F(Source, AClickOnAValueShowsItInEveryPixelAndASaveIsFollowed) {
    open_slope();
    screen_->click({900, 400});
    ASSERT_TRUE(tells());
    settle();
    screen_->click(*told());
    screen_->move({1000, 600});
    // From black at the left to white at the right, whatever the scene's colour.
    EXPECT_TRUE(eventually([&] { return gray(screen_->pixel({640, 400})) > 0; }));
    EXPECT_NEAR(gray(screen_->pixel({960, 400})), 191, 2) << "3/4 of the way";
    screen_->tap("Escape");
    EXPECT_TRUE(shows({204, 26, 26}, {960, 300}));
    const auto before = lines();
    write(scene(), text(-3.0));
    EXPECT_TRUE(eventually([&] { return lines() != before && told(); })) << "the save's values";
}

TEST_F(Source, CostsNothingWhileItIsClosed) {
    open(text(1.0));
    settle();
    screen_->move({700, 400});
    settle();
    EXPECT_TRUE(processes().empty());
    screen_->tap("Control_L+i");
    EXPECT_TRUE(eventually([&] { return processes().size() == 1; }));
    screen_->tap("Control_L+i");
    EXPECT_TRUE(eventually([&] { return processes().empty(); }));
}

TEST_F(Source, WhatIsWatchedIsKeptInThePreset) {
    write(scene(), text(1.0));
    const fs::path preset = folder_->path() / "look.toml";
    write(preset, "scene = \"scene.frag\"\n# mine\n");
    start({preset.string()});
    ASSERT_TRUE(glint_->says("look.toml: shown")) << glint_->errors();
    screen_->tap("Control_L+space");
    screen_->tap("Control_L+t");
    screen_->tap("Control_L+i");
    screen_->click({900, 400});
    ASSERT_TRUE(tells());
    settle();
    screen_->click(*told(), 3);  // the right button
    settle();
    screen_->tap("Control_L+s");
    EXPECT_TRUE(eventually([&] {
        return read(preset).find("watch = [\"slope@2\"]") != std::string::npos;
    })) << read(preset);
    EXPECT_NE(read(preset).find("# mine"), std::string::npos);
}

}  // namespace
}  // namespace glint::window::probe_test
