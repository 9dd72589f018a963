// Texts written for VS Code's Shader Toy and for the Book of Shaders, as they are.
#include "command.h"
#include "media/image.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace glint::cli::foreign_test {
namespace {

class Foreign : public InAFolder {
protected:
    // The bottom left pixel.
    std::array<int, 3> draw(std::vector<std::string> more = {}) {
        std::vector<std::string> words = {"still", "a.glsl", "-o", "out.png", "--size", "64x36"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome drawn = glint(words);
        errors_ = drawn.err;
        EXPECT_EQ(drawn.code, 0) << drawn.err;
        if (drawn.code != 0) return {};
        const Image image = read_image(folder() / "out.png");
        const auto at = [&](std::size_t i) { return std::to_integer<int>(image.pixels[i]); };
        return {at(0), at(1), at(2)};
    }
    std::string errors_;
};

TEST_F(Foreign, AUniformInEveryFormIsATweak) {
    write("a.glsl",
          "#iUniform float speed = 1.0 in { 0.0, 5.0 } step 0.5 // how \"fast\"\n"
          "#iUniform float plain = 0.2\n"
          "#iUniform int count = 3 in {0, 10}\n"
          "#iUniform color3 tint = color3(1.0, 0.0, 0.6) // of all\n"
          "#iUniform vec2 place = vec2(0.4);\n"
          "#iUniform vec4 four = vec4(0.1, 0.2, 0.3, 0.4) in { 0.0, 1.0 }\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = vec4(tint.x * plain, place.y * float(count) / 3.0, tint.z, 1);\n}\n");
    EXPECT_EQ(draw(), (std::array{51, 102, 153})) << errors_;
    EXPECT_EQ(draw({"--tweak", "plain=0.4", "--tweak", "count=0"}), (std::array{102, 0, 153}));
    const auto info = nlohmann::json::parse(glint({"info", "a.glsl", "--json"}).out);
    const auto& speed = info["tweaks"][0];
    EXPECT_EQ(speed["name"], "speed");
    EXPECT_EQ(speed["min"], 0.0);
    EXPECT_EQ(speed["max"], 5.0);
}

TEST_F(Foreign, AMistakeHasItsLine) {
    write("a.glsl",
          "// one\n#iUniform float = 3\nvoid mainImage(out vec4 c, in vec2 p) { c = nothing; }\n");
    Outcome outcome = glint({"still", "a.glsl", "-o", "out.png"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_NE(outcome.err.find("a.glsl:2:1: error: this #iUniform"), std::string::npos)
        << outcome.err;
    // Lines that became several keep their own number.
    write("a.glsl",
          "#iKeyboard\n#iChannel0 \"self\"\nvoid mainImage(out vec4 c, in vec2 p) {\n"
          "    c = nothing;\n}\n");
    outcome = glint({"still", "a.glsl", "-o", "out.png"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_NE(outcome.err.find("a.glsl:4:9: error:"), std::string::npos) << outcome.err;
}

TEST_F(Foreign, APictureMayReadItself) {
    write(
        "a.glsl",
        "#iChannel0 \"self\"\n#iChannel0::MinFilter \"Nearest\"\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    c = texelFetch(iChannel0, ivec2(p), 0) + vec4(0.1, 0.2, iFrame > 0 ? 0.0 : 0.4, 0);\n"
        "}\n");
    EXPECT_EQ(draw({"--frame", "3"}), (std::array{102, 204, 102}));
}

TEST_F(Foreign, OtherFilesAreBuffersDrawnBeforeWhatReadsThem) {
    fs::create_directories(folder() / "parts");
    write("parts/sim.glsl",
          "#iChannel0 \"self\"\n#iChannel1 \"file://noise.glsl\"\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = texelFetch(iChannel0, ivec2(0), 0) + texelFetch(iChannel1, ivec2(0), 0);\n}\n");
    write("parts/noise.glsl",
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.1, 0, 0, 1); }\n");
    write("a.glsl",
          "#iChannel0 \"file://parts/sim.glsl\"\n"
          "#iChannel1 \"file://parts/noise.glsl\"\n#iChannel1::WrapMode \"Repeat\"\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = vec4(texture(iChannel0, vec2(0.5)).r, texture(iChannel1, vec2(2.5)).r * 2.0,\n"
          "             iChannelResolution[1].x / 128.0, 1);\n}\n");
    EXPECT_EQ(draw({"--frame", "3"}), (std::array{102, 51, 128})) << errors_;
    const auto info = nlohmann::json::parse(glint({"info", "a.glsl", "--json"}).out);
    EXPECT_EQ(info["passes"][0]["name"], "noiseBuffer");
    EXPECT_EQ(info["passes"][1]["name"], "simBuffer");
}

TEST_F(Foreign, PicturesAndKeysAreRead) {
    write("flat.frag", "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.2, 0.4, 0.6, 1); }\n");
    ASSERT_EQ(glint({"still", "flat.frag", "-o", "duck.png", "--size", "8x8"}).code, 0);
    write("a.glsl",
          "#iKeyboard\n#iChannel2 \"file://duck.png\"\n#iChannel2::MagFilter \"Nearest\"\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = texture(iChannel2, p) * (isKeyDown(Key_A) ? 2.0 : 1.0)\n"
          "        * (isKeyToggled(Key_UpArrow) ? 0.0 : 1.0);\n}\n");
    write("keys.toml", "scene = \"a.glsl\"\n[[events]]\nt = 0.1\nkey = \"a\"\ndown = true\n");
    EXPECT_EQ(draw(), (std::array{51, 102, 153})) << errors_;
    ASSERT_EQ(glint({"still", "keys.toml", "-o", "keys.png", "--size", "8x8", "--time", "1"}).code,
              0);
    EXPECT_EQ(std::to_integer<int>(read_image(folder() / "keys.png").pixels[0]), 102);
}

TEST_F(Foreign, AKeyThatIsLetGoIsReleasedForOneFrame) {
    write("a.glsl",
          "#iKeyboard\nvoid mainImage(out vec4 c, in vec2 p) {\n"
          "    c = vec4(isKeyReleased(Key_A), isKeyDown(Key_A), isKeyReleased(Key_B), 1);\n}\n");
    write("keys.toml",
          "scene = \"a.glsl\"\n[[events]]\nt = 0.05\nkey = \"a\"\ndown = true\n"
          "[[events]]\nt = 0.15\nkey = \"a\"\ndown = false\n");
    const auto at = [&](int frame) {
        const Outcome drawn = glint({"still", "keys.toml", "-o", "k.png", "--size", "8x8",
                                     "--frame", std::to_string(frame)});
        EXPECT_EQ(drawn.code, 0) << drawn.err;
        const Image image = read_image(folder() / "k.png");
        return std::array{std::to_integer<int>(image.pixels[0]),
                          std::to_integer<int>(image.pixels[1]),
                          std::to_integer<int>(image.pixels[2])};
    };
    EXPECT_EQ(at(5), (std::array{0, 255, 0})) << "held";
    EXPECT_EQ(at(9), (std::array{255, 0, 0})) << "let go at 0.15 s";
    EXPECT_EQ(at(10), (std::array{0, 0, 0}));
}

TEST_F(Foreign, CubesOfSixFilesAndSoundsAreRead) {
    const char* names[] = {"px", "nx", "py", "ny", "pz", "nz"};
    write("flat.frag",
          "uniform float red; //@ 0 [0, 1]\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(red, 0.4, 0.6, 1); }\n"
          "vec2 mainSound(int samp, float time) { return vec2(sin(6.2831853 * 441.0 * time)); }\n");
    for (int i = 0; i < 6; ++i)
        ASSERT_EQ(glint({"still", "flat.frag", "-o", fmt::format("sky_{}.png", names[i]), "--size",
                         "4x4", "--tweak", fmt::format("red={}", 0.2 * i)})
                      .code,
                  0);
    ASSERT_EQ(glint({"sound", "flat.frag", "-o", "tune.wav", "--seconds", "1"}).code, 0);
    write("a.glsl",
          "#iChannel0 \"file://sky_{}.png\"\n#iChannel0::Type \"CubeMap\"\n"
          "#iChannel1 \"file://tune.wav\"\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = vec4(texture(iChannel0, vec3(0, 0, 1)).r,\n"
          "             texelFetch(iChannel1, ivec2(20, 0), 0).r > 0.8, 0.6, 1);\n}\n");
    EXPECT_EQ(draw({"--time", "0.5"}), (std::array{204, 255, 153})) << errors_;
}

TEST_F(Foreign, WhatHasNoCounterpartIsSaid) {
    write("a.glsl",
          "#iChannel0 \"https://example.com/x.png\"\n"
          "#iChannel1 \"file://none_{}.png\"\n#iChannel1::Type \"CubeMap\"\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p); }\n");
    draw();
    EXPECT_NE(errors_.find("a.glsl:1:1: warning: 'https://example.com/x.png' is not read here"),
              std::string::npos)
        << errors_;
    EXPECT_NE(errors_.find("a.glsl:2:1: warning: 'file://none_{}.png'"), std::string::npos)
        << errors_;
}

TEST_F(Foreign, AMainOfTheBookOfShadersDraws) {
    write(
        "a.glsl",
        "#ifdef GL_ES\nprecision mediump float;\n#endif\n"
        "uniform vec2 u_resolution;\nuniform vec2 u_mouse;\nuniform float u_time;\n"
        "float half_of(float x) { return x * 0.5; }\n"
        "void main() {\n"
        "    vec2 st = gl_FragCoord.xy / u_resolution.xy;\n"
        "    gl_FragColor = vec4(half_of(u_time), u_mouse.x / u_resolution.x, st.x * 64.0, 1.0);\n"
        "}\n");
    write("book.toml",
          "scene = \"a.glsl\"\n[[events]]\nt = 0.1\nmouse = [0.5, 0.5]\ndown = true\n");
    EXPECT_EQ(draw({"--time", "0.8"}), (std::array{102, 0, 128})) << errors_;
    EXPECT_EQ(errors_, "");
    EXPECT_EQ(draw({"--time", "0.8", "--samples", "4"})[0], 102);
    ASSERT_EQ(
        glint({"still", "book.toml", "-o", "book.png", "--size", "64x36", "--time", "1"}).code, 0);
    EXPECT_EQ(std::to_integer<int>(read_image(folder() / "book.png").pixels[1]), 128);
    write("a.glsl",
          "uniform float u_time; //@ 0.4 [0, 1]\n"
          "void main() { gl_FragColor = vec4(u_time); }\n");
    EXPECT_EQ(draw({"--time", "0.8"})[0], 102);
    write("a.glsl", "void main() {\n    gl_FragColor = vec4(nothing);\n}\n");
    EXPECT_NE(glint({"still", "a.glsl", "-o", "x.png"}).err.find("a.glsl:2:25: error:"),
              std::string::npos);
}

TEST_F(Foreign, AFragmentShaderOfThreeJsOrADesktopProgramHasItsTextureCoordinates) {
    for (const std::string& text :
         {std::string(
              "varying vec2 vUv;\nuniform float uTime;\nuniform vec2 uResolution;\n"
              "void main() { gl_FragColor = vec4(vUv * uResolution * 0.8, uTime, 1.0); }\n"),
          std::string(
              "#version 330 core\nin highp vec2 v_texcoord;\nout vec4 colour;\n"
              "uniform float time;\nuniform vec2 resolution;\n"
              "void main() { colour = vec4(v_texcoord * resolution * 0.8, time, 1.0); }\n")}) {
        write("a.glsl", text);
        EXPECT_EQ(draw({"--time", "0.2"}), (std::array{102, 102, 51})) << text << errors_;
        EXPECT_EQ(errors_, "");
    }
    write("a.glsl",
          "varying vec2 vUv;\n#define vUv (vUv * 2.0)\n"
          "void main() { gl_FragColor = vec4(vUv * 25.6 * 0.5, 1.0, 1.0); }\n");
    EXPECT_EQ(draw()[2], 255) << errors_;
    write("a.glsl",
          "varying vec2 vUv, v_texcoord;\nvarying vec3 vNormal;\n"
          "void main() { gl_FragColor = vec4(vUv + v_texcoord, 1.0, 1.0) * 51.2; }\n");
    EXPECT_EQ(draw()[0], 204) << errors_ << "and what is not read may stay";
    write("a.glsl", "varying vec3 vNormal;\nvoid main() { gl_FragColor = vec4(vNormal, 1.0); }\n");
    const std::string said = glint({"still", "a.glsl", "-o", "x.png"}).err;
    EXPECT_NE(said.find("a.glsl:1:14: error: nothing feeds vNormal"), std::string::npos) << said;
    write("a.glsl",
          "varying vec2 vUv;\nuniform vec2 iResolution;\n"
          "void main() { gl_FragColor = vec4(vUv * iResolution * 0.8, 0.2, 1.0); }\n");
    EXPECT_EQ(draw(), (std::array{102, 102, 51})) << errors_ << "beside a size of its own";
}

TEST_F(Foreign, AnOlderTextMayCallAVariableTexture) {
    write("a.glsl",
          "uniform sampler2D t; //@ noise rgba 16\n"
          "vec4 get(sampler2D texture, vec2 p) { return texture2D(texture, p); }\n"
          "void main() { vec4 texture = get(t, vec2(0)) + texture2D(t, vec2(1));\n"
          "  gl_FragColor = texture * 0.0 + 0.2; }\n");
    EXPECT_EQ(draw(), (std::array{51, 51, 51})) << errors_;
}

TEST_F(Foreign, ThePlaceOfAMainImageMayBeConstant) {
    for (const std::string place : {"const in vec2 p", "const vec2 p"}) {
        write("a.glsl",
              "void mainImage(out vec4 c, " + place + ") { c = vec4(p * 0.0 + 0.2, 0.2, 1); }\n");
        EXPECT_EQ(draw(), (std::array{51, 51, 51})) << errors_;
    }
}

TEST_F(Foreign, ItsNamesAreFedByTheTypesThatItGivesThem) {
    const char* texts[] = {
        "#version 330\nuniform vec2 iResolution;\nuniform float iTime;\nout vec4 c;\n"
        "void main() { c = vec4((gl_FragCoord.xy / iResolution).xx * 51.2, iTime, 1.0); }\n",
        "uniform vec3 uResolution;\nuniform float u_time;\nuniform int u_frame;\n"
        "void main() { gl_FragColor = vec4((gl_FragCoord / uResolution.x).xx * 51.2, "
        "u_time + float(u_frame - 12), 1.0); }\n",
        "#version 330\nin vec4 gl_FragCoord;\nlayout(location = 0) out vec4 c;\n"
        "layout(std140, binding = 0) uniform B { float unused; } b;\nuniform float time;\n"
        "void main() { c = vec4(gl_FragCoord.xy / 64.0 * 51.2, time + b.unused, 1.0); }\n",
        "varying\nvec4 vertTexCoord;\nuniform\nfloat time;\n"
        "void main() { gl_FragColor = vec4(vertTexCoord.xx * 51.2, time, vertTexCoord.w); }\n"};
    for (const char* text : texts) {
        write("a.glsl", text);
        EXPECT_EQ(draw({"--time", "0.2"}), (std::array{102, 102, 51})) << text << errors_;
        EXPECT_EQ(errors_.find("error"), std::string::npos) << errors_;
    }
    write("a.glsl",
          "#version 330\nin Place { vec3 normal; vec3 colour; } place;\nout vec4 c;\n"
          "void main() { c = vec4(place.colour, 1); }\n");
    const std::string said = glint({"still", "a.glsl", "-o", "x.png"}).err;
    EXPECT_NE(said.find("a.glsl:2:1: error: nothing feeds this block"), std::string::npos) << said;
}

// As GLSL ES 1.00 and desktop GLSL let it.
TEST_F(Foreign, AMainMayAddToTheFunctionsOfGlsl) {
    write("a.glsl",
          "uniform vec2 resolution;\n"
          "int mod(int a, int b) { return a - (a / b) * b; }\n"
          "int min(int a, int b) { return a < b ? a : b; }\n"
          "float pow(float x, int n) { float r = 1.0; for (int i = 0; i < 8; i++) { if (i >= n) "
          "break; r *= x; } return r; }\n"
          "vec2 length(mat2 m) { return vec2(length(m[0]), length(m[1])); }\n"
          "void main() {\n    float x = mod(5.2, 1.0) + float(mod(7, 3) - min(2, 1));\n"
          "    gl_FragColor = vec4(x + 0.2, 0.8 * length(mat2(1.0)).y, pow(2.0, 3) - pow(2.8, "
          "2.0) + 0.04, 1.0);\n}\n");
    EXPECT_EQ(draw(), (std::array{102, 204, 51})) << errors_;
    EXPECT_EQ(errors_, "");
}

// Constants, what stands before the text's own, and members are GLSL's.
TEST_F(Foreign, WhereOnlyGlslsFunctionCanBeMeantItIs) {
    const std::string texts[] = {
        "float max(float a, float b, float c) { return max(a, max(b, c)); }\n"
        "const float most = max(0.4, 0.1);\nfloat light[max(1, 2)];\n"
        "void main() { light[1] = max(0.1, 0.8, 0.2); "
        "gl_FragColor = vec4(most, light[1], 0.2, 1.0); }\n",
        "float before(float x) { return mod(x, 1.0); }\n"
        "float mod(float x, float y) { return 0.8; }\n"
        "void main() { gl_FragColor = vec4(before(3.4), mod(1.0, 1.0), 0.2, 1.0); }\n",
        "struct Rod { float length; };\nvec2 length(mat2 m) { return vec2(length(m[0])); }\n"
        "void main() { Rod r = Rod(0.4); gl_FragColor = vec4(r.length, 0.8 * "
        "length(mat2(1.0)).x, 0.2, 1.0); }\n",
        "float cross(vec2 a, vec2 b) { return a.x * b.y - a.y * b.x; }\n"
        "vec2 round(vec2 p, float s) { return floor(p / s + 0.5) * s; }\n"
        "void main() { vec3 z = cross(vec3(1, 0, 0), vec3(0, 1, 0)); gl_FragColor = vec4("
        "round(vec2(0.41), 0.1).x * z.z, 0.8 * cross(vec2(1, 0), vec2(0, 1)), 0.2, 1.0); }\n",
        "float max(float a, float b, float c) { return max(a, max(b, c)); }\n"
        "#define MOST max(0.4, 0.1)\nconst float most = MOST;\n"
        "void main() { gl_FragColor = vec4(most, max(0.1, 0.8, 0.2), 0.2, 1.0); }\n",
        "#define OF(T) T min(T a, T b, T c) { return min(a, min(b, c)); }\nOF(float)\nOF(vec2)\n"
        "void main() { gl_FragColor = vec4(min(0.9, 0.4, 0.5), min(vec2(1), vec2(0.8), "
        "vec2(0.9)).x, 0.2, 1.0); }\n",
        "#version 330 core\nout vec4 c;\nvoid main() { float sample = 0.4, patch = 0.8; "
        "c = vec4(sample, patch, 0.2, 1.0); }\n"};
    for (const std::string& text : texts) {
        write("a.glsl", text);
        EXPECT_EQ(draw(), (std::array{102, 204, 51})) << text << errors_;
        EXPECT_EQ(errors_, "");
    }
    write("a.glsl",
          "float mix(float a, float b) { return mix(a, b, 0.5); }\nconst float k = mix(0.2, 0.6, "
          "0.5);\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(k, mix(0.6, 1.0), 0.2, 1); }\n");
    EXPECT_EQ(draw(), (std::array{102, 204, 51})) << errors_;
}

TEST_F(Foreign, AMistakeInABracketOrAHeadHasItsPlace) {
    const std::pair<const char*, const char*> texts[] = {
        {"void main() {\n gl_FragColor = vec4(1.0);\n",
         "a.glsl:1:13: error: this '{' is never closed; write '}'"},
        {"out vec4 c;\nfloat f() { return 1.0;\nvoid main() { c = vec4(f()); }\n",
         "a.glsl:3:1: error: a function begins within another one"},
        {"varying vec2 vUv;\nvoid main() {\n gl_FragColor = vec4(vUv, 0.0, 1.0);\n",
         "a.glsl:2:13: error: this '{' is never closed; write '}'"},
        {"varying vec2 vUv;\nvoid main() { gl_FragColor = vec4(vuv, 0.0, 1.0); }\n",
         "a.glsl:2:35: error: `vuv' undeclared; did you mean 'vUv'?"},
        {"#ifdef A\n#else if B\n#endif\nvoid main() { gl_FragColor = vec4(1.0); }\n",
         "a.glsl:2:7: error: "},
        {"out vec4 c;\nvoid main) { c = vec4(1); }\n", "a.glsl:2:10: error: "},
        {"void mian() { gl_FragColor = vec4(1.0); }\n",
         "a.glsl:1:6: error: there is no main here; did you mean this one?"},
        {"layout(location 0) out vec4 c;\nvoid main() { c = vec4(1); }\n",
         "a.glsl:1:8: error: this layout is not understood; write layout(location = 0)"},
        {"out vec c;\nvoid main() { c = vec4(1); }\n", "a.glsl:1:5: error: 'vec' is no type"},
        {"varying vec2 vUv\nvoid main() { gl_FragColor = vec4(1.0); }\n",
         "a.glsl:1:17: error: ';' is missing here"},
        {"void main(vec2 p) { gl_FragColor = vec4(1.0); }\n",
         "a.glsl:1:6: error: main() takes nothing"},
        {"void main() { gl_fragColor = vec4(1.0); }\n",
         "a.glsl:1:15: error: no gl_fragColor is known; did you mean gl_FragColor?"},
        {"#if 1\nvoid main() { gl_FragColor = vec4(1.0); }\n",
         "a.glsl:1:1: error: this #if is never ended"}};
    for (const auto& [text, words] : texts) {
        write("a.glsl", text);
        const Outcome outcome = glint({"still", "a.glsl", "-o", "x.png"});
        EXPECT_EQ(outcome.code, 3) << text;
        EXPECT_TRUE(outcome.err.starts_with(words)) << outcome.err;
        EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
    }
}

TEST_F(Foreign, AnArgumentListOfAMacroThatNeverClosesIsTold) {
    write("a.glsl",
          "#define SAT(x) clamp(x, 0.0, 1.0)\n"
          "void main() {\n  float a = SAT(sin(1.0);\n  gl_FragColor = vec4(a);\n}\n");
    const Outcome outcome = glint({"still", "a.glsl", "-o", "x.png"});
    EXPECT_TRUE(outcome.err.starts_with("a.glsl:3:13: error: the arguments of the macro SAT"))
        << outcome.err;
}

TEST_F(Foreign, ATextWithABlockIsProbed) {
    write("a.glsl",
          "#version 330\nlayout(std140) uniform Params { float a; vec4 b; };\nout vec4 c;\n"
          "void main() { c = b + a; }\n");
    const Outcome outcome = glint({"probe", "a.glsl", "--at", "1,1", "--size", "8x8"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("a.glsl:4: main: c = (0, 0, 0, 0)"), std::string::npos)
        << outcome.out;
}

TEST_F(Foreign, WhatIsWrongIsToldInItsOwnWords) {
    const std::pair<const char*, const char*> texts[] = {
        {"out vec4 col\nvoid main() { col = vec4(1); }\n", "a.glsl:1:13: error: ';' is missing"},
        {"precision mediump float\nvoid main() { gl_FragColor = vec4(1.0); }\n",
         "a.glsl:1:24: error: ';' is missing here"},
        {"void main() { float x = 1.0 gl_FragColor = vec4(x); }\n", "before 'gl_FragColor'"},
        {"float round(float x) { return x; }\nvoid main() { gl_FragColor = "
         "vec4(round(mat2(1.0)), 1.0, 1.0); }\n",
         "call to `round(mat2)'"},
        {"void main() { mediump x = 1.0; gl_FragColor = vec4(x); }\n", "behind 'mediump'"},
        {"void main() { gl_FragColor = vec4(1.0); }\nvoid main() { }\n", "`main' redefined"},
        {"varying vec3 vNormal;\nvoid main() { gl_FragColor = vec4(vNormal, 1.0); }\n",
         "a.glsl:1:14: error: nothing feeds vNormal"}};
    for (const auto& [text, words] : texts) {
        write("a.glsl", text);
        const std::string said = glint({"still", "a.glsl", "-o", "x.png"}).err;
        EXPECT_NE(said.find(words), std::string::npos) << said;
        EXPECT_EQ(said.find("glint_"), std::string::npos) << said;
        EXPECT_EQ(said.find("Color_"), std::string::npos) << said;
    }
}

TEST_F(Foreign, AGlobalMayBeginWithWhatIsNoConstant) {
    for (const std::string head :
         {"uniform float time;\nfloat t = 0.5 * time, two = 2.0;\nfloat u = t * two;\n",
          "#version 330\nuniform float time;\nfloat half_of(float x) { return 0.5 * x; }\n"
          "float t = half_of(time);\nvec2 two[2] = vec2[2](vec2(t), vec2(time));\n"
          "float u = two[1].x;\n"}) {
        const bool is_newer = head.starts_with("#version");
        write("a.glsl", head + (is_newer ? "out vec4 ink;\n" : "") + "void main() { " +
                            (is_newer ? "ink" : "gl_FragColor") + " = vec4(t, u, 0.2, 1.0); }\n");
        EXPECT_EQ(draw({"--time", "0.8"}), (std::array{102, 204, 51})) << head << errors_;
        EXPECT_EQ(errors_, "");
    }
    write(
        "a.glsl",
        "uniform float time;\nfloat t =\n  0.5 * tim;\nvoid main() { gl_FragColor = vec4(t); }\n");
    EXPECT_NE(glint({"still", "a.glsl", "-o", "x.png"}).err.find("a.glsl:3:9: error: `tim' undecl"),
              std::string::npos);
}

TEST_F(Foreign, ABlockOfInputsIsThatOfAPictureBeforeTheEye) {
    write("a.glsl",
          "#version 450\nlayout(location = 0) in VertexData { vec4 v_position; vec3 v_normal; "
          "vec2 v_texcoord; } inData;\nlayout(binding = 1) uniform float dim; //@ 0.4 [0, 1]\n"
          "layout(location = 0) out vec4 colour;\nvoid main() { colour = vec4(dim, "
          "inData.v_normal.z * 0.8, inData.v_texcoord.x * 12.8 + inData.v_position.w * 0.1, 1); "
          "}\n");
    EXPECT_EQ(draw(), (std::array{102, 204, 51})) << errors_;
}

TEST_F(Foreign, NamesThatOnlyNewerLanguagesOrOtherHostsHaveAreFree) {
    write("a.glsl",
          "#extension GL_EXT_draw_buffers : enable\n"
          "float fwidth(float x) { return 0.4 * x; }\nfloat iTime(float x) { return 0.8 * x; }\n"
          "void main() { gl_FragColor = vec4(fwidth(1.0), iTime(1.0), 0.2, 1.0); }\n");
    EXPECT_EQ(draw(), (std::array{102, 204, 51})) << errors_;
}

// GLSL ES 3.00 and desktop GLSL have no gl_FragColor.
TEST_F(Foreign, AMainMayHaveAnOutputOfItsOwn) {
    const std::string body = "void main() { colour = vec4(0.4, 0.8, 0.2, 1.0); }\n";
    for (const std::string& declaration :
         {std::string("out vec4 colour;\n"), std::string("layout(location = 0) out vec4 colour;\n"),
          std::string("#version 330 core\nout highp vec4 colour;\n"),
          std::string("layout(location = 1) out vec4 more;\nout vec4 colour;\n")}) {
        write("a.glsl", declaration + body);
        EXPECT_EQ(draw(), (std::array{102, 204, 51})) << declaration << errors_;
        EXPECT_EQ(errors_, "");
    }
    write("a.glsl", "out vec3 color;\nvoid main() { color += vec3(0.4, 0.8, 0.2); }\n");
    EXPECT_EQ(draw(), (std::array{102, 204, 51})) << errors_;
    write("a.glsl", "out vec4 colour;\nvoid main() {\n    colour = vec4(nothing);\n}\n");
    EXPECT_NE(glint({"still", "a.glsl", "-o", "x.png"}).err.find("a.glsl:3:19: error:"),
              std::string::npos);
}

TEST_F(Foreign, NamesOfTheSandboxAreFed) {
    write("a.glsl",
          "uniform float time;\nuniform vec2 resolution, mouse;\nout vec4 colour;\n"
          "void main() { colour = vec4(time * 0.5, mouse.x, gl_FragCoord.x / resolution.x * 64.0, "
          "1.0); }\n");
    write("box.toml", "scene = \"a.glsl\"\n[[events]]\nt = 0.1\nmouse = [0.5, 0.5]\ndown = true\n");
    EXPECT_EQ(draw({"--time", "0.8"}), (std::array{102, 0, 128})) << errors_;
    EXPECT_EQ(errors_, "");
    ASSERT_EQ(glint({"still", "box.toml", "-o", "box.png", "--size", "64x36", "--time", "1"}).code,
              0);
    EXPECT_EQ(std::to_integer<int>(read_image(folder() / "box.png").pixels[1]), 128);
    write("a.glsl",
          "uniform float time; //@ 0.4 [0, 1]\nvoid main() { gl_FragColor = vec4(time); }\n");
    EXPECT_EQ(draw({"--time", "0.8"})[0], 102);
}

TEST_F(Foreign, AMainThatDrawsNoColourIsSaidToBeAnothers) {
    const std::pair<const char*, const char*> cases[] = {
        {"void main() { gl_Position = vec4(0.0); }\n",
         "a.glsl:1:6: error: this main() is of a vertex shader"},
        {"void main() { uvec3 i = gl_GlobalInvocationID; }\n",
         "a.glsl:1:6: error: this main() is of a compute shader"},
        {"float c;\nvoid main() { c = 1.0; }\n",
         "a.glsl:2:6: error: this main() writes no colour"}};
    for (const auto& [text, told] : cases) {
        write("a.glsl", text);
        const Outcome outcome = glint({"still", "a.glsl", "-o", "x.png"});
        EXPECT_EQ(outcome.code, 3) << text;
        EXPECT_TRUE(outcome.err.starts_with(told)) << outcome.err;
    }
}

// 1.00 of GLSL ES has fewer names than 3.00, and lets a text use them.
TEST_F(Foreign, AMainMayUseWhatItsGlslLeavesFree) {
    const std::string end = "    gl_FragColor = vec4(0.4, 0.8, 0.2, 1.0);\n}\n";
    const std::pair<const char*, std::string> texts[] = {
        {"macros of the host's words",
         "#define color vec4(0.4, 0.8, 0.2, 1.0)\n#define coord 1\n"
         "void main() { gl_FragColor = color; }\n"},
        {"a texture2D of its own",
         "vec4 texture2D(vec2 p) { return vec4(p, 0.2, 1.0); }\n"
         "void main() { gl_FragColor = texture2D(vec2(0.4, 0.8)); }\n"},
        {"texture2D for other arguments, too",
         "uniform sampler2D t;\n"
         "vec4 texture2D(sampler2D s, vec2 p, vec3 more) { return texture2D(s, p) * 0.0 + "
         "more.xyzz; }\n"
         "void main() { gl_FragColor = texture2D(t, vec2(0.5), vec3(0.4, 0.8, 0.2)); }\n"},
        {"samplers without a precision",
         "#version 330\nout vec4 o;\nuniform usampler2D u;\nuniform sampler2DShadow s;\n"
         "void main() { o = vec4(0.4, 0.8, 0.2, 1); }\n"},
        {"a text that asks for its version",
         "#version 330\n#if __VERSION__ >= 330 && defined(__VERSION__)\nout vec4 o;\n#endif\n"
         "void main() { o = vec4(0.4, 0.8, 0.2, 1); }\n"},
        {"a macro texture2D",
         "#define texture2D(a) vec4(a, 0.2, 1.0)\n"
         "void main() { gl_FragColor = texture2D(vec2(0.4, 0.8)); }\n"},
        {"a sampler called texture",
         "uniform sampler2D texture;\n"
         "void main() { gl_FragColor = vec4(0.4, 0.8, 0.2, 1) + texture2D(texture, vec2(0.5)); "
         "}\n"},
        {"a function round",
         "float round(float x) { return floor(x + 0.5) * 0.4; }\n"
         "void main() { gl_FragColor = vec4(round(1.2), 0.8, 0.2, 1); }\n"},
        {"a mainImage that it calls",
         "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.4, 0.8, 0.2, 1); }\n"
         "void main() { mainImage(gl_FragColor, gl_FragCoord.xy); }\n"},
        {"what it makes of a mainImage",
         "void mainImage(out vec4 c, in vec2 p) { c += vec4(0.6, 0.2, 0.8, 0); }\n"
         "void main() { mainImage(gl_FragColor, gl_FragCoord.xy); gl_FragColor.rgb = 1.0 - "
         "gl_FragColor.rgb; }\n"},
        {"variables of the host's names, which it fills",
         "uniform float time; //@ 0.8\nuniform vec2 resolution;\n"
         "float iTime = 0.0;\nvec3 iResolution = vec3(0.0);\nconst vec4 iMouse = vec4(0.2);\n"
         "const int iFrame = 4;\n"
         "void mainImage(out vec4 c, in vec2 p) {\n"
         "    c = vec4(float(iFrame) * 0.1 * iResolution.x / 64.0, iTime, iMouse.x, 1);\n}\n"
         "void main() { iTime = time; iResolution = vec3(resolution, 0.0);\n"
         "    mainImage(gl_FragColor, gl_FragCoord.xy); }\n"},
        {"words of later versions",
         "float smooth(float sample) { return sample; }\n"
         "float patch(float filter) { float common = filter, active = common; return active; }\n"
         "void main() { gl_FragColor = vec4(smooth(0.4), patch(0.8), 0.2, 1); }\n"},
        {"an inverse of its own",
         "mat2 inverse(mat2 m) { return m; }\nfloat transpose(float x) { return 2.0 * x; }\n"
         "void main() { gl_FragColor = vec4(inverse(mat2(0.4))[0][0], transpose(0.4), 0.2, 1); "
         "}\n"},
        {"its colour by another name",
         "void main() { gl_FragData[0] = vec4(0.4, 0.8, 0.2, 1.0); }\n"},
        {"a buffer",
         "uniform sampler2D half_of; //@ pass mainHalf\n"
         "void mainHalf(out vec4 c, in vec2 p) { c = vec4(0.2, 0.4, 0.1, 1); }\n"
         "void main() { gl_FragColor = 2.0 * texture2D(half_of, vec2(0.5)); }\n"},
        {"a picture that reads itself",
         "#iChannel0 \"self\"\nvoid main() {\n    vec4 old = texture2D(iChannel0, vec2(0.5));\n" +
             end},
        {"a file with a main(), too",
         "#iChannel0 \"b.glsl\"\n"
         "void main() { gl_FragColor = texture2D(iChannel0, vec2(0.5)); }\n"},
    };
    write("b.glsl", "void main() {\n" + end);
    for (const auto& [what, text] : texts) {
        SCOPED_TRACE(what);
        write("a.glsl", text);
        EXPECT_EQ(draw({"--frame", "2"}), (std::array{102, 204, 51})) << errors_;
    }
    write("a.glsl", "vec2 mainSound(int s, float t) { return vec2(0.5); }\nvoid main() {\n" + end);
    EXPECT_EQ(glint({"sound", "a.glsl", "-o", "a.wav", "--seconds", "1"}).code, 0);
}

// Fed as they are elsewhere; a text may declare another thing by the name.
TEST_F(Foreign, OldNamesOfOtherTypesAreUniformsThatNothingFills) {
    for (const char* declaration : {"vec4 u_resolution", "vec4 u_mouse", "int u_time",
                                    "vec2 iGlobalTime", "float u_time[2]"}) {
        const std::string name =
            std::string(declaration).substr(std::string(declaration).find(' ') + 1);
        write("a.glsl",
              std::string("uniform ") + declaration +
                  ";\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(" +
                  (name.ends_with(']') ? "u_time[1]" : name + (name == "u_time" ? "" : ".x")) +
                  ") + 0.4; }\n");
        EXPECT_EQ(draw({"--time", "3"})[0], 102) << declaration;
        EXPECT_NE(errors_.find("has no annotation, so it stays 0"), std::string::npos) << errors_;
    }
}

TEST_F(Foreign, ATickOfItsOwnIsTheTexts) {
    for (const char* text :
         {"float iTick = 0.4;\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(iTick); }\n",
          "float iTick() { return 0.4; }\nvoid mainImage(out vec4 c, in vec2 p) { c = "
          "vec4(iTick()); }\n",
          "struct iTick { float a; };\n"
          "void mainImage(out vec4 c, in vec2 p) { iTick t = iTick(0.4); c = vec4(t.a); }\n"}) {
        write("a.glsl", text);
        EXPECT_EQ(draw()[0], 102) << text << errors_;
        EXPECT_EQ(errors_, "");
    }
}

TEST_F(Foreign, AnEmptyChannelIsToldOnceWithItsLine) {
    write(
        "a.glsl",
        "// pasted\nvoid mainImage(out vec4 c, in vec2 p) {\n    c = texture(iChannel0, p);\n}\n");
    const std::string said = "a.glsl:3:17: warning: nothing fills iChannel0, which is read here";
    EXPECT_EQ(draw(), (std::array{0, 0, 0}));
    EXPECT_TRUE(errors_.starts_with(said)) << errors_;
    const Outcome info = glint({"info", "a.glsl"});
    EXPECT_EQ(info.code, 0);
    EXPECT_TRUE(info.err.starts_with(said)) << info.err;
    EXPECT_EQ(info.err.find(said, 1), std::string::npos) << info.err;
}

}  // namespace
}  // namespace glint::cli::foreign_test
