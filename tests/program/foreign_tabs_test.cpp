// Texts of VS Code's Shader Toy in several parts: each has a main(), inputs and uniforms of its
// own.
#include "command.h"
#include "media/image.h"

#include <nlohmann/json.hpp>

namespace glint::cli::foreign_tabs_test {
namespace {

class ForeignTabs : public InAFolder {
protected:
    // A pixel in the middle, of the third frame.
    std::array<int, 3> draw(const std::string& text) {
        write("a.glsl", text);
        const Outcome drawn =
            glint({"still", "a.glsl", "-o", "out.png", "--size", "10x10", "--frame", "2"});
        EXPECT_EQ(drawn.code, 0) << drawn.err;
        EXPECT_EQ(drawn.err, "");
        if (drawn.code != 0) return {};
        const Image image = read_image(folder() / "out.png");
        const auto at = [&](std::size_t i) {
            return std::to_integer<int>(image.pixels[(5 * 10 + 5) * 3 + i]);
        };
        return {at(0), at(1), at(2)};
    }
    std::string errors_of(const std::string& text) {
        write("a.glsl", text);
        const Outcome outcome = glint({"still", "a.glsl", "-o", "out.png"});
        EXPECT_EQ(outcome.code, 3);
        return outcome.err;
    }
};

constexpr std::string_view kSelf = "#iChannel0 \"self\"\n";
constexpr std::array<int, 3> kThrice{153, 38, 0};  // 0.2 and 0.05 a frame

TEST_F(ForeignTabs, WhatReadsItselfMayHaveAMainOfEveryKind) {
    const std::string mains[] = {
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    c = texture(iChannel0, p / iResolution.xy) + vec4(0.2, 0.05, 0, 1);\n}\n"
        "void main() { mainImage(gl_FragColor, gl_FragCoord.xy); }\n",
        "out vec4 c;\nvoid main() {\n"
        "    c = texture(iChannel0, gl_FragCoord.xy / iResolution.xy) + vec4(0.2, 0.05, 0, "
        "1);\n}\n",
        "void main() {\n    gl_FragData[0] = texture2D(iChannel0, gl_FragCoord.xy / "
        "iResolution.xy) + vec4(0.2, 0.05, 0, 1);\n}\n",
        "varying vec2 vUv;\nvoid main() {\n"
        "    gl_FragColor = texture2D(iChannel0, vUv) + vec4(0.2, 0.05, 0, 1);\n}\n",
        "uniform vec2 iResolution;\nuniform float time;\nfloat t = time * 0.0 + 0.05;\n"
        "void main() {\n    gl_FragColor = texture2D(iChannel0, gl_FragCoord.xy / iResolution) + "
        "vec4(4.0 * t, t, 0, 1);\n}\n"};
    for (const std::string& main : mains) {
        SCOPED_TRACE(main);
        EXPECT_EQ(draw(std::string(kSelf) + main), kThrice);
    }
}

TEST_F(ForeignTabs, PictureAndBufferMayBothHaveAMain) {
    write(
        "b.glsl",
        "out vec4 colour;\nin vec2 uv;\nvoid main() { colour = vec4(0.2 + 0.0 * uv, 0.6, 1); }\n");
    EXPECT_EQ(draw("#iChannel0 \"b.glsl\"\nout vec4 c;\nvoid main() {\n"
                   "    c = texelFetch(iChannel0, ivec2(gl_FragCoord.xy), 0).zyxw;\n}\n"),
              (std::array{153, 51, 51}));
    EXPECT_EQ(draw("#iChannel0 \"b.glsl\"\nvoid mainImage(out vec4 c, in vec2 p) {\n"
                   "    c = texelFetch(iChannel0, ivec2(p), 0).zyxw;\n}\n"),
              (std::array{153, 51, 51}));
}

TEST_F(ForeignTabs, AMistakeInAMainIsToldOnceAndInItsFile) {
    EXPECT_EQ(errors_of(std::string(kSelf) + "void main() {\n    gl_FragColor = nothing;\n}\n"),
              "a.glsl:3:20: error: `nothing' undeclared\n");
    write("b.glsl", "void main() {\n    float x = 1.0;\n}\n");
    const std::string errors = errors_of(
        "#iChannel0 \"b.glsl\"\nvoid mainImage(out vec4 c, in vec2 p) {\n"
        "    c = texelFetch(iChannel0, ivec2(p), 0);\n}\n");
    EXPECT_NE(errors.find("b.glsl:1:6: error: this main() writes no colour"), std::string::npos)
        << errors;
}

TEST_F(ForeignTabs, TheSameUniformInSeveralFilesIsOneTweak) {
    const std::string uniform = "#iUniform float k = 0.4 in { 0.0, 1.0 }\n";
    write("b.glsl", uniform + "void mainImage(out vec4 c, in vec2 p) { c = vec4(k, 0, 0, 1); }\n");
    const std::string reads = "#iChannel0 \"b.glsl\"\n" + uniform +
                              "void mainImage(out vec4 c, in vec2 p) {\n"
                              "    c = texelFetch(iChannel0, ivec2(p), 0) + vec4(0, k, 0, 0);\n}\n";
    EXPECT_EQ(draw(reads), (std::array{102, 102, 0}));
    const Outcome info = glint({"info", "a.glsl", "--json"});
    EXPECT_EQ(nlohmann::json::parse(info.out)["tweaks"].size(), 1u) << info.out;
    const Outcome tweaked = glint(
        {"still", "a.glsl", "-o", "out.png", "--size", "4x4", "--tweak", "k=1", "--no-specialise"});
    EXPECT_EQ(tweaked.code, 0) << tweaked.err;
    const Image image = read_image(folder() / "out.png");
    EXPECT_EQ(image.pixels[0], std::byte{255});
    EXPECT_EQ(image.pixels[1], std::byte{255});
    write("b.glsl",
          "#iUniform float k = 0.9\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(k); }\n");
    EXPECT_NE(errors_of(reads).find("all tabs have one tweak of a name"), std::string::npos);
}

TEST_F(ForeignTabs, TabsShareATweakWhoseAnnotationsAreAlikeWhateverTheSpaces) {
    const auto tabs = [](const char* one, const char* two) {
        return std::string("uniform sampler2D buf; //@ pass main_buf\n#ifdef PASS_buf\n") + one +
               "void mainImage(out vec4 c, in vec2 p) { c = vec4(k, 0, 0, 1); }\n#endif\n"
               "#ifdef PASS_image\n" +
               two +
               "void mainImage(out vec4 c, in vec2 p) {\n"
               "    c = texelFetch(buf, ivec2(p), 0) + vec4(0, k, 0, 0);\n}\n#endif\n";
    };
    EXPECT_EQ(draw(tabs("uniform float k; //@ 0.4 [0, 1] \"k\"\n",
                        "uniform  float k;  //@ 0.4 [0, 1] \"k\"  \n")),
              (std::array{102, 102, 0}));
    EXPECT_NE(errors_of(tabs("uniform float\n  k; //@ 0.2 [0, 1] \"one\"\n",
                             "uniform float\n  k; //@ 0.9 [0, 5] \"two\"\n"))
                  .find("declare it alike"),
              std::string::npos);
}

TEST_F(ForeignTabs, AMistakeInAMainOfSeveralPassesIsToldOnce) {
    const std::string errors = errors_of(
        "uniform sampler2D a; //@ pass main_a\nuniform sampler2D b; //@ pass main_b\n"
        "void main() { gl_Fragcolor = vec4(1.0); }\n#ifdef PASS_a\nfloat x1;\n#endif\n"
        "#ifdef PASS_b\nfloat x2;\n#endif\n#ifdef PASS_image\nfloat x3;\n#endif\n");
    EXPECT_EQ(std::ranges::count(errors, '\n'), 1) << errors;
}

// As for a compiler that sees each tab alone.
TEST_F(ForeignTabs, AFileThatIsIncludedOnceIsIncludedOnceInEachTab) {
    write("lib.glsl",
          "#pragma once\n#iUniform float k = 0.4\nfloat half_of(float x) { return 0.5 * x; }\n");
    write("b.glsl",
          "#include \"lib.glsl\"\n#include \"lib.glsl\"\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(half_of(k), 0, 0, 1); }\n");
    EXPECT_EQ(draw("#iChannel0 \"b.glsl\"\n#include \"lib.glsl\"\n"
                   "void mainImage(out vec4 c, in vec2 p) {\n"
                   "    c = texelFetch(iChannel0, ivec2(p), 0) + vec4(0, half_of(k), 0, 0);\n}\n"),
              (std::array{51, 51, 0}));
}

TEST_F(ForeignTabs, UniformsAreReadAsThereWithoutAValueWithSignsAndInBrackets) {
    EXPECT_EQ(draw("#iUniform float low in { 0.2, 5.0 }\n"
                   "#iUniform vec2 place = vec2(0.5, 0.25) in { vec2(0.0, -1.0), vec2(1.0, 2.0) }\n"
                   "#iUniform float sum = +1.0 in [ -2.0, +2.0 ]\n"
                   "#iUniform ivec2 cells = ivec2(1, 2) in { 0, 4 }\n"
                   "#iUniform float nothing\n"
                   "void mainImage(out vec4 c, in vec2 p) {\n"
                   "    c = vec4(low, place.x + nothing, float(cells.x * 10 + cells.y) / 20.0 * "
                   "sum, 1);\n}\n"),
              (std::array{51, 128, 153}));
    const auto tweaks = nlohmann::json::parse(glint({"info", "a.glsl", "--json"}).out)["tweaks"];
    EXPECT_EQ(tweaks[1]["min"], -1.0);
    EXPECT_EQ(tweaks[1]["max"], 2.0);
    EXPECT_EQ(tweaks[2]["min"], -2.0);
    EXPECT_EQ(tweaks[3]["name"], "cells_x");
}

TEST_F(ForeignTabs, SingleQuotesAreQuotesToo) {
    write("inc.glsl", "const float kRed = 0.2;\n");
    EXPECT_EQ(
        draw("#include 'inc.glsl'\n#iChannel0 'self'\n#iChannel0::WrapMode 'Repeat'\n"
             "void mainImage(out vec4 c, in vec2 p) {\n"
             "    c = texture(iChannel0, p / iResolution.xy + 1.0) + vec4(kRed, 0.05, 0, 1);\n"
             "}\n"),
        kThrice);
}

TEST_F(ForeignTabs, OtherLanguagesAreNamedBeforeTheFilesThatTheyInclude) {
    write("a.glsl",
          "#include <metal_stdlib>\nusing namespace metal;\n"
          "fragment float4 shade(VertexOut in [[stage_in]]) { return float4(in.uv, 0.5, 1.0); }\n");
    const Outcome outcome = glint({"still", "a.glsl", "-o", "out.png"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_TRUE(outcome.err.starts_with("a.glsl:2:7: error: this is Metal")) << outcome.err;
    EXPECT_EQ(std::ranges::count(outcome.err, '\n'), 1) << outcome.err;
}

TEST_F(ForeignTabs, AnInputWithALayoutThatNothingFeedsIsTold) {
    const std::string errors = errors_of(
        "#version 450 core\nlayout(location = 0) in vec3 vColor;\n"
        "layout(location = 0) out vec4 outColor;\nvoid main() { outColor = vec4(vColor, 1.0); }\n");
    EXPECT_NE(errors.find("a.glsl:2:30: error: nothing feeds vColor"), std::string::npos) << errors;
    EXPECT_EQ(draw("#version 450 core\nlayout(location = 0) in vec2 fragTexCoord;\n"
                   "layout(location = 0) out vec4 outColor;\n"
                   "void main() { outColor = vec4(step(0.5, fragTexCoord), 0.0, 1.0); }\n"),
              (std::array{255, 255, 0}));
}

}  // namespace
}  // namespace glint::cli::foreign_tabs_test
