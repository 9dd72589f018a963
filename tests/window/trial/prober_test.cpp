// A process that stands by tells what a text is worth at a pixel, with the window's own buffers.
#include "window/trial/prober.h"

#include "../../base/test_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <thread>

namespace glint::prober_test {
namespace {

// Of the line that holds "float height" on: a simulation of one pixel feeds it.
constexpr const char* kScene = R"(
uniform sampler2D count; //@ pass mainCount size=1x1
void mainCount(out vec4 c, in vec2 p) { c = texelFetch(count, ivec2(0), 0) + 0.25; }
float never(float x) {
    return sqrt(x);
}
void mainImage(out vec4 c, in vec2 p) {
    float height = floor(p.x) * 10.0 + texelFetch(count, ivec2(0), 0).r;
    if (p.y > 4.0) {
        height = -height;
    }
    c = vec4(height);
}
)";

class Probing : public ::testing::Test {
protected:
    Probing() {
        const TestFolder folder;
        order_.scene.preset =
            std::move(read_preset(folder.write("scene.frag", kScene)).preset).value();
        order_.scene.preset.size = {8, 8};
        order_.pass = kImagePass;
        order_.lines = {0, order_.scene.preset.scene.text.size()};
        order_.subject = order_.instant = 1;
        order_.scene.given.push_back({.pass = 0, .feeds_state = true, .size = {1, 1}});
        give(0.5f);
    }
    void give(float value) {
        const std::span<std::byte> memory = prober_.memory().room(4 * sizeof(float));
        ASSERT_EQ(memory.size(), 4 * sizeof(float));
        std::fill_n(reinterpret_cast<float*>(memory.data()), 4, value);
    }
    nlohmann::json ask() {
        ++order_.number;
        prober_.ask(order_);
        answer_ = {};
        for (int i = 0; i < 60000; ++i) {
            if (auto answer = prober_.update()) {
                answer_ = std::move(*answer);
                break;
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        EXPECT_EQ(answer_.number, order_.number) << answer_.problem;
        return answer_.found.empty() ? nlohmann::json() : nlohmann::json::parse(answer_.found);
    }
    // Of a line, the last that has this name; NaN where there is none.
    static double value(const nlohmann::json& found, const std::string& name, int line) {
        double last = std::numeric_limits<double>::quiet_NaN();
        for (const auto& row : found.at("values"))
            if (row.at("name") == name && row.at("line") == line) last = row.at("value")[0];
        return last;
    }
    LineState ran(std::size_t line) const {
        return line <= answer_.ran.size() ? static_cast<LineState>(answer_.ran[line - 1])
                                          : LineState::unknown;
    }

    ProbeOrder order_;
    ProbeAnswer answer_;
    Prober prober_{"", GLINT_BINARY};
};

TEST_F(Probing, TellsWhatEachLineWasWorthAtThePixelWithTheWindowsBuffers) {
    order_.pixel = glm::ivec2(3, 6);
    nlohmann::json found = ask();
    EXPECT_EQ(value(found, "height", 8), 30.5);
    EXPECT_EQ(value(found, "height", 10), -30.5);
    EXPECT_EQ(ran(10), LineState::ran);
    EXPECT_EQ(ran(5), LineState::did_not_run) << "no pass calls it";
    order_.pixel = glm::ivec2(2, 1);
    found = ask();
    EXPECT_EQ(answer_.compile_ms, 0.0) << "all is at hand";
    EXPECT_EQ(value(found, "height", 8), 20.5);
    EXPECT_EQ(ran(10), LineState::did_not_run);
    EXPECT_EQ(ran(8), LineState::ran);
    EXPECT_EQ(ran(1), LineState::unknown) << "nothing stands there";
    give(0.75f);
    order_.instant = 2;
    EXPECT_EQ(value(ask(), "height", 8), 20.75) << "the next frame's";
}

TEST_F(Probing, AnotherTextIsAnotherSubject) {
    order_.pixel = glm::ivec2(1, 1);
    EXPECT_EQ(value(ask(), "height", 8), 10.5);
    std::string& text = order_.scene.preset.scene.text;
    text.replace(text.find("* 10.0"), 6, "* 20.0");
    ++order_.subject;
    EXPECT_EQ(value(ask(), "height", 8), 20.5);
}

TEST_F(Probing, WatchesStandFirstAndAWrongOneIsToldBesideTheOthers) {
    order_.pixel = glm::ivec2(1, 1);
    order_.scene.preset.watch = {"2.0 * height@8", "nothing@8", "height@900"};
    const nlohmann::json found = ask();
    ASSERT_EQ(answer_.watched, 1);
    EXPECT_EQ(found.at("values")[0].at("value")[0], 21.0);
    ASSERT_EQ(found.at("notes").size(), 2u) << found.at("notes");
}

TEST_F(Probing, AValueOfEveryPixelSaysWhereItWasNotReached) {
    order_.pixel = glm::ivec2(3, 6);
    const nlohmann::json found = ask();
    for (const auto& row : found.at("values")) {
        if (row.at("line") != 10) continue;
        order_.map = ProbeMap::value;
        order_.line = 10;
        order_.column = row.at("column");
        order_.file = row.at("file");
        order_.name = row.at("name");
        order_.kind = row.at("kind");
    }
    ask();
    ASSERT_EQ(answer_.size, glm::ivec2(8, 8));
    EXPECT_EQ(answer_.components, 1);
    std::vector<float> values(4 * 64);
    ASSERT_EQ(answer_.values.size(), values.size() * sizeof(float));
    std::memcpy(values.data(), answer_.values.data(), answer_.values.size());
    EXPECT_EQ(values[4 * (6 * 8 + 5)], -50.5f);
    EXPECT_EQ(answer_.reached[6 * 8 + 5], std::byte{1});
    EXPECT_EQ(answer_.reached[2 * 8 + 5], std::byte{0}) << "below, the branch is not taken";
}

// A driver compiles a copy of a function for each of its calls, and of what is recorded in it.
TEST_F(Probing, LinesOfWhichThePassHasManyCopiesAreToldOneAfterAnother) {
    std::string text = "\nfloat h0(float x) {\n    float a = x + 1.0;\n    return a;\n}\n";
    for (int i = 1; i <= 7; ++i)
        text +=
            fmt::format("float h{0}(float x) {{ return h{1}(x) + h{1}(x + 1.0); }}\n", i, i - 1);
    Scene& scene = order_.scene.preset.scene;
    scene.text.replace(scene.text.find("\nfloat never"), 1, text);
    scene.text.replace(scene.text.find("c = vec4(height)"), 16, "c = vec4(h7(1.0))");
    scene.origins.resize(static_cast<std::size_t>(std::ranges::count(scene.text, '\n')) + 1);
    for (std::size_t i = 0; i < scene.origins.size(); ++i)
        scene.origins[i] = {0, static_cast<int>(i) + 1};
    order_.pixel = glm::ivec2(1, 1);
    nlohmann::json found = ask();
    EXPECT_FALSE(answer_.is_whole);
    EXPECT_TRUE(answer_.ran.empty()) << "what is not compiled yet may have run";
    std::size_t told = found.at("values").size();
    for (int i = 0; i < 20 && !answer_.is_whole; ++i) {
        found = ask();
        EXPECT_GE(found.at("values").size(), told);
        told = found.at("values").size();
    }
    EXPECT_TRUE(answer_.is_whole);
    EXPECT_EQ(value(found, "a", 5), 9.0) << "1 + 7 + 1, of the last call";
    EXPECT_EQ(ran(5), LineState::ran);
    ask();
    EXPECT_EQ(answer_.compile_ms, 0.0);
}

TEST_F(Probing, WhatDoesNotCompileIsTold) {
    order_.pixel = glm::ivec2(1, 1);
    order_.scene.preset.scene.text += "void broken( {}\n";
    order_.scene.preset.scene.text.replace(order_.scene.preset.scene.text.find("c = vec4(height);"),
                                           17, "c = undeclared;  ");
    ask();
    EXPECT_NE(answer_.problem, "");
}

TEST_F(Probing, AProcessThatEndsWhileNobodyAsksIsReplaced) {
    order_.pixel = glm::ivec2(1, 1);
    ASSERT_EQ(value(ask(), "height", 8), 10.5);
    ::kill(prober_.process(), SIGKILL);
    for (int i = 0; i < 10000 && prober_.process() != 0; ++i) {
        prober_.update();
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    prober_.prepare();
    ASSERT_NE(prober_.process(), 0);
    EXPECT_EQ(value(ask(), "height", 8), 10.5);
}

TEST_F(Probing, ASceneWhoseNameIsNoUtf8IsAnsweredToo) {
    order_.pixel = glm::ivec2(1, 1);
    order_.scene.preset.scene.files.front() = "sc\xe9ne.frag";
    EXPECT_EQ(value(ask(), "height", 8), 10.5) << answer_.problem;
}

}  // namespace
}  // namespace glint::prober_test
