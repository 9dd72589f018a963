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
    // Instead of the renderer at hand.
    void make_after(Drawn& before) {
        CompiledScene scene = renderer->take_scene();
        renderer.emplace(preset, std::move(scene), RenderOptions{.size = preset.size},
                         &*before.renderer);
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

// Large ones would take longer to make than a frame.
TEST_F(Maps, OfTheOneBeforeAreTakenInsteadOfMadeAnew) {
    Drawn before(folder_, kConstants), after(folder_, kFed, {{"size=8x8", "size=16x8"}});
    before.draw();
    std::vector<GLuint> textures;
    for (std::size_t i = 0; i < kAll.size(); ++i)
        textures.push_back(before.renderer->buffer(i).texture(0));
    after.make_after(before);
    for (std::size_t i = 0; i < kAll.size(); ++i) {
        const bool has_another_size = kAll[i] == "land";
        EXPECT_EQ(after.renderer->buffer(i).texture(0) == textures[i], !has_another_size)
            << kAll[i];
    }
    EXPECT_EQ(after.draw(), kAll);
}

TEST_F(Maps, OfFedProgramsAreMadeAheadWhereConstantsHaveNoUseForThem) {
    const std::vector<std::pair<std::string, std::string>> edits{
        {"tint * texture(clouds, p)", "(tint < 0.5 ? vec4(tint) : texture(clouds, p))"}};
    Drawn before(folder_, kConstants, edits), after(folder_, kFed, edits);
    EXPECT_EQ(before.draw(), (Names{"land", "light", "image"}));
    EXPECT_TRUE(before.renderer->make_ahead(after.renderer->scene()));
    EXPECT_FALSE(before.renderer->make_ahead(after.renderer->scene()));
    const Texture made_later = make_texture_2d(GL_R8, {1, 1});
    after.make_after(before);
    EXPECT_LT(after.renderer->buffer(2).texture(0), made_later.id());
    EXPECT_EQ(after.draw(), kRest);
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

// Every call draws at least one part, so a time that is over at once shows how few.
constexpr double kNoTime = 1e-9;  // s

// A fed scene whose tweak has been moved, drawn with hardly any time for maps.
struct Moved : Drawn {
    explicit Moved(const TestFolder& folder, float height = 0.25f) : Drawn(folder, kFed) {
        draw();
        move(height);
        renderer->set_map_seconds(kNoTime);
    }
    void move(float height) {
        std::vector<TweakValue> values = preset.values;
        values[0][0] = height;
        renderer->set_values(values);
    }
    // How often it has to be drawn until nothing is left.
    int draw_to_the_end() {
        int frames = 0;
        do draw(), ++frames;
        while (renderer->has_maps_left() && frames < 100);
        return frames;
    }
};

TEST_F(Maps, AreDrawnInPartsWhereTimeIsShortAndEndAsIfDrawnAtOnce) {
    Moved scene(folder_);
    Drawn whole(folder_, kFed, {}, 0.25f);
    whole.draw();
    EXPECT_GT(scene.draw_to_the_end(), 8) << "one row of eight and of four at a time";
    EXPECT_EQ(scene.renderer->read_bytes(), whole.renderer->read_bytes());
    for (const std::size_t map : {0u, 1u})
        EXPECT_EQ(scene.renderer->read_buffer(map, 0), whole.renderer->read_buffer(map, 0));
    EXPECT_EQ(scene.draw(2.0), kRest) << "nothing is left";
}

TEST_F(Maps, ThePictureShowsThePartsAsTheyCome) {
    Moved scene(folder_);
    const auto before = scene.renderer->read_bytes();
    scene.draw();
    EXPECT_TRUE(scene.renderer->has_maps_left());
    const auto land = scene.renderer->read_buffer(0, 0);
    EXPECT_FLOAT_EQ(land[0], 0.25f * 0.5f / 8.5f) << "the first row is new";
    EXPECT_FLOAT_EQ(land[4 * 8 * 7], 0.5f * 0.5f / 8.5f) << "the last is not";
    while (scene.renderer->read_bytes() == before && scene.renderer->has_maps_left()) scene.draw();
    EXPECT_TRUE(scene.renderer->has_maps_left()) << "it was seen before all was drawn";
}

TEST_F(Maps, ThatReadOthersHaveTheirTurnWhileATweakMovesOn) {
    Moved scene(folder_);
    const auto light = [&] { return scene.renderer->read_buffer(1, 0); };
    const auto before = light();
    for (int frame = 0; frame < 40; ++frame) {
        scene.draw();
        scene.move(0.25f + 0.005f * static_cast<float>(frame));
    }
    EXPECT_NE(light(), before);
    scene.move(0.75f);
    scene.draw_to_the_end();
    Drawn whole(folder_, kFed, {}, 0.75f);
    whole.draw();
    EXPECT_EQ(light(), whole.renderer->read_buffer(1, 0));
    EXPECT_EQ(scene.renderer->read_bytes(), whole.renderer->read_bytes());
}

TEST_F(Maps, ThatChangedWhileTheyWereDrawnAreDrawnOnceMore) {
    Moved scene(folder_);
    scene.draw();
    scene.move(0.75f);
    scene.renderer->set_map_seconds(60.0);  // for all that is left
    scene.draw();
    EXPECT_FALSE(scene.renderer->has_maps_left());
    Drawn whole(folder_, kFed, {}, 0.75f);
    whole.draw();
    EXPECT_EQ(scene.renderer->read_bytes(), whole.renderer->read_bytes());
}

TEST_F(Maps, OfWhichAPartIsOldAreTakenForNothing) {
    Moved scene(folder_, 0.75f);
    scene.draw();
    ASSERT_TRUE(scene.renderer->has_maps_left());
    EXPECT_TRUE(scene.renderer->is_mixed_map(0));
    Drawn next(folder_, kFed, {}, 0.75f), whole(folder_, kFed, {}, 0.75f);
    EXPECT_EQ(next.draw_after(scene), kAll);
    whole.draw();
    EXPECT_EQ(next.renderer->read_bytes(), whole.renderer->read_bytes());
}

TEST_F(Maps, ThatWereBegunAreDrawnWholeOnceThereIsTime) {
    Moved scene(folder_);
    Drawn whole(folder_, kFed, {}, 0.25f);
    whole.draw();
    scene.draw();
    scene.renderer->set_map_seconds(0.0);
    scene.draw();
    EXPECT_FALSE(scene.renderer->has_maps_left());
    EXPECT_EQ(scene.renderer->read_bytes(), whole.renderer->read_bytes());
}

TEST_F(Maps, ThatTheProgramsBeforeDidNotReadComeInPartsToo) {
    // What constants switch off is there in fed programs, and waits for nobody.
    const std::vector<std::pair<std::string, std::string>> off{
        {"texture(light, p / 8.0)", "(height > 0.4 ? vec4(0.0) : texture(light, p / 8.0))"}};
    Drawn constants(folder_, kConstants, off), fed(folder_, kFed, off), whole(folder_, kFed, off);
    EXPECT_EQ(constants.draw(), kRest);
    fed.renderer->adopt(*constants.renderer);
    fed.renderer->set_map_seconds(kNoTime);
    fed.draw();
    EXPECT_TRUE(fed.renderer->has_maps_left());
    for (int frame = 0; frame < 100 && fed.renderer->has_maps_left(); ++frame) fed.draw();
    whole.draw();
    EXPECT_EQ(fed.renderer->read_buffer(1, 0), whole.renderer->read_buffer(1, 0));
}

// The bed of a pool, which a tweak shapes and a simulation reads.
TEST_F(Maps, ThatASimulationReadsAreWholeWhereItIsPlayedUpToATime) {
    const std::vector<std::pair<std::string, std::string>> pool{
        {"vec4(iTime * 0.125)",
         "texelFetch(clouds, ivec2(0), 0) + texelFetch(land, ivec2(0, 7), 0)"}};
    Drawn scene(folder_, kFed, pool), whole(folder_, kFed, pool, 0.25f);
    scene.draw();
    scene.draw();
    std::vector<TweakValue> values = scene.preset.values;
    values[0][0] = 0.25;
    scene.renderer->set_values(values);
    scene.renderer->set_map_seconds(kNoTime);
    scene.draw();
    EXPECT_TRUE(scene.renderer->is_mixed_map(0));
    scene.renderer->before_pass = nullptr;
    scene.renderer->advance({});
    EXPECT_FALSE(scene.renderer->is_mixed_map(0));
    whole.draw();
    EXPECT_EQ(scene.renderer->read_buffer(0, 0), whole.renderer->read_buffer(0, 0));
}

// Somebody who renames a pass while editing saves many names, of large buffers.
TEST_F(Maps, OfNamesThatTheTextHasLostGo) {
    const auto named = [](const char* name) {
        return std::vector<std::pair<std::string, std::string>>{
            {"sampler2D clouds", "sampler2D " + std::string(name)},
            {"texture(clouds", "texture(" + std::string(name)}};
    };
    Drawn first(folder_, kConstants), second(folder_, kConstants, named("fog")),
        third(folder_, kConstants, named("haze"));
    first.draw();
    const GLuint clouds = first.renderer->buffer(2).texture(0);
    second.draw_after(first);
    third.draw_after(second);
    EXPECT_FALSE(glIsTexture(clouds));
}

TEST_F(Maps, OfAPassThatIsSwitchedOffStay) {
    const std::vector<std::pair<std::string, std::string>> off{
        {"tint * texture(clouds, p)", "vec4(tint)"}};
    Drawn first(folder_, kConstants), second(folder_, kConstants, off),
        third(folder_, kConstants, off), fourth(folder_, kConstants);
    first.draw();
    const GLuint clouds = first.renderer->buffer(2).texture(0);
    second.draw_after(first);
    third.draw_after(second);
    fourth.draw_after(third);
    EXPECT_EQ(fourth.renderer->buffer(2).texture(0), clouds);
}

}  // namespace
}  // namespace glint::maps_test
