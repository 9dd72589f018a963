// Time, mouse and keys by the site's rules.
#include "scene/frame.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace glint::frame_test {
namespace {

constexpr glm::ivec2 kSize(100, 50);
constexpr double kForever = std::numeric_limits<double>::infinity();

glm::dvec2 at(double x, double y) {
    return {x / kSize.x, y / kSize.y};
}

TEST(Mouse, IsZeroBeforeAnyClick) {
    InputState state;
    state.mouse(at(10, 10), false);
    EXPECT_EQ(state.next_frame(kSize).mouse, glm::vec4(0));
}

TEST(Mouse, FollowsTheSitesSignsThroughADrag) {
    InputState state;
    state.mouse(at(10.7, 20.2), true);
    EXPECT_EQ(state.next_frame(kSize).mouse, glm::vec4(10, 20, 10, 20));
    EXPECT_EQ(state.next_frame(kSize).mouse, glm::vec4(10, 20, 10, -20));
    state.mouse(at(30, 25), true);
    EXPECT_EQ(state.next_frame(kSize).mouse, glm::vec4(30, 25, 10, -20));
    state.mouse(at(30, 25), false);
    EXPECT_EQ(state.next_frame(kSize).mouse, glm::vec4(30, 25, -10, -20));
    state.mouse(at(80, 5), false);  // moving with the button up changes nothing
    EXPECT_EQ(state.next_frame(kSize).mouse, glm::vec4(30, 25, -10, -20));
    state.mouse(at(1, 2), true);
    EXPECT_EQ(state.next_frame(kSize).mouse, glm::vec4(1, 2, 1, 2));
}

TEST(Mouse, APressAndReleaseWithinOneFrameIsSeen) {
    InputState state;
    state.mouse(at(10, 20), true);
    state.mouse(at(10, 20), false);
    EXPECT_EQ(state.next_frame(kSize).mouse, glm::vec4(10, 20, -10, 20));
    EXPECT_EQ(state.next_frame(kSize).mouse, glm::vec4(10, 20, -10, -20));
}

TEST(Mouse, ADragOutOfTheWindowKeepsItsPlace) {
    InputState state;
    state.mouse(at(10, 20), true);
    state.mouse(at(-5, 70), true);
    EXPECT_EQ(state.next_frame(kSize).mouse, glm::vec4(-5, 70, 10, 20));
}

TEST(Mouse, EveryPixelOfAPictureComesBackFromItsFraction) {
    for (int width = 1; width < 200; ++width)
        for (int x = 0; x < width; ++x) {
            InputState state;
            state.mouse({static_cast<double>(x) / width, 0.0}, true);
            EXPECT_EQ(state.next_frame({width, 1}).mouse.x, static_cast<float>(x));
        }
}

TEST(Mouse, FollowsAResizeAndIgnoresWhatIsNoPlace) {
    InputState state;
    state.mouse({0.5, 0.5}, true);
    state.mouse({std::numeric_limits<double>::quiet_NaN(), 0.0}, true);
    EXPECT_EQ(state.next_frame({200, 100}).mouse, glm::vec4(100, 50, 100, 50));
    EXPECT_EQ(state.next_frame({20, 10}).mouse, glm::vec4(10, 5, 10, -5));
}

TEST(Keyboard, CountsAPressOnceAndTogglesAtEach) {
    InputState state;
    const auto expect = [&](int held, int pressed, int toggled) {
        const Input input = state.next_frame(kSize);
        EXPECT_EQ(input.held[38], held);
        EXPECT_EQ(input.pressed[38], pressed);
        EXPECT_EQ(input.toggled[38], toggled);
    };
    state.key(38, true);
    expect(255, 255, 255);
    state.key(38, true);  // auto-repeat
    expect(255, 0, 255);
    state.key(38, false);
    expect(0, 0, 255);
    state.key(38, true);
    state.key(38, false);
    expect(0, 255, 0);
    state.key(-1, true);
    state.key(kKeyCount, true);
    expect(0, 0, 0);
}

TEST(Keyboard, KnowsKeysByName) {
    const struct {
        const char* name;
        int code;
    } cases[] = {{"up", 38},    {"Left", 37},     {"right", 39},  {"down", 40},     {"space", 32},
                 {"enter", 13}, {"escape", 27},   {"tab", 9},     {"shift", 16},    {"ctrl", 17},
                 {"alt", 18},   {"backspace", 8}, {"delete", 46}, {"home", 36},     {"end", 35},
                 {"a", 65},     {"Z", 90},        {"0", 48},      {"9", 57},        {"f1", 112},
                 {"F12", 123},  {"pageup", 33},   {"65", 65},     {"pagedown", 34}, {"255", 255},
                 {"256", -1},   {"f13", -1},      {"f0", -1},     {"", -1},         {"-1", -1},
                 {"upp", -1},   {"0x41", -1},     {" a", -1}};
    for (const auto& c : cases) EXPECT_EQ(key_code(c.name), c.code) << c.name;
}

TEST(Replay, CountsAsNewWhatHappenedSinceTheFrameBefore) {
    const std::vector<Event> events = {
        {.time = 0.0, .key = 38, .down = true},
        {.time = 1.0, .key = -1, .down = true, .mouse = {0.5, 0.5}},
        {.time = 2.0, .key = 38, .down = false},
    };
    EXPECT_EQ(replay(events, -kForever, -1.0, kSize), Input{});
    EXPECT_EQ(replay(events, -kForever, 0.0, kSize).pressed[38], 255);
    EXPECT_EQ(replay(events, 0.0, 0.5, kSize).pressed[38], 0);
    EXPECT_EQ(replay(events, 0.0, 0.5, kSize).held[38], 255);
    EXPECT_EQ(replay(events, 0.5, 1.0, kSize).mouse, glm::vec4(50, 25, 50, 25));
    EXPECT_EQ(replay(events, 1.0, 1.5, kSize).mouse, glm::vec4(50, 25, 50, -25));
    const Input last = replay(events, -kForever, 9.0, kSize);
    EXPECT_EQ(last.held[38], 0);
    EXPECT_EQ(last.pressed[38], 255);
    EXPECT_EQ(last.toggled[38], 255);
    EXPECT_EQ(replay({}, 0.0, 1.0, kSize), Input{});
}

TEST(Date, CountsMonthsFromZeroAndCrossesMidnights) {
    const struct {
        Date start;
        double elapsed;
        glm::vec4 date;
    } cases[] = {
        {{}, 0.0, {2000, 0, 1, 0}},
        {{}, 86399.5, {2000, 0, 1, 86399.5}},
        {{}, 86400.0, {2000, 0, 2, 0}},
        {{2000, 2, 28, 86399.0}, 2.0, {2000, 1, 29, 1}},
        {{1900, 2, 28, 0.0}, 86400.0, {1900, 2, 1, 0}},
        {{2023, 12, 31, 86400.0 - 0.25}, 0.5, {2024, 0, 1, 0.25}},
        {{2000, 1, 1, 0.0}, 366 * 86400.0, {2001, 0, 1, 0}},
        {{2000, 3, 1, 0.0}, -0.5, {2000, 1, 29, 86399.5}},
    };
    for (const auto& c : cases) EXPECT_EQ(shadertoy_date(c.start, c.elapsed), c.date);
}

TEST(Date, StaysADateWhateverTheTime) {
    for (const double elapsed : {1e300, -1e300, kForever, -kForever, 86399.99999, 3e11}) {
        const glm::vec4 date = shadertoy_date({}, elapsed);
        EXPECT_GE(date.y, 0.0f);
        EXPECT_LE(date.y, 11.0f);
        EXPECT_GE(date.z, 1.0f);
        EXPECT_LE(date.z, 31.0f);
        EXPECT_GE(date.w, 0.0f);
        EXPECT_LT(date.w, 86400.0f);
    }
}

TEST(Tick, IsExactAtAnyTime) {
    const struct {
        double time;
        std::uint32_t tick;
    } cases[] = {
        {0.0, 0},
        {1.0, 65536},
        {1.5 / 65536, 1},
        {65536.0, 0},
        {65536.0 - 1.0 / 65536, 0xFFFFFFFF},
        {31536000.0 + 1.0 / 65536, 31536000u % 65536u * 65536u + 1u},
        {0x1p36 - 0x1p-16, 0xFFFFFFFF},
        {-1.0 / 65536, 0xFFFFFFFF},
        {-0.5 / 65536, 0xFFFFFFFF},
        {1e300, 0},
        {kForever, 0},
    };
    for (const auto& c : cases) EXPECT_EQ(tick(c.time), c.tick) << c.time;
}

TEST(KeyName, ReadsBackAsItsCode) {
    for (int code = 0; code < kKeyCount; ++code) EXPECT_EQ(key_code(key_name(code)), code);
    EXPECT_EQ(key_name(38), "up");
    EXPECT_EQ(key_name(65), "a");
    EXPECT_EQ(key_name(55), "7");
    EXPECT_EQ(key_name(112), "f1");
}

TEST(InputState, ItsEventsLeadToTheSameState) {
    struct Case {
        const char* what;
        std::vector<Event> events;
    };
    const Event press{.key = 65, .down = true}, release{.key = 65, .down = false};
    const Event click{.down = true, .mouse = {0.25, 0.5}}, drag{.down = true, .mouse = {0.5, 0.75}};
    const Event up{.down = false, .mouse = {0.5, 0.75}};
    const Case cases[] = {{"untouched", {}},
                          {"held", {press}},
                          {"toggled", {press, release}},
                          {"toggled back", {press, release, press, release}},
                          {"toggled back and held", {press, release, press}},
                          {"pressed", {click}},
                          {"dragged", {click, drag}},
                          {"let go", {click, drag, up}},
                          {"all", {press, click, release, drag}}};
    for (const Case& c : cases) {
        InputState state, again;
        const auto feed = [](InputState& to, const std::vector<Event>& events) {
            for (const Event& event : events)
                if (event.key >= 0)
                    to.key(event.key, event.down);
                else
                    to.mouse(event.mouse, event.down);
            to.next_frame(kSize);
        };
        feed(state, c.events);
        feed(again, state.as_events(3.0));
        EXPECT_EQ(state.next_frame(kSize), again.next_frame(kSize)) << c.what;
        EXPECT_LE(state.as_events(3.0).size(), c.events.size()) << c.what;
    }
}

}  // namespace
}  // namespace glint::frame_test
