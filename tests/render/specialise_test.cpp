// Tweaks written in as constants give the picture that they give as uniforms.
#include "fixture.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace glint::specialise_test {
namespace {

using Specialised = GlTest;

// A march along a ray, a sum of octaves, a simulation: what compilers reorder.
const char* const kScenes[] = {
    R"(
uniform float radius;   //@ 0.7 [0.1, 2]
uniform vec3 light;     //@ 0.4, 0.8, -0.5 [-1, 1]
uniform int steps;      //@ 48 [1, 200]
uniform bool bumps;     //@ on
uniform vec3 colour;    //@ #c08040
float map(vec3 q) {
    float d = length(q) - radius;
    if (bumps) d += 0.03 * sin(12.0 * q.x) * sin(13.0 * q.y) * sin(11.0 * q.z);
    return min(d, q.y + 0.8);
}
void mainImage(out vec4 c, vec2 p) {
    vec3 ro = vec3(0, 0.2, -3), rd = normalize(vec3((p - 0.5 * iResolution.xy) / iResolution.y, 1.5));
    float t = 0.0;
    for (int i = 0; i < steps; ++i) t += map(ro + rd * t);
    vec3 q = ro + rd * t;
    vec2 e = vec2(1e-3, 0);
    vec3 n = normalize(vec3(map(q + e.xyy), map(q + e.yxy), map(q + e.yyx)) - map(q));
    c = vec4(colour * max(dot(n, normalize(light)), 0.0) * exp(-0.1 * min(t, 50.0)), 1);
}
)",
    R"(
uniform int octaves;     //@ 6 [1, 12]
uniform float gain;      //@ 0.55 [0, 1]
uniform float frequency; //@ 3 [0.1, 30] log
uniform vec2 drift;      //@ 0.3, -0.2 [-1, 1]
uniform sampler2D n;     //@ noise rgba 64
void mainImage(out vec4 c, vec2 p) {
    vec2 uv = p / iResolution.xy + drift * iTime;
    float sum = 0.0, amplitude = 0.5, f = frequency / 16.0;
    for (int i = 0; i < octaves; ++i) {
        sum += amplitude * textureLod(n, uv * f, 0.0).x;
        amplitude *= gain;
        f *= 2.03;
    }
    c = vec4(sum, sqrt(sum), pow(sum, 2.2), 1);
}
)",
    R"(
uniform float diffusion; //@ 0.2 [0, 0.25]
uniform vec4 source;     //@ 0.3, 0.6, 0.9, 1 [0, 1]
uniform int mode;        //@ warm {cold, warm, hot}
uniform sampler2D heat;  //@ pass mainHeat
void mainHeat(out vec4 c, vec2 p) {
    ivec2 i = ivec2(p), last = textureSize(heat, 0) - 1;
    vec4 sum = vec4(0);
    for (int k = 0; k < 4; ++k) {
        ivec2 d = ivec2(k == 0 ? 1 : k == 1 ? -1 : 0, k == 2 ? 1 : k == 3 ? -1 : 0);
        sum += texelFetch(heat, clamp(i + d, ivec2(0), last), 0);
    }
    vec4 old = texelFetch(heat, i, 0);
    c = old + diffusion * (sum - 4.0 * old);
    if (i == last / 2) c = source * float(mode) * 4.0;
}
void mainImage(out vec4 c, vec2 p) { c = sqrt(texture(heat, p / iResolution.xy)); }
)",
};

TEST_F(Specialised, PicturesAreThoseOfUniforms) {
    for (const char* scene : kScenes) {
        SCOPED_TRACE(scene);
        const glm::ivec2 size(96, 54);
        Player constants(scene, {.size = size, .format = PixelFormat::rgba8});
        Player uniforms(scene, {.size = size, .specialise = false, .format = PixelFormat::rgba8});
        constants.draw_frames(0, 8);
        uniforms.draw_frames(0, 8);
        const auto a = constants.renderer().read_bytes(), b = uniforms.renderer().read_bytes();
        ASSERT_EQ(a.size(), b.size());
        const Differences differences = compare(a, b, 1);
        // A silhouette may flip by a rounding: 0.05 % of the pixels.
        EXPECT_LE(differences.share, 0.0005);
        EXPECT_FALSE(differences.is_dark) << "a black picture would prove nothing";
    }
}

// The bits of four values, as the shader has them. `word` turns v.x … v.w into uints.
std::vector<std::uint32_t> bits_in_shader(const std::string& declaration, const char* words,
                                          const TweakValue& value, bool specialise) {
    // One byte a pixel: floats carry it exactly, whatever the bits mean.
    const std::string text =
        declaration +
        fmt::format(
            "uniform sampler2D bytes; //@ pass mainBytes size=4x1\n"
            "void mainBytes(out vec4 c, vec2 p) {{\n"
            "    uvec4 w = {};\n"
            "    c = vec4((w >> uvec4(8 * int(p.x))) & 255u);\n"
            "}}\n"
            "void mainImage(out vec4 c, vec2 p) {{ c = texelFetch(bytes, ivec2(p), 0); }}\n",
            words);
    const TestFolder folder;
    ReadPreset read = read_scene_text(folder, text, {});
    if (!read.preset) throw std::runtime_error(to_text(read.diagnostics));
    Preset& preset = *read.preset;
    preset.values[0] = value;
    CompileResult compiled =
        compile_scene(preset, {.root = 0, .program = {.specialise = specialise}});
    if (!compiled.scene) throw std::runtime_error(to_text(compiled.diagnostics));
    Renderer renderer(preset, std::move(*compiled.scene), {.size = {4, 1}});
    renderer.draw({});
    const std::vector<float> bytes = renderer.read_floats();
    std::vector<std::uint32_t> result(4, 0);
    for (std::size_t i = 0; i < 16; ++i)
        result[i % 4] |= static_cast<std::uint32_t>(bytes[i]) << 8 * (i / 4);
    return result;
}

TEST_F(Specialised, EveryFloatReachesTheShaderBitByBit) {
    using Limits = std::numeric_limits<float>;
    const double values[] = {0.0,
                             -0.0,
                             1.0,
                             0.1,
                             -1.0 / 3.0,
                             1e-7,
                             16777217.0,
                             123456.789,
                             1e20,
                             -9.87654321e-20,
                             Limits::min(),
                             Limits::max(),
                             Limits::lowest(),
                             0.30000001192092896,
                             1.0 + Limits::epsilon(),
                             3.14159265358979};
    for (const double value : values) {
        for (const bool specialise : {false, true}) {
            SCOPED_TRACE(fmt::format("{} {}", value, specialise));
            EXPECT_EQ(bits_in_shader("uniform float v; //@ 0\n",
                                     "uvec4(floatBitsToUint(v), 0, 0, 0)", {value}, specialise)[0],
                      std::bit_cast<std::uint32_t>(static_cast<float>(value)));
        }
    }
}

TEST_F(Specialised, EveryTypeReachesTheShaderWithAllItsComponents) {
    const auto bits = [](double v) { return std::bit_cast<std::uint32_t>(static_cast<float>(v)); };
    const TweakValue four{0.1, -2.5, 1e-3, 7};
    struct {
        const char* declaration;
        const char* words;
        TweakValue value;
        std::vector<std::uint32_t> expected;
    } const cases[] = {
        {"uniform vec2 v; //@ 0, 0\n",
         "uvec4(floatBitsToUint(v), 0, 0)",
         four,
         {bits(0.1), bits(-2.5), 0, 0}},
        {"uniform vec3 v; //@ 0, 0, 0\n",
         "uvec4(floatBitsToUint(v), 0)",
         four,
         {bits(0.1), bits(-2.5), bits(1e-3), 0}},
        {"uniform vec4 v; //@ 0, 0, 0, 0\n",
         "floatBitsToUint(v)",
         four,
         {bits(0.1), bits(-2.5), bits(1e-3), bits(7)}},
        {"uniform int v; //@ 0\n", "uvec4(v, 0, 0, 0)", {-2147483648.0}, {0x80000000u, 0, 0, 0}},
        {"uniform int v; //@ 0\n", "uvec4(v, 0, 0, 0)", {2147483647.0}, {0x7fffffffu, 0, 0, 0}},
        {"uniform int v; //@ 0\n", "uvec4(v, 0, 0, 0)", {-1.0}, {0xffffffffu, 0, 0, 0}},
        {"uniform int v; //@ 0\n", "uvec4(v, 0, 0, 0)", {16777217.0}, {16777217u, 0, 0, 0}},
        {"uniform bool v; //@ off\n", "uvec4(v, !v, 0, 0)", {1.0}, {1, 0, 0, 0}},
        {"uniform bool v; //@ on\n", "uvec4(v, !v, 0, 0)", {0.0}, {0, 1, 0, 0}},
        {"uniform int v; //@ a {a, b, c}\n", "uvec4(v, 0, 0, 0)", {2.0}, {2, 0, 0, 0}},
    };
    for (const auto& c : cases) {
        for (const bool specialise : {false, true}) {
            SCOPED_TRACE(fmt::format("{} {}", c.declaration, specialise));
            EXPECT_EQ(bits_in_shader(c.declaration, c.words, c.value, specialise), c.expected);
        }
    }
}

TEST_F(Specialised, AConstantStandsWhereItsUniformStood) {
    // Over several lines, with a qualifier, between other declarations of the same line.
    const std::string text =
        "uniform highp float\n  a\n  ; //@ 0.25\n"
        "const float before = 0.5; uniform float b; //@ 2\n"
        "void mainImage(out vec4 c, vec2 p) { c = vec4(a, before, b, float(__LINE__ > 0)); }\n";
    for (const bool specialise : {false, true}) {
        Player player(text, {.specialise = specialise});
        player.draw(0);
        EXPECT_EQ(player.colour(), glm::vec3(0.25, 0.5, 2));
    }
}

TEST_F(Specialised, ATweakMayBoundALoopOrSizeAnArray) {
    const std::string text =
        "uniform int count; //@ 3 [1, 9]\n"
        "float values[count];\n"
        "void mainImage(out vec4 c, vec2 p) { c = vec4(values.length()); }\n";
    Player player(text);
    player.draw(0);
    EXPECT_EQ(player.colour(), glm::vec3(3));
}

// With a constant no driver compiles it, and NVIDIA's with a variable neither; what is read there
// is of no interest.
TEST_F(Specialised, AnIndexOutOfRangeCompiles) {
    Player player(
        "uniform int n; //@ 7 [0, 9]\n"
        "uniform int m; //@ 8 [0, 9]\n"
        "uniform int k; //@ 2 [0, 9]\n"
        "#define AT m\n"
        "float part(vec3 v) { return v[n]; }\n"
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    float a[4] = float[4](0.1, 0.2, 0.3, 0.4);\n"
        "    c = vec4(part(vec3(0.5)) + a[AT + 1], a[k], 0, 1);\n"
        "}\n",
        {.specialise = true});
    player.draw(0);
    EXPECT_FLOAT_EQ(player.colour().y, 0.3f);
}

TEST_F(Specialised, StripsGiveTheSameBytes) {
    for (const char* scene : kScenes) {
        const glm::ivec2 size(70, 81);  // beyond the 32 rows that are drawn first
        Player whole(scene, {.size = size, .format = PixelFormat::rgba8});
        whole.draw_frames(0, 4);
        Player strips(scene, {.size = size, .in_strips = true, .format = PixelFormat::rgba8});
        strips.draw_frames(0, 4);
        EXPECT_EQ(strips.renderer().read_bytes(), whole.renderer().read_bytes());
    }
    Player whole(kScenes[0], {.size = {33, 80}, .samples = 3});
    Player strips(kScenes[0], {.size = {33, 80}, .samples = 3, .in_strips = true});
    whole.draw(0);
    strips.draw(0);
    EXPECT_EQ(whole.floats(), strips.floats()) << "averaged pictures too";
}

}  // namespace
}  // namespace glint::specialise_test
