// [quality.NAME] of presets: read, kept and written.
#include "../base/test_folder.h"
#include "scene/preset.h"
#include "scene/preset_writer.h"

#include <gtest/gtest.h>

namespace glint {
namespace {

constexpr const char* kScene =
    "uniform int steps; //@ 8 [1, 64] quality\n"
    "uniform int method; //@ 0 {fast, exact} quality\n"
    "void mainImage(out vec4 c, in vec2 p) {}\n";

class Quality : public testing::Test {
protected:
    ReadPreset read(const std::string& text) const {
        folder.write("a.frag", kScene);
        return read_preset(folder.write("a.toml", "scene = \"a.frag\"\n" + text));
    }
    TestFolder folder;
};

TEST_F(Quality, IsReadAndChangesNothingByItself) {
    const ReadPreset found =
        read("[quality.fast]\nsteps = 4\n[quality.best]\nmethod = \"exact\"\nsteps = 64\n");
    EXPECT_TRUE(found.diagnostics.empty());
    ASSERT_EQ(found.preset->qualities.size(), 2u);
    const QualitySet& best = found.preset->qualities[0];
    EXPECT_EQ(best.name, "best");
    ASSERT_EQ(best.values.size(), 2u);
    EXPECT_EQ(best.values[0].tweak, 1u);
    EXPECT_EQ(best.values[0].value[0], 1.0);
    EXPECT_EQ(found.preset->values[0][0], 8.0);
}

TEST_F(Quality, IsToldWhereItIsWrong) {
    const ReadPreset found = read("[quality]\nfast = 3\n[quality.best]\nstep = 4\nmethod = 7\n");
    ASSERT_EQ(found.diagnostics.size(), 3u);
    EXPECT_EQ(found.diagnostics[0].place.line, 3);
    EXPECT_NE(found.diagnostics[1].text.find("did you mean 'steps'?"), std::string::npos);
    EXPECT_EQ(found.diagnostics[2].place.line, 6);
}

TEST_F(Quality, IsWrittenBehindWhatStandsAndInPlaceOfItself) {
    const std::string text =
        "scene = \"a.frag\"\n# mine\n[quality.fast]  # by hand\nsteps = 4  # no less\n\n"
        "[quality.other]\nsteps = 2\n";
    folder.write("a.frag", kScene);
    ReadPreset found = read_preset(folder.write("a.toml", text));
    EXPECT_EQ(write_preset(*found.preset, folder.path() / "a.toml", text).text, text);
    std::erase_if(found.preset->qualities, [](const QualitySet& q) { return q.name == "fast"; });
    found.preset->qualities.push_back({"fast", {{1, {1.0}}, {0, {16.0}}}});
    found.preset->qualities.push_back({"8 ms", {{0, {32.0}}}});
    const PresetText written = write_preset(*found.preset, folder.path() / "a.toml", text);
    ASSERT_TRUE(written.text);
    EXPECT_EQ(*written.text,
              "scene = \"a.frag\"\n# mine\n[quality.fast]  # by hand\nsteps = 16  # no less\n"
              "method = \"exact\"\n\n[quality.other]\nsteps = 2\n\n"
              "[quality.\"8 ms\"]\nsteps = 32\n");
}

TEST_F(Quality, IsWrittenIntoWhicheverFormStands) {
    const std::string head = "scene = \"a.frag\"\n";
    struct {
        const char *before, *after;
    } const cases[] = {
        {"quality.best.steps = 3\n", "quality.best.steps = 5\nquality.best.method = \"exact\"\n"},
        {"quality.fast.steps = 2\nquality.best.steps = 3\n[tweaks]\n",
         "quality.fast.steps = 2\nquality.best.steps = 5\nquality.best.method = \"exact\"\n"
         "[tweaks]\n"},
        {"[quality]\n  best.steps = 3 # mine\nfast.steps = 2\n  best.method = 0\n",
         "[quality]\n  best.steps = 5 # mine\nfast.steps = 2\n  best.method = \"exact\"\n"},
        {"[quality]\nbest = { steps = 3 } # mine\n",
         "[quality]\nbest = { method = \"exact\", steps = 5 } # mine\n"},
        {"[quality]\nbest = 3\n", "[quality]\nbest = { method = \"exact\", steps = 5 }\n"},
        {"quality = 3\n", "quality = { best = { method = \"exact\", steps = 5 } }\n"},
        {"quality = {}\n", "quality = { best = { method = \"exact\", steps = 5 } }\n"},
        {"quality = { fast = { steps = 2 } }\n",
         "quality = { fast = { steps = 2 }, best = { method = \"exact\", steps = 5 } }\n"},
        {"[[quality.best]]\nsteps = 3\n[[quality.best]]\nsteps = 4\n[quality.fast]\nsteps = 2\n",
         "[quality.fast]\nsteps = 2\n\n[quality.best]\nmethod = \"exact\"\nsteps = 5\n"},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.before);
        ReadPreset found = read(c.before);
        ASSERT_TRUE(found.preset);
        std::erase_if(found.preset->qualities,
                      [](const QualitySet& q) { return q.name == "best"; });
        found.preset->qualities.push_back({"best", {{1, {1.0}}, {0, {5.0}}}});
        const PresetText written =
            write_preset(*found.preset, folder.path() / "a.toml", head + c.before);
        ASSERT_TRUE(written.text) << to_string(written.diagnostics.at(0));
        EXPECT_EQ(*written.text, head + c.after);
    }
}

}  // namespace
}  // namespace glint
