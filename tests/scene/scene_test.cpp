// Whole files: what they declare, what is blanked, and what they say when something is wrong.
#include "scene/scene.h"

#include "temporary_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace glint {
namespace {

const std::string kImage = "void mainImage(out vec4 c, in vec2 f) { c = vec4(1); }\n";

std::string all(const Diagnostics& diagnostics) {
    std::string text;
    for (const Diagnostic& diagnostic : diagnostics) text += to_string(diagnostic) + "\n";
    return text;
}

ReadScene read(std::string_view text) {
    const TemporaryFolder folder;
    return read_scene(folder.write("a.frag", text));
}

// The scene of a text that is right; an empty one, and a failure, when it is not.
Scene good(std::string_view text) {
    ReadScene result = read(text);
    EXPECT_EQ(all(result.diagnostics), "") << text;
    return result.scene.value_or(Scene{});
}

std::string tweak_names(const Scene& scene) {
    std::string names;
    for (const Tweak& tweak : scene.tweaks) names += tweak.name + " ";
    return names;
}

std::string lines(int count, std::string_view line) {
    std::string text;
    for (int i = 0; i < count; ++i) text += line;
    return text;
}

TEST(Scene, TheSmallestIsMainImageAlone) {
    const Scene scene = good(kImage);
    EXPECT_EQ(scene.text, kImage);
    EXPECT_EQ(scene.origins.size(), 1u);
    EXPECT_EQ(scene.files.size(), 1u);
    EXPECT_TRUE(scene.tweaks.empty() && scene.samplers.empty() && scene.passes.empty());
    EXPECT_EQ(scene.image_entry, "mainImage");
    EXPECT_FALSE(scene.has_sound);
}

TEST(Scene, ReadsTheExampleOfTheManual) {
    const Scene scene = good(R"(
uniform float choppiness;     //@ 0.6 [0, 1] "steepness of the crests"
uniform float turbidity;      //@ 2.0 [0.1, 100] log unit=1/m "how fast light fades under water"
uniform vec3  waterTint;      //@ #0b3a53 "colour of deep water"
uniform bool  firstPerson;    //@ off "eye on the boat"
uniform int   reflections;    //@ 1 {off, screen-space, traced} "how mirrors find what they show"
uniform int   marchSteps;     //@ 64 [8, 1024] log quality reference=4096 "steps along one view ray"

uniform sampler2D albedo;     //@ pass mainGBuffer
uniform sampler2D normalDepth;//@ pass mainGBuffer
uniform sampler2D waves;      //@ pass mainWaves size=256x256 step=1/240 wrap=repeat
uniform sampler2D wood;       //@ image textures/wood.png wrap=repeat filter=mipmap
uniform sampler2D grain;      //@ noise rgba 256
uniform samplerCube sky;      //@ pass mainSky size=256
uniform sampler2D keys;       //@ keyboard
void mainGBuffer(out vec4 a, out vec4 n, in vec2 f) {}
void mainWaves(out vec4 c, in vec2 f) {}
void mainSky(out vec4 c, in vec2 f, in vec3 o, in vec3 d) {}
void mainImage(out vec4 c, in vec2 f) {}
)");
    EXPECT_EQ(tweak_names(scene),
              "choppiness turbidity waterTint firstPerson reflections marchSteps ");
    ASSERT_EQ(scene.samplers.size(), 7u);
    ASSERT_EQ(scene.passes.size(), 3u);
    EXPECT_EQ(scene.passes[0].name, "albedo");
    EXPECT_EQ(scene.passes[0].entry, "mainGBuffer");
    EXPECT_EQ(scene.passes[0].outputs, (std::vector<std::string>{"albedo", "normalDepth"}));
    EXPECT_FALSE(scene.passes[0].size);
    EXPECT_EQ(scene.passes[1].size, glm::ivec2(256, 256));
    EXPECT_EQ(scene.passes[1].step, (Step{1, 240}));
    EXPECT_TRUE(scene.passes[2].cube);
    EXPECT_EQ(scene.passes[2].size, glm::ivec2(256));
    EXPECT_EQ(scene.passes[2].format, PixelFormat::rgba16f);
    EXPECT_EQ(scene.samplers[1].pass, 0u);
    EXPECT_EQ(scene.samplers[1].output, 1u);
    EXPECT_EQ(scene.samplers[2].pass, 1u);
    EXPECT_EQ(scene.samplers[2].place.line, 11);
    EXPECT_EQ(scene.samplers[2].place.column, 19);
}

TEST(Scene, ACubeIsAThousandPixelsWideUnlessWritten) {
    const Scene scene = good(
        "uniform samplerCube s; //@ pass mainCubemap\n"
        "void mainCubemap(out vec4 c, in vec2 f, in vec3 ro, in vec3 rd) { c = vec4(1); }\n" +
        kImage);
    EXPECT_EQ(scene.passes.at(0).size, glm::ivec2(1024));
}

TEST(Scene, KnowsTheBytesOfEachDeclaration) {
    const ReadScene result = read(
        "  uniform  float\n  a /* x */ ; //@ 1\nhighp uniform mediump int b; //@ 2\n" + kImage);
    ASSERT_TRUE(result.scene) << all(result.diagnostics);
    const auto declaration = [&](std::size_t i) {
        const Tweak& tweak = result.scene->tweaks.at(i);
        return result.scene->text.substr(tweak.declaration_begin,
                                         tweak.declaration_end - tweak.declaration_begin);
    };
    EXPECT_EQ(declaration(0), "uniform  float\n  a /* x */ ;");
    EXPECT_EQ(declaration(1), "highp uniform mediump int b;");
}

TEST(Scene, GroupsHeadTheTweaksAfterThem) {
    const Scene scene = good(
        "uniform float a; //@ 1\n//@ group Deep water\nuniform float b; //@ 1\n"
        "uniform float c; //@ 1 group=Own\nuniform float d; //@ 1\n//@ group\n"
        "uniform float e; //@ 1\n" +
        kImage);
    std::vector<std::string> groups;
    for (const Tweak& tweak : scene.tweaks) groups.push_back(tweak.group);
    EXPECT_EQ(groups, (std::vector<std::string>{"", "Deep water", "Own", "Deep water", ""}));
}

TEST(Scene, BlanksTheHostsOwnInPlace) {
    const struct {
        const char* line;
        const char* blanked;
    } cases[] = {
        {"uniform vec3 iResolution;", "                         "},
        {"uniform highp float iTime ; int x;", "                            int x;"},
        {"uniform vec3 iResolution, foo;", "uniform vec3              foo;"},
        {"uniform float foo, iTime;", "uniform float foo       ;"},
        {"uniform float iTime, foo, iTimeDelta, bar, iFrameRate;",
         "uniform float        foo            , bar            ;"},
        {"uniform float iTime, iTimeDelta, foo;", "uniform float                    foo;"},
        {"uniform vec3 iChannelResolution[4];", "                                   "},
        {"uniform float[4] iChannelTime;", "                              "},
        {"uniform float iChannelTime[ 4 ];", "                                "},
        {"uniform sampler2D iChannel0, iChannel1;", "                                       "},
        {"uniform samplerCube iChannel3;", "                              "},
        {"layout(location=0) uniform uint iTick;", "                                      "},
        {"uniform /* a */ int iFrame; // b", "                            // b"},
        {"#version 300 es", "               "},
        {"  # version 100 // x", "                // x"},
        {"#line 7", "       "},
        {"#pragma once", "            "},
        {"#define iTime 3", "#define iTime 3"},
        {"float f(float iTime) { return iTime; }", "float f(float iTime) { return iTime; }"},
        {"// uniform float iTime;", "// uniform float iTime;"},
        {"/* uniform float iTime; */", "/* uniform float iTime; */"},
    };
    for (const auto& c : cases) {
        const ReadScene result = read(c.line + ("\n" + kImage));
        ASSERT_TRUE(result.scene) << all(result.diagnostics);
        EXPECT_EQ(result.scene->text, c.blanked + ("\n" + kImage)) << c.line;
    }
}

TEST(Scene, AChannelWithAnAnnotationIsAnOrdinarySampler) {
    const Scene scene =
        good("uniform sampler2D iChannel0; //@ noise 8\nuniform sampler2D iChannel1;\n" + kImage);
    ASSERT_EQ(scene.samplers.size(), 1u);
    EXPECT_EQ(scene.samplers[0].name, "iChannel0");
    EXPECT_NE(scene.text.find("uniform sampler2D iChannel0;"), std::string::npos);
    EXPECT_EQ(scene.text.find("iChannel1"), std::string::npos);
}

TEST(Scene, ATabsEntryIsMainImage) {
    const Scene scene = good(
        "uniform sampler2D bufferA; //@ pass mainA\nuniform sampler2D bufferB; //@ pass mainB\n"
        "uniform sampler2D bufferC; //@ pass bufferC\n"
        "// mainA is not here\nvoid mainB(out vec4 c, in vec2 f) {}\n#ifdef PASS_bufferA\n" +
        kImage + "#elif defined(PASS_bufferC)\n" + kImage + "#else\n" + kImage + "#endif\n");
    EXPECT_EQ(scene.passes.at(0).entry, "mainImage");
    EXPECT_EQ(scene.passes.at(1).entry, "mainB");
    EXPECT_EQ(scene.passes.at(2).entry, "mainImage");
}

TEST(Scene, OneOutputsTabIsTheTabOfItsPass) {
    const Scene scene = good(
        "uniform sampler2D a; //@ pass mainAB\nuniform sampler2D b; //@ pass mainAB\n#ifdef "
        "PASS_b\n"
        "void mainImage(out vec4 c, out vec4 d, in vec2 f) {}\n#endif\n#ifdef PASS_image\n" +
        kImage + "#endif\n");
    EXPECT_EQ(scene.passes.at(0).entry, "mainImage");
}

TEST(Scene, ATabForAllButThePictureMayStandBehindAnElse) {
    const Scene scene = good("uniform sampler2D a; //@ pass mainA\n#ifdef PASS_image\n" + kImage +
                             "#else\n" + kImage + "#endif\n");
    EXPECT_EQ(scene.passes.at(0).entry, "mainImage");
}

TEST(Scene, APassWithoutItsFunctionIsAnErrorThatNamesTheNearestAndAllThereAre) {
    const ReadScene result = read(
        "uniform sampler2D waves; //@ pass mainWawes\n"
        "void helper(vec2 p, out float d) { d = p.x; }\n"
        "void mainWaves(out vec4 c, in vec2 f) { c = vec4(1); }\n" +
        kImage);
    EXPECT_FALSE(result.scene);
    const std::string text = all(result.diagnostics);
    EXPECT_NE(text.find("a.frag:1:35: error: there is no function 'mainWawes' among mainWaves, "
                        "mainImage; did you mean 'mainWaves'?"),
              std::string::npos)
        << text;
    EXPECT_EQ(text.find("helper"), std::string::npos);
}

TEST(Scene, APassNobodyReadsOrACubeWithoutItsFunctionIsAnErrorToo) {
    for (const char* line :
         {"uniform samplerCube sky; //@ pass mainSkyy\n", "uniform sampler2D a; //@ pass a\n",
          "uniform sampler2D a; //@ pass mainA\nuniform sampler2D b; //@ pass mainA\n"}) {
        const ReadScene result = read(line + kImage);
        EXPECT_FALSE(result.scene) << line;
        EXPECT_NE(all(result.diagnostics).find("there is no function"), std::string::npos) << line;
    }
}

TEST(Scene, AFunctionThatAMacroMakesIsLeftToTheDriver) {
    for (const char* text :
         {"#define ENTRY(name) void name(out vec4 c, in vec2 f)\nENTRY(mainA) { c = vec4(1); }\n",
          "#define other mainA\nvoid other(out vec4 c, in vec2 f) { c = vec4(1); }\n",
          "#define ENTRY(x) void main##x(out vec4 c, in vec2 f)\nENTRY(A) { c = vec4(1); }\n",
          "#if 1\nvoid mainA(out vec4 c, in vec2 f) { c = vec4(1); }\n#endif\n"}) {
        const Scene scene = good("uniform sampler2D a; //@ pass mainA\n" + (text + kImage));
        ASSERT_EQ(scene.passes.size(), 1u) << text;
        EXPECT_EQ(scene.passes[0].entry, "mainA") << text;
    }
}

TEST(Scene, AFunctionMayStandInAnIncludedFile) {
    const TemporaryFolder folder;
    folder.write("waves.glsl", "void mainWaves(out vec4 c, in vec2 f) { c = vec4(1); }\n");
    const char* text = "#include \"waves.glsl\"\nuniform sampler2D waves; //@ pass mainWaves\n";
    const ReadScene read = read_scene(folder.write("a.frag", text + kImage));
    EXPECT_EQ(all(read.diagnostics), "");
    const ReadScene missing = read_scene(folder.write(
        "b.frag",
        "#include \"none.glsl\"\nuniform sampler2D waves; //@ pass mainWaves\n" + kImage));
    EXPECT_EQ(missing.diagnostics.size(), 1u) << all(missing.diagnostics);
}

TEST(Scene, AnotherReaderSharesTheBufferButNotTheFilter) {
    const Scene scene = good(
        "uniform sampler2D sharp; //@ buffer b filter=nearest\n"
        "uniform sampler2D a; //@ pass mainAB\nuniform sampler2D b; //@ pass mainAB "
        "filter=mipmap\nvoid mainAB(out vec4 c, out vec4 d, in vec2 f) { c = d = vec4(1); }\n" +
        kImage);
    EXPECT_EQ(scene.passes.size(), 1u);
    EXPECT_EQ(scene.samplers.at(0).output, 1u);
    EXPECT_EQ(scene.samplers.at(0).filter, Filter::nearest);
    EXPECT_EQ(scene.samplers.at(2).filter, Filter::mipmap);
}

TEST(Scene, LaterOutputsRepeatOrOmitWhatTheFirstSays) {
    const std::string first = "uniform sampler2D a; //@ pass p size=64 format=rgba8\n";
    const std::string rest =
        "void p(out vec4 c, out vec4 d, in vec2 f) { c = d = vec4(1); }\n" + kImage;
    for (const char* same : {"", " size=64x64", " format=rgba8 size=64"})
        good(first + "uniform sampler2D b; //@ pass p" + same + "\n" + rest);
    for (const char* other : {" size=32", " scale=0.5", " format=rgba32f", " step=1/60"}) {
        const ReadScene result =
            read(first + "uniform sampler2D b; //@ pass p" + other + "\n" + rest);
        EXPECT_FALSE(result.scene) << other;
        EXPECT_NE(all(result.diagnostics).find("a.frag:2:"), std::string::npos);
    }
}

TEST(Scene, SoundIsFoundOnlyInCode) {
    EXPECT_TRUE(good("vec2 mainSound(int s, float t) { return vec2(0); }\n" + kImage).has_sound);
    EXPECT_FALSE(good("// mainSound\n" + kImage).has_sound);
    EXPECT_FALSE(good("#if 0\nvec2 mainSound(float t);\n#endif\n" + kImage).has_sound);
    EXPECT_TRUE(
        good("#if 0\n#if 1\n#endif\n#else\nvec2 mainSound(float t);\n#endif\n" + kImage).has_sound);
}

TEST(Scene, SaysWhatIsWrongAndWhere) {
    const struct {
        const char* text;  // before mainImage
        const char* diagnostic;
    } cases[] = {
        {"uniform float a;", "1:15: warning: 'a' has no annotation, so it stays 0"},
        {"uniform sampler2D a;", "1:19: warning: 'a' has no annotation"},
        {"uniform vec3 iTime, b;", "1:14: error: 'iTime' is the host's own, of another type"},
        {"uniform vec2 iResolution;", "uniform vec3 iResolution"},
        {"uniform float iChannelTime;", "uniform float iChannelTime[4]"},
        {"uniform float iChannelTime[3];", "uniform float iChannelTime[4]"},
        {"uniform vec3 iMouse;", "uniform vec4 iMouse"},
        {"uniform int iTick;", "uniform uint iTick"},
        {"uniform vec4 iChannel2;", "uniform sampler2D iChannel2"},
        {"float x; //@ 0.5", "1:10: warning: no uniform on this line"},
        {"//@ groop Water", "1:1: warning: no uniform on this line"},
        {"uniform float a[3]; //@ 1", "1:15: error: an annotation is for one plain uniform"},
        {"uniform float[3] a; //@ 1", "1:18: error: an annotation is for one plain uniform"},
        {"uniform Light { vec3 l; }; //@ 1", "1:1: error: an annotation is for one plain uniform"},
        {"uniform struct L { vec3 l; } a; //@ 1", "1:1: error: an annotation is for one plain"},
        {"uniform float a, b; //@ 1", "1:18: error: an annotation is for one uniform"},
        {"uniform float a = 1.0; //@ 1", "1:15: error: GLSL ES gives uniforms no value here"},
        {"uniform float a //@ 1\nuniform float b; //@ 2", "1:1: error: this declaration is not"},
        {"uniform mat3 a; //@ 1", "1:9: error: 'mat3' cannot be annotated"},
        {"uniform uint a; //@ 1", "1:9: error: 'uint' cannot be annotated"},
        {"uniform float iTime; //@ 1", "1:15: error: 'iTime' is the host's own"},
        {"uniform float iChannel0; //@ 1", "1:15: error: 'iChannel0' is the host's own"},
        {"uniform float a; //@ 1\nuniform int a; //@ 1", "2:13: error: 'a' is declared already"},
        {"uniform float a; //@ 2 [0, 1]", "1:22: error: the default 2 is outside"},
        {"uniform float a; //@ 1 shiny", "1:24: error: unknown word 'shiny'"},
        {"uniform float a; uniform float b; //@ 1", "1:15: warning: 'a' has no annotation"},
        {"uniform sampler2D a; //@ buffer b", "1:33: error: no pass fills a sampler 'b'"},
        {"uniform sampler2D ab; //@ pass p\nuniform sampler2D b; //@ buffer abb",
         "did you mean 'ab'"},
        {"uniform sampler2D a; //@ pass p\nuniform samplerCube b; //@ buffer a",
         "2:35: error: 'a' is not of the same sampler type"},
        {"uniform samplerCube a; //@ pass p\nuniform samplerCube b; //@ pass p",
         "2:33: error: a cube pass fills one samplerCube"},
        {"uniform sampler2DArray a; //@ image x.png", "'sampler2DArray' cannot be annotated"},
        {"int x; /* never", "1:8: error: this comment is never closed"},
        {"/* \xC3\xA4\xC3\xB6 */ uniform float a;", "1:24: warning: 'a'"},  // columns of characters
    };
    for (const auto& c : cases) {
        const ReadScene result = read(c.text + ("\n" + kImage));
        const std::string said = all(result.diagnostics);
        EXPECT_NE(said.find(c.diagnostic), std::string::npos) << c.text << "\n" << said;
        EXPECT_EQ(result.scene.has_value(), !has_errors(result.diagnostics)) << c.text;
    }
}

TEST(Scene, ReportsEveryError) {
    const ReadScene result = read(
        "uniform float a; //@ x\nuniform float b; //@ 1 y\n"
        "uniform vec2 iTime;\n" +
        kImage);
    EXPECT_EQ(result.diagnostics.size(), 3u) << all(result.diagnostics);
    EXPECT_FALSE(result.scene);
}

TEST(Scene, AFileWithoutAShaderSaysWhatToWrite) {
    for (const char* text : {"", "\n", "// void mainImage\n", "\xEF\xBB\xBF", "void main() {}"}) {
        const ReadScene result = read(text);
        EXPECT_FALSE(result.scene);
        EXPECT_NE(all(result.diagnostics).find("write void mainImage("), std::string::npos) << text;
    }
}

TEST(Scene, AMissingFileAndAFolderAreMissing) {
    const TemporaryFolder folder;
    for (const auto& path : {folder.path() / "none.frag", folder.path()}) {
        const ReadScene result = read_scene(path);
        EXPECT_FALSE(result.scene);
        ASSERT_EQ(result.diagnostics.size(), 1u);
        EXPECT_TRUE(result.diagnostics[0].missing_file);
        EXPECT_EQ(result.diagnostics[0].place.file, path.string());
        EXPECT_EQ(result.diagnostics[0].place.line, 0);
        EXPECT_EQ(result.files, (std::vector<std::filesystem::path>{path}));
    }
}

TEST(Scene, ATabHasSamplersOfItsOwn) {
    const Scene scene = good(
        "uniform sampler2D bufferA; //@ pass mainBufferA\n"
        "#ifdef PASS_bufferA\n"
        "uniform sampler2D iChannel0; //@ buffer bufferA\n"
        "#if 1\n"
        "uniform sampler2D iChannel1; //@ keyboard\n"
        "#endif\n"
        "#endif\n"
        "#if defined(PASS_image)\n"
        "uniform samplerCube iChannel0; //@ noise 16\n"
        "#else\n"
        "uniform sampler2D everywhere; //@ noise 16\n"
        "#endif\n" +
        std::string(kImage));
    std::string tabs;
    for (const Sampler& sampler : scene.samplers) tabs += sampler.name + ":" + sampler.tab + " ";
    EXPECT_EQ(tabs, "bufferA: iChannel0:bufferA iChannel1:bufferA iChannel0:image everywhere: ");
    const ReadScene twice = read(
        "#ifdef PASS_image\n"
        "uniform sampler2D a; //@ keyboard\n"
        "uniform sampler2D a; //@ keyboard\n"
        "#endif\n" +
        std::string(kImage));
    EXPECT_NE(all(twice.diagnostics).find("3:19: error: 'a' is declared already"),
              std::string::npos)
        << all(twice.diagnostics);
    EXPECT_FALSE(read("uniform sampler2D a; //@ keyboard\n#ifdef PASS_image\n"
                      "uniform sampler2D a; //@ keyboard\n#endif\n" +
                      std::string(kImage))
                     .scene);
}

TEST(OddText, EveryKindOfLineEndIsOne) {
    const std::string plain = "// one\n\nuniform float a; //@ 0.5 [0, 1] \"x\"\n" + kImage;
    const std::string expected = good(plain).text;
    for (const std::string& end : {std::string("\r\n"), std::string("\r")}) {
        std::string text;
        for (const char c : plain) text += c == '\n' ? end : std::string(1, c);
        const Scene scene = good(text);
        EXPECT_EQ(scene.text, expected);
        EXPECT_EQ(scene.origins.size(), 4u);
        EXPECT_EQ(scene.tweaks.at(0).place.line, 3);
        EXPECT_EQ(scene.tweaks.at(0).description, "x");
    }
    EXPECT_EQ(good("\xEF\xBB\xBF" + plain).text, expected);
    EXPECT_EQ(good(plain.substr(0, plain.size() - 1)).text, expected);
}

TEST(OddText, IsReadWithoutHarm) {
    const struct {
        const char* name;
        std::string text;
        const char* tweaks;
    } cases[] = {
        {"a note in a block comment", "/*\nuniform float a; //@ 1\n*/", ""},
        {"a comment in a comment", "// /*\nuniform float a; //@ 1\n// */", "a "},
        {"a comment within a declaration", "uniform /* // */ float // x\n a; //@ 1", "a "},
        {"a note within a declaration", "uniform float //@ 1\n a;", "a "},
        {"a joined comment", "// \\\nuniform float a; //@ 1", ""},
        {"a joined note", "uniform vec2 a; //@ 1, \\\n 2 [0, \\\n 3]", "a "},
        {"a joined declaration", "uniform \\\n float a; //@ 1", "a "},
        {"a macro's body", "#define U uniform float a; \\\n uniform float b; //@ 1\n", ""},
        {"a dead branch", "#if 0\nuniform float a; //@ 1\n#include \"none\"\n#endif", ""},
        {"Latin-1 in a comment", "// gr\xFC\xDF\nuniform float a; //@ 1 \"gr\xFC\xDF\"", "a "},
        {"a precision statement", "precision mediump float;\nuniform float a; //@ 1", "a "},
        {"a block's members", "struct S { float uniformity; }; uniform float a; //@ 1", "a "},
        {"tabs and form feeds", "\tuniform\tfloat\fa\v;\t//@\t1\t[0,\t1]", "a "},
    };
    for (const auto& c : cases) {
        ReadScene result = read(c.text + "\n" + kImage);
        ASSERT_TRUE(result.scene) << c.name << "\n" << all(result.diagnostics);
        EXPECT_EQ(tweak_names(*result.scene), c.tweaks) << c.name;
    }
}

TEST(OddText, ANulByteIsAnErrorAtItsPlace) {
    const ReadScene result = read(std::string("// ab\nx\0y\n", 10) + kImage);
    EXPECT_FALSE(result.scene);
    EXPECT_NE(all(result.diagnostics).find("a.frag:2:2: error: a NUL byte"), std::string::npos)
        << all(result.diagnostics);
}

TEST(OddText, MainImageMayStandBehindAMacro) {
    good("#define main_image mainImage\nvoid main_image(out vec4 c, in vec2 f) { c = vec4(1); }\n");
}

// What is quadratic would take minutes here.
TEST(OddText, AnEndlessLineIsReadInLinearTime) {
    const std::string endless(1 << 20, 'x');
    for (const std::string& text :
         {endless, "// " + endless, "//@ " + endless, "/*" + endless + "*/",
          "uniform float a; //@ 1 " + endless, "uniform float a; //@ 1 \"" + endless + "\"",
          "uniform float a; //@ " + lines(1 << 16, "1, "), "#include " + lines(1 << 16, "< \" "),
          lines(1 << 14, "uniform float a;"), lines(1 << 14, "uniform "), lines(1 << 16, "/**/ "),
          lines(1 << 14, "//@ 1\n"), "uniform float " + lines(1 << 16, "a, ") + "b;",
          "uniform int a; //@ 0 {" + lines(1 << 16, "a, ") + "b}", lines(1 << 17, "\\\n"),
          lines(1 << 17, "{ "), "uniform float a" + lines(1 << 17, "["),
          lines(1 << 14, "#if 0\n")}) {
        const ReadScene result = read(text + "\n" + kImage);
        EXPECT_EQ(result.scene.has_value(), !has_errors(result.diagnostics));
    }
}

TEST(Include, StandsInPlaceAndKeepsEveryLinesOrigin) {
    const TemporaryFolder folder;
    folder.write("lib/noise.glsl", "float n;\n#include \"hash.glsl\"\nuniform float a; //@ x");
    folder.write("lib/hash.glsl", "float h;\n");
    const auto file =
        folder.write("a.frag", "int one;\n  #include <lib/noise.glsl> // hi\n" + kImage);
    const ReadScene wrong = read_scene(file);
    EXPECT_EQ(wrong.diagnostics.size(), 1u);
    EXPECT_EQ(wrong.diagnostics.at(0).place.file, (folder.path() / "lib/noise.glsl").string());
    EXPECT_EQ(wrong.diagnostics.at(0).place.line, 3);
    EXPECT_EQ(wrong.diagnostics.at(0).place.column, 22);

    folder.write("lib/noise.glsl", "float n;\n#include \"hash.glsl\"\nuniform float a; //@ 1");
    const ReadScene result = read_scene(file);
    ASSERT_TRUE(result.scene) << all(result.diagnostics);
    const Scene& scene = *result.scene;
    EXPECT_EQ(scene.text,
              "int one;\nfloat n;\nfloat h;\n                    \n"
              "uniform float a; //@ 1\n                            // hi\n" +
                  kImage);
    ASSERT_EQ(scene.files.size(), 3u);
    EXPECT_EQ(scene.files[2], folder.path() / "lib/hash.glsl");
    const struct {
        std::size_t file;
        int line;
    } origins[] = {{0, 1}, {1, 1}, {2, 1}, {1, 2}, {1, 3}, {0, 2}, {0, 3}};
    ASSERT_EQ(scene.origins.size(), std::size(origins));
    for (std::size_t i = 0; i < std::size(origins); ++i) {
        EXPECT_EQ(scene.origins[i].file, origins[i].file) << i;
        EXPECT_EQ(scene.origins[i].line, origins[i].line) << i;
    }
    EXPECT_EQ(scene.place(5, 9).file, (folder.path() / "lib/noise.glsl").string());
    EXPECT_EQ(scene.place(5, 9).line, 3);
    EXPECT_EQ(scene.place(5, 9).column, 9);
    EXPECT_EQ(scene.place(999, 1).line, 3);
    EXPECT_EQ(scene.place(0, 0).line, 0);
    const Tweak& tweak = scene.tweaks.at(0);
    EXPECT_EQ(scene.text.substr(tweak.declaration_begin, 16), "uniform float a;");
}

TEST(Include, ImagesAreNamedFromTheFileThatNamesThem) {
    const TemporaryFolder folder;
    folder.write("lib/wood.glsl", "uniform sampler2D wood; //@ image wood.png\n");
    const ReadScene result =
        read_scene(folder.write("a.frag", "#include \"lib/wood.glsl\"\n" + kImage));
    ASSERT_TRUE(result.scene) << all(result.diagnostics);
    EXPECT_EQ(result.scene->samplers.at(0).files.at(0), folder.path() / "lib/wood.png");
}

TEST(Include, AMissingFileIsReportedWhereItIsNamed) {
    const TemporaryFolder folder;
    folder.write("b.glsl", "int b;\n   #include \"none.glsl\"\n");
    const ReadScene result = read_scene(folder.write("a.frag", "#include \"b.glsl\"\n"));
    EXPECT_FALSE(result.scene);
    ASSERT_EQ(result.diagnostics.size(), 1u) << all(result.diagnostics);
    EXPECT_TRUE(result.diagnostics[0].missing_file);
    EXPECT_EQ(result.diagnostics[0].place.file, (folder.path() / "b.glsl").string());
    EXPECT_EQ(result.diagnostics[0].place.line, 2);
    EXPECT_EQ(result.diagnostics[0].place.column, 4);
    // A reload watches for the missing file too.
    EXPECT_EQ(result.files.size(), 3u);
}

TEST(Branches, ThatAreNotTakenSayNothing) {
    const std::string text =
        "#define IN_SHADERTOY\n"
        "#ifdef NOPE\n#include \"none.glsl\"\nuniform float a; //@ 1\n#endif\n"
        "#ifndef IN_SHADERTOY\n#include \"none.glsl\"\n#endif\n"
        "#ifndef HW_PERFORMANCE\nuniform vec4 iResolution;\n//@ nonsense\n#endif\n"
        "#if __VERSION__ < 300 || defined(IN_SHADERTOY) && 0\nuniform int iTime;\n#endif\n" +
        kImage;
    const Scene scene = good(text);
    EXPECT_EQ(scene.text, text) << "what is not compiled stays as it is";
    EXPECT_TRUE(scene.tweaks.empty());
}

TEST(Branches, OfWhatIsDefinedInAnIncludeAreKnown) {
    const TemporaryFolder folder;
    folder.write("b.glsl", "#ifndef GUARD\n#define GUARD\nuniform float a; //@ 1\n#endif\n");
    const ReadScene result =
        read_scene(folder.write("a.frag",
                                "#include \"b.glsl\"\n#include \"b.glsl\"\n#ifndef GUARD\n#include "
                                "\"none.glsl\"\n#endif\n" +
                                    kImage));
    ASSERT_TRUE(result.scene) << all(result.diagnostics);
    EXPECT_EQ(tweak_names(*result.scene), "a ");
}

TEST(Branches, OfAPassMayBeTaken) {
    const std::string text =
        "uniform sampler2D a; //@ pass mainA\n"
        "#ifdef PASS_a\nuniform sampler2D iChannel0; //@ noise rgba 64\n"
        "void mainImage(out vec4 c, in vec2 f) { c = vec4(1); }\n#else\nuniform float b; //@ 1\n" +
        kImage + "#endif\n";
    const Scene scene = good(text);
    EXPECT_EQ(scene.samplers.at(1).tab, "a");
    EXPECT_EQ(tweak_names(scene), "b ");
}

TEST(Blanked, ArePragmas) {
    const Scene scene = good("#pragma optimize(off);  // fast\n" + kImage);
    EXPECT_EQ(scene.text, "                        // fast\n" + kImage);
}

TEST(Uniforms, MayComeFromMacros) {
    const Scene scene = good("#define KNOB uniform float\nKNOB a; //@ 1\n" + kImage);
    EXPECT_EQ(tweak_names(scene), "a ");
    EXPECT_EQ(scene.text.substr(scene.tweaks.at(0).declaration_begin, 7), "KNOB a;");
    const ReadScene both =
        read("#define KNOBS uniform float a; uniform float b\nKNOBS; //@ 1\n" + kImage);
    EXPECT_FALSE(both.scene) << "nothing tells which of them is meant";
}

TEST(Include, ACircleIsAnErrorThatNamesIt) {
    const TemporaryFolder folder;
    folder.write("b.glsl", "#include \"c.glsl\"\n");
    folder.write("c.glsl", "\n#include \"./b.glsl\"\n");
    const ReadScene result = read_scene(folder.write("a.frag", "#include \"b.glsl\"\n" + kImage));
    ASSERT_EQ(result.diagnostics.size(), 1u) << all(result.diagnostics);
    EXPECT_EQ(result.diagnostics[0].place.file, (folder.path() / "c.glsl").string());
    EXPECT_EQ(result.diagnostics[0].place.line, 2);
    EXPECT_NE(result.diagnostics[0].text.find("c.glsl -> "), std::string::npos);
}

TEST(Include, TwiceIsTwiceUnlessPragmaOnce) {
    const TemporaryFolder folder;
    const auto file = folder.write("a.frag", "#include \"b\"\n#include \"b\"\n" + kImage);
    folder.write("b", "int b;\n");
    EXPECT_EQ(read_scene(file).scene->origins.size(), 5u);
    folder.write("b", "#pragma once\n#include \"b\"\nuniform float a; //@ 1\n");
    const ReadScene result = read_scene(file);
    ASSERT_TRUE(result.scene) << all(result.diagnostics);
    EXPECT_EQ(result.scene->tweaks.size(), 1u);
    EXPECT_EQ(result.scene->files.size(), 2u);
}

TEST(Include, FilesThatDoubleThemselvesEnd) {
    const TemporaryFolder folder;
    for (int i = 0; i < 30; ++i) {
        const std::string next = "#include \"" + std::to_string(i + 1) + "\"\n";
        folder.write(std::to_string(i), next + next);
    }
    folder.write("30", "");
    const ReadScene result = read_scene(folder.write("a.frag", "#include \"0\"\n" + kImage));
    EXPECT_EQ(result.diagnostics.size(), 1u);
    EXPECT_NE(all(result.diagnostics).find("too many includes"), std::string::npos);
}

TEST(Include, IsReadOnlyWhereItIsOne) {
    const TemporaryFolder folder;
    folder.write("b", "int b;\n");
    folder.write("c//d", "int d;\n");
    const struct {
        const char* text;
        bool expanded;
        bool error;
    } cases[] = {
        {"// #include \"none\"\n", false, false},
        {"/*\n#include \"none\"\n*/\n", false, false},
        {"/*\n*/ #include \"b\" /* x\n */\n", true, false},
        {"#define X \\\n#include \"none\"\n", false, false},
        {"#  include \"b\"\n", true, false},
        {"#include \"c//d\"\n", true, false},
        {"#include \"b\" int x;\n", true, true},
        {"#include\n", false, true},
        {"#include \"\"\n", false, true},
        {"#include \"b\n", false, true},
        {"#include \".\"\n", false, true},
    };
    for (const auto& c : cases) {
        const ReadScene result = read_scene(folder.write("a.frag", c.text + kImage));
        EXPECT_EQ(has_errors(result.diagnostics), c.error) << c.text << all(result.diagnostics);
        if (result.scene) {
            EXPECT_EQ(result.scene->files.size(), c.expanded ? 2u : 1u) << c.text;
            EXPECT_EQ(result.scene->text.find("#include \"b\""), std::string::npos);
        }
    }
}

}  // namespace
}  // namespace glint
