// `glint export`: what goes to the site draws the same when it comes back.
#include "command.h"
#include "media/image.h"

#include <nlohmann/json.hpp>

namespace glint::cli::export_test {
namespace {

constexpr std::string_view kScene =
    "// A header that belongs to nothing.\n"
    "uniform float level; //@ 0.5 [0, 1] \"how bright\"\n"
    "uniform bool extra; //@ off\n"
    "uniform sampler2D first; //@ pass mainBoth\n"
    "uniform sampler2D second; //@ pass mainBoth filter=nearest\n"
    "uniform sampler2D unused; //@ pass mainUnused\n"
    "#define HALF 0.5\n"
    "const float kA = 0.25, kB = kA * 2.0;   // of the picture\n"
    "struct Pair { float a, b; };\n"
    "// Nobody calls it.\n"
    "float lonely(float x) { return x; }\n"
    "float twice(float x) { return x * 2.0; }\n"
    "Pair pair_of(float x) { Pair p = Pair(x, twice(x)); return p; }\n"
    "void mainBoth(out vec4 a, out vec4 b, in vec2 p) {\n"
    "    a = texelFetch(first, ivec2(p), 0) + vec4(0.1);\n"
    "    b = vec4(pair_of(kB * HALF).b * level);\n}\n"
    "void mainUnused(out vec4 a, in vec2 p) { a = vec4(lonely(1.0)); }\n"
    "void mainImage(out vec4 c, in vec2 p) {\n"
    "    c = vec4(texelFetch(first, ivec2(p), 0).r, texture(second, p / iResolution.xy).r, 0, 1);\n"
    "    if (extra) c += texture(unused, p);\n"
    "    c.b = float(iTick % 65536u) / 65536.0;\n}\n";

class Export : public InAFolder {
protected:
    Image draw(const std::string& file) {
        const Outcome drawn =
            glint({"still", file, "-o", file + ".png", "--size", "32x18", "--frame", "5"});
        EXPECT_EQ(drawn.code, 0) << drawn.err;
        return read_image(folder() / (file + ".png"));
    }
    void expect_to_come_back(const std::string& text) {
        SCOPED_TRACE(text);
        write("a.frag", text);
        const Outcome made = glint({"export", "a.frag", "-o", "out", "--size", "32x18"});
        ASSERT_EQ(made.code, 0) << made.err;
        fs::remove(folder() / "back.frag");
        ASSERT_EQ(glint({"import", "out/shadertoy.json", "-o", "back.frag"}).code, 0);
        EXPECT_EQ(draw("a.frag").pixels, draw("back.frag").pixels);
    }
};

TEST_F(Export, WhatComesBackDrawsTheSameBytes) {
    write("a.frag", kScene);
    const Outcome made = glint({"export", "a.frag", "-o", "out"});
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_EQ(made.out, "out/bufferA.glsl\nout/bufferB.glsl\nout/image.glsl\nout/shadertoy.json\n");
    EXPECT_NE(made.err.find("image: iTick becomes"), std::string::npos) << made.err;
    ASSERT_EQ(glint({"import", "out/shadertoy.json", "-o", "back.frag"}).code, 0);
    EXPECT_EQ(draw("a.frag").pixels, draw("back.frag").pixels);
}

TEST_F(Export, NamesOfOlderGlslStandForTodays) {
    write("a.frag",
          "void mainImage(out vec4 c, in vec2 p) { c = texture2D(iChannel0, p / 64.0) + "
          "texture2DLod(iChannel0, p, 0.0); }\n");
    write("a.toml", "scene = \"a.frag\"\n[channels]\niChannel0 = { noise = \"rgba 16\" }\n");
    ASSERT_EQ(glint({"export", "a.toml", "-o", "out"}).code, 0);
    const std::string defines = "#define texture2D texture\n#define texture2DLod textureLod\n";
    EXPECT_NE(bytes("out/image.glsl").find(defines), std::string::npos) << bytes("out/image.glsl");
    ASSERT_EQ(glint({"import", "out", "-o", "back.frag"}).err, "");
    EXPECT_EQ(draw("a.toml").pixels, draw("back.frag").pixels);
    ASSERT_EQ(glint({"export", "a.toml", "-o", "a.html"}).code, 0);
    EXPECT_NE(bytes("a.html").find("#define texture2DLod textureLod"), std::string::npos);
}

// With a constant that is out of an array's range no driver compiles.
TEST_F(Export, WhatAnIndexIsMadeOfKeepsItsValueAndIsNoConstant) {
    write("a.frag",
          "uniform int axis; //@ 1 {x, y, z}\nuniform int n; //@ 9 [1, 9]\n"
          "uniform vec2 k; //@ 0.25, 0.7\n"
          "float get(int k) { return vec3(0.1, 0.5, 0.9)[k]; }\n"
          "void mainImage(out vec4 c, in vec2 p) {\n    float a[8];\n    a[2] = 0.3;\n"
          "    c = vec4(a[2], get(axis), k.y, 1);\n    if (n < 8) c = vec4(a[n]);\n}\n");
    write("a.toml", "scene = \"a.frag\"\n[tweaks]\naxis = \"z\"\n");
    ASSERT_EQ(glint({"export", "a.toml", "-o", "out"}).code, 0);
    const std::string text = bytes("out/image.glsl");
    for (const char* line : {"\nint n = 9;", "\nvec2 k = vec2(0.25, 0.699999988);"})
        EXPECT_NE(text.find(line), text.npos) << text;
    ASSERT_EQ(glint({"import", "out", "-o", "back.frag"}).err, "");
    EXPECT_EQ(draw("a.toml").pixels, draw("back.frag").pixels);
    ASSERT_EQ(glint({"export", "a.toml", "-o", "page.html"}).code, 0);
    EXPECT_NE(bytes("page.html").find("\"index\":true"), std::string::npos);
}

// Browsers refuse one that ends nothing, and drivers take it.
TEST_F(Export, SemicolonsAmongTheFunctionsAreLeftOut) {
    write("a.frag",
          "struct S { float x; };; float f(S s) { ; return s.x; };\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(f(S(0.5))); };\n");
    ASSERT_EQ(glint({"export", "a.frag", "-o", "out"}).code, 0);
    const std::string text = bytes("out/image.glsl");
    EXPECT_EQ(text,
              "struct S { float x; };  float f(S s) { ; return s.x; } \n"
              "void mainImage(out vec4 c, in vec2 p) { c = vec4(f(S(0.5))); } \n");
    ASSERT_EQ(glint({"export", "a.frag", "-o", "page.html"}).code, 0);
    EXPECT_EQ(bytes("page.html").find("s.x; };"), text.npos);
}

TEST_F(Export, AUniformBlockIsVariablesThatAreZero) {
    write("a.frag",
          "layout(std140) uniform Look { vec4 tint; float gain; };\n"
          "uniform Sun { vec3 direction; } sun;\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.25, 0.5, 0, 1) + tint * gain + "
          "sun.direction.x; }\n");
    ASSERT_EQ(glint({"export", "a.frag", "-o", "out"}).code, 0);
    const std::string text = bytes("out/image.glsl");
    EXPECT_NE(text.find("vec4 tint; float gain;"), text.npos) << text;
    EXPECT_NE(text.find("struct { vec3 direction; } sun;"), text.npos) << text;
    EXPECT_EQ(text.find("uniform"), text.npos) << text;
    ASSERT_EQ(glint({"import", "out", "-o", "back.frag"}).err, "");
    EXPECT_EQ(draw("a.frag").pixels, draw("back.frag").pixels);
}

// Of a tab that somebody has edited since, too.
TEST_F(Export, TheFolderOfTabsComesBackWithWhatEachReads) {
    write("a.frag",
          "uniform sampler2D state; //@ pass mainState filter=nearest wrap=repeat\n"
          "uniform sampler2D grain; //@ noise rgba 64\n"
          "void mainState(out vec4 c, in vec2 p) { c = vec4(p / 32.0, iGlobalTime, 1); }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texture(grain, p / 64.0) * 0.5 + "
          "texture(state, p / iResolution.xy + 0.7) * 0.25; }\n");
    ASSERT_EQ(glint({"export", "a.frag", "-o", "out"}).code, 0);
    EXPECT_NE(bytes("out/bufferA.glsl").find("#define iGlobalTime iTime\n"), std::string::npos);
    ASSERT_EQ(glint({"import", "out", "-o", "back.frag"}).err, "");
    EXPECT_EQ(draw("a.frag").pixels, draw("back.frag").pixels);
    write("out/image.glsl",
          "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p / 64.0); }");
    ASSERT_EQ(glint({"import", "out", "-o", "edited.frag"}).err, "");
    EXPECT_NE(bytes("edited.frag").find("noise rgba 64x64"), std::string::npos);
    write("out/shadertoy.json", "{");
    const Outcome broken = glint({"import", "out", "-o", "broken.frag"});
    EXPECT_EQ(broken.code, 0) << broken.err;
    EXPECT_EQ(broken.err.find("out/shadertoy.json:2:1: warning: what the tabs read"), 0)
        << broken.err;
}

// Also where a text asks for a channel that nothing fills, or for a size or a time alone, and where
// a sampler has the name of a component.
TEST_F(Export, ChannelsAreThoseThatTheTextMeans) {
    const std::string image = "void mainImage(out vec4 c, in vec2 p) { c = ";
    const std::string texts[] = {
        "uniform sampler2D A; //@ pass mainA\n"
        "void mainA(out vec4 c, in vec2 p) { c = vec4(0, 1, 0, 1); }\n" +
            image +
            "texelFetch(A, ivec2(p), 0) * 0.25 + texelFetch(iChannel0, ivec2(p), 0) + "
            "iChannelTime[1]; }\n",
        "uniform sampler2D iChannel0; //@ noise rgba 256\n" + image +
            "vec4(iChannelResolution[0].x / 512.0, 0, 0, 1); }\n",
        "uniform sampler2D b; //@ pass mainB\n"
        "void mainB(out vec4 c, in vec2 p) { c = vec4(1); }\n" +
            image + "texelFetch(b, ivec2(p), 0); c.b = 0.5; }\n",
        "uniform sampler2D b; //@ pass mainB\nuniform samplerCube d; //@ pass mainD size=1024\n"
        "uniform sampler2D iChannel0; //@ buffer b\nuniform samplerCube iChannel1; //@ buffer d\n"
        "void mainB(out vec4 c, in vec2 p) { c = vec4(1); }\n"
        "void mainD(out vec4 c, in vec2 p, in vec3 o, in vec3 d) { c = vec4(1); }\n" +
            image + "vec4(iChannelResolution[0].xy / 99.0, iChannelResolution[1].x / 2e3, 1); }\n"};
    for (const std::string& text : texts) {
        write("a.frag", text);
        ASSERT_EQ(glint({"export", "a.frag", "-o", "out"}).code, 0);
        ASSERT_EQ(glint({"import", "out/shadertoy.json", "-o", "back.frag"}).code, 0);
        EXPECT_EQ(draw("a.frag").pixels, draw("back.frag").pixels) << text;
        fs::remove_all(folder() / "out");
        fs::remove(folder() / "back.frag");
    }
}

// Another export of what has come back says no more, and one that was cut short is begun again.
TEST_F(Export, ATextThatComesBackStaysAsLong) {
    write("a.frag", std::string(kScene) + "// iChannels of the film, repeat\n");
    ASSERT_EQ(glint({"export", "a.frag", "-o", "out"}).code, 0);
    ASSERT_EQ(glint({"import", "out/shadertoy.json", "-o", "once.frag"}).code, 0);
    ASSERT_EQ(glint({"export", "once.frag", "-o", "once"}).code, 0);
    ASSERT_EQ(glint({"import", "once/shadertoy.json", "-o", "twice.frag"}).code, 0);
    ASSERT_EQ(glint({"export", "twice.frag", "-o", "twice"}).code, 0);
    EXPECT_EQ(bytes("once/image.glsl"), bytes("twice/image.glsl"));
    EXPECT_EQ(bytes("once/bufferA.glsl"), bytes("twice/bufferA.glsl"));
    EXPECT_EQ(bytes("once/bufferB.glsl"), bytes("twice/bufferB.glsl"));
    fs::remove(folder() / "twice/shadertoy.json");
    fs::remove(folder() / "twice/bufferA.glsl");
    const Outcome again = glint({"export", "twice.frag", "-o", "twice"});
    EXPECT_EQ(again.code, 0) << again.err;
}

// A #define of the sampler's name would change what is called so, too.
TEST_F(Export, NamesThatTheTextGivesToItsOwnAreNotTheSamplers) {
    const std::string buffers =
        "uniform sampler2D a; //@ pass mainA size=16x9\n"
        "uniform sampler2D wind; //@ pass mainWind\n"
        "uniform sampler2D xy; //@ pass mainXy\n"
        "struct Pair { float a, wind; vec2 xy; };\n"
        "#define fragCoord gl_FragCoord.xy\n"
        "#define READ(s) texelFetch(s, ivec2(fragCoord) % ivec2(16, 9), 0)\n"
        "float aspect(vec3 iResolution, float a) { return iResolution.x / iResolution.y * a; }\n"
        "void mainA(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, "
        "aspect(iResolution, 0.3), 1); }\n"
        "void mainWind(out vec4 c, in vec2 p) { c = vec4(0, p.y / 20.0, READ(a).b, 1); }\n"
        "void mainXy(out vec4 c, in vec2 p) { c = READ(a) + READ(wind); c.a = 1.0; }\n";
    const std::string images[] = {
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    c = READ(xy);\n"
        "    float wind = 1.0;\n"
        "    for (int i = 0; i < 2; ++i) { float a = 0.25; c *= wind - 0.1 * a; }\n"
        "    c.a = 1.0;\n}\n",
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    Pair s = Pair(0.5, 0.25, vec2(0.2));\n"
        "    c = READ(xy) * s.a + READ(wind).xyxy * s.wind;\n"
        "    c.xy += s.xy;\n"
        "    float wind = READ(wind).g;\n"
        "    c.b *= wind;\n}\n",
        "float both(float wind, float xy) { return 0.7 * wind + 0.3 * xy; }\n"
        "void mainImage(out vec4 c, in vec2 p) { c = READ(a) * both(0.5, 1.0); c.a = 1.0; }\n"};
    for (const std::string& image : images) expect_to_come_back(buffers + image);
}

TEST_F(Export, ASamplerOfAnotherTabMayBeCalledLikeAGlobal) {
    expect_to_come_back(
        "uniform sampler2D buf; //@ pass main_buf\n#ifdef PASS_buf\n"
        "uniform sampler2D wind; //@ noise rgba 16\n"
        "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(wind, ivec2(p) % 16, 0); }\n"
        "#endif\n#ifdef PASS_image\nfloat wind = 0.5;\n"
        "void mainImage(out vec4 c, in vec2 p) { wind += 0.1; c = texelFetch(buf, ivec2(p), 0) * "
        "wind; }\n#endif\n");
}

// Macros that may be either, or whose words are others later, are renamed where they are spelled.
TEST_F(Export, AMacroThatCannotBeWrittenOutIsRenamedInItself) {
    for (const char* macro :
         {"#ifdef GL_OES_standard_derivatives\n#define READ(s) texelFetch(s, ivec2(q), 0)\n#else\n"
          "#define READ(s) texelFetch(s, ivec2(q), 0)\n#endif\n",
          "#define READ(s) texelFetch(s, ivec2(q), 0) * gain\n#define gain 3.0\n"}) {
        expect_to_come_back(
            "uniform sampler2D hist; //@ pass mainHist\n" + std::string(macro) +
            "struct Ray { vec3 o; vec4 hist; };\n"
            "vec4 look(Ray r) { return r.hist; }\n"
            "void mainHist(out vec4 c, in vec2 p) { c = vec4(p / 40.0, 0.3, 1); }\n"
            "void mainImage(out vec4 c, in vec2 q) { Ray r; r.hist = READ(hist); c = look(r); "
            "}\n");
    }
}

TEST_F(Export, ABufferThatTheSoundAloneReadsIsRefused) {
    write("a.frag",
          "uniform sampler2D tab; //@ pass mainTab\n"
          "void mainTab(out vec4 c, in vec2 p) { c = vec4(0.25, iTime, 0, 1); }\n"
          "vec2 mainSound(float time) { return texelFetch(tab, ivec2(0), 0).xy; }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n");
    const Outcome made = glint({"export", "a.frag", "-o", "out"});
    EXPECT_EQ(made.code, 2);
    EXPECT_NE(made.err.find("The sound alone reads tab"), std::string::npos) << made.err;
    EXPECT_FALSE(fs::exists(folder() / "out"));
}

TEST_F(Export, FilesOfOneNameAreTold) {
    write("make.frag", "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5); }\n");
    fs::create_directory(folder() / "more");
    for (const char* file : {"p.png", "more/p.png"})
        ASSERT_EQ(glint({"still", "make.frag", "-o", file, "--size", "4x4"}).code, 0);
    write("a.frag",
          "uniform sampler2D one; //@ image p.png\nuniform sampler2D two; //@ image more/p.png\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texture(one, p) + texture(two, p); }\n");
    const Outcome made = glint({"export", "a.frag", "-o", "out"});
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_NE(made.err.find("more/p.png have one name"), std::string::npos) << made.err;
    write("b.frag",
          "uniform sampler2D one; //@ image p.png\n"
          "uniform sampler2D two; //@ image more/../p.png wrap=repeat\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texture(one, p) + texture(two, p); }\n");
    const Outcome same = glint({"export", "b.frag", "-o", "same"});
    EXPECT_EQ(same.err.find("have one name"), std::string::npos) << same.err;
}

TEST_F(Export, ACubeOfSixFilesComesBackWithAllSix) {
    std::string faces;
    write("make.frag",
          "uniform float grey; //@ 0 [0, 1]\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(grey); }\n");
    for (const char* side : {"px", "nx", "py", "ny", "pz", "nz"}) {
        const std::string grey = fmt::format("grey=0.{}", faces.size() % 10);
        const std::string file = std::string(side) + ".png";
        ASSERT_EQ(glint({"still", "make.frag", "-o", file, "--size", "4x4", "--tweak", grey}).code,
                  0);
        faces += " " + file;
    }
    write("a.frag", "uniform samplerCube sky; //@ cube" + faces +
                        "\nvoid mainImage(out vec4 c, in vec2 p) {\n"
                        "    int side = int(p.x) % 6;\n    vec3 towards = vec3(0);\n"
                        "    towards[side / 2] = side % 2 == 0 ? 1.0 : -1.0;\n"
                        "    c = texture(sky, towards);\n}\n");
    ASSERT_EQ(glint({"export", "a.frag", "-o", "."}).code, 0);
    ASSERT_EQ(glint({"import", "shadertoy.json", "-o", "back.frag"}).code, 0);
    EXPECT_EQ(draw("a.frag").pixels, draw("back.frag").pixels);
    fs::remove(folder() / "ny.png");
    const Outcome without = glint({"import", "shadertoy.json", "-o", "without.frag"});
    EXPECT_NE(without.err.find("ny.png"), std::string::npos) << without.err;
}

TEST_F(Export, ACubeThatReadsABufferBelowItIsTold) {
    write("a.frag",
          "uniform samplerCube sky; //@ pass mainSky\nuniform sampler2D late; //@ pass mainLate\n"
          "void mainSky(out vec4 c, in vec2 p, in vec3 o, in vec3 d) { c = texelFetch(late, "
          "ivec2(3), 0); }\n"
          "void mainLate(out vec4 c, in vec2 p) { c = vec4(fract(iTime)); }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texture(sky, vec3(p, 7)); }\n");
    const Outcome made = glint({"export", "a.frag", "-o", "out"});
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_NE(made.err.find("reads what a buffer below it holds"), std::string::npos) << made.err;
}

TEST_F(Export, WhatTheSiteDrawsInAnotherOrderIsTold) {
    write("a.frag",
          "uniform samplerCube sky; //@ pass mainSky\nuniform sampler2D pos; //@ pass mainStep\n"
          "uniform sampler2D vel; //@ pass mainStep\n"
          "void mainSky(out vec4 c, in vec2 p, in vec3 o, in vec3 d) { c = vec4(iTime); }\n"
          "void mainStep(out vec4 p, out vec4 v, in vec2 c) {\n"
          "    p = texelFetch(vel, ivec2(c), 0) + texture(sky, vec3(1, 0, 0));\n"
          "    v = texelFetch(pos, ivec2(c), 0);\n}\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(pos, ivec2(p), 0) + "
          "texelFetch(vel, ivec2(p), 0); }\n");
    const Outcome made = glint({"export", "a.frag", "-o", "out"});
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_NE(made.err.find("pos, vel: of several outputs"), std::string::npos) << made.err;
    EXPECT_NE(made.err.find("draws its cube behind the buffers"), std::string::npos) << made.err;
}

// What nothing fills is 0 there, too, and the site's names stand for those of other programs.
TEST_F(Export, UniformsWithoutAnAnnotationComeBack) {
    write("a.frag",
          "uniform vec2 u_resolution;\nuniform float u_time, gain, list[3];\n"
          "uniform struct Lamp { vec3 at; } lamp;\nuniform sampler2D nothing;\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = vec4(p / u_resolution, u_time, 1) + gain + list[1] + lamp.at.x;\n"
          "    c.r += texture(nothing, p).r;\n}\n");
    const Outcome made = glint({"export", "a.frag", "-o", "out"});
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_NE(made.err.find("nothing fills nothing"), std::string::npos) << made.err;
    ASSERT_EQ(glint({"import", "out/shadertoy.json", "-o", "back.frag"}).code, 0);
    EXPECT_EQ(draw("a.frag").pixels, draw("back.frag").pixels);
}

TEST_F(Export, TabsOfAnotherExportAreTold) {
    write("a.frag", kScene);
    write("b.frag", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n");
    ASSERT_EQ(glint({"export", "a.frag", "-o", "out"}).code, 0);
    const Outcome made = glint({"export", "b.frag", "-o", "out"});
    EXPECT_NE(made.err.find("out/bufferA.glsl stands there and is none of this scene's"),
              std::string::npos)
        << made.err;
}

TEST_F(Export, TabsThatSomebodyEditedStay) {
    write("a.frag", kGradient);
    ASSERT_EQ(glint({"export", "a.frag", "-o", "out"}).code, 0);
    EXPECT_EQ(glint({"export", "a.frag", "-o", "out"}).code, 0) << "what an export left is renewed";
    write("out/image.glsl", "precious");
    const Outcome again = glint({"export", "a.frag", "-o", "out"});
    EXPECT_EQ(again.code, 1);
    EXPECT_NE(again.err.find("somebody may have worked on it"), std::string::npos) << again.err;
    EXPECT_EQ(bytes("out/image.glsl"), "precious");
    write("site/shadertoy.json", R"({"Shader":{"info":{"id":"XsXXDn"},"renderpass":[]}})");
    EXPECT_EQ(glint({"export", "a.frag", "-o", "site"}).code, 1);
    EXPECT_EQ(glint({"export", "a.frag", "-o", "-"}).code, 2);
}

TEST_F(Export, ATickOfTheTextsOwnStaysItsOwn) {
    write("a.frag",
          "float iTick = 0.4;\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(iTick); }\n");
    const Outcome made = glint({"export", "a.frag", "-o", "out"});
    EXPECT_EQ(made.err, "");
    ASSERT_EQ(glint({"import", "out/shadertoy.json", "-o", "back.frag"}).code, 0);
    EXPECT_EQ(draw("a.frag").pixels, draw("back.frag").pixels);
    EXPECT_EQ(bytes("out/image.glsl").find("#define"), std::string::npos);
}

TEST_F(Export, ATextWithAMainOfItsOwnIsRefused) {
    write("a.frag", "void main() { gl_FragColor = vec4(1.0); }\n");
    const Outcome made = glint({"export", "a.frag", "-o", "out"});
    EXPECT_EQ(made.code, 2);
    EXPECT_NE(made.err.find("Write void mainImage("), std::string::npos) << made.err;
    EXPECT_FALSE(fs::exists(folder() / "out"));
}

TEST_F(Export, ATabHoldsOnlyWhatItsPassNeedsAndTweaksAreConstants) {
    write("a.frag", kScene);
    ASSERT_EQ(glint({"export", "a.frag", "-o", "out", "--tweak", "level=0.75"}).code, 0);
    const std::string image = bytes("out/image.glsl"), second = bytes("out/bufferB.glsl");
    EXPECT_TRUE(
        image.starts_with("// iChannel0: bufferA, linear, clamp\n"
                          "// iChannel1: bufferB, nearest, clamp\n"
                          "#define first iChannel0\n#define second iChannel1\n"))
        << image;
    for (const char* gone : {"lonely", "twice", "uniform", "mainBoth", "kA"})
        EXPECT_EQ(image.find(gone), std::string::npos) << gone << "\n" << image;
    EXPECT_NE(second.find("const float level = 0.75;"), std::string::npos) << second;
    EXPECT_NE(second.find("how bright"), std::string::npos) << second;
    EXPECT_NE(second.find("struct Pair"), std::string::npos) << second;
    EXPECT_NE(second.find("// of the picture"), std::string::npos) << second;
}

// A tab of its own, names of channels shared by tabs, code that is switched off in the midst of
// text, noise of a size that the site has not.
TEST_F(Export, ATabKeepsItsChannelsItsConditionsAndItsNoise) {
    write("a.frag",
          "uniform sampler2D bufferA; //@ pass mainBufferA\n"
          "#ifdef PASS_bufferA\nuniform sampler2D iChannel1; //@ noise rg 16x8 "
          "filter=nearest\n#endif\n"
          "#ifdef PASS_image\nuniform sampler2D iChannel0; //@ buffer bufferA\n"
          "uniform sampler2D iChannel1; //@ buffer bufferA filter=nearest wrap=repeat\n#endif\n"
          "#if 0\nno code ' at all\n#endif\n"
          "#ifndef HALF\n#define HALF 0.5\n#endif\n"
          "#ifdef PASS_bufferA\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel1, p / 20.0); }\n"
          "#endif  // bufferA\n"
          "#ifdef PASS_image\nvoid mainImage(out vec4 c, in vec2 p) {\n"
          "    c = texture(iChannel0, p / 40.0) * HALF + texture(iChannel1, p / 12.0) * HALF;\n}\n"
          "#endif\n");
    ASSERT_EQ(glint({"export", "a.frag", "-o", "out"}).code, 0);
    ASSERT_EQ(glint({"import", "out/shadertoy.json", "-o", "back.frag"}).code, 0);
    EXPECT_EQ(draw("a.frag").pixels, draw("back.frag").pixels) << bytes("back.frag");
    EXPECT_EQ(bytes("out/bufferA.glsl").find("switched off"), std::string::npos)
        << bytes("out/bufferA.glsl");
}

TEST_F(Export, MoreThanTheSiteHoldsIsRefusedAndNothingIsWritten) {
    std::string text, sum = "vec4(0)";
    for (const std::string name : {"a", "b", "c", "d", "e"}) {
        text += "uniform sampler2D " + name + "; //@ noise 8\n";
        sum += " + texture(" + name + ", p)";
    }
    write("five.frag", text + "void mainImage(out vec4 x, in vec2 p) { x = " + sum + "; }\n");
    const Outcome outcome = glint({"export", "five.frag", "-o", "out"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("reads 5 samplers; the site has four channels"), std::string::npos)
        << outcome.err;
    EXPECT_FALSE(fs::exists(folder() / "out"));
}

TEST_F(Export, WhatTheSiteDoesOtherwiseIsSaid) {
    write("odd.frag",
          "uniform sampler2D waves; //@ pass mainWaves size=16x8 step=1/240 format=rgba16f\n"
          "void mainWaves(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, 0.1, 1); }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texture(waves, p); }\n");
    const Outcome made = glint({"export", "odd.frag", "-o", "out"});
    ASSERT_EQ(made.code, 0) << made.err;
    for (const char* words : {"not every 1/240 s", "it has 16x8 pixels", "floats of 32 bits"})
        EXPECT_NE(made.err.find(words), std::string::npos) << words << "\n" << made.err;
    EXPECT_NE(bytes("out/bufferA.glsl").find("#define iResolution vec3(16.0, 8.0, 1.0)"),
              std::string::npos);
}

TEST_F(Export, ChannelsThatABufferHasNotAreAbsentOnTheSiteToo) {
    write("narrow.frag",
          "uniform sampler2D one; //@ pass mainOne format=r32f\n"
          "uniform sampler2D two; //@ pass mainTwo format=rg32f\n"
          "void mainOne(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, 0.5, 0.25); }\n"
          "void mainTwo(out vec4 c, in vec2 p) { c = texelFetch(one, ivec2(p), 0) + 0.1; }\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = 0.4 * (texelFetch(one, ivec2(p), 0) + texelFetch(two, ivec2(p), 0).yxwz);\n"
          "}\n");
    ASSERT_EQ(glint({"export", "narrow.frag", "-o", "out"}).code, 0);
    ASSERT_EQ(glint({"import", "out/shadertoy.json", "-o", "back.frag"}).code, 0);
    EXPECT_EQ(draw("narrow.frag").pixels, draw("back.frag").pixels);
}

TEST_F(Export, ALargeSceneComesBackAsItWas) {
    const std::string preset = std::string(GLINT_REPOSITORY) + "/presets/analytic.toml";
    ASSERT_EQ(glint({"export", preset, "-o", "out"}).code, 0);
    ASSERT_EQ(glint({"import", "out/shadertoy.json", "-o", "back.frag"}).code, 0);
    for (const auto& [file, picture] : {std::pair{preset, "a.png"}, {"back.frag", "b.png"}}) {
        const Outcome drawn =
            glint({"still", file, "-o", picture, "--size", "96x54", "--time", "4"});
        ASSERT_EQ(drawn.code, 0) << drawn.err;
    }
    const Image was = read_image(folder() / "a.png"), is = read_image(folder() / "b.png");
    // iTick, which it reads, is rounded as a float there: some pixels of an edge may differ.
    std::size_t off = 0;
    for (std::size_t i = 0; i < was.pixels.size(); ++i)
        off +=
            std::abs(std::to_integer<int>(was.pixels[i]) - std::to_integer<int>(is.pixels[i])) > 1;
    EXPECT_LE(off, was.pixels.size() / 2000);
}

}  // namespace
}  // namespace glint::cli::export_test
