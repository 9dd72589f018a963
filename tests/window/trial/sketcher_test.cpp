// A text is drawn once by another process, with what the window's buffers hold already.
#include "window/trial/sketcher.h"

#include "../../base/test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <thread>

namespace glint::sketcher_test {
namespace {

bool eventually(const std::function<bool()>& is_true) {
    for (int i = 0; i < 60000; ++i) {
        if (is_true()) return true;
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return false;
}

// Red is a simulation, green a buffer that nobody edits, blue one that reads another.
constexpr const char* kScene = R"(
uniform sampler2D count; //@ pass mainCount size=1x1
uniform sampler2D kept;  //@ pass mainKept size=1x1
uniform sampler2D first; //@ pass mainFirst size=1x1
uniform sampler2D last;  //@ pass mainLast size=1x1
void mainCount(out vec4 c, in vec2 p) { c = texelFetch(count, ivec2(0), 0) + 0.25; }
void mainKept(out vec4 c, in vec2 p) { c = vec4(0.0); }
void mainFirst(out vec4 c, in vec2 p) { c = vec4(0.2); }
void mainLast(out vec4 c, in vec2 p) { c = 2.0 * texelFetch(first, ivec2(0), 0); }
void mainImage(out vec4 c, in vec2 p) {
    ivec2 o = ivec2(0);
    c = vec4(texelFetch(count, o, 0).r, texelFetch(kept, o, 0).r, texelFetch(last, o, 0).r, 1);
}
)";

class Sketch : public ::testing::Test {
protected:
    Sketch() {
        const TestFolder folder;
        order_.preset = std::move(read_preset(folder.write("scene.frag", kScene)).preset).value();
        order_.preset.size = {8, 8};
        order_.samples = 1;
    }

    // The buffer holds this value, and was drawn with the text as it is now.
    void give(std::size_t pass, float value, std::vector<std::size_t> reads = {}) {
        const std::span<std::byte> memory = sketcher_.memory().room(4 * 4 * sizeof(float));
        ASSERT_EQ(memory.size(), 4 * 4 * sizeof(float));
        auto* const at = reinterpret_cast<float*>(memory.data()) + 4 * pass;
        std::fill_n(at, 4, value);
        order_.given.push_back(
            {.pass = pass,
             .feeds_state = pass == 0,
             .text_hash = sketch_hash(pass_text(order_.preset, pass, kSketched).text),
             .reads = std::move(reads),
             .size = {1, 1},
             .begin = 4 * pass * sizeof(float)});
    }
    void edit(const std::string& from, const std::string& to) {
        std::string& text = order_.preset.scene.text;
        text.replace(text.find(from), from.size(), to);
    }
    // Of the picture; -1 where there is none.
    int channel(std::size_t i) {
        sketcher_.start(order_);
        eventually([&] { return sketcher_.update() || sketcher_.descriptor() < 0; });
        const auto& pixels = sketcher_.picture().pixels;
        return pixels.empty() ? -1 : std::to_integer<int>(pixels[i]);
    }

    RefineOrder order_;
    Sketcher sketcher_{"", GLINT_BINARY};
};

TEST_F(Sketch, WhatAnEditLeavesAsItIsIsTakenFromTheWindow) {
    give(0, 0.4f, {0});
    give(1, 0.8f);
    give(2, 0.0f);
    give(3, 0.6f, {2});
    edit("1);\n}", "1); c.a = 1.0;\n}");
    EXPECT_EQ(channel(0), 102);
    EXPECT_EQ(sketcher_.picture().pixels[1], std::byte{204});
    EXPECT_EQ(sketcher_.picture().pixels[2], std::byte{153});
}

TEST_F(Sketch, ABufferThatWasEditedIsDrawnAndThoseThatReadIt) {
    give(0, 0.4f, {0});
    give(1, 0.8f);
    give(2, 0.0f);
    give(3, 0.6f, {2});
    edit("vec4(0.2)", "vec4(0.3)");
    EXPECT_EQ(channel(2), 153) << "twice 0.3, and not what it held";
    EXPECT_EQ(sketcher_.picture().pixels[1], std::byte{204}) << "nobody edits this one";
}

TEST_F(Sketch, AnEditedSimulationStandsAsItIs) {
    give(0, 0.4f, {0});
    edit("+ 0.25", "+ 0.5");
    EXPECT_EQ(channel(0), 102);
}

TEST_F(Sketch, WhereTheSimulationIsNotGivenThereIsNone) {
    EXPECT_EQ(channel(0), -1);
}

TEST_F(Sketch, WhatWasGivenBeforeAnEditIsTakenFromThere) {
    give(0, 0.4f, {0});
    give(1, 0.8f);
    sketcher_.prepare();
    RefineOrder before = order_;
    before.samples = 0;
    before.given = {order_.given[1]};
    sketcher_.make_ready(before);
    note_known(order_.given, before.given);
    EXPECT_FALSE(order_.given[0].is_known);
    EXPECT_TRUE(order_.given[1].is_known);
    EXPECT_FALSE(sketcher_.is_drawing());
    edit("1);\n}", "1); c.a = 1.0;\n}");
    ASSERT_EQ(channel(0), 102);
    EXPECT_EQ(sketcher_.picture().pixels[1], std::byte{204});
}

TEST_F(Sketch, AMapIsKnownAsLongAsItsTextAndThoseOfWhatItReadsStay) {
    const std::vector<GivenBuffer> before = {{.pass = 2, .text_hash = 5},
                                             {.pass = 3, .text_hash = 6, .reads = {2}}};
    const auto known = [&](std::size_t first, std::size_t last) {
        std::vector<GivenBuffer> later = before;
        later[0].text_hash = first;
        later[1].text_hash = last;
        note_known(later, before);
        return std::pair(later[0].is_known, later[1].is_known);
    };
    EXPECT_EQ(known(5, 6), std::pair(true, true));
    EXPECT_EQ(known(5, 7), std::pair(true, false));
    EXPECT_EQ(known(4, 6), std::pair(false, false)) << "what it reads is another";
    std::vector<GivenBuffer> mixed = {{.pass = 2}};  // of no one text, then as now
    note_known(mixed, {{.pass = 2}});
    EXPECT_FALSE(mixed[0].is_known);
}

// After a slider was moved; until the tweaks rest, and compiled constants say the same.
TEST_F(Sketch, WhatFedProgramsHaveDrawnIsTakenForTheSameValues) {
    const TestFolder folder;
    Preset drawn = std::move(read_preset(folder.write("scene.frag", R"(
uniform float level;    //@ 0.5 [0, 1]
uniform sampler2D kept; //@ pass mainKept size=1x1
void mainKept(out vec4 c, in vec2 p) { c = vec4(level); }
void mainImage(out vec4 c, in vec2 p) { c = texelFetch(kept, ivec2(0), 0); }
)"))
                                 .preset)
                       .value();
    drawn.values[0] = {0.25};
    const std::string constants = pass_text(drawn, 0, kSketched).text;
    EXPECT_EQ(filling_hash(drawn, 0, nullptr), sketch_hash(constants));
    EXPECT_EQ(filling_hash(drawn, 0, &constants), sketch_hash(constants));
    order_.preset = drawn;
    order_.preset.size = {8, 8};
    give(0, 0.8f);
    order_.given[0].feeds_state = false;
    order_.given[0].text_hash = filling_hash(drawn, 0, nullptr);
    edit("0); }", "0) + 0.0; }");
    EXPECT_EQ(channel(0), 204);
    order_.preset.values[0] = {0.75};
    EXPECT_EQ(channel(0), 191) << "its value has moved since";
}

TEST_F(Sketch, TheProcessAtHandDrawsAndSoDoesTheNext) {
    give(0, 0.4f, {0});
    for (int i = 0; i < 2; ++i) {
        sketcher_.prepare();
        const pid_t at_hand = sketcher_.process();
        ASSERT_GT(at_hand, 0);
        EXPECT_FALSE(sketcher_.is_drawing());
        sketcher_.prepare();
        sketcher_.start(order_);
        EXPECT_EQ(sketcher_.process(), at_hand);
        ASSERT_TRUE(eventually([&] { return sketcher_.update(); }));
        ASSERT_TRUE(eventually([&] { return sketcher_.update(), sketcher_.process() == 0; }));
    }
    EXPECT_EQ(channel(0), 102) << "also where none is at hand";
}

}  // namespace
}  // namespace glint::sketcher_test
