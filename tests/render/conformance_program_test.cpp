// The program that a scene's text is wrapped in, sentence by sentence of what the site does.
#include "fixture.h"
#include "render/pass_text.h"

namespace glint::conformance_program_test {
namespace {

using WrappedProgram = GlTest;

struct Case {
    std::string text;
    glm::vec3 expected;
};

void expect_first_pixel(const std::vector<Case>& cases) {
    for (const Case& c : cases) {
        SCOPED_TRACE(c.text);
        Player player(c.text);
        player.draw(0);
        EXPECT_EQ(player.colour(), c.expected);
    }
}

TEST_F(WrappedProgram, MacrosOfTheUserDoNotReachTheHostsMain) {
    const std::string body = "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.25); }";
    for (const char* line :
         {"#define main not_main", "#define color c.zyx", "#define coord 1.0",
          "#define glint_out0 nothing", "#define void_ void", "#define clamp(a, b, c) nothing",
          "#define normalize(v) nothing", "#define iResolution nothing", "#define int float",
          "#define st_assert(c) nothing", "#define iFrame nothing", "#define layout nothing",
          "#define precision nothing", "#define uniform nothing", "#define mainSound nothing"}) {
        SCOPED_TRACE(line);
        Player player(std::string(line) + "\n" + body);
        player.draw(0);
        EXPECT_EQ(player.pixel(0, 0), glm::vec4(0.25, 0.25, 0.25, 1.0));
    }
    expect_first_pixel({
        {"#define vec4(x) (vec4(x) * 0.5)\nvoid mainImage(out vec4 c, vec2 p) { c = vec4(1.0); }",
         {0.5, 0.5, 0.5}},
        {"#define out inout\n"
         "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n",
         {1, 1, 1}},
    });
}

// `color += light` relies on it. A name of so many letters does not stand where short texts do.
TEST_F(WrappedProgram, TheColourStartsAtZeroWhateverThePassIsCalled) {
    TestFolder folder;
    const ReadPreset read = read_scene_text(
        folder,
        "uniform sampler2D light; //@ pass mainLightOfTheWholeEveningSky\n"
        "void mainLightOfTheWholeEveningSky(out vec4 c, vec2 p) { c += vec4(0.5); }\n"
        "void mainImage(out vec4 c, vec2 p) { c = texture(light, p); }\n",
        {});
    ASSERT_TRUE(read.preset);
    EXPECT_NE(pass_text(*read.preset, 0, {}).text.find("Sky(inout vec4 c,"), std::string::npos);
    EXPECT_NE(pass_text(*read.preset, kImagePass, {}).text.find("mainImage(inout vec4 c,"),
              std::string::npos);
}

TEST_F(WrappedProgram, HardwareCountsAsFast) {
    expect_first_pixel({
        {"#if HW_PERFORMANCE == 1\nvoid mainImage(out vec4 c, vec2 p) { c = vec4(1); }\n#endif",
         {1, 1, 1}},
        {"#ifdef HW_PERFORMANCE\nvoid mainImage(out vec4 c, vec2 p) { c = vec4(1); }\n#endif",
         {1, 1, 1}},
    });
}

TEST_F(WrappedProgram, AnUndefinedNameInAnIfIsAnError) {
    TestFolder folder;
    const ReadPreset read = read_scene_text(folder,
                                            "// first line\n"
                                            "#if NEVER_DEFINED\n"
                                            "#endif\n"
                                            "void mainImage(out vec4 c, vec2 p) { c = vec4(1); }",
                                            {});
    ASSERT_TRUE(read.preset) << to_text(read.diagnostics);
    const CompileResult result = compile_scene(*read.preset, {});
    EXPECT_FALSE(result.scene);
    ASSERT_TRUE(has_errors(result.diagnostics));
    EXPECT_EQ(result.diagnostics[0].place.line, 2) << to_text(result.diagnostics);
}

TEST_F(WrappedProgram, PackedIsAnOrdinaryName) {
    expect_first_pixel({
        {"float packed(float packed) { return packed * 2.0; }\n"
         "void mainImage(out vec4 c, vec2 p) { c = vec4(packed(0.25)); }",
         {0.5, 0.5, 0.5}},
        {"struct S { float packed; };\n"
         "void mainImage(out vec4 c, vec2 p) { S s = S(0.5); c = vec4(s.packed); }",
         {0.5, 0.5, 0.5}},
        {"#define packed 0.5\nvoid mainImage(out vec4 c, vec2 p) { c = vec4(packed); }",
         {0.5, 0.5, 0.5}},
        {"#define packed(x) (x)\nvoid mainImage(out vec4 c, vec2 p) { c = vec4(packed(0.5)); }",
         {0.5, 0.5, 0.5}},
    });
}

// Mesa's preprocessor makes other texts of these.
TEST_F(WrappedProgram, MacrosBecomeWhatTheyBecomeInBrowsers) {
    const auto image = [](const std::string& body) {
        return "void mainImage(out vec4 O, vec2 U) {\n" + body + "\n}\n";
    };
    expect_first_pixel({
        {"#define glow(x) (1.-x)\n" + image("float k = -.25; O = vec4(glow(-k), -k, 0, 1);"),
         {0.75, 0.25, 0}},
        {"#define lerp(a,b,t) (a+(b-a)*t)\n" + image("float k = 0.5; O = vec4(lerp(-k,k,.75));"),
         {0.25, 0.25, 0.25}},
        {"#define neg -\n#define PLUS +\n#define M -\n" +
             image("float k = .25; O = vec4(.25 neg-k, k PLUS+k, M M k, 1);"),
         {0.5, 0.5, 0.25}},
        {"#define N -0.5\n" + image("float k = .25; O = vec4(k-N, -N, k -N*k, 1);"),
         {0.75, 0.5, 0.375}},
        {"#define S(x) sin(x)\n" + image("float S = .25;\n O = vec4(S);"), {0.25, 0.25, 0.25}},
        {"#define f(x) (x*2.)\n" +
             image("float f = .5; float k = max(.1,f);\n#ifdef ZZ\nk = 1.;\n#endif\n"
                   "O = vec4(k, f(.125), max(f(.125),f), 1);"),
         {0.5, 0.25, 0.5}},
        {"#define T(p) (p*.5)\n#define K 1.-T\n" + image("O = vec4(K(\n .5));"),
         {0.75, 0.75, 0.75}},
        {"#define M(a) a\n" + image("O = M(vec4(\n#ifdef GL_ES\n.5\n#else\n.7\n#endif\n));"),
         {0.5, 0.5, 0.5}},
    });
}

// The lines behind are those of the text.
TEST_F(WrappedProgram, ANameThatIsAlsoAMacroMovesNoLine) {
    TestFolder folder;
    const ReadPreset read = read_scene_text(folder,
                                            "#define S(x) sin(x)\n"
                                            "void mainImage(out vec4 c, vec2 p) {\n"
                                            "float S = .3;\n"
                                            "c = vec4(S);\n"
                                            "float q = S(1.0);\n"
                                            "c.x = unknown;\n}\n",
                                            {});
    ASSERT_TRUE(read.preset) << to_text(read.diagnostics);
    const CompileResult result = compile_scene(*read.preset, {});
    ASSERT_TRUE(has_errors(result.diagnostics));
    EXPECT_EQ(result.diagnostics[0].place.line, 6) << to_text(result.diagnostics);
}

TEST_F(WrappedProgram, NamesOfOtherGlslAreOrdinary) {
    expect_first_pixel({
        {"float dmat2(float dmat3) { return dmat3; }\n"
         "void mainImage(out vec4 c, vec2 p) { c = vec4(dmat2(0.5)); }",
         {0.5, 0.5, 0.5}},
        {"float atomicAdd(vec2 a, mat2 b) { return a.x; }\n"
         "void mainImage(out vec4 c, vec2 p) { c = vec4(atomicAdd(vec2(0.5), mat2(1))); }",
         {0.5, 0.5, 0.5}},
        {"float textureGrad(vec4 a, mat3 b) { return a.x; }\n"
         "uniform sampler2D n; //@ noise r 64\n"
         "void mainImage(out vec4 c, vec2 p) {\n"
         "    c = vec4(textureGrad(vec4(0.5), mat3(1))) + 0.0 * textureGrad(n, p, p, p); }",
         {0.5, 0.5, 0.5}},
    });
}

// As the site's compiler has it: of what extensions could do nothing is there.
TEST_F(WrappedProgram, NoExtensionTellsOfItself) {
    expect_first_pixel({
        {"#ifdef GL_EXT_shader_framebuffer_fetch\n#define A 1.0\n#else\n#define A 0.5\n#endif\n"
         "#if defined(GL_OES_standard_derivatives) || !defined(GL_FRAGMENT_PRECISION_HIGH)\n"
         "#define B 1.0\n#elif GL_ES\n#define B 0.5\n#endif\n"
         "#extension GL_OES_standard_derivatives : enable\n"
         "void mainImage(out vec4 c, vec2 p) { c = vec4(A, B, fwidth(p.x) * 0.5, 1); }",
         {0.5, 0.5, 0.5}},
    });
}

TEST_F(WrappedProgram, AMacroThatPastesTokensIsNoErrorUntilItIsUsed) {
    const std::string pastes =
        "#define PASTE(a, b) a##b\n"
        "#define TEXT(a) \\\n    #a\n"
        "#ifndef PASTE\nnot here\n#endif\n";
    const std::string idle = pastes + "void mainImage(out vec4 c, vec2 p) { c = vec4(0.5); }";
    expect_first_pixel({{idle.c_str(), {0.5, 0.5, 0.5}}});
    for (const char* used : {"PASTE(0.5, 1)", "W(0.5)"}) {
        const TestFolder folder;
        const ReadPreset read = read_scene_text(
            folder,
            pastes + "#define W(a) PASTE(a, 1)\nvoid mainImage(out vec4 c, vec2 p) { c = vec4(" +
                used + "); }",
            {});
        ASSERT_TRUE(read.preset);
        const CompileResult result = compile_scene(*read.preset, {});
        EXPECT_FALSE(result.scene) << used;
        EXPECT_EQ(result.diagnostics.at(0).place.line, 1) << to_text(result.diagnostics);
    }
}

TEST_F(WrappedProgram, FunctionsOfOlderGlslMayBeDefinedAnew) {
    expect_first_pixel({
        {"vec4 texture2D(vec2 p) { return p.xyxy; }\n"
         "void mainImage(out vec4 c, vec2 p) { c = texture2D(p) * 0.5; }",
         {0.25, 0.25, 0.25}},
        {"vec4 texture2DLod(sampler2D s, vec2 p, float l) { return textureLod(s, p, l) + 0.5; }\n"
         "void mainImage(out vec4 c, vec2 p) { c = texture2DLod(iChannel0, p, 0.0); }",
         {0.5, 0.5, 0.5}},
    });
}

TEST_F(WrappedProgram, AFailedAssertionColoursItsPixel) {
    const auto with = [](const char* assertion) {
        return colour_of(fmt::format("0.5); {}; c += vec4(0.0", assertion));
    };
    EXPECT_EQ(with("st_assert(true)"), glm::vec3(0.5));
    EXPECT_EQ(with("st_assert(true, 2)"), glm::vec3(0.5));
    EXPECT_EQ(with("st_assert(false)"), glm::vec3(1, 0, 0));
    EXPECT_EQ(with("st_assert(false, 0)"), glm::vec3(1, 0, 0));
    EXPECT_EQ(with("st_assert(false, 1)"), glm::vec3(0, 1, 0));
    EXPECT_EQ(with("st_assert(false, 2)"), glm::vec3(0, 0, 1));
    EXPECT_EQ(with("st_assert(false, 3)"), glm::vec3(1, 1, 0));
    Player player("void mainImage(out vec4 c, vec2 p) { c = vec4(0.5); st_assert(p.x < 2.0, 1); }");
    player.draw(0);
    EXPECT_EQ(player.colour(1, 0), glm::vec3(0.5));
    EXPECT_EQ(player.colour(2, 0), glm::vec3(0, 1, 0));
}

TEST_F(WrappedProgram, TheOldNameOfTimeIsKnownUnlessTheTextDeclaresIt) {
    const std::string body = "void mainImage(out vec4 c, vec2 p) { c = vec4(iGlobalTime); }";
    struct {
        std::string text;
        float expected;
    } const cases[] = {
        {body, 0.5f},
        {"uniform float iGlobalTime;\n" + body, 0.5f},
        {"#define iGlobalTime iTime\n" + body, 0.5f},
        {"#define iGlobalTime 7.0\n" + body, 7.0f},
        {"const float iGlobalTime = 7.0;\n" + body, 7.0f},
        {"float iGlobalTime = 7.0;\n" + body, 7.0f},
        {"void mainImage(out vec4 c, vec2 p) { float iGlobalTime = 7.0; c = vec4(iGlobalTime); }",
         7.0f},
        {"// iGlobalTime\nvoid mainImage(out vec4 c, vec2 p) { c = vec4(iTime); }", 0.5f},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.text);
        Player player(c.text);
        player.draw(30);
        EXPECT_EQ(player.colour(), glm::vec3(c.expected));
    }
}

TEST_F(WrappedProgram, TextMayDeclareTheHostsUniformsItself) {
    expect_first_pixel({
        {"uniform vec3 iResolution;\nuniform float iTime, iTimeDelta;\nuniform vec4 iMouse;\n"
         "uniform sampler2D iChannel0;\nuniform vec3 iChannelResolution[4];\n"
         "void mainImage(out vec4 c, vec2 p) { c = vec4(iResolution, 1) + texture(iChannel0, p); }",
         {4, 2, 1}},
        {"precision mediump float;\nuniform highp vec3 iResolution;\n"
         "void mainImage(out vec4 c, vec2 p) { c = vec4(iResolution, 1); }",
         {4, 2, 1}},
    });
}

TEST_F(WrappedProgram, AByteOrderMarkAndAnyLineEndsAreRead) {
    expect_first_pixel({
        {"\xEF\xBB\xBFvoid mainImage(out vec4 c, vec2 p) { c = vec4(0.5); }", {0.5, 0.5, 0.5}},
        {"#define A 0.5\r\nvoid mainImage(out vec4 c, vec2 p)\r\n{ c = vec4(A); }\r\n",
         {0.5, 0.5, 0.5}},
        {"#version 300 es\nvoid mainImage(out vec4 c, vec2 p) { c = vec4(0.5); }", {0.5, 0.5, 0.5}},
    });
}

TEST_F(WrappedProgram, IntegersAndFloatsHaveAllTheirBits) {
    expect_first_pixel({
        {"void mainImage(out vec4 c, vec2 p) {\n"
         "    uint u = 0xfffffff1u + uint(iFrame);\n"
         "    int i = 2147483600 + iFrame;\n"
         "    float f = 16777215.0 + iTime;\n"
         "    c = vec4(u % 256u, i % 100, f - 16777214.0, 1);\n"
         "}",
         {241, 0, 1}},
    });
}

// Where a driver has halves, they must not creep in: the site's drivers have none.
TEST_F(WrappedProgram, EverythingIsOfHighPrecisionWhateverTheTextSays) {
    const std::string value = "1.0 + 1.0 / 8192.0";
    for (const char* line : {"", "precision mediump float;", "precision lowp float;",
                             "precision lowp sampler2D;\nprecision mediump int;"}) {
        for (const char* local : {"", "mediump", "lowp", "highp"}) {
            SCOPED_TRACE(fmt::format("{} {}", line, local));
            Player player(
                fmt::format("{}\n"
                            "uniform sampler2D a; //@ pass mainA\n"
                            "void mainA(out vec4 c, vec2 p) {{ c = vec4({}); }}\n"
                            "void mainImage(out vec4 c, vec2 p) {{\n"
                            "    {} float x = texelFetch(a, ivec2(p), 0).x;\n"
                            "    {} int i = 100000 + iFrame;\n"
                            "    c = vec4(x, x * x - 1.0, i, 1);\n"
                            "}}\n",
                            line, value, local, local));
            player.draw(0);
            const float x = 1.0f + 1.0f / 8192.0f;
            EXPECT_EQ(player.colour(), glm::vec3(x, x * x - 1.0f, 100000));
        }
    }
}

TEST_F(WrappedProgram, EveryPixelIsDrawnOnceAtItsCentre) {
    Player player("void mainImage(out vec4 c, vec2 p) { c = vec4(p, gl_FragCoord.x - p.x, 1); }",
                  {.size = {7, 5}});
    player.draw(0);
    for (int y = 0; y < 5; ++y) {
        for (int x = 0; x < 7; ++x) {
            EXPECT_EQ(player.pixel(x, y), glm::vec4(glm::vec2(x, y) + 0.5f, 0, 1));
        }
    }
}

// The site hands in 1e20 and opaque black; but Chromium's translator makes `out` parameters 0, so
// that nobody sees these.
TEST_F(WrappedProgram, ThePicturesColourStartsAtZero) {
    Player player("void mainImage(out vec4 c, vec2 p) { if (p.x < 1.0) c = vec4(0.5); }");
    player.draw(0);
    EXPECT_EQ(player.pixel(0, 0), glm::vec4(0.5, 0.5, 0.5, 1));
    EXPECT_EQ(player.pixel(1, 0), glm::vec4(0, 0, 0, 1));
}

TEST_F(WrappedProgram, VariablesWithoutAFirstValueStartAtZero) {
    expect_first_pixel({
        {"void mainImage(out vec4 c, vec2 p) { float i, sum; for (; i++ < 4.0; sum += p.x) ; c = "
         "vec4(sum); }",
         glm::vec3(2)},
        {"float f(int n) { vec2 v; mat2 m; if (n > 7) v.x = m[1].y = 1.0;\n"
         "    return v.x + m[1].y; }\n"
         "void mainImage(out vec4 c, vec2 p) { c = vec4(f(int(p.x)) + 0.5); }",
         glm::vec3(0.5)},
        {"vec3 state;\nvoid mainImage(out vec4 c, vec2 p) { state.x += p.x; c = vec4(state, 1); }",
         {0.5, 0, 0}},
    });
}

TEST_F(WrappedProgram, CommentsMayStandAnywhereInTheSignature) {
    expect_first_pixel({
        {"void mainImage /* out ( */ ( // (\n  out /* out */ vec4 c, in vec2 p /* ) */) { c += "
         "0.5; }",
         glm::vec3(0.5)},
    });
}

TEST_F(WrappedProgram, ThePicturesAlphaIsIgnoredAndComesOutAsOne) {
    for (const PixelFormat format : {PixelFormat::rgba8, PixelFormat::rgba32f}) {
        Player player("void mainImage(out vec4 c, vec2 p) { c = vec4(1, 0, 0, p.x - 1.5); }",
                      {.format = format});
        player.draw(0);
        for (int x = 0; x < 4; ++x) EXPECT_EQ(player.pixel(x, 0), glm::vec4(1, 0, 0, 1));
    }
}

TEST_F(WrappedProgram, ABuffersColourStartsAtZero) {
    Player player(
        "uniform sampler2D a; //@ pass mainA\n"
        "void mainA(out vec4 c, vec2 p) { if (p.x < 1.0) c = vec4(0.5); }\n"
        "void mainImage(out vec4 c, vec2 p) { c = texelFetch(a, ivec2(p), 0); }",
        {.pass = "a"});
    player.draw(0);
    EXPECT_EQ(player.pixel(0, 0), glm::vec4(0.5));
    EXPECT_EQ(player.pixel(1, 0), glm::vec4(0));
}

TEST_F(WrappedProgram, TheChannelStructsAreThereInTheImagePass) {
    Player player(
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    int x = int(p.x);\n"
        "    if (x == 0) c = vec4(iCh0.size, 1);\n"
        "    if (x == 1) c = vec4(iCh0.loaded, iCh1.loaded, iCh0.time, 1);\n"
        "    if (x == 2) c = vec4(texture(iCh1.sampler, vec2(0.5)).rgb, 1);\n"
        "    if (x == 3) c = texelFetch(iCh0.sampler, ivec2(1, 0), 0) - \n"
        "                    texelFetch(iChannel0, ivec2(1, 0), 0);\n"
        "}",
        {.preset = "[channels]\niChannel0 = { noise = \"rgba 8x2\" }"});
    player.draw(0);
    EXPECT_EQ(player.colour(0), glm::vec3(8, 2, 1));
    EXPECT_EQ(player.colour(1), glm::vec3(1, 0, 0));
    EXPECT_EQ(player.colour(2), glm::vec3(0));
    EXPECT_EQ(player.colour(3), glm::vec3(0));
}

// Mesa keeps an index and the next one in one register (glsl/stored_index.h).
TEST_F(WrappedProgram, AnElementIsStoredWhereTheTextSays) {
    struct {
        const char* body;
        float sum;  // of w[k] * (k + 1)
    } const cases[] = {
        {"for (int i = 0; i < n; i++) w[i] = float(i + 1);", 1 + 4 + 9 + 16 + 25},
        {"for (int i = 0; i < n; i++) w[i] = w[i + 1];", 2 + 6 + 12 + 20 + 30 + 36},
        {"for (int i = n; i > 0; i--) w[i] = w[i - 1];", 1 + 2 + 6 + 12 + 20 + 30},
        {"int m = 0; while (m < n) { if (p.x > 0.0) { w[m] = 2.0 * float(m + 1); m++; } }",
         2 + 8 + 18 + 32 + 50 + 36},
    };
    for (const auto& [body, sum] : cases) {
        const bool begins_empty = std::string_view(body).find("float(i + 1)") != std::string::npos;
        Player player(
            "uniform int n; //@ 5 [0, 9]\nvoid mainImage(out vec4 c, vec2 p) {\n"
            "    float w[6] = float[](" +
            std::string(begins_empty ? "0.,0.,0.,0.,0.,0." : "1.,2.,3.,4.,5.,6.") + ");\n    " +
            body +
            "\n    c = vec4(w[0] + 2. * w[1] + 3. * w[2] + 4. * w[3] + 5. * w[4] + 6. * "
            "w[5]);\n}\n");
        player.draw(0);
        EXPECT_EQ(player.pixel(0, 0).x, sum) << body;
    }
}

}  // namespace
}  // namespace glint::conformance_program_test
