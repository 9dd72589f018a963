// What kind of texture a text takes a sampler for.
#include "glsl/sampler_use.h"

#include <gtest/gtest.h>

namespace glint::sampler_use_test {
namespace {

std::string_view used_in(const std::string& statements, const std::string& above = "") {
    const std::string text =
        above + "void mainImage(out vec4 c, in vec2 p) { vec2 uv = p; vec3 rd = vec3(p, 1.0); " +
        statements + " }\n";
    return sampler_used_as(read_glsl(text, known_of_driver()), "iChannel0");
}

TEST(SamplerUse, ThreeComponentsAreADirection) {
    for (const char* place : {"rd", "-rd", "normalize(vec3(p - 0.5, 1.0))", "reflect(rd, rd) * 2.0",
                              "(rd + 1.0)", "rd.zyx", "mat3(1.0) * rd", "abs(rd.xyz)"})
        EXPECT_EQ(used_in("c = texture(iChannel0, " + std::string(place) + ");"), "samplerCube")
            << place;
}

TEST(SamplerUse, TwoOrWhatIsNotKnownAreAPicture) {
    for (const char* place :
         {"uv", "rd.xy", "uv * rd.z", "(rd * 2.0).xy", "vec2(rd)", "uv * length(rd)",
          "mat3x2(1.0) * rd", "f(rd)", "rd.xy / dot(rd, rd)", "normalize(rd).xy"})
        EXPECT_EQ(used_in("c = texture(iChannel0, " + std::string(place) + ");"), "") << place;
    EXPECT_EQ(used_in("c = texture(iChannel0, uv) + texture(iChannel0, rd);"), "");
    EXPECT_EQ(used_in("c = texture(iChannel1, rd);"), "");
}

TEST(SamplerUse, WholeTexelsInThreeDirectionsAreAVolume) {
    EXPECT_EQ(used_in("c = texelFetch(iChannel0, ivec3(rd), 0) + texture(iChannel0, rd);"),
              "sampler3D");
    EXPECT_EQ(used_in("c = texelFetch(iChannel0, ivec2(p), 0);"), "");
}

TEST(SamplerUse, FunctionsOfOlderGlslSayItByTheirNames) {
    EXPECT_EQ(used_in("c = textureCube(iChannel0, f(p));"), "samplerCube");
    EXPECT_EQ(used_in("c = texture3D(iChannel0, rd);"), "sampler3D");
    EXPECT_EQ(used_in("c = texture2D(iChannel0, f(rd)) + texture(iChannel0, rd);"), "");
}

TEST(SamplerUse, AParameterSaysIt) {
    const std::string cube = "vec4 f(float k, samplerCube s, vec3 d) { return texture(s, d); }\n",
                      volume =
                          "float g(in sampler3D s) { return textureLod(s, vec3(0), 0.0).x; }\n";
    EXPECT_EQ(used_in("c = f(1.0, iChannel0, rd);", cube), "samplerCube");
    EXPECT_EQ(used_in("c.x = g(iChannel0);", volume), "sampler3D");
    EXPECT_EQ(
        used_in("c = h(iChannel0, uv);", "vec4 h(sampler2D s, vec2 p) { return texture(s, p); }\n"),
        "");
    EXPECT_EQ(used_in("c = T(rd);", "#define T(p) textureLod(iChannel0, p, 0.0)\n"), "samplerCube");
}

}  // namespace
}  // namespace glint::sampler_use_test
