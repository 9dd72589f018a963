// Maps that took long to draw stand in the next run.
#include "window/live/kept_maps.h"

#include "../../render/fixture.h"

namespace glint::kept_maps_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScene = R"(
uniform float height; //@ 0.5 [0, 1]
uniform sampler2D land; //@ pass mainLand size=8x8
void mainLand(out vec4 c, in vec2 p) { c = vec4(height * p.x / 8.5); }
void mainImage(out vec4 c, in vec2 p) { c = texture(land, p / 8.0); }
)";

class KeptMap : public GlTest {
protected:
    // A run: how many passes it drew.
    int run(const std::string& word = "", const std::string& by = "",
            const std::string& driver = "any") {
        std::string text = kScene;
        if (!word.empty()) text.replace(text.find(word), word.size(), by);
        const Preset preset = *read_scene_text(folder_, text, {.size = {8, 4}}).preset;
        ProgramShelf shelf;
        CompileResult compiled =
            compile_scene(preset, {.program = {.lean = true}}, nullptr, nullptr, &shelf);
        Renderer renderer(preset, std::move(*compiled.scene), {.size = preset.size});
        KeptMaps maps(folder_.path() / "maps");
        maps.give(preset, renderer, shelf, driver);
        int drawn = 0;
        renderer.before_pass = [&](std::size_t) { ++drawn; };
        renderer.draw({});
        picture_ = renderer.read_bytes();
        if (maps.wants()) maps.keep(renderer);
        return drawn;
    }
    TestFolder folder_;
    std::vector<std::byte> picture_;
};

TEST_F(KeptMap, StandsInTheNextRunOfTheSameTextAndDriver) {
    EXPECT_EQ(run(), 2);
    const auto first = picture_;
    EXPECT_EQ(run(), 1);
    EXPECT_EQ(picture_, first);
    EXPECT_EQ(run("texture(land", "0.5 * texture(land"), 1) << "the picture alone is another";
    EXPECT_EQ(run("8.5", "9.5"), 2);
    EXPECT_EQ(run("//@ 0.5", "//@ 0.25"), 2);
    EXPECT_EQ(run("", "", "another"), 2);
}

TEST_F(KeptMap, AFileThatIsNotWholeIsNone) {
    EXPECT_EQ(run(), 2);
    for (const auto& entry : fs::directory_iterator(folder_.path() / "maps"))
        fs::resize_file(entry.path(), 7);
    EXPECT_EQ(run(), 2);
    EXPECT_EQ(run(), 1) << "it has been written anew";
}

}  // namespace
}  // namespace glint::kept_maps_test
