// What the panels write and where they stand: numbers, keys, columns.
#include "window/ui/layout.h"
#include "window/ui/number_text.h"
#include "window/ui/shortcuts.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace glint::text_test {
namespace {

Tweak ranged(double min, double max, double step = 0.0) {
    Tweak tweak;
    tweak.min = min;
    tweak.max = max;
    tweak.step = step;
    return tweak;
}

TEST(NumberText, APixelOfALoweredPictureIsToldAtFullSizeToo) {
    EXPECT_EQ(pixel_text({3, 4}, {640, 360}, {}), "pixel 3, 4 of 640 \u00d7 360");
    EXPECT_EQ(pixel_text({150, 30}, {240, 135}, glm::ivec2(401, 81)),
              "pixel 150, 30 of 240 \u00d7 135 (401, 81 at full size)");
}

TEST(NumberText, ATimeIsSecondsOrMinutesOrHours) {
    for (const auto& [text, seconds] : std::initializer_list<std::pair<const char*, double>>{
             {"90", 90}, {"0.5", 0.5}, {"1:30", 90}, {"1:00:30.5", 3630.5}, {"90:00", 5400}})
        EXPECT_EQ(parse_clock(text), seconds) << text;
    for (const char* none : {"", "x", "-1", "1:", ":30", "1:60", "1.5:30", "1:2:3:4", "nan"})
        EXPECT_FALSE(parse_clock(none)) << none;
}

TEST(NumberText, HasTheDigitsThatTheRangeDeserves) {
    EXPECT_EQ(number_text(ranged(0, 1), 0.5), "0.500");
    EXPECT_EQ(number_text(ranged(-180, 180), 20), "20.0");
    EXPECT_EQ(number_text(ranged(0, 2, 0.25), 0.75), "0.75");
    EXPECT_EQ(number_text(ranged(0, 1e-3), 5e-4), "0.000500");
    EXPECT_EQ(number_text(ranged(0, 1e-4, 1e-7), 5e-5), "0.0000500");
    Tweak whole = ranged(0, 9);
    whole.type = TweakType::int1;
    EXPECT_EQ(number_text(whole, 3), "3");
    EXPECT_EQ(number_text(ranged(0, 1), 1.0 / 0.0), "inf");
}

TEST(NumberText, ShortNumbersFitColumns) {
    EXPECT_EQ(short_number(0), "0");
    EXPECT_EQ(short_number(12345.6), "12346");
    EXPECT_EQ(short_number(0.1234567), "0.1235");
    EXPECT_EQ(short_number(-1.2345e-5), "-1.23e-5");
    EXPECT_EQ(short_number(3.4e38), "3.40e38");
}

TEST(NumberText, AFractionOfTheRangeLeadsBack) {
    Tweak logarithmic = ranged(0.1, 100);
    logarithmic.log = true;
    Tweak minute = ranged(1e-12, 1e-3);
    minute.log = true;
    for (const Tweak& tweak : {ranged(0, 1), ranged(-5, 3), ranged(0, 2, 0.25), logarithmic, minute,
                               ranged(0, 1e-9), ranged(0, 8e-5, 1e-7)})
        for (const double t : {0.0, 0.125, 0.5, 0.875, 1.0}) {
            const double value = value_at(tweak, t);
            EXPECT_NEAR(fraction_of(tweak, value), t, 0.001);
            EXPECT_EQ(value_at(tweak, fraction_of(tweak, value)), value);
        }
}

TEST(Shortcuts, NoKeyMeansTwoThingsAndNoneIsTheScenes) {
    std::set<std::pair<int, int>> seen;
    for (const Shortcut& shortcut : kShortcuts) {
        EXPECT_TRUE(seen.emplace(shortcut.key, shortcut.modifiers).second) << shortcut.keys;
        const bool is_plain = shortcut.modifiers == 0 && shortcut.key < GLFW_KEY_ESCAPE;
        EXPECT_FALSE(is_plain) << shortcut.keys;
        EXPECT_EQ(action_of(shortcut.key, shortcut.modifiers | GLFW_MOD_NUM_LOCK), shortcut.action);
    }
    EXPECT_FALSE(action_of(GLFW_KEY_SPACE, 0));
}

TEST(Layout, PanelsStandInsideTheScreenAndLeaveRoomForThePicture) {
    const Theme theme{.scale = 1.0f};
    for (const ImVec2 screen : {ImVec2{1280, 720}, {640, 360}, {300, 300}, {3840, 2160}}) {
        Layout layout;
        layout.places.width = {2000, 2000};
        layout.wanted = {5000, 5000, 50};
        layout.bar = {{8, 8}, {300, 30}};
        layout.transport = {{8, screen.y - 48}, {screen.x - 16, 40}};
        layout.arrange(theme, screen, {true, true, true});
        float covered = 0.0f;
        for (const Area& area : layout.areas) {
            EXPECT_GE(area.corner.x, 0.0f);
            EXPECT_LE(area.right(), screen.x);
            EXPECT_LE(area.bottom(), layout.transport.corner.y + 1.0f);
            covered += area.size.x * area.size.y;
        }
        EXPECT_LT(covered, 0.75f * screen.x * screen.y);
        EXPECT_GT(layout.free.size.x, 0.15f * screen.x);
    }
}

}  // namespace
}  // namespace glint::text_test
