// Every kind of tweak under the mouse: the picture follows, a reload keeps it, undo takes it back
// to the last bit.
#include "live.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <optional>
#include <thread>

namespace glint::window::tweaks_test {
namespace {

using namespace std::chrono_literals;

struct Kind {
    const char* name;
    const char* declaration;  // of `value`
    const char* colour;       // what the scene makes of it
    // From the left of the control, in the row's height: where the mouse goes down and up. A second
    // click, where a popup must be answered.
    glm::ivec2 from, to;
    std::optional<glm::ivec2> then = std::nullopt;
};

std::ostream& operator<<(std::ostream& stream, const Kind& kind) {
    return stream << kind.name;
}

// The row of a scene with a single tweak, in a window of 1280x720: the left of its control.
constexpr glm::ivec2 kControl{1070, 89};

class Tweaks : public Window, public ::testing::WithParamInterface<Kind> {
protected:
    static std::string text(const char* more = "") {
        return fmt::format(
            "{} value; //@ {}\n"
            "void mainImage(out vec4 c, in vec2 p) {{\n"
            "    vec3 v = {};\n"
            "    c = vec4(p.x < 6.0 ? fract(v * 0.731 + 0.11) : v, 1);{}\n}}\n",
            std::string("uniform ") + type(), GetParam().declaration, GetParam().colour, more);
    }
    static std::string type() {
        const std::string name = GetParam().name;
        return name.substr(0, name.find('_'));
    }
    std::vector<std::uint32_t> margin() const { return screen_->picture({0, 100}, {6, 500}); }
    void use_mouse(int y) const {
        const Kind& kind = GetParam();
        const glm::ivec2 corner{kControl.x, y};
        const auto where = corner + kind.then.value_or(kind.to) - 8;
        const auto without = screen_->picture(where, {16, 16});
        screen_->drag(corner + kind.from, corner + kind.to);
        if (kind.then) {
            EXPECT_TRUE(eventually([&] {
                return screen_->picture(where, {16, 16}) != without;
            })) << "a popup";
            settle();
            screen_->drag(corner + *kind.then, corner + *kind.then);
            screen_->tap("Escape");
        }
        screen_->move({500, 400});
    }
};

TEST_P(Tweaks, TheMouseMovesItAReloadKeepsItUndoTakesItBack) {
    open(text());
    screen_->tap("Control_L+space");
    settle();
    const auto before = margin();
    use_mouse(kControl.y);
    ASSERT_TRUE(eventually([&] { return margin() != before; }));
    settle();
    const auto moved = margin();

    write(scene(), text(" // saved again"));
    ASSERT_TRUE(glint_->says(": shown", 2));
    settle();
    EXPECT_EQ(margin(), moved);

    screen_->tap("Control_L+z");
    EXPECT_TRUE(eventually([&] { return margin() == before; }));
    screen_->tap("Control_L+Shift_L+z");
    EXPECT_TRUE(eventually([&] { return margin() == moved; }));

    // With the constants written in, and in a new program without the tweak, it is the same.
    std::this_thread::sleep_for(1s);
    EXPECT_EQ(margin(), moved);
    write(scene(), flat({1, 2, 3}));
    ASSERT_TRUE(shows({1, 2, 3}, {3, 300}));
    ASSERT_TRUE(glint_->says(": shown", 3)) << "a sketch shows it sooner";
    write(scene(), text());
    ASSERT_TRUE(glint_->says(": shown", 4));
    settle();
    EXPECT_EQ(margin(), moved);
}

INSTANTIATE_TEST_SUITE_P(
    Kinds, Tweaks,
    ::testing::Values(
        Kind{"float", "0.25 [0, 1]", "vec3(value)", {15, 0}, {120, 0}},
        Kind{"float_log", "1 [0.01, 100] log", "vec3(log(value) / 10.0)", {15, 0}, {130, 0}},
        Kind{"float_free", "0.25", "vec3(value)", {15, 0}, {120, 0}},
        Kind{"int", "3 [0, 10]", "vec3(float(value) / 10.0)", {15, 0}, {120, 0}},
        Kind{"int_index",
             "3 [0, 10]",
             "vec3(float[11](0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0)[value])",
             {15, 0},
             {120, 0}},
        Kind{"int_menu",
             "0 {off, slow, fast}",
             "vec3(float(value) / 2.0)",
             {15, 0},
             {15, 0},
             glm::ivec2{30, 45}},
        Kind{"bool", "off", "vec3(float(value) * 0.5)", {11, 0}, {11, 0}},
        Kind{"vec3_colour", "#336699", "value", {11, 0}, {11, 0}, glm::ivec2{60, 80}},
        Kind{"vec4_colour",
             "#33669980",
             "value.rgb + value.a",
             {11, 0},
             {11, 0},
             glm::ivec2{60, 80}},
        Kind{"vec2_pad", "0, 0 [-1, 1]", "vec3(value * 0.5 + 0.5, 0)", {20, 20}, {60, 60}},
        Kind{"vec2", "0.1, 0.2", "vec3(value, 0)", {15, 0}, {120, 0}},
        Kind{"vec3", "0, 1, 0", "value * 0.3", {15, 0}, {120, 0}},
        Kind{"vec4", "0.1, 0.2, 0.3, 0.4", "value.rgb + value.a", {15, 0}, {120, 0}}),
    [](const auto& kind) { return std::string(kind.param.name); });

class Drag : public Window {};

TEST_F(Drag, AClickCountsWhereItHappenedAlsoBetweenTwoFramesOfASlowScene) {
    open(
        "uniform bool value; //@ off\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    float x = iTime;\n"
        "    for (int i = 0; i < 150; ++i) x = sin(x + p.x);\n"
        "    c = p.x < 6.0 ? vec4(vec3(value), 1) : vec4(x);\n}\n");
    std::this_thread::sleep_for(1s);
    const auto is_on = [&] { return screen_->pixel({3, 300}).r > 128; };
    for (const bool on : {true, false, true}) {
        screen_->move(kControl + glm::ivec2(11, 0));
        screen_->button(true);
        screen_->button(false);
        screen_->move({500, 400});
        EXPECT_TRUE(eventually([&] { return is_on() == on; })) << on;
    }
}

// The slider is in a person's hand when the file is saved.
TEST_F(Drag, ASaveInTheMiddleOfADragDoesNotTakeTheSliderAway) {
    const std::string text =
        "uniform float value; //@ 0.25 [0, 1]\n"
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(vec3(value), 1); }\n";
    open(text);
    screen_->tap("Control_L+space");
    settle();
    const auto value = [&] { return screen_->pixel({3, 300}).r; };
    const int before = value();
    screen_->move({1085, 89});
    screen_->button(true);
    for (int x = 1090; x <= 1150; x += 10) {
        screen_->move({x, 89});
        std::this_thread::sleep_for(30ms);
    }
    settle();
    const int half = value();
    EXPECT_NE(half, before);
    write(scene(), text + "// saved\n");
    ASSERT_TRUE(glint_->says(": shown", 2));
    settle();
    EXPECT_EQ(value(), half);
    for (int x = 1160; x <= 1210; x += 10) {
        screen_->move({x, 89});
        std::this_thread::sleep_for(30ms);
    }
    settle();
    EXPECT_GT(value(), half);
    screen_->button(false);
    settle();
    screen_->tap("Control_L+z");
    settle();
    EXPECT_EQ(value(), before);  // one entry of the undo list
}

TEST_F(Drag, ASaveThatPutsAnotherTweakInThePlaceOfTheHeldOneMovesNone) {
    const std::string text =
        "uniform float value; //@ 0.25 [0, 1]\n"
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5, value, 0, 1); }\n";
    open(text);
    screen_->tap("Control_L+space");
    settle();
    screen_->move({1085, 89});
    screen_->button(true);
    screen_->move({1120, 89});
    settle();
    write(scene(),
          "uniform float other; //@ 0.5 [0, 1]\n"
          "uniform float value; //@ 0.25 [0, 1]\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(other, value, 0, 1); }\n");
    ASSERT_TRUE(glint_->says(": shown", 2));
    settle();
    const Colour before = screen_->pixel({3, 300});
    for (int x = 1130; x <= 1200; x += 10) {
        screen_->move({x, 89});
        std::this_thread::sleep_for(30ms);
    }
    settle();
    EXPECT_EQ(screen_->pixel({3, 300}).r, before.r) << "what stands there now";
    EXPECT_GT(screen_->pixel({3, 300}).g, before.g) << "what is held";
    screen_->button(false);
}

// A map that takes half a second: its first rows are new on the screen before its last.
TEST_F(Drag, AMapThatTakesLongFollowsInPartsAndEndsWhole) {
    open(
        "uniform float value; //@ 0.25 [0, 1]\n"
        "uniform sampler2D slow; //@ pass mainSlow size=64x512 filter=nearest\n"
        "void mainSlow(out vec4 c, in vec2 p) {\n"
        "    float x = value;\n"
        "    for (int i = 0; i < 20000; ++i) x = fract(1.7 * x + 0.1);\n"
        "    c = vec4(vec3(value + 1e-6 * x), 1);\n}\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    c = texelFetch(slow, ivec2(1, 512.0 * p.y / iResolution.y), 0);\n}\n");
    screen_->tap("Control_L+space");
    settle();
    // The first rows are the lowest ones.
    const auto first = [&] { return screen_->pixel({3, 550}).r; };
    const auto last = [&] { return screen_->pixel({3, 120}).r; };
    const int before = last();
    screen_->drag(kControl + glm::ivec2(15, 0), kControl + glm::ivec2(120, 0));
    EXPECT_TRUE(eventually([&] { return last() == before && std::abs(first() - last()) > 8; }));
    EXPECT_TRUE(eventually([&] { return last() != before && first() == last(); }));
    settle();
    EXPECT_EQ(first(), last());
}

}  // namespace
}  // namespace glint::window::tweaks_test
