// Presets: what they set, and what they say about each thing that a person may get wrong.
#include "scene/preset.h"

#include "read_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace glint::preset_test {
namespace {

const std::string kScene = R"(uniform float choppiness; //@ 0.6 [0, 1]
uniform vec3 tint; //@ #0b3a53
uniform int mode; //@ 0 {off, traced}
uniform int steps; //@ 8 [1, 64]
uniform bool boat; //@ off
uniform vec2 wind; //@ 1, 2 [-5, 5]
uniform sampler2D waves; //@ pass mainWaves
uniform samplerCube sky; //@ pass mainSky
uniform sampler2D iChannel3; //@ noise 8
void mainWaves(out vec4 c, in vec2 f) { c = vec4(1); }
void mainSky(out vec4 c, in vec2 f, in vec3 ro, in vec3 rd) { c = vec4(1); }
void mainImage(out vec4 c, in vec2 f) { c = vec4(1); }
)";

ReadPreset read(std::string_view text) {
    const TestFolder folder;
    folder.write("fragments/a.frag", kScene);
    return read_preset(folder.write("presets/a.toml", text));
}

const std::string kHead = "scene = \"../fragments/a.frag\"\n";

TEST(Preset, ABareSceneOpensWithItsDefaults) {
    const TestFolder folder;
    const auto file = folder.write("a.frag", kScene);
    const ReadPreset result = read_preset(file);
    ASSERT_TRUE(result.preset) << all(result.diagnostics);
    EXPECT_EQ(result.preset->file, file);
    ASSERT_EQ(result.preset->values.size(), 6u);
    EXPECT_EQ(result.preset->values[0][0], 0.6);
    EXPECT_EQ(result.preset->size, glm::ivec2(1280, 720));
    EXPECT_EQ(result.preset->date.year, 2000);
}

// As everywhere else, and not by their places.
TEST(Preset, NumbersOfAMenuAreItsNames) {
    const TestFolder folder;
    folder.write("a.frag",
                 "uniform int samples; //@ 4 {1, 4, 16}\n"
                 "void mainImage(out vec4 c, in vec2 f) { c = vec4(samples); }\n");
    const auto value = [&](const std::string& written) {
        const auto file =
            folder.write("a.toml", "scene = \"a.frag\"\n[tweaks]\nsamples = " + written + "\n");
        const ReadPreset result = read_preset(file);
        EXPECT_TRUE(result.diagnostics.empty()) << all(result.diagnostics);
        return result.preset->values[0][0];
    };
    EXPECT_EQ(value("1"), 0.0);
    EXPECT_EQ(value("4"), 1.0);
    EXPECT_EQ(value("\"16\""), 2.0);
    EXPECT_EQ(value("2"), 2.0);
}

TEST(Preset, SetsEverything) {
    const ReadPreset result = read(kHead + R"(title = "Harbour at dusk"
time = 12
size = [640, 360]
settle = 5
date = 2024-02-29T12:30:15.5
[tweaks]
choppiness = 1
tint = "#ff0000"
mode = "traced"
steps = 16
boat = true
wind = [0.5, -3]
[channels]
iChannel0 = { image = "oak.png", wrap = "clamp", filter = "nearest", vflip = false }
iChannel1 = { noise = "r 64x32" }
iChannel2 = { buffer = "sky" }
[[events]]
t = 2.0
mouse = [0.5, 0.4]
down = true
[[events]]
t = 0.5
key = "up"
down = true
[[events]]
t = 2.0
key = 65
down = false
)");
    EXPECT_EQ(all(result.diagnostics), "");
    ASSERT_TRUE(result.preset);
    const Preset& preset = *result.preset;
    EXPECT_EQ(preset.title, "Harbour at dusk");
    EXPECT_EQ(preset.time, 12.0);
    EXPECT_EQ(preset.size, glm::ivec2(640, 360));
    EXPECT_EQ(preset.settle, 5);
    EXPECT_EQ(preset.date.year, 2024);
    EXPECT_EQ(preset.date.month, 2);
    EXPECT_EQ(preset.date.day, 29);
    EXPECT_EQ(preset.date.seconds, 12 * 3600 + 30 * 60 + 15.5);
    EXPECT_EQ(preset.values, (std::vector<TweakValue>{{1}, {1, 0, 0}, {1}, {16}, {1}, {0.5, -3}}));
    EXPECT_EQ(preset.channels[0].source, Source::image);
    EXPECT_EQ(preset.channels[0].files.at(0).filename(), "oak.png");
    EXPECT_EQ(preset.channels[0].files.at(0).parent_path(), preset.file.parent_path());
    EXPECT_EQ(preset.channels[0].wrap, Wrap::clamp);
    EXPECT_EQ(preset.channels[0].filter, Filter::nearest);
    EXPECT_FALSE(preset.channels[0].vflip);
    EXPECT_EQ(preset.channels[0].place.line, 15);
    EXPECT_EQ(preset.channels[1].noise_size, glm::ivec3(64, 32, 1));
    EXPECT_EQ(preset.channels[1].filter, Filter::mipmap);
    EXPECT_EQ(preset.channels[2].type, SamplerType::samplerCube);
    EXPECT_EQ(preset.channels[2].pass, 1u);
    EXPECT_EQ(preset.channels[3].source, Source::none);
    ASSERT_EQ(preset.events.size(), 3u);
    EXPECT_EQ(preset.events[0].key, 38);
    EXPECT_EQ(preset.events[1].mouse, glm::dvec2(0.5, 0.4));  // stable: written first
    EXPECT_EQ(preset.events[2].key, 65);
    ASSERT_EQ(result.files.size(), 2u);
}

TEST(Preset, WarnsAtThePlaceAndLoadsTheRest) {
    const struct {
        const char* text;  // from line 2
        const char* diagnostic;
    } cases[] = {
        {"sise = 3", "2:1: warning: unknown key 'sise'; known are scene, title"},
        {"sise = 3", "did you mean 'size'?"},
        {"choppiness = 1", "2:1: warning: 'choppiness' is a tweak of the scene: write it below"},
        {"[tweaks]\nsize = [64, 36]", "3:1: warning: the scene has no tweak 'size': this is a key"},
        {"title = 3", "2:9: warning: title is a text"},
        {"time = \"x\"", "2:8: warning: time is a number of seconds from 0 to 1000000000; it is 0"},
        {"time = -1", "2:8: warning: time is a number of seconds from 0 to 1000000000; it is 0"},
        {"time = nan", "2:8: warning: time is a number of seconds from 0 to 1000000000; it is 0"},
        {"time = inf", "2:8: warning: time is a number of seconds from 0 to 1000000000; it is 0"},
        {"locked = 3", "2:10: warning: locked is a list of tweaks"},
        {"locked = [3]", "2:11: warning: the name of a tweak is a text"},
        {"locked = [\"choppines\"]", "2:11: warning: the scene has no tweak 'choppines'; did you"},
        {"watch = 3", "2:9: warning: watch is a list of texts"},
        {"watch = [\"nor\"]", "2:10: warning: watch is a list of texts"},
        {"size = 640", "2:8: warning: size is two whole numbers"},
        {"size = [640]", "2:8: warning: size is two whole numbers"},
        {"size = [640, 3.5]", "2:8: warning: size is two whole numbers"},
        {"size = [640, 0]", "2:14: warning: 0 pixels are outside 1 to 1000000; clamped to 1"},
        {"size = [99999999999, 1]", "2:9: warning: 99999999999 pixels are outside"},
        {"settle = 1.5", "2:10: warning: settle is a whole number"},
        {"settle = -1", "2:10: warning: settle is from 0"},
        {"time = 1e308",
         "2:8: warning: time is a number of seconds from 0 to 1000000000; it is 1e+09"},
        {"date = \"today\"", "2:8: warning: date is a date and time"},
        {"date = 2000-01-01T00:00:00Z", "2:8: warning: date is a date and time"},
        {"channels = { iChannel0 = { cube = 3 } }", "cube is a text; write cube = \"sky.hdr\""},
        {"channels = { iChannel0 = { cube = [\"a\", \"b\"] } }",
         "2:35: warning: a cube is one file, or six in the order +X -X +Y -Y +Z -Z, and not 2"},
        {"channels = { iChannel0 = { cube = [\"a\", \"b\", \"c\", 4, \"e\", \"f\"] } }",
         "2:51: warning: the name of a file is a text"},
        {"channels = { iChannel0 = { sound = \"\" } }",
         "sound is empty; write sound = \"song.ogg\""},
        {"channels = { iChannel0 = { keyboard = true, vflip = true } }",
         "2:53: warning: vflip means nothing here: an image or a cube may be turned upside down"},
        {"channels = { iChannel0 = { noise = \"rgba 64\", plays = true } }", ""},
        {"quality = { 8 = { a = 1 } }", "2:13: warning: a quality has a word for its name"},
        {"tweaks = 3", "2:10: warning: tweaks is a table"},
        {"[tweaks]\nchopiness = 1", "3:1: warning: the scene has no tweak 'chopiness'; did you"},
        {"[tweaks]\nchoppiness = 2",
         "3:14: warning: choppiness is 2, not a number from 0 to 1; "
         "clamped to 1"},
        {"[tweaks]\nchoppiness = inf", "clamped to 1"},
        {"[tweaks]\nchoppiness = nan", "3:14: warning: choppiness takes a number"},
        {"[tweaks]\nchoppiness = true", "3:14: warning: choppiness takes a number"},
        {"[tweaks]\nchoppiness = [1]", "3:14: warning: choppiness takes a number"},
        {"[tweaks.choppiness]\nx = 1", "2:1: warning: choppiness takes a number"},
        {"[tweaks]\ntint = \"#12345\"", "3:8: warning: tint takes three numbers"},
        {"[tweaks]\ntint = [1, 2]", "3:8: warning: tint takes three numbers"},
        {"[tweaks]\ntint = [1, 2, \"x\"]", "3:8: warning: tint takes three numbers"},
        {"[tweaks]\nmode = \"of\"", "3:8: warning: mode takes off, traced"},
        {"[tweaks]\nmode = 2", "clamped to traced"},
        {"[tweaks]\nsteps = 1.5", "3:9: warning: steps takes a whole number"},
        {"[tweaks]\nsteps = 9223372036854775807", "clamped to 64"},
        {"[tweaks]\nboat = 1", "3:8: warning: boat takes on or off"},
        {"[tweaks]\nwind = [9, 0]", "clamped to 5, 0"},
        {"[channels]\niChanel0 = 3", "3:1: warning: unknown key 'iChanel0'"},
        {"[channels]\niChannel0 = 3", "3:13: warning: iChannel0 is a table"},
        {"[channels]\niChannel0 = {}", "3:13: warning: this channel has no source"},
        {"[channels]\niChannel0 = { imag = \"a\" }", "did you mean 'image'?"},
        {"[channels]\niChannel0 = { image = 1 }", "3:23: warning: image is a text"},
        {"[channels]\niChannel0 = { noise = \"rgba\" }", "size of the noise is missing"},
        {"[channels]\niChannel0 = { buffer = \"wave\" }", "did you mean 'waves'?"},
        {"[channels]\niChannel0 = { keyboard = 1 }", "keyboard is a switch"},
        {"[channels]\niChannel0 = { keyboard = false }", "keyboard is a switch"},
        {"[channels]\niChannel0 = { keyboard = true, noise = \"8\" }", "has one source"},
        {"[channels]\niChannel0 = { keyboard = true, wrap = \"x\" }", "wrap is \"clamp\""},
        {"[channels]\niChannel0 = { keyboard = true, filter = 1 }", "filter is \"nearest\""},
        {"[channels]\niChannel0 = { image = \"a\", vflip = 1 }", "vflip is true or false"},
        {"[channels]\niChannel0 = { noise = \"8\", plays = 1 }", "plays is true or false"},
        {"[channels]\niChannel3 = { keyboard = true }", "3:1: warning: the scene fills iChannel3"},
        {"events = 3", "2:10: warning: events is a list"},
        {"events = [3]", "2:11: warning: an event is a table"},
        {"[[events]]\nkey = \"up\"\ndown = true", "2:1: warning: an event needs its time"},
        {"[[events]]\nt = -1\nkey = \"up\"\ndown = true", "3:5: warning: an event needs its time"},
        {"[[events]]\nt = 1\nkey = \"up\"", "2:1: warning: an event says down"},
        {"[[events]]\nt = 1\ndown = true", "2:1: warning: an event has either"},
        {"[[events]]\nt = 1\ndown = true\nkey = \"uppp\"", "5:7: warning: no such key"},
        {"[[events]]\nt = 1\ndown = true\nkey = 256", "5:7: warning: no such key"},
        {"[[events]]\nt = 1\ndown = true\nmouse = [1]", "5:9: warning: mouse is two fractions"},
        {"[[events]]\nt = 1\ndown = true\nmouse = [1, nan]", "5:9: warning: mouse is two"},
        {"[[events]]\nt = 1\ndown = true\nkey = 1\nbutton = 1", "6:1: warning: unknown key"},
    };
    for (const auto& c : cases) {
        const ReadPreset result = read(kHead + c.text + "\n");
        const std::string said = all(result.diagnostics);
        EXPECT_NE(said.find(c.diagnostic), std::string::npos) << c.text << "\n" << said;
        EXPECT_EQ(said.find("error"), std::string::npos) << c.text << "\n" << said;
        ASSERT_TRUE(result.preset) << c.text;
        for (std::size_t i = 0; i < result.preset->values.size(); ++i)
            EXPECT_EQ(clamp_to_range(result.preset->scene.tweaks[i], result.preset->values[i]),
                      result.preset->values[i]);
    }
}

TEST(Preset, WarningsFollowTheOrderOfTheLines) {
    const ReadPreset result = read(kHead + "zeta = 1\nalpha = 1\n[tweaks]\nsteps = 99\nboat = 1\n");
    std::vector<int> lines;
    for (const Diagnostic& diagnostic : result.diagnostics) lines.push_back(diagnostic.place.line);
    EXPECT_EQ(lines, (std::vector<int>{2, 3, 5, 6}));
}

// The system would read the name up to there, and open another file.
TEST(Preset, ANameWithANulOpensNothing) {
    const TestFolder folder;
    folder.write("a.frag", kScene);
    const ReadPreset scene = read_preset(folder.write("a.toml", "scene = \"a.frag\\u0000.png\"\n"));
    EXPECT_FALSE(scene.preset);
    EXPECT_NE(all(scene.diagnostics)
                  .find("a.toml:1:9: error: the scene is missing, for this is no file's name"),
              std::string::npos)
        << all(scene.diagnostics);
    const ReadPreset picture = read_preset(folder.write(
        "b.toml", "scene = \"a.frag\"\n[channels]\niChannel0 = {image = \"a.png\\u0000.x\"}\n"));
    EXPECT_NE(all(picture.diagnostics).find("b.toml:3:"), std::string::npos)
        << all(picture.diagnostics);
}

TEST(Preset, ASyntaxErrorHasAPlace) {
    for (const char* text : {"scene = \n", "[tweaks\n", "a = 1\na = 2\n", "x = \"\xFF\"\n",
                             "x = [[[[\n", "[#x]\n", "[[#x]]\n", "[a.#]\n", "x = 1979-99-99\n",
                             "\u00e9 = 3\n", "c\u0327 = 3\n", "x = \u00e9\n"}) {
        const ReadPreset result = read(kHead + text);
        EXPECT_FALSE(result.preset) << text;
        ASSERT_EQ(result.diagnostics.size(), 1u) << text;
        EXPECT_EQ(result.diagnostics[0].severity, Severity::error);
        EXPECT_GE(result.diagnostics[0].place.line, 2) << all(result.diagnostics);
        EXPECT_GE(result.diagnostics[0].place.column, 1);
    }
}

TEST(Preset, WithoutASceneIsAnError) {
    const std::pair<const char*, const char*> cases[] = {
        {"", "a.toml:1:1: error: the scene is missing"},
        {"title = \"x\"\n", "a.toml:1:1: error: the scene is missing"},
        {"scene = 3\n", "a.toml:1:9: error: the scene is missing, for this is no file's name"},
        {"scene = \"\"\n", "a.toml:1:9: error: the scene is missing, for this is no file's name"}};
    for (const auto& [text, told] : cases) {
        const ReadPreset result = read(text);
        EXPECT_FALSE(result.preset);
        EXPECT_NE(all(result.diagnostics).find(told), std::string::npos) << all(result.diagnostics);
    }
}

TEST(Preset, AMissingSceneIsReportedWhereItIsNamed) {
    const ReadPreset result = read("title = \"x\"\nscene = \"none.frag\"\n");
    EXPECT_FALSE(result.preset);
    ASSERT_EQ(result.diagnostics.size(), 1u);
    EXPECT_TRUE(result.diagnostics[0].missing_file);
    EXPECT_TRUE(result.diagnostics[0].place.file.ends_with("a.toml"));
    EXPECT_EQ(result.diagnostics[0].place.line, 2);
    EXPECT_EQ(result.diagnostics[0].place.column, 9);
    EXPECT_EQ(result.files.size(), 2u);
}

TEST(Preset, AMissingPresetIsMissing) {
    const TestFolder folder;
    const ReadPreset result = read_preset(folder.path() / "none.toml");
    EXPECT_FALSE(result.preset);
    ASSERT_EQ(result.diagnostics.size(), 1u);
    EXPECT_TRUE(result.diagnostics[0].missing_file);
    EXPECT_EQ(result.diagnostics[0].place.line, 0);
}

TEST(Preset, PassesOnWhatTheSceneSays) {
    const TestFolder folder;
    folder.write("a.frag", "uniform float a; //@ x\n" + kScene);
    const ReadPreset result =
        read_preset(folder.write("a.toml", "scene = \"a.frag\"\n[tweaks]\na = 1\nnone = 1\n"));
    EXPECT_FALSE(result.preset);
    ASSERT_EQ(result.diagnostics.size(), 1u) << all(result.diagnostics);
    EXPECT_TRUE(result.diagnostics[0].place.file.ends_with("a.frag"));
}

TEST(Preset, DeepNestingIsAnErrorNotACrash) {
    const ReadPreset result = read("x = " + std::string(100000, '[') + "\n");
    EXPECT_FALSE(result.preset);
    EXPECT_TRUE(has_errors(result.diagnostics));
}

TEST(Preset, WhatIsNoTomlSaysWhatToWrite) {
    const std::pair<const char*, const char*> cases[] = {
        {"time = .5", "a.toml:2:8: error: no valid TOML: a number has digits on both sides"},
        {"time = 0,5",
         "a.toml:2:9: error: no valid TOML: one value stands here; a number has a point"},
        {"title = \"open", "a.toml:2:14: error: no valid TOML: this text is not closed"},
        {"time = 1\ntime = 2",
         "a.toml:3:8: error: no valid TOML: 'time' stands here a second time"},
        {"time: 1", "a.toml:2:5: error: no valid TOML: behind a key stands '='"},
        {"[tweaks\nmode = 1", "a.toml:2:8: error: no valid TOML: this '[' is never closed"},
        {"time =", "a.toml:2:7: error: no valid TOML: the value is missing"},
        {"[tweaks]\ntint = #ff0000",
         "a.toml:3:8: error: no valid TOML: the value is missing: '#' begins"},
        {"[tweaks]\ntint = vec3(1)", "a.toml:3:8: error: no valid TOML: this is no value"},
        {"[tweaks]\nboat = True", "a.toml:3:8: error: no valid TOML: a switch is true or false"},
        {"// note", "a.toml:2:1: error: no valid TOML: here stands a key"}};
    for (const auto& [text, said] : cases) {
        const ReadPreset result = read(kHead + text + "\n");
        EXPECT_FALSE(result.preset) << text;
        ASSERT_EQ(result.diagnostics.size(), 1u) << text;
        EXPECT_NE(all(result.diagnostics).find(said), std::string::npos) << all(result.diagnostics);
    }
}

TEST(Diagnostic, IsWrittenForAnEditor) {
    EXPECT_EQ(to_string({Severity::error, {"a.frag", 3, 7}, "x"}), "a.frag:3:7: error: x");
    EXPECT_EQ(to_string({Severity::warning, {"a.frag", 3, 0}, "x"}), "a.frag:3: warning: x");
    EXPECT_EQ(to_string({Severity::error, {"a.frag"}, "x"}), "a.frag: error: x");
}

TEST(Diagnostic, GuessesTheWordThatWasMeant) {
    const std::vector<std::string> known = {"size", "scale", "step", "format"};
    EXPECT_EQ(nearest("sise", known), "size");
    EXPECT_EQ(nearest("fromat", known), "format");
    EXPECT_EQ(nearest("colour", known), "");
    EXPECT_EQ(nearest("", known), "");
    EXPECT_EQ(nearest(std::string(1 << 20, 's'), known), "");
}

}  // namespace
}  // namespace glint::preset_test
