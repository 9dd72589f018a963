// The probe itself: what goes in and comes out, and one hash as an example of its use.
#include "probe.h"

#include "worst_case.h"

#include <bit>
#include <cstdint>

namespace glint::probe_test {
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

// Q8: a scene's hash gives the bits of C++'s, over 2^20 cells each round -1e6, 1e6 and beyond 2^24,
// where a float no longer knows its neighbour. (That all scenes have one text of it is asked
// elsewhere.) A case folds the hashes of 64 cells in a row.
int rows_with_other_bits(const std::array<int, 3>& place) {
    const std::string fold =
        "#include \"" GLINT_REPOSITORY
        "/fragments/sea.frag\"\n"
        "vec4 folded(vec4 high, vec4 low) {\n"
        "    ivec3 q = ivec3(high.xyz) * 65536 + ivec3(low.xyz);\n"
        "    uvec3 sum = uvec3(0u);\n"
        "    for (int k = 0; k < 64; ++k) sum = 31u * sum + hash3(q + ivec3(k, 0, 0));\n"
        "    uvec2 all = uvec2(sum.x + 7u * sum.z, sum.y + 5u * sum.z);\n"
        "    return vec4(all & 0xffffu, all >> 16u).xzyw;\n}\n";
    const auto hash = [](std::uint32_t x, std::uint32_t y, std::uint32_t z) {
        x = x * 1664525u + 1013904223u;
        y = y * 1664525u + 1013904223u;
        z = z * 1664525u + 1013904223u;
        x += y * z, y += z * x, z += x * y;
        x ^= x >> 16u, y ^= y >> 16u, z ^= z >> 16u;
        x += y * z, y += z * x, z += x * y;
        return std::array{x, y, z};
    };
    std::vector<ProbeCase> cases;
    std::vector<std::array<std::uint32_t, 2>> wanted;
    for (int i = 0; i < 16384; ++i) {
        const std::array q = {place[0] + 64 * (i % 16), place[1] + i / 16 % 32, place[2] + i / 512};
        ProbeCase one;
        for (int c = 0; c < 3; ++c) {
            const int n = q[static_cast<std::size_t>(c)];
            one.a[c] = static_cast<float>(n >> 16);
            one.b[c] = static_cast<float>(n & 65535);
        }
        cases.push_back(one);
        std::array<std::uint32_t, 3> sum{};
        for (int k = 0; k < 64; ++k) {
            const auto h = hash(static_cast<std::uint32_t>(q[0] + k),
                                static_cast<std::uint32_t>(q[1]), static_cast<std::uint32_t>(q[2]));
            for (std::size_t c = 0; c < 3; ++c) sum[c] = 31u * sum[c] + h[c];
        }
        wanted.push_back({sum[0] + 7u * sum[2], sum[1] + 5u * sum[2]});
    }
    const auto got = probe(fold, "folded(a, b)", cases);
    int wrong = 0;
    for (std::size_t i = 0; i < cases.size(); ++i) {
        const auto bits = [](float low, float high) {
            return static_cast<std::uint32_t>(low) | static_cast<std::uint32_t>(high) << 16u;
        };
        wrong +=
            bits(got[i].x, got[i].y) != wanted[i][0] || bits(got[i].z, got[i].w) != wanted[i][1];
    }
    return wrong;
}
constexpr const char* kOtherBits = "Q8 hash: rows of 64 cells with other bits";
TEST_F(Probe, AHashOfTheScenesIsTheSameInCppOverMillionsOfCells) {
    Bar different(kOtherBits, 0.0);
    for (const int far : {-1'000'000, 1'000'000, (1 << 24) + 1})
        different.see(rows_with_other_bits({far, -far, far}), fmt::format("cells round {}", far));
}
TEST_F(Probe, AHashIsTheSameInCppWhateverTheCase) {
    Bar different(kOtherBits, 0.0);
    search_worst(3, 40, {&different}, [&](Dials& dials) {
        std::array<int, 3> place{};
        for (int& one : place) one = static_cast<int>(dials.between(-2.1e9, 2.1e9));
        different.see(rows_with_other_bits(place),
                      fmt::format("cells round {} {} {}", place[0], place[1], place[2]));
    });
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
}  // namespace glint::probe_test
