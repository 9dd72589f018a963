// What is compiled and drawn at all: only what the picture needs, only when something has changed.
#include "fixture.h"
#include "render/compile_ahead.h"
#include "render/programs_ahead.h"

#include <atomic>
#include <chrono>
#include <map>
#include <thread>

namespace glint::runs_test {
namespace {

using namespace std::chrono_literals;

using LeftOut = GlTest;

std::vector<std::string> drawn_passes(const Player& player) {
    std::vector<std::string> names;
    for (const GraphPass& pass : player.renderer().graph().passes)
        names.push_back(pass_name(player.preset.scene, pass.pass));
    return names;
}

using Names = std::vector<std::string>;

enum class Ahead { no, before_drawing, while_drawing };

// With what it tells: of which passes, and how long each took. Nothing on a single processor.
void compile_ahead(Renderer& renderer, Ahead ahead) {
    if (ahead == Ahead::no) return;
    const std::size_t passes = renderer.graph().passes.size();
    std::vector<std::size_t> told;
    const auto tell = [&](std::size_t index) { told.push_back(index); };
    if (ahead == Ahead::while_drawing || !renderer.compile_ahead(tell, 0.0)) {
        renderer.compile_ahead(nullptr, 0.0);
        return;
    }
    const std::vector<double> ms = renderer.finish_compiling();
    EXPECT_EQ(ms.size(), passes);
    for (const double each : ms) EXPECT_GT(each, 0.0);
    EXPECT_FALSE(told.empty());
    for (const std::size_t index : told) EXPECT_LT(index, passes);
}

// Contexts beside ours compile what is drawn here afterwards, and leave no other trace.
TEST_F(LeftOut, WhatIsCompiledAheadLooksTheSame) {
    const std::string text =
        "uniform sampler2D grain;  //@ pass mainGrain size=8x8 filter=mipmap wrap=repeat\n"
        "uniform sampler2D trail;  //@ pass mainTrail\n"
        "uniform sampler2D clock;  //@ pass mainClock size=1x1 step=1/240\n"
        "uniform sampler2D bytes;  //@ noise rgba 64\n"
        "void mainGrain(out vec4 c, vec2 p) { c = vec4(fract(p.x * 0.37 + p.y * 0.61)); }\n"
        "void mainTrail(out vec4 c, vec2 p) {\n"
        "    c = 0.9 * texelFetch(trail, ivec2(p), 0) + texture(bytes, p / 64.0) * iTime; }\n"
        "void mainClock(out vec4 c, vec2 p) { c = texelFetch(clock, ivec2(0), 0) + 1.0; }\n"
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    c = textureLod(grain, p / 5.0, 1.5) + texelFetch(trail, ivec2(p), 0)\n"
        "        + 0.01 * texelFetch(clock, ivec2(0), 0); }\n";
    for (const int samples : {1, 3}) {
        std::vector<std::vector<float>> pictures;
        for (const Ahead ahead : {Ahead::no, Ahead::before_drawing, Ahead::while_drawing}) {
            Player player(text, {.samples = samples});
            compile_ahead(player.renderer(), ahead);
            player.draw_frames(0, 5);
            pictures.push_back(player.floats());
        }
        EXPECT_EQ(pictures[0], pictures[1]) << samples;
        EXPECT_EQ(pictures[0], pictures[2]) << samples;
        EXPECT_GT(pictures[0][0], 0.0f);
    }
}

TEST_F(LeftOut, NothingIsBegunForLaterFramesWhileThePictureIsDrawn) {
    std::atomic<std::size_t> begun = 0;
    std::atomic<bool> may_end = false;
    const auto compile = [&](std::size_t) {
        ++begun;
        while (!may_end) std::this_thread::sleep_for(1ms);
    };
    const std::size_t passes = std::thread::hardware_concurrency() + 2, last = passes - 1;
    CompileAhead ahead(passes, compile, nullptr);
    if (!ahead.is_there()) GTEST_SKIP() << "one processor";
    for (int k = 0; k < 5000 && begun == 0; ++k) std::this_thread::sleep_for(1ms);
    std::this_thread::sleep_for(30ms);  // the other threads
    const std::size_t threads = begun;
    const std::jthread ends([&] {
        std::this_thread::sleep_for(10ms);
        may_end = true;
    });
    ahead.take(last);
    std::this_thread::sleep_for(30ms);
    EXPECT_EQ(begun, threads);
    ahead.take(0);  // of the next frame
    for (int k = 0; k < 5000 && begun + 1 < passes; ++k) std::this_thread::sleep_for(1ms);
    EXPECT_EQ(begun + 1, passes);
}

TEST_F(LeftOut, WhatThePictureDiscardsIsTransparentWhateverWasDrawnBefore) {
    Player player(
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    if (iFrame > 1 && p.x < 1.0) discard;\n"
        "    c = vec4(1); }\n");
    player.draw_frames(0, 4);
    const std::vector<float> picture = player.floats();
    EXPECT_EQ(picture[0], 0.0f);
    EXPECT_EQ(picture[3], 0.0f);
    EXPECT_EQ(picture[4], 1.0f);
}

// As with the two textures that the site has of every buffer.
TEST_F(LeftOut, WhatABufferDiscardsStaysAsItWasTwoFramesAgo) {
    const char* text =
        "uniform sampler2D kept; //@ pass mainKept\n"
        "void mainKept(out vec4 c, vec2 p) { if (iFrame > 0) discard; c = vec4(1); }\n"
        "void mainImage(out vec4 c, vec2 p) { c = texelFetch(kept, ivec2(p), 0); }\n";
    Player player(text);
    for (int frame = 0; frame < 4; ++frame) {
        player.draw(frame);
        EXPECT_EQ(player.colour().r, frame % 2 == 0 ? 1.0f : 0.0f) << frame;
    }
    EXPECT_TRUE(player.renderer().graph().stateful) << "a still has to play up to its frame";
    Player plain(
        "uniform sampler2D kept; //@ pass mainKept\n"
        "void mainKept(out vec4 c, vec2 p) { c = vec4(1); }  // nothing to discard\n"
        "void mainImage(out vec4 c, vec2 p) { c = texelFetch(kept, ivec2(p), 0); discard; }\n");
    EXPECT_FALSE(plain.renderer().graph().stateful);
}

// A text that is worth a thread of its own.
std::string long_text(const std::string& text) {
    return text + "//" + std::string(20'000, '-') + "\n";
}

TEST_F(LeftOut, WhatIsLinkedBesideThePictureIsSaidAndLooksTheSame) {
    const std::string passes =
        "uniform sampler2D a; //@ pass mainA size=8x8\n"
        "uniform sampler2D b; //@ pass mainB size=8x8\n"
        "void mainA(out vec4 c, vec2 p) { c = vec4(p, 0, 1); }\n"
        "void mainB(out vec4 c, vec2 p) { c = 0.5 * texture(a, p / 8.0); }\n";
    const std::string image =
        "void mainImage(out vec4 c, vec2 p) { c = texture(b, p / iResolution.xy); }\n";
    const std::string broken = "float f() { return undeclared; }\n#endif\n";
    const std::string cases[] = {
        passes + image,
        passes +
            "uniform sampler2D d; //@ pass mainD\n"
            "void mainD(out vec4 c, vec2 p) { c = vec4(1); }\n" +
            image,
        // A warning of a pass behind the picture.
        "uniform sampler2D a; //@ pass mainA\n"
        "void mainA(out vec4 c, vec2 p) { c = texture(iChannel0, p) + 0.5; }\n"
        "void mainImage(out vec4 c, vec2 p) { c = texture(a, p / iResolution.xy); }\n",
        // Errors that the picture's pass does not see, in one that it reads, and in one that not.
        passes + "#ifdef PASS_a\n" + broken + image,
        passes + "#ifdef PASS_d\n" + broken + image,
    };
    for (const std::string& text : cases) {
        SCOPED_TRACE(text);
        const TestFolder folder;
        const ReadPreset read = read_scene_text(folder, long_text(text), {});
        ASSERT_TRUE(read.preset) << to_text(read.diagnostics);
        const CompileResult alone = compile_scene(*read.preset, {});
        const CompileResult beside = compile_scene(*read.preset, {.side_by_side = true});
        EXPECT_EQ(to_text(alone.diagnostics), to_text(beside.diagnostics));
        ASSERT_EQ(alone.scene.has_value(), beside.scene.has_value());
        if (!alone.scene) continue;
        EXPECT_EQ(alone.scene->programs.size(), beside.scene->programs.size());
        Player one(long_text(text)), other(long_text(text), {.side_by_side = true});
        one.draw(0);
        other.draw(0);
        EXPECT_EQ(one.floats(), other.floats());
        EXPECT_GT(one.floats().back(), 0.0f);
    }
}

TEST_F(LeftOut, BesideThePictureIsLinkedWhatItReadsAndNothingElse) {
    const std::string declared =
        "uniform sampler2D a; //@ pass mainA\n"
        "uniform sampler2D b; //@ pass mainB\n"
        "uniform sampler2D d; //@ pass mainD\n";
    const auto tab = [](const std::string& pass, const std::string& channel) {
        return "#ifdef PASS_" + pass + "\nuniform sampler2D iChannel0; //@ buffer " + channel +
               "\nvoid mainImage(out vec4 c, vec2 p) { c = texture(iChannel0, p); }\n#endif\n";
    };
    const std::string texts[] = {
        declared +
            "void mainA(out vec4 c, vec2 p) { c = vec4(1); }\n"
            "void mainB(out vec4 c, vec2 p) { c = texture(iChannel2, p); }\n"
            "void mainD(out vec4 c, vec2 p) { c = texture(d, p) + texture(b, p); }\n"
            "void mainImage(out vec4 c, vec2 p) { c = texture(b, p); }\n",
        declared + tab("a", "a") + tab("b", "a") + tab("d", "d") + tab("image", "b")};
    for (const std::string& text : texts) {
        SCOPED_TRACE(text);
        const TestFolder folder;
        const ReadPreset read = read_scene_text(
            folder, text, {.preset = "[channels]\niChannel2 = { buffer = \"a\" }\n"});
        ASSERT_TRUE(read.preset) << to_text(read.diagnostics);
        const ProgramOptions options{.lean = text.find("PASS_") == std::string::npos};
        const GiveUp nothing;
        bool has_a = false, has_b = false;
        for (auto wait = 10ms; wait < 20s && !(has_a && has_b); wait *= 4) {
            ProgramsAhead ahead(*read.preset, options, nothing);
            std::this_thread::sleep_for(wait);
            has_b = ahead.take(1).has_value();
            has_a = ahead.take(0).has_value();
            EXPECT_FALSE(ahead.take(2));
        }
        EXPECT_TRUE(has_a && has_b);
    }
}

TEST_F(LeftOut, APassThatNothingReadsIsNotCompiled) {
    const std::string passes =
        "uniform sampler2D a; //@ pass mainA\n"
        "uniform sampler2D b; //@ pass mainB\n"
        "uniform sampler2D d; //@ pass mainD\n"
        "void mainA(out vec4 c, vec2 p) { c = vec4(1); }\n"
        "void mainB(out vec4 c, vec2 p) { c = texture(a, p); }\n"
        "void mainD(out vec4 c, vec2 p) { c = texture(d, p) + texture(b, p); }\n";
    struct {
        const char* image;
        Names expected;
    } const cases[] = {
        {"c = vec4(0);", {"image"}},
        {"c = texture(a, p);", {"a", "image"}},
        {"c = texture(b, p);", {"a", "b", "image"}},
        {"c = texture(d, p);", {"a", "b", "d", "image"}},
        {"c = texture(b, p); c = vec4(0);", {"image"}},
        {"c = vec4(0); if (false) c = texture(d, p);", {"image"}},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.image);
        const Player player(passes + "void mainImage(out vec4 c, vec2 p) { " + c.image + " }");
        EXPECT_EQ(drawn_passes(player), c.expected);
    }
}

TEST_F(LeftOut, AnErrorInAFunctionThatNothingCallsIsStillAnError) {
    EXPECT_THROW(Player("uniform sampler2D a; //@ pass mainA\n"
                        "void mainA(out vec4 c, vec2 p) { c = undeclared; }\n"
                        "void mainImage(out vec4 c, vec2 p) { c = vec4(1); }"),
                 std::runtime_error);
    // In a tab of its own it is not part of what is compiled.
    Player player(
        "uniform sampler2D a; //@ pass mainA\n"
        "#ifdef PASS_a\nvoid mainImage(out vec4 c, vec2 p) { c = undeclared; }\n#endif\n"
        "#ifdef PASS_image\nvoid mainImage(out vec4 c, vec2 p) { c = vec4(1); }\n#endif\n");
    EXPECT_EQ(drawn_passes(player), Names{"image"});
}

TEST_F(LeftOut, WhatATweakSwitchesOffVanishesWhenSpecialised) {
    const std::string text =
        "uniform bool reflections; //@ off\n"
        "uniform int quality; //@ 0 [0, 2]\n"
        "uniform sampler2D mirror; //@ pass mainMirror\n"
        "uniform sampler2D fine; //@ pass mainFine\n"
        "void mainMirror(out vec4 c, vec2 p) { c = vec4(1); }\n"
        "void mainFine(out vec4 c, vec2 p) { c = vec4(1); }\n"
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    c = vec4(0);\n"
        "    if (reflections) c += texture(mirror, p);\n"
        "    for (int i = 0; i < quality; ++i) c += texture(fine, p);\n"
        "}\n";
    EXPECT_EQ(drawn_passes(Player(text)), Names{"image"});
    EXPECT_EQ(drawn_passes(Player(text, {.specialise = false})),
              (Names{"mirror", "fine", "image"}));
    EXPECT_EQ(drawn_passes(Player(text, {.preset = "[tweaks]\nreflections = true\n"})),
              (Names{"mirror", "image"}));
}

TEST_F(LeftOut, ImagesThatNothingReadsAreNotAskedFor) {
    Player player(
        "uniform bool wooden; //@ off\n"
        "uniform sampler2D wood; //@ image there_is_no_such.png\n"
        "void mainImage(out vec4 c, vec2 p) { c = vec4(1); if (wooden) c = texture(wood, p); }\n");
    EXPECT_TRUE(player.renderer().inputs_needed().empty());
}

TEST_F(LeftOut, OnlyABufferThatReadsItselfIsDouble) {
    Player player(
        "uniform sampler2D a; //@ pass mainA\n"
        "uniform sampler2D b; //@ pass mainB\n"
        "uniform sampler2D d; //@ pass mainD\n"
        "void mainA(out vec4 c, vec2 p) { c = texture(d, p); }\n"
        "void mainB(out vec4 c, vec2 p) { c = texture(b, p) + texture(a, p); }\n"
        "void mainD(out vec4 c, vec2 p) { c = texture(b, p); }\n"
        "void mainImage(out vec4 c, vec2 p) { c = texture(d, p); }\n");
    const auto is_double = [&](const char* name) {
        return player.renderer().buffer(player.graph_index(name)).shape().feedback;
    };
    EXPECT_FALSE(is_double("a"));
    EXPECT_TRUE(is_double("b"));
    EXPECT_FALSE(is_double("d"));
    EXPECT_FALSE(is_double("image"));
}

// How often each pass is drawn, by name.
class Counted {
public:
    explicit Counted(Player& player) : player_(player) {
        player.renderer().after_pass = [this](std::size_t index) {
            ++counts_[pass_name(player_.preset.scene,
                                player_.renderer().graph().passes[index].pass)];
        };
    }
    // What was drawn since the last call.
    std::map<std::string, int> take() { return std::exchange(counts_, {}); }

private:
    Player& player_;
    std::map<std::string, int> counts_;
};

using Counts = std::map<std::string, int>;

TEST_F(LeftOut, APassRunsAgainOnlyWhenSomethingThatItReadsHasChanged) {
    Player player(
        "uniform float size; //@ 1 [0, 9]\n"
        "uniform float other; //@ 1 [0, 9]\n"
        "uniform sampler2D keys; //@ keyboard\n"
        "uniform sampler2D still; //@ pass mainStill\n"
        "uniform sampler2D pointed; //@ pass mainPointed\n"
        "uniform sampler2D tweaked; //@ pass mainTweaked\n"
        "uniform sampler2D typed; //@ pass mainTyped\n"
        "uniform sampler2D both; //@ pass mainBoth\n"
        "void mainStill(out vec4 c, vec2 p) { c = vec4(p / iResolution.xy, 0, 1); }\n"
        "void mainPointed(out vec4 c, vec2 p) { c = iMouse; }\n"
        "void mainTweaked(out vec4 c, vec2 p) { c = vec4(size); }\n"
        "void mainTyped(out vec4 c, vec2 p) { c = texelFetch(keys, ivec2(65, 0), 0); }\n"
        "void mainBoth(out vec4 c, vec2 p) { c = texture(pointed, p) + texture(tweaked, p); }\n"
        "void mainImage(out vec4 c, vec2 p) {\n"
        "    c = texture(still, p) + texture(both, p) + texture(typed, p) + other;\n"
        "}\n",
        {.specialise = false});
    Counted counted(player);
    Frame frame;
    EXPECT_TRUE(player.draw(frame));
    EXPECT_EQ(counted.take(), (Counts{{"still", 1},
                                      {"pointed", 1},
                                      {"tweaked", 1},
                                      {"typed", 1},
                                      {"both", 1},
                                      {"image", 1}}));
    frame.time = 1.0, frame.frame = 60, frame.date.w = 5.0f;
    EXPECT_FALSE(player.draw(frame)) << "nothing here reads time";
    EXPECT_EQ(counted.take(), Counts{});

    frame.input.mouse = {1, 2, 3, 4};
    EXPECT_TRUE(player.draw(frame));
    EXPECT_EQ(counted.take(), (Counts{{"pointed", 1}, {"both", 1}, {"image", 1}}));

    player.preset.values[0][0] = 2.0;
    EXPECT_TRUE(player.draw(frame));
    EXPECT_EQ(counted.take(), (Counts{{"tweaked", 1}, {"both", 1}, {"image", 1}}));

    player.preset.values[1][0] = 2.0;
    EXPECT_TRUE(player.draw(frame));
    EXPECT_EQ(counted.take(), (Counts{{"image", 1}}));

    frame.input.held[65] = 255;
    EXPECT_TRUE(player.draw(frame));
    EXPECT_EQ(counted.take(), (Counts{{"typed", 1}, {"image", 1}}));

    player.renderer().redraw();
    EXPECT_TRUE(player.draw(frame));
    EXPECT_EQ(counted.take(), (Counts{{"image", 1}}));

    player.renderer().resize({8, 8});
    EXPECT_TRUE(player.draw(frame));
    EXPECT_EQ(counted.take().size(), 6u) << "everything has the picture's size";
    EXPECT_FALSE(player.draw(frame));
}

TEST_F(LeftOut, APausedFrameDrawsNothingAndARunningOneOnlyWhatReadsTime) {
    Player player(
        "uniform sampler2D still; //@ pass mainStill\n"
        "uniform sampler2D moving; //@ pass mainMoving\n"
        "void mainStill(out vec4 c, vec2 p) { c = vec4(1); }\n"
        "void mainMoving(out vec4 c, vec2 p) { c = vec4(sin(iTime)) + texture(still, p); }\n"
        "void mainImage(out vec4 c, vec2 p) { c = texture(moving, p); }\n");
    Counted counted(player);
    player.draw_frames(0, 10);
    EXPECT_EQ(counted.take(), (Counts{{"still", 1}, {"moving", 10}, {"image", 10}}));
    const Frame paused = player.frame(9);
    EXPECT_FALSE(player.renderer().draw(paused));
    EXPECT_EQ(counted.take(), Counts{});
    EXPECT_EQ(player.colour().x, 1.0f + static_cast<float>(std::sin(static_cast<float>(9 / 60.0))));
}

TEST_F(LeftOut, AStatelessSceneIsDrawnOnceForAStillAndAStatefulOneIsPlayed) {
    Player stateless("void mainImage(out vec4 c, vec2 p) { c = vec4(iTime, iFrame, 0, 1); }");
    Counted stateless_counts(stateless);
    EXPECT_EQ(stateless.still(2.0), 1);
    EXPECT_EQ(stateless_counts.take(), (Counts{{"image", 1}}));
    EXPECT_EQ(stateless.colour(), glm::vec3(2, 120, 0));

    Player stateful(
        "uniform sampler2D count; //@ pass mainCount\n"
        "uniform sampler2D look; //@ pass mainLook\n"
        "void mainCount(out vec4 c, vec2 p) { c = texelFetch(count, ivec2(p), 0) + vec4(1, iTime, "
        "0, 0); }\n"
        "void mainLook(out vec4 c, vec2 p) { c = texelFetch(count, ivec2(p), 0) * iTime; }\n"
        "void mainImage(out vec4 c, vec2 p) { c = texelFetch(look, ivec2(p), 0); }\n");
    Counted counts(stateful);
    EXPECT_EQ(stateful.still(2.0), 121);
    EXPECT_EQ(counts.take(), (Counts{{"count", 121}, {"look", 1}, {"image", 1}}))
        << "what later frames do not need is drawn once, at the end";
    EXPECT_EQ(stateful.colour().x, 242.0f);
}

TEST_F(LeftOut, ATimeOffTheFrameGridIsReachedExactly) {
    const std::string text =
        "uniform sampler2D last; //@ pass mainLast\n"
        "void mainLast(out vec4 c, vec2 p) {\n"
        "    c = vec4(texelFetch(last, ivec2(0), 0).x + 1.0, iTime, iTimeDelta, iFrame);\n"
        "}\n"
        "void mainImage(out vec4 c, vec2 p) { c = texelFetch(last, ivec2(0), 0); }\n";
    struct {
        double time;
        float frames, delta;
    } const cases[] = {{0.0, 1, 1.0f / 60},
                       {0.1, 7, 1.0f / 60},
                       {0.105, 8, 0.005f},
                       {7.0 / 60, 8, 1.0f / 60},
                       {0.001, 2, 0.001f}};
    for (const auto& c : cases) {
        SCOPED_TRACE(c.time);
        Player player(text, {.pass = "last"});
        player.still(c.time);
        const glm::vec4 last = player.pixel(0, 0);
        EXPECT_EQ(last.x, c.frames);
        EXPECT_EQ(last.y, static_cast<float>(c.time));
        EXPECT_NEAR(last.z, c.delta, 1e-8) << "a difference of two doubles, as a float";
        EXPECT_EQ(last.w, c.frames - 1);
    }
}

TEST_F(LeftOut, SettlingHoldsTimeWhileFramesCountOn) {
    Player player(
        "uniform sampler2D last; //@ pass mainLast\n"
        "void mainLast(out vec4 c, vec2 p) {\n"
        "    vec4 old = texelFetch(last, ivec2(0), 0);\n"
        "    c = vec4(old.x + 1.0, iTime, old.z + float(iMouse.w > 0.0), iFrame);\n"
        "}\n"
        "void mainImage(out vec4 c, vec2 p) { c = texelFetch(last, ivec2(0), 0); }\n",
        {.preset = "[[events]]\nt = 0.1\nmouse = [0.5, 0.5]\ndown = true\n", .pass = "last"});
    EXPECT_EQ(player.still(0.1, 50), 57);
    EXPECT_EQ(player.pixel(0, 0), glm::vec4(57, 0.1f, 1, 56)) << "the click is new only once";
}

}  // namespace
}  // namespace glint::runs_test
