// Programs that are fed with numbers and tweaks, and what an edit leaves of those that are kept.
#include "fixture.h"

#include <cstdlib>
#include <string>
#include <tuple>
#include <vector>

namespace glint::fed_test {
namespace {

constexpr ProgramOptions kConstants{.specialise = true, .lean = true};
constexpr ProgramOptions kFed{.specialise = false, .lean = true, .feed = true};

class Fed : public GlTest {};

std::vector<std::byte> picture(const Preset& preset, const ProgramOptions& options, double time,
                               ProgramShelf* shelf = nullptr) {
    CompileResult compiled = compile_scene(preset, {.program = options}, nullptr, nullptr, shelf);
    if (!compiled.scene) throw std::runtime_error(to_text(compiled.diagnostics));
    Renderer renderer(preset, std::move(*compiled.scene),
                      {.size = preset.size, .picture_format = PixelFormat::rgba8});
    load_inputs(preset, renderer);
    int frames = 0;
    renderer.draw(play(preset, renderer, {.end = time, .fps = 60.0}, 0, frames));
    return renderer.read_bytes();
}

constexpr const char* kScene = R"(
uniform float speed; //@ 1.5 [0, 4]
uniform sampler2D waves; //@ pass mainWaves size=32x32
float unused(float x) { return x * 3.5; }
float wave(float x) { return 0.5 + 0.25 * sin(x * 6.5 + speed); }
void mainWaves(out vec4 c, in vec2 p) { c = vec4(wave(p.x / 32.0)); }
void mainImage(out vec4 c, in vec2 p) {
    c = vec4(texture(waves, p / iResolution.xy).x, 0.75 * wave(p.y / 9.5), 0.3, 1);
}
)";

// The scene with a word of its text exchanged.
Preset preset_of(const TestFolder& folder, const std::string& word = "",
                 const std::string& by = "") {
    std::string text = kScene;
    if (!word.empty()) text.replace(text.find(word), word.size(), by);
    ReadPreset read = read_scene_text(folder, text, {.size = {32, 18}});
    return std::move(*read.preset);
}

TEST_F(Fed, ANumberThatChangesNeedsNoOtherProgramAndIsSeen) {
    const TestFolder folder;
    ProgramShelf shelf;
    const auto first = picture(preset_of(folder), kFed, 0.0, &shelf);
    ASSERT_EQ(shelf.size(), 2u);
    const Preset changed = preset_of(folder, "0.75", "0.25");
    const auto second = picture(changed, kFed, 0.0, &shelf);
    EXPECT_EQ(shelf.size(), 2u);
    EXPECT_GT(compare(first, second, 1).share, 0.5);
    EXPECT_EQ(compare(second, picture(changed, kConstants, 0.0), 1).share, 0.0);
    EXPECT_EQ(compare(first, picture(preset_of(folder), kFed, 0.0, &shelf), 0).share, 0.0)
        << "and back";
}

TEST_F(Fed, APassThatAnEditLeavesAsItWasIsNotCompiledAgain) {
    struct Case {
        const char *word, *by;
        std::size_t compiled;
    };
    for (const Case& c :
         {Case{"x * 3.5", "x * x", 0}, Case{"float unused", "// why\nfloat unused", 0},
          Case{"[0, 4]", "[0, 5]", 0}, Case{"0.3, 1)", "0.4, 1)", 1},
          Case{"6.5 + speed", "7.5 + speed", 2}}) {
        SCOPED_TRACE(c.by);
        const TestFolder folder;
        ProgramShelf shelf;
        picture(preset_of(folder), kConstants, 0.0, &shelf);
        ASSERT_EQ(shelf.size(), 2u);
        picture(preset_of(folder, c.word, c.by), kConstants, 0.0, &shelf);
        EXPECT_EQ(shelf.size(), 2u + c.compiled);
    }
}

TEST_F(Fed, AShelfGivesUpWhatIsNotWanted) {
    const TestFolder folder;
    ProgramShelf shelf;
    const Preset preset = preset_of(folder);
    const CompileResult kept =
        compile_scene(preset, {.program = kConstants}, nullptr, nullptr, &shelf);
    picture(preset, kFed, 0.0, &shelf);
    ASSERT_EQ(shelf.size(), 4u);
    shelf.keep_only(ids_of(*kept.scene));
    EXPECT_EQ(shelf.size(), 2u);
    EXPECT_NE(shelf.find(pass_text(preset, kImagePass, kConstants).text), 0u);
}

// Fed scenes are the plain ones but for roundings, which a compiler that knows the numbers makes
// elsewhere; where they turn a silhouette or a noisy sample over, pixels differ. 3 % of them may,
// by more than 4 of 255.
class FedScenes : public GlTest, public ::testing::WithParamInterface<const char*> {};

TEST_P(FedScenes, LookLikeThePlainOnes) {
    const auto file =
        std::filesystem::path(GLINT_REPOSITORY) / "presets" / (std::string(GetParam()) + ".toml");
    ReadPreset read = read_preset(file);
    ASSERT_TRUE(read.preset) << to_text(read.diagnostics);
    read.preset->size = {64, 36};
    const double time = std::min(read.preset->time, 0.25);  // simulations at their beginning
    const auto plain = picture(*read.preset, {}, time);
    const Differences fed = compare(plain, picture(*read.preset, kFed, time), 4);
    EXPECT_FALSE(fed.is_dark) << "a black picture would prove nothing";
    EXPECT_LT(fed.share, 0.03);
    EXPECT_EQ(compare(plain, picture(*read.preset, kConstants, time), 0).share, 0.0)
        << "what is left out changes nothing";
}

INSTANTIATE_TEST_SUITE_P(Quick, FedScenes, ::testing::Values("christmas", "magic"),
                         [](const auto& scene) { return std::string(scene.param); });
INSTANTIATE_TEST_SUITE_P(Long, FedScenes,
                         ::testing::Values("analytic", "boat", "caustics", "deep_ocean", "sea",
                                           "terrain", "water"),
                         [](const auto& scene) { return std::string(scene.param); });

}  // namespace
}  // namespace glint::fed_test
