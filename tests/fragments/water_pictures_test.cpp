// The pool's pictures: what its two ways of drawing leave out, how near they are, and that no
// tweak, size, mouse or age makes anything in them that is not finite.
#include "water.h"

#include <algorithm>
#include <cmath>

namespace glint::water_pictures_test {
namespace {

std::vector<std::string> drawn(const std::string& tweaks) {
    const Player player(water_text(), {.size = {16, 9}, .preset = "[tweaks]\n" + tweaks});
    std::vector<std::string> names;
    for (const GraphPass& pass : player.renderer().graph().passes)
        names.push_back(pass_name(player.preset.scene, pass.pass));
    return names;
}

TEST_F(Water, EachWayOfDrawingLeavesOutThePassesOfTheOther) {
    const auto has = [](const std::vector<std::string>& names, const char* name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    const auto traced = drawn("water = \"traced\"\n"), planar = drawn("water = \"planar\"\n");
    for (const char* name : {"mirror", "below", "dudv"}) {
        EXPECT_FALSE(has(traced, name)) << name;
        EXPECT_TRUE(has(planar, name)) << name;
    }
    EXPECT_TRUE(has(traced, "pond"));
    const auto still = drawn("water = \"traced\"\nripples = false\n");
    for (const char* name : {"bedEast", "pushes", "pond", "relief", "heights", "peaks", "crest"})
        EXPECT_FALSE(has(still, name)) << name;
    EXPECT_FALSE(has(drawn("ripples = false\nwaveHeight = 0\nlanterns = 0\n"), "floats"));
}

// On level water the classic pictures are the truth, but for what their own pixels blur: both ways
// must show the same, waterlines included.
TEST_F(Water, BothWaysShowTheSameStillWater) {
    const std::string tweaks = "ripples = false\nwaveHeight = 0\n";
    constexpr glm::ivec2 kSize(192, 108);
    Player traced(water_text(),
                  {.size = kSize, .preset = "[tweaks]\nwater = \"traced\"\n" + tweaks});
    Player planar(water_text(),
                  {.size = kSize, .preset = "[tweaks]\nwater = \"planar\"\n" + tweaks});
    traced.draw(0);
    planar.draw(0);
    const std::vector<float> a = traced.floats(), b = planar.floats();
    double sum = 0.0;
    int far_off = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += std::pow(a[i] - b[i], 2.0);
        far_off += std::abs(a[i] - b[i]) > 0.25f;
    }
    const double rmse = std::sqrt(sum / static_cast<double>(a.size()));
    fmt::print("still water: RMSE {:.4f}, {:.3f} % of values off by a quarter\n", rmse,
               100.0 * far_off / static_cast<double>(a.size()));
    EXPECT_LE(rmse, 0.04) << "edges and joints are as sharp as a picture's pixels";
    EXPECT_LE(far_off, 0.004 * static_cast<double>(a.size()));
}

// The scene without its display curve, which would hide what is not a number, and a coarse pond.
std::string bare() {
    return with_cells(
        replaced(water_text(),
                 "vec4(display(exp2(exposure) * sum / float(antialias)) + dither(fragCoord), 1.0)",
                 "vec4(exp2(exposure) * sum / float(antialias), 1.0)"),
        {64, 96});
}

// The first pass of which a buffer holds something that is not finite.
std::string not_finite(const Player& player) {
    const Renderer& renderer = player.renderer();
    for (std::size_t i = 0; i < renderer.graph().passes.size(); ++i) {
        for (const float value : renderer.read_buffer(i, 0)) {
            if (!std::isfinite(value))
                return pass_name(player.preset.scene, renderer.graph().passes[i].pass);
        }
    }
    return {};
}

const std::string kPressNow = "[[events]]\nt = 0.01\nmouse = [0.5, 0.3]\ndown = true\n";

// A tweak at its least or greatest value.
TweakValue at_end(const Tweak& tweak, bool greatest) {
    TweakValue value{};
    double end = greatest ? 1.0 : 0.0;
    if (tweak.min) end = greatest ? *tweak.max : *tweak.min;
    if (!tweak.names.empty()) end = greatest ? static_cast<double>(tweak.names.size()) - 1.0 : 0.0;
    value.fill(end);
    return value;
}

TEST_F(Water, EveryTweakAtItsEndsIsFinite) {
    for (const char* way : {"planar", "traced"}) {
        Player player(bare(), {.size = {24, 14},
                               .preset = fmt::format("[tweaks]\nwater = \"{}\"\n", way) + kPressNow,
                               .specialise = false});
        const std::vector<TweakValue> defaults = player.preset.values;
        const auto check = [&](const std::string& what) {
            player.renderer().reset();
            player.still(0.1);
            EXPECT_EQ(not_finite(player), "") << way << ", " << what;
        };
        const auto& tweaks = player.preset.scene.tweaks;
        for (std::size_t i = 1; i < tweaks.size(); ++i) {
            for (const bool greatest : {false, true}) {
                player.preset.values = defaults;
                player.preset.values[i] = at_end(tweaks[i], greatest);
                check(fmt::format("{} {}", tweaks[i].name, greatest));
            }
        }
        for (const bool greatest : {false, true}) {
            for (std::size_t i = 1; i < tweaks.size(); ++i) {
                player.preset.values[i] = at_end(tweaks[i], greatest);
                // Many paths a pixel times many steps a path are beyond llvmpipe's budget of turns.
                if (tweaks[i].quality && greatest) player.preset.values[i] = defaults[i];
            }
            check(greatest ? "all at their greatest" : "all at their least");
        }
    }
}

TEST_F(Water, RandomTweaksAreFinite) {
    Player player(bare(), {.size = {24, 14}, .preset = kPressNow, .specialise = false});
    std::mt19937 random(13);
    const auto& tweaks = player.preset.scene.tweaks;
    for (int k = 0; k < 64; ++k) {
        for (std::size_t i = 0; i < tweaks.size(); ++i) {
            const TweakValue low = at_end(tweaks[i], false), high = at_end(tweaks[i], true);
            if (tweaks[i].quality) continue;
            for (std::size_t c = 0; c < 4; ++c)
                player.preset.values[i][c] = uniform(random, low[c], high[c]);
            if (tweaks[i].type == TweakType::int1 || tweaks[i].type == TweakType::bool1)
                player.preset.values[i][0] = std::round(player.preset.values[i][0]);
        }
        player.renderer().reset();
        player.still(0.1);
        EXPECT_EQ(not_finite(player), "") << "case " << k;
    }
}

TEST_F(Water, AnySizeAndMouseAndAgeIsFinite) {
    for (const char* way : {"planar", "traced"}) {
        const std::string tweaks = fmt::format("[tweaks]\nwater = \"{}\"\n", way);
        Player player(bare(), {.size = {1, 1}, .preset = tweaks});
        for (const glm::ivec2 size : {glm::ivec2(1, 1), {7, 3}, {1, 512}, {512, 1}, {64, 36}}) {
            player.renderer().resize(size);
            for (const glm::vec4 mouse : {glm::vec4(0),
                                          {0, 0, 0, 0.5f},
                                          {size.x, size.y, 1, 1},
                                          {-50, 4000, -9, -9},
                                          {1, 1, 900, -900}}) {
                Frame frame;
                frame.time = 0.05;
                frame.input.mouse = mouse;
                player.renderer().reset();
                player.draw(frame);
                EXPECT_EQ(not_finite(player), "") << way << ", " << size.x << " x " << size.y;
            }
        }
        Player old(bare(), {.size = {48, 27}, .preset = tweaks + "ripples = false\n"});
        for (const double time : {0.0, 3600.0, 86400.0, 2592000.0, 31536000.0}) {
            Frame frame;
            frame.time = time;
            old.draw(frame);
            EXPECT_EQ(not_finite(old), "") << way << ", " << time << " s";
        }
    }
}

}  // namespace
}  // namespace glint::water_pictures_test
