// The probe itself: what goes in and comes out, and one hash as an example of its use.
#include "probe.h"

#include <bit>
#include <cstdint>

namespace glint {
namespace {

using Probe = GlTest;

TEST_F(Probe, GivesBackItsInputsBitByBit) {
    std::vector<ProbeCase> cases;
    for (int i = 0; i < 1000; ++i) {
        const float x = std::ldexp(1.0f + static_cast<float>(i) / 1000.0f, i % 250 - 124);
        cases.push_back({.a = {x, -x, 0.0f, 1.0f / x}, .d = {0.0f, 0.0f, 0.0f, x}});
    }
    const std::vector<glm::vec4> same = probe("", "a", cases);
    const std::vector<glm::vec4> sum = probe("", "a + b + c", cases);
    const std::vector<glm::vec4> last = probe("", "d.wz", cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        EXPECT_EQ(same[i], cases[i].a);
        EXPECT_EQ(sum[i], cases[i].a) << "inputs that are not given are 0";
        EXPECT_EQ(last[i], glm::vec4(cases[i].d.w, 0, 0, 0));
    }
}

TEST_F(Probe, CallsTheFunctionsOfAWholeScene) {
    const std::string scene =
        "uniform float slope; //@ 2.5 [0, 10]\n"
        "uniform sampler2D n; //@ noise r 4\n"
        "float line(float x) { return slope * x + 1.0; }\n"
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(line(p.x)) + texture(n, p); }\n";
    const std::vector<ProbeCase> cases = {{.a = {2, 0, 0, 0}}, {.a = {-4, 0, 0, 0}}};
    const std::vector<glm::vec4> lines = probe(scene, "line(a.x)", cases);
    EXPECT_EQ(lines[0].x, 6.0f);
    EXPECT_EQ(lines[1].x, -9.0f);
}

TEST_F(Probe, SaysWhatDoesNotCompile) {
    const std::vector<ProbeCase> one(1);
    EXPECT_THROW(probe("", "nothing(a)", one), std::runtime_error);
}

// pcg3d in GLSL agrees with the textures of noise that the host makes (Jarzynski and Olano 2020).
TEST_F(Probe, AHashInTheShaderIsTheNoiseOfTheHost) {
    const std::string hash =
        "uvec3 pcg3d(uvec3 v) {\n"
        "    v = v * 1664525u + 1013904223u;\n"
        "    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;\n"
        "    v ^= v >> 16u;\n"
        "    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;\n"
        "    return v;\n"
        "}\n";
    constexpr int kSide = 32;
    const std::vector<std::byte> bytes = noise_bytes({kSide, kSide, 1}, 3);
    std::vector<ProbeCase> cases;
    for (int i = 0; i < kSide * kSide; ++i) cases.push_back({.a = {i % kSide, i / kSide, 0, 0}});
    const auto hashed = probe(hash, "vec3(pcg3d(uvec3(a.xyz)) >> 24u)", cases);
    for (std::size_t i = 0; i < cases.size(); ++i) {
        for (std::size_t c = 0; c < 3; ++c) {
            EXPECT_EQ(hashed[i][static_cast<int>(c)], static_cast<float>(bytes[i * 3 + c]));
        }
    }
}

}  // namespace
}  // namespace glint
