// Buffers that follow from the text and the tweaks alone stand in the renderer that takes over.
#include "fixture.h"

namespace glint::maps_test {
namespace {

constexpr ProgramOptions kConstants{.specialise = true, .lean = true};
constexpr ProgramOptions kFed{.specialise = false, .lean = true, .feed = true};
using Names = std::vector<std::string>;

constexpr const char* kScene = R"(
uniform float height; //@ 0.5 [0, 1]
uniform float tint; //@ 0.25 [0, 1]
uniform sampler2D land; //@ pass mainLand size=8x8 filter=nearest
uniform sampler2D light; //@ pass mainLight size=4x4
uniform sampler2D clouds; //@ pass mainClouds size=4x4
void mainLand(out vec4 c, in vec2 p) { c = vec4(height * p.x / 8.5); }
void mainLight(out vec4 c, in vec2 p) { c = 0.75 * texture(land, p / iResolution.xy); }
void mainClouds(out vec4 c, in vec2 p) { c = vec4(iTime * 0.125); }
void mainImage(out vec4 c, in vec2 p) {
    c = texture(light, p / 8.0) + tint * texture(clouds, p) + 0.0625;
}
)";

// A scene that is drawn, and which of its passes.
struct Drawn {
    Drawn(const TestFolder& folder, const ProgramOptions& options,
          std::vector<std::pair<std::string, std::string>> edits = {}, float height = 0.5f) {
        std::string text = kScene;
        for (const auto& [word, by] : edits) text.replace(text.find(word), word.size(), by);
        preset = *read_scene_text(folder, text, {.size = {8, 4}}).preset;
        preset.values[0][0] = height;
        CompileResult compiled = compile_scene(preset, {.program = options});
        if (!compiled.scene) throw std::runtime_error(to_text(compiled.diagnostics));
        renderer.emplace(preset, std::move(*compiled.scene), RenderOptions{.size = preset.size});
    }
    Names draw(double time = 1.0) {
        Names names;
        renderer->before_pass = [&](std::size_t index) {
            names.push_back(pass_name(preset.scene, renderer->graph().passes[index].pass));
        };
        Frame frame;
        frame.time = time;
        renderer->draw(frame);
        return names;
    }
    Names draw_after(Drawn& before) {
        renderer->adopt(*before.renderer);
        return draw();
    }
    Preset preset;
    std::optional<Renderer> renderer;
};

class Maps : public GlTest {
protected:
    TestFolder folder_;
};

const Names kAll{"land", "light", "clouds", "image"}, kRest{"clouds", "image"};

TEST_F(Maps, StandInAnotherRendererWhoseTextSaysTheSameOfThem) {
    using Edits = std::vector<std::pair<std::string, std::string>>;
    struct {
        const char* what;
        Edits edits;
        Names drawn;
    } const cases[] = {
        {"the same text", {}, kRest},
        {"a number of the picture", {{"0.0625", "0.125"}}, kRest},
        {"a number of a map", {{"8.5", "9.5"}}, kAll},
        {"a number of a map that reads another", {{"0.75", "0.5"}}, {"light", "clouds", "image"}},
        {"how a map is read", {{"filter=nearest", "filter=linear"}}, {"light", "clouds", "image"}},
        {"its size", {{"size=8x8", "size=16x8"}}, kAll},
    };
    for (const auto& c : cases) {
        for (const ProgramOptions& options : {kConstants, kFed}) {
            SCOPED_TRACE(std::string(c.what) + (options.feed ? ", fed" : ", as constants"));
            Drawn before(folder_, kConstants), anew(folder_, options, c.edits),
                alone(folder_, options, c.edits);
            before.draw();
            EXPECT_EQ(anew.draw_after(before), c.drawn);
            alone.draw();
            EXPECT_EQ(anew.renderer->read_bytes(), alone.renderer->read_bytes());
        }
    }
}

TEST_F(Maps, AreDrawnForTweaksThatTheyReadAlone) {
    Drawn constants(folder_, kConstants), fed(folder_, kFed);
    constants.draw();
    fed.renderer->adopt(*constants.renderer);
    std::vector<TweakValue> values = fed.preset.values;
    values[1][0] = 0.75;  // the picture's
    fed.renderer->set_values(values);
    EXPECT_EQ(fed.draw(), kRest);
    values[0][0] = 0.25;  // a map's
    fed.renderer->set_values(values);
    EXPECT_EQ(fed.draw(2.0), kAll);
}

TEST_F(Maps, OfOneThatHasDrawnNothingAreDrawn) {
    Drawn before(folder_, kConstants), after(folder_, kConstants);
    EXPECT_EQ(after.draw_after(before), kAll);
}

TEST_F(Maps, OfFedProgramsAreDrawnAnewByConstants) {
    Drawn fed(folder_, kFed), constants(folder_, kConstants);
    fed.draw();
    EXPECT_EQ(constants.draw_after(fed), kAll);
}

TEST_F(Maps, OfConstantsOutliveFedOnesThatLeaveThemAlone) {
    Drawn constants(folder_, kConstants), fed(folder_, kFed), again(folder_, kConstants);
    constants.draw();
    EXPECT_EQ(fed.draw_after(constants), kRest);
    EXPECT_EQ(again.draw_after(fed), kRest);
}

TEST_F(Maps, AreNotTakenForOtherValues) {
    Drawn before(folder_, kConstants), other(folder_, kConstants, {}, 0.75f),
        fed(folder_, kFed, {}, 0.75f);
    before.draw();
    EXPECT_EQ(other.draw_after(before), kAll);
    Drawn first(folder_, kConstants);
    first.draw();
    EXPECT_EQ(fed.draw_after(first), kAll);
}

TEST_F(Maps, StandAfterAJumpOfTime) {
    Drawn scene(folder_, kConstants);
    EXPECT_EQ(scene.draw(), kAll);
    const auto before = scene.renderer->read_bytes();
    scene.renderer->reset();
    EXPECT_EQ(scene.draw(), kRest);
    EXPECT_EQ(scene.renderer->read_bytes(), before);
}

TEST_F(Maps, AreTakenBackFromBytesOfAnEarlierRun) {
    Drawn first(folder_, kConstants), second(folder_, kConstants);
    EXPECT_FALSE(first.renderer->map_bytes()) << "before it has drawn";
    first.draw();
    const auto kept = first.renderer->map_bytes();
    ASSERT_TRUE(kept);
    ASSERT_TRUE(second.renderer->set_map_bytes(*kept));
    EXPECT_EQ(second.draw(), kRest);
    EXPECT_EQ(second.renderer->read_bytes(), first.renderer->read_bytes());
    EXPECT_FALSE(second.renderer->set_map_bytes(std::span(*kept).first(5)));
    Drawn fed(folder_, kFed);
    fed.draw();
    EXPECT_FALSE(fed.renderer->map_bytes()) << "their last digits may be others";
}

}  // namespace
}  // namespace glint::maps_test
