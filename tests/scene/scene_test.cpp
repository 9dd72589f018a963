// Whole files: what they declare, what is blanked, and what they say when something is wrong.
#include "read_text.h"

#include <algorithm>
#include <string>
#include <vector>

namespace glint::scene_test {
namespace {

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
        const Span place = tweak.declarations.at(0);
        return result.scene->text.substr(place.begin, place.end - place.begin);
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

TEST(Scene, AFunctionThatCannotBeCalledAsItsPassIsAnErrorAtItsName) {
    const std::string a = "uniform sampler2D a; //@ pass mainA\n";
    const std::string b = "uniform sampler2D b; //@ pass mainA\n";
    const std::pair<std::string, const char*> wrong[] = {
        {a + b + "void mainA(out vec4 c, in vec2 f) { c = vec4(1); }\n" + kImage,
         "a.frag:3:6: error: it fills a, b, and so has to be void mainA(out vec4 a, out vec4 b, in "
         "vec2 coord)"},
        {a + "void mainA(out vec4 c, out vec4 d, vec2 f) { c = d = vec4(1); }\n" + kImage,
         "a.frag:2:6: error: it fills a, and so has to be void mainA(out vec4 a, in vec2 coord)"},
        {a + "void mainA(out vec3 c, in vec2 f) { c = vec3(1); }\n" + kImage, "a.frag:2:6: error"},
        {a + "vec4 mainA(in vec2 f) { return vec4(1); }\n" + kImage, "a.frag:2:6: error"},
        {"uniform samplerCube a; //@ pass mainA\n"
         "void mainA(out vec4 c, in vec2 f) { c = vec4(1); }\n" +
             kImage,
         "in vec2 coord, in vec3 rayOri, in vec3 rayDir)"},
        {"void mainImage(out vec3 c, in vec2 f) { c = vec3(1); }\n",
         "a.frag:1:6: error: this draws the picture, and so has to be void mainImage(out vec4 "
         "color, in vec2 coord)"}};
    for (const auto& [text, words] : wrong) {
        const ReadScene result = read(text);
        EXPECT_FALSE(result.scene) << text;
        EXPECT_NE(all(result.diagnostics).find(words), std::string::npos)
            << all(result.diagnostics);
    }
    for (const char* right : {"void mainA(out highp vec4 c, vec2 f) { c = vec4(1); }\n",
                              "void mainA(inout vec4 c, const in vec2 f) { c = vec4(1); }\n",
                              "#define V vec4\nvoid mainA(out V c, in vec2) { c = V(1); }\n",
                              "float mainA(float x) { return x; }\n"
                              "void mainA(out vec4 c, in vec2 f) { c = vec4(1); }\n"})
        good(a + (right + kImage));
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
    const TestFolder folder;
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
        {"uniform vec3 a;", "such as //@ 0.5, 0.5, 0.5 \"what it does\""},
        {"uniform vec3 a[3];", "so it stays 0; nothing fills one of its type here"},
        {"uniform mat3 a;", "so it stays 0; nothing fills one of its type here"},
        {"Shader \"Custom/A\" { SubShader { } }", "this is Unity's ShaderLab"},
        {"uniform vec3 iTime, b;", "1:14: error: 'iTime' is the host's own, of another type"},
        {"uniform vec2 iResolution;", "uniform vec3 iResolution"},
        {"uniform float iChannelTime;", "uniform float iChannelTime[4]"},
        {"uniform float iChannelTime[3];", "uniform float iChannelTime[4]"},
        {"uniform vec3 iMouse;", "uniform vec4 iMouse"},
        {"uniform int iTick;", "uniform uint iTick"},
        {"uniform vec4 iChannel2;", "uniform sampler2D iChannel2"},
        {"float x; //@ 0.5", "1:10: warning: no uniform on this line"},
        {"//@ groop Water", "NAME; did you mean 'group'?"},
        {"uniform float a[3]; //@ 1", "1:15: error: an annotation is for one plain uniform"},
        {"uniform float[3] a; //@ 1", "1:18: error: an annotation is for one plain uniform"},
        {"uniform Light { vec3 l; }; //@ 1", "1:1: error: an annotation is for one plain uniform"},
        {"uniform struct L { vec3 l; } a; //@ 1", "1:1: error: an annotation is for one plain"},
        {"uniform float a, b; //@ 1", "1:18: error: an annotation is for one uniform"},
        {"uniform float a = 1.0;", "1:15: error: GLSL ES gives uniforms no value here"},
        {"uniform float a = 1.0; //@ 1", "1:15: error: GLSL ES gives uniforms no value here"},
        {"uniform float a //@ 1\nuniform float b; //@ 2", "1:16: error: ';' is missing here"},
        {"uniform mat3 a; //@ 1", "1:9: error: 'mat3' cannot be annotated"},
        {"uniform uint a; //@ 1", "1:9: error: 'uint' cannot be annotated"},
        {"uniform float iTime; //@ 1", "1:15: error: 'iTime' is the host's own"},
        {"uniform float iChannel0; //@ 1", "1:15: error: 'iChannel0' is the host's own"},
        {"uniform float a; //@ 1\nuniform int a; //@ 1", "2:13: error: 'a' is declared already"},
        {"uniform float a; //@ 2 [0, 1]", "1:22: error: the default 2 is outside"},
        {"uniform float a; //@ 1 shiny", "1:24: warning: unknown word 'shiny'"},
        {"#iChannel0 \"self\"\n#iChannel0::MinFilter \"Nearst\"",
         "2:1: warning: 'Nearst' is no MinFilter; known are"},
        {"#iChannel0 \"self\"\n#iChannel0::MagFiltr \"Nearest\"", "did you mean 'MagFilter'?"},
        {"#iChannel0 self",
         "1:1: warning: what fills a channel stands in quotes: #iChannel0 \"self\""},
        {"uniform sampler2D a; //@ noise rgba 256 wrp=clamp", "1:41: warning: unknown word 'wrp'"},
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

TEST(Scene, AReferenceMeasuredByItselfIsAnErrorWhereItIsWritten) {
    const auto told = [](const char* line) { return all(read(line + kImage).diagnostics); };
    EXPECT_NE(told("uniform int k; //@ 8 [1, 256] quality reference=256 second=256\n")
                  .find("a.frag:1:53: error: second=256: that is the reference itself"),
              std::string::npos)
        << told("uniform int k; //@ 8 [1, 256] quality reference=256 second=256\n");
    EXPECT_NE(told("uniform int m; //@ 0 {a, b} quality reference=b second=m=b\n")
                  .find("error: second=m=b: that is the reference itself"),
              std::string::npos);
    EXPECT_EQ(told("uniform int k; //@ 8 [1, 256] quality reference=256 second=128\n"), "");
    EXPECT_EQ(told("uniform int m; //@ 0 {a, b} quality reference=b second=b,k=9\n"
                   "uniform int k; //@ 8 [1, 256]\n"),
              "")
        << "with more work, it is another picture";
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
    for (const char* text : {"", "\n", "// void mainImage\n", "\xEF\xBB\xBF", "float f;"}) {
        const ReadScene result = read(text);
        EXPECT_FALSE(result.scene);
        EXPECT_NE(all(result.diagnostics).find("write void mainImage("), std::string::npos) << text;
    }
    EXPECT_NE(all(read("// C:\\dir\\\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(0); }")
                      .diagnostics)
                  .find(":1:1: error: there is no mainImage here: the '\\' at the end"),
              std::string::npos);
    const ReadScene idle = read("void main() {}");
    EXPECT_FALSE(idle.scene);
    EXPECT_NE(all(idle.diagnostics).find(":1:6: error: this main() writes no colour"),
              std::string::npos)
        << all(idle.diagnostics);
}

TEST(Scene, AMissingFileAndAFolderAreMissing) {
    const TestFolder folder;
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

}  // namespace
}  // namespace glint::scene_test
