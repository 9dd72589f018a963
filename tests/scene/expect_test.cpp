// `[expect]` of a preset: read, told what is wrong with it, and kept when the preset is saved.
#include "../base/test_folder.h"
#include "scene/preset.h"
#include "scene/preset_writer.h"

#include <gtest/gtest.h>

namespace glint {
namespace {

class ExpectTest : public testing::Test {
protected:
    ExpectTest() {
        folder_.write("s.frag",
                      "uniform float a; //@ 1 [0, 2]\n"
                      "void mainImage(out vec4 c, in vec2 p) { c = vec4(a); }\n");
    }

    ReadPreset read(const std::string& expect) {
        return read_preset(folder_.write("looks/look.toml", "scene = \"../s.frag\"\n" + expect));
    }

    // The warnings, a line each.
    std::string warnings(const std::string& expect) {
        std::string text;
        for (const Diagnostic& warning : read(expect).diagnostics)
            text += std::to_string(warning.place.line) + ": " + warning.text + "\n";
        return text;
    }

    TestFolder folder_;
};

TEST_F(ExpectTest, NamesAPictureAndHowFarItMayBe) {
    const ReadPreset found = read(
        "[expect]\npicture = \"pictures/look.png\"\nrmse = 0.002\nflip = 0\n"
        "ms_ratio = { of = \"calm.toml\", most = 1.5 }\n");
    EXPECT_TRUE(found.diagnostics.empty());
    const Expect& expect = found.preset->expect;
    EXPECT_EQ(expect.picture, folder_.path() / "looks/pictures/look.png");
    EXPECT_EQ(expect.rmse, 0.002);
    EXPECT_EQ(expect.flip, 0.0);
    EXPECT_EQ(expect.ms_ratio, 1.5);
    EXPECT_EQ(expect.ms_of, folder_.path() / "looks/calm.toml");
    EXPECT_EQ(read("").preset->expect, Expect());
}

TEST_F(ExpectTest, WhatIsWrongIsAWarningWithItsLine) {
    EXPECT_EQ(warnings("[expect]\npictur = \"a.png\"\nrmse = 0.1\n"),
              "3: unknown key 'pictur'; known are picture, rmse, flip, ms_ratio; did you mean "
              "'picture'?\n");
    EXPECT_EQ(warnings("expect = 3\n"),
              "2: expect is a table; write [expect] on a line of its own\n");
    EXPECT_EQ(warnings("[expect]\npicture = 3\n"),
              "3: picture is a file's name; write picture = \"expected.png\"\n");
    for (const char* bad : {"-1", "nan", "inf", "\"0.1\""})
        EXPECT_EQ(warnings("[expect]\npicture = \"a.png\"\nflip = " + std::string(bad) + "\n"),
                  "4: flip is the most that is allowed, a number from 0; not used\n");
    EXPECT_EQ(warnings("[expect]\nrmse = 0.1\n"),
              "3: rmse is how far the picture may be from another; write picture = "
              "\"expected.png\", too\n");
    for (const char* half : {"{ of = \"calm.toml\" }", "{ most = 2 }"})
        EXPECT_EQ(warnings("[expect]\nms_ratio = " + std::string(half) + "\n"),
                  "3: ms_ratio needs both, of and most; write ms_ratio = { of = \"calm.toml\", "
                  "most = 1.5 }\n");
    EXPECT_EQ(warnings("[expect]\nms_ratio = 1.5\n"),
              "3: ms_ratio says of which look, and the most; write ms_ratio = { of = "
              "\"calm.toml\", most = 1.5 }\n");
    EXPECT_FALSE(
        read("[expect]\nms_ratio = { of = \"a.toml\", most = -1 }\n").preset->expect.ms_ratio);
}

constexpr const char* kExpect =
    "[expect]   # of the release\npicture = \"look.png\"  # drawn by hand\nrmse = 0.002\n"
    "ms_ratio = { of = \"calm.toml\", most = 1.5 }\n";

TEST_F(ExpectTest, StaysAsItWasWrittenWhenTheLookIsSaved) {
    const std::string text = "scene = \"../s.frag\"\n" + std::string(kExpect);
    ReadPreset found = read(kExpect);
    found.preset->values[0][0] = 0.25;
    const PresetText saved = write_preset(*found.preset, folder_.path() / "looks/look.toml", text);
    ASSERT_TRUE(saved.text);
    EXPECT_NE(saved.text->find(kExpect), std::string::npos) << *saved.text;
    EXPECT_NE(saved.text->find("a = 0.25"), std::string::npos) << *saved.text;
}

TEST_F(ExpectTest, NamesTheSameFilesFromAnotherFolder) {
    const std::string text = "scene = \"../s.frag\"\n" + std::string(kExpect);
    const ReadPreset found = read(kExpect);
    std::filesystem::create_directories(folder_.path() / "far/away");
    const std::filesystem::path file = folder_.path() / "far/away/look.toml";
    for (const std::string& existing : {text, std::string()}) {
        const PresetText saved = write_preset(*found.preset, file, existing);
        ASSERT_TRUE(saved.text) << to_string(saved.diagnostics.front());
        folder_.write("far/away/look.toml", *saved.text);
        const ReadPreset again = read_preset(file);
        EXPECT_TRUE(again.diagnostics.empty());
        EXPECT_EQ(std::filesystem::weakly_canonical(again.preset->expect.picture),
                  std::filesystem::weakly_canonical(found.preset->expect.picture))
            << *saved.text;
        EXPECT_EQ(std::filesystem::weakly_canonical(again.preset->expect.ms_of),
                  std::filesystem::weakly_canonical(found.preset->expect.ms_of));
        EXPECT_EQ(again.preset->expect.rmse, 0.002);
        EXPECT_EQ(again.preset->expect.ms_ratio, 1.5);
        EXPECT_EQ(*write_preset(*again.preset, file, *saved.text).text, *saved.text) << "twice";
    }
}

}  // namespace
}  // namespace glint
