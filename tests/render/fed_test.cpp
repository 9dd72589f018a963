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

// To the byte: what is fed here a compiler cannot fold.
TEST_F(Fed, ConstantsExponentsAndWholeNumbersChangeWithoutAnotherProgram) {
    const std::string text = R"(
const float kEdge = 0.37;
const vec3 kTint = vec3(1.0, 0.8, 0.55);
void mainImage(out vec4 c, in vec2 p) {
    vec2 uv = p / vec2(32, 18);
    c = vec4(kTint * pow(uv.x, 1.7) * step(kEdge, uv.y) + uv.y / float(3), 1);
}
)";
    const TestFolder folder;
    ProgramShelf shelf;
    const auto drawn = [&](const std::string& word, const std::string& by) {
        std::string changed = text;
        if (!word.empty()) changed.replace(changed.find(word), word.size(), by);
        const Preset preset = *read_scene_text(folder, changed, {.size = {32, 18}}).preset;
        const auto fed = picture(preset, kFed, 0.0, &shelf);
        EXPECT_EQ(compare(fed, picture(preset, {}, 0.0), 0).share, 0.0) << by;
        EXPECT_EQ(shelf.size(), 1u) << by;
        return fed;
    };
    const auto first = drawn("", "");
    for (const auto& [word, by] :
         {std::pair("0.37", "0.62"), {"0.55", "0.2"}, {"1.7", "3.3"}, {"(3)", "(5)"}})
        EXPECT_GT(compare(first, drawn(word, by), 1).share, 0.1) << by;
}

// A slider that comes to rest, and an edit of a constant, are of no account to other passes.
TEST_F(Fed, APassIsNotCompiledAgainForAConstantThatItDoesNotAskFor) {
    const TestFolder folder;
    ProgramShelf shelf;
    Preset preset = preset_of(folder, "0.3, 1)", "tint, 1)");
    const std::string text =
        "const float kOwn = 0.3;\nuniform float tint; //@ 0.2 [0, 1]\n" + preset.scene.text;
    const auto read = [&](const char* by) {
        std::string changed = text;
        changed.replace(changed.find("0.3;"), 3, by);
        changed.replace(changed.find("0.75 *"), 6, "kOwn *");
        return *read_scene_text(folder, changed, {.size = {32, 18}}).preset;
    };
    preset = read("0.3");
    picture(preset, kConstants, 0.0, &shelf);
    ASSERT_EQ(shelf.size(), 2u);
    preset.values[0][0] = 0.8;  // tint
    picture(preset, kConstants, 0.0, &shelf);
    EXPECT_EQ(shelf.size(), 3u);
    picture(read("0.4"), kConstants, 0.0, &shelf);
    EXPECT_EQ(shelf.size(), 4u);
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
