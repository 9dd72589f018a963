// The same scene gives the same bytes, and every way to draw it the same picture.
#include "command.h"
#include "media/image.h"

#include <algorithm>

namespace glint::cli::same_picture_test {
namespace {

constexpr std::string_view kScene =
    "uniform float a;   //@ 0.37 [0, 1]\n"
    "uniform int   n;   //@ 12 [1, 64]\n"
    "uniform bool  far; //@ on\n"
    "uniform vec3  tint; //@ #d08040\n"
    "uniform sampler2D grain; //@ noise rgba 64\n"
    "uniform sampler2D trail; //@ pass mainTrail\n"
    "void mainTrail(out vec4 c, in vec2 p) {\n"
    "    c = 0.9 * texelFetch(trail, ivec2(p), 0) + sin(0.01 * p.xyxy * float(iFrame)); }\n"
    "void mainImage(out vec4 c, in vec2 p) {\n"
    "    vec3 s = vec3(0);\n"
    "    for (int i = 0; i < n; ++i) s += sin(a * float(i) + p.xyx * 0.1 + iTime);\n"
    "    if (far) s = s / (1.0 + dot(s, s));\n"
    "    c = vec4(pow(abs(s), vec3(0.4545)) * tint, 1) + 0.1 * texture(grain, p / 64.0) + 0.01 * "
    "texelFetch(trail, ivec2(p), 0);\n"
    "}\n";

class SamePicture : public InAFolder {
protected:
    SamePicture() { write("scene.frag", kScene); }
};

// The share of pixels in which some channel differs by more than 1/255.
double share_that_differs(const Image& a, const Image& b) {
    EXPECT_EQ(a.size, b.size);
    EXPECT_EQ(a.type, ChannelType::u8);
    const auto channels = static_cast<std::size_t>(a.channels);
    std::size_t different = 0;
    for (std::size_t i = 0; i < a.pixels.size(); i += channels) {
        bool same = true;
        for (std::size_t c = 0; c < channels; ++c) {
            same &= std::abs(std::to_integer<int>(a.pixels[i + c]) -
                             std::to_integer<int>(b.pixels[i + c])) <= 1;
        }
        different += same ? 0 : 1;
    }
    return static_cast<double>(different * channels) / static_cast<double>(a.pixels.size());
}

// A silhouette may flip by a rounding.
constexpr double kShare = 0.0005;

TEST_F(SamePicture, RunsThreadsAndCachesGiveTheSameBytes) {
    const std::vector<std::pair<std::string, std::string>> environments[] = {
        {},
        {{"LP_NUM_THREADS", "0"}},
        {{"LP_NUM_THREADS", "1"}},
        {{"LP_NUM_THREADS", "2"}},
        {{"MESA_SHADER_CACHE_DISABLE", "true"}},
        {{"LC_ALL", "de_DE.UTF-8"}, {"TZ", "Asia/Kathmandu"}},
    };
    for (const std::string kind : {".png", ".exr", ".tif", ".jpg"}) {
        const std::string first = "first" + kind, again = "again" + kind;
        still({"scene.frag", "-o", first, "--time", "0.5"});
        for (const auto& environment : environments) {
            // What the driver does is the same whatever the picture becomes.
            const bool of_driver = !environment.empty() && environment[0].first != "LC_ALL";
            if (of_driver && kind != ".png") continue;
            SCOPED_TRACE(kind + " " + (environment.empty() ? "" : environment[0].first));
            Command command = this->command(
                {"still", "scene.frag", "-o", again, "--time", "0.5", "--size", "64x36"});
            command.environment = environment;
            EXPECT_EQ(run(command).code, 0);
            EXPECT_EQ(bytes(first), bytes(again));
        }
    }
}

TEST_F(SamePicture, AveragedPicturesGiveTheSameBytes) {
    for (const std::string threads : {"1", "2"}) {
        Command command = this->command(
            {"still", "scene.frag", "-o", threads + ".png", "--size", "64x36", "--samples", "9"});
        command.environment = {{"LP_NUM_THREADS", threads}};
        EXPECT_EQ(run(command).code, 0);
    }
    EXPECT_EQ(bytes("1.png"), bytes("2.png"));
}

TEST_F(SamePicture, ConstantsAndUniformsAgree) {
    still({"scene.frag", "-o", "a.png", "--size", "160x90"});
    still({"scene.frag", "-o", "b.png", "--size", "160x90", "--no-specialise"});
    EXPECT_LE(share_that_differs(read_image(folder() / "a.png"), read_image(folder() / "b.png")),
              kShare);
}

// By which the picture divides, whatever it makes of them first.
TEST_F(SamePicture, ConstantsOfZeroAndUniformsAgree) {
    write("zero.frag",
          "uniform float softness; //@ 0 [0, 1]\nuniform vec2 size; //@ 0, 1 [0, 2]\n"
          "float part(float x, float of) { float y = x; return y / of; }\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    float d = p.x / iResolution.x - 0.5, w = softness * 0.5, v = w;\n"
          "    c = clamp(vec4(d / (softness * 0.1), d / size.x, d / v, 1), 0.0, 1.0);\n"
          "    c.g *= clamp(part(d, softness), 0.0, 1.0) * step(0.0, d / max(softness, 0.0));\n"
          "}\n");
    still({"zero.frag", "-o", "a.png", "--size", "160x90"});
    still({"zero.frag", "-o", "b.png", "--size", "160x90", "--no-specialise"});
    EXPECT_EQ(bytes("a.png"), bytes("b.png"));
    const Image image = read_image(folder() / "a.png");
    EXPECT_EQ(std::to_integer<int>(image.pixels.front()), 0);
    EXPECT_EQ(std::to_integer<int>(image.pixels[image.pixels.size() - 3]), 255);
}

class Christmas : public InAFolder {
protected:
    static std::vector<fs::path> presets() {
        std::vector<fs::path> list;
        const fs::path folder = fs::path(GLINT_REPOSITORY) / "presets";
        if (!fs::is_directory(folder)) return list;
        for (const auto& entry : fs::directory_iterator(folder)) {
            if (entry.path().filename().string().starts_with("christmas")) {
                list.push_back(entry.path());
            }
        }
        std::sort(list.begin(), list.end());
        return list;
    }

    Image draw(const fs::path& preset, std::vector<std::string> more) const {
        std::vector<std::string> arguments = {preset.string(), "-o", "a.png", "--size", "128x72"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        still(std::move(arguments));
        return read_image(folder() / "a.png");
    }
};

// Fed by uniforms, all presets share one program, which the driver compiles once.
TEST_F(Christmas, ConstantsUniformsAndEveryAccelerationGiveTheSamePicture) {
    if (presets().empty()) GTEST_SKIP() << "there is no presets/christmas*.toml";
    for (const fs::path& preset : presets()) {
        const Image constants = draw(preset, {});
        for (const std::string kind : {"none", "boxes", "hierarchy"}) {
            const Image fed = draw(preset, {"--no-specialise", "--tweak", "acceleration=" + kind});
            EXPECT_LE(share_that_differs(constants, fed), kShare)
                << preset.filename() << " " << kind;
        }
    }
}

}  // namespace
}  // namespace glint::cli::same_picture_test
