// A preset with a mistake: what cannot be used is told with its place, and the rest still draws.
#include "command.h"
#include "media/image.h"

namespace glint::cli::broken_preset_test {
namespace {

struct Case {
    std::string_view what, text;
    std::string_view message;  // how a line of stderr starts
};

class BrokenPreset : public InAFolder {
protected:
    BrokenPreset() {
        write("scene.frag",
              "uniform float a;    //@ 0.5 [0, 1]\n"
              "uniform int   n;    //@ 1 {off, low, high}\n"
              "uniform bool  on;   //@ off\n"
              "uniform vec3  tint; //@ #ff8000\n"
              "void mainImage(out vec4 c, in vec2 p) { c = vec4(a, float(n) / 2.0, on ? 1.0 : "
              "0.0, 1) + 0.0 * tint.xyzz; }\n");
    }

    static void expect_line(const Outcome& outcome, std::string_view message) {
        EXPECT_NE(("\n" + outcome.err).find("\n" + std::string(message)), std::string::npos)
            << "wanted: " << message << "\nstderr: " << outcome.err;
    }
};

std::string times(int count, std::string_view text) {
    std::string all;
    for (int i = 0; i < count; ++i) all += text;
    return all;
}

TEST_F(BrokenPreset, WhatCannotBeReadAtAllIsUnreadable) {
    const std::string scene = "scene = \"scene.frag\" # a.b\n";
    const std::string parts_of_table = scene + "[a" + times(200'000, ".a") + "]\n";
    const std::string parts_of_key = scene + "a" + times(200'000, " . a") + " = 1\n";
    const std::string parts_in_braces = scene + "b = {\"a\"" + times(200'000, ".'a'") + " = 1}\n";
    const Case cases[] = {
        {"an open string", "scene = \"scene.frag\n", "look.toml:1:"},
        {"a bad line below", "scene = \"scene.frag\"\ntime = = 3\n", "look.toml:2:"},
        {"a key twice", "scene = \"scene.frag\"\ntime = 1\ntime = 2\n", "look.toml:3:"},
        {"binary", std::string_view("\0\1\2\3", 4), "look.toml:1:1: error: no valid TOML"},
        {"not UTF-8", "scene = \"\xFF\xFE\"\n", "look.toml:1:"},
        {"no scene", "title = \"nothing\"\n", "look.toml:1:1: error: the scene is missing"},
        {"empty", "", "look.toml:1:1: error: the scene is missing"},
        {"a scene of the wrong type", "time = 1\nscene = 7\n",
         "look.toml:2:9: error: the scene is missing"},
        {"a scene that is not there", "\nscene = \"gone.frag\"\n",
         "look.toml:2:9: error: cannot read 'gone.frag': No such file or directory"},
        {"a scene that is a folder", "scene = \".\"\n", "look.toml:1:9: error: cannot read "},
        {"itself for a scene", "scene = \"look.toml\"\n",
         "look.toml:1:9: error: 'look.toml' is a preset, and no scene"},
        {"another preset for a scene", "scene = \"other.toml\"\n",
         "look.toml:1:9: error: 'other.toml' is a preset, and no scene"},
        {"a table of a table of a table", parts_of_table,
         "look.toml:2:2: error: a key of more than 16 parts"},
        {"a key of many parts", parts_of_key, "look.toml:2:1: error: a key of more than 16 parts"},
        {"one in braces and quotes", parts_in_braces,
         "look.toml:2:6: error: a key of more than 16 parts"},
    };
    write("out.png", "precious");
    write("other.toml", "scene = \"scene.frag\"\n");
    for (const auto& [what, text, message] : cases) {
        SCOPED_TRACE(what);
        write("look.toml", text);
        const auto before = names();
        const Outcome outcome = glint({"still", "look.toml", "-o", "out.png"});
        EXPECT_EQ(outcome.code, 4);
        EXPECT_EQ(outcome.out, "");
        expect_line(outcome, message);
        EXPECT_EQ(bytes("out.png"), "precious");
        EXPECT_EQ(names(), before);
    }
    EXPECT_EQ(glint({"still", "gone.toml", "-o", "out.png"}).code, 4);
}

// Dots in texts, numbers and comments part no keys.
TEST_F(BrokenPreset, ManyDotsElsewhereAreNoDeepKeys) {
    const std::string dots = times(100, "a.b.");
    write("look.toml", "scene = \"scene.frag\"\ntitle = \"\\\"" + dots + "\" # '" + dots +
                           "\n[x]\nlist = [" + times(100, "1.5, ") + "]\ntext = '''\n'" + dots +
                           "'''\nother = \"\"\"\n\"\\\"" + dots + "\"\"\"\nlast = 'a\\'\n");
    const Outcome outcome = glint({"still", "look.toml", "-o", "out.png", "--size", "8x8"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
}

TEST_F(BrokenPreset, AMistakeInItsSceneIsToldAtTheScenesPlace) {
    write("scenes/wrong.frag", "void mainImage(out vec4 c, in vec2 p) { c = wrong; }\n");
    write("looks/look.toml", "scene = \"../scenes/wrong.frag\"\n");
    const Outcome outcome = glint({"still", "looks/look.toml", "-o", "out.png"});
    EXPECT_EQ(outcome.code, 3);
    expect_line(outcome, "scenes/wrong.frag:1:45: error: `wrong' undeclared");
}

TEST_F(BrokenPreset, OneMistakeIsWarnedOfAndTheRestStillDraws) {
    const Case cases[] = {
        {"an unknown key", "sise = [3, 3]\n", "look.toml:3:1: warning: unknown key 'sise'"},
        {"an unknown tweak", "tweaks.b = 1\n",
         "look.toml:3:8: warning: the scene has no tweak 'b'"},
        {"a tweak of the wrong type", "tweaks.on = [1, 2]\n",
         "look.toml:3:13: warning: on takes on or off"},
        {"a colour that is none", "tweaks.tint = \"#xyz\"\n",
         "look.toml:3:15: warning: tint takes three numbers"},
        {"a name that the menu lacks", "tweaks.n = \"highest\"\n",
         "look.toml:3:12: warning: n takes off, low, high"},
        {"tweaks that are no table", "tweaks = 3\n", "look.toml:3:10: warning: tweaks is a table"},
        {"a time before the start", "time = -1\n", "look.toml:3:8: warning: time is"},
        {"a time that is text", "time = \"soon\"\n", "look.toml:3:8: warning: time is"},
        {"a time without end", "time = inf\n", "look.toml:3:8: warning: time is"},
        {"an event without a time", "[[events]]\nkey = \"up\"\ndown = true\n",
         "look.toml:3:1: warning: an event needs its time"},
        {"an event with an unknown key", "[[events]]\nt = 0\nkey = \"upp\"\ndown = true\n",
         "look.toml:5:7: warning: no such key"},
        {"a channel without a source", "[channels]\niChannel0 = {}\n",
         "look.toml:4:13: warning: this channel has no source"},
        {"a channel that does not exist", "[channels]\niChannel7 = { noise = \"rgba 8\" }\n",
         "look.toml:4:1: warning: unknown key 'iChannel7'"},
        {"a channel that reads no buffer", "[channels]\niChannel0 = { buffer = \"waves\" }\n",
         "look.toml:4:24: warning: the scene has no buffer 'waves'"},
        {"a title that is a number", "title = 3\n", "look.toml:3:9: warning: title is a text"},
    };
    for (const auto& [what, text, message] : cases) {
        SCOPED_TRACE(what);
        write("look.toml", "scene = \"scene.frag\"\nsize = [8, 4]\n" + std::string(text));
        const Outcome outcome = glint({"still", "look.toml", "-o", "out.png"});
        EXPECT_EQ(outcome.code, 0);
        expect_line(outcome, message);
        const Image image = read_image(folder() / "out.png");
        EXPECT_EQ(image.size, glm::ivec2(8, 4));
        EXPECT_EQ(image.pixels[0], std::byte{128});
        fs::remove(folder() / "out.png");
    }
}

TEST_F(BrokenPreset, AValueBeyondItsRangeIsClampedWithAWarning) {
    write("look.toml", "scene = \"scene.frag\"\nsize = [4, 0]\ntweaks.a = 7\n");
    const Outcome outcome = glint({"still", "look.toml", "-o", "out.png"});
    EXPECT_EQ(outcome.code, 0);
    expect_line(outcome, "look.toml:2:12: warning: 0 pixels are outside 1 to");
    expect_line(outcome, "look.toml:3:12: warning: a is 7, not");
    const Image image = read_image(folder() / "out.png");
    EXPECT_EQ(image.size, glm::ivec2(4, 1));
    EXPECT_EQ(image.pixels[0], std::byte{255});
}

TEST_F(BrokenPreset, AMissingPictureOfAChannelIsToldAtItsLine) {
    write(
        "pasted.frag",
        "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p / iResolution.xy); }\n");
    write("look.toml",
          "scene = \"pasted.frag\"\n[channels]\niChannel0 = { image = \"gone.png\" }\n");
    const Outcome outcome = glint({"still", "look.toml", "-o", "out.png"});
    EXPECT_EQ(outcome.code, 4);
    expect_line(outcome, "look.toml:3:13: error: Cannot read gone.png: No such file or directory");
}

}  // namespace
}  // namespace glint::cli::broken_preset_test
