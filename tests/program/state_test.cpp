// `--save-state` and `--from-state`: a simulation that is cut in two gives the bytes of one run.
#include "media/image.h"
#include "sequence.h"

#include <fmt/format.h>

#include <thread>

namespace glint::cli::state_test {
namespace {

using Json = nlohmann::json;
using namespace std::chrono_literals;

// One buffer of each kind: two outputs with mipmaps, half floats, bytes, fewer channels, a cube, a
// simulation with steps. NaN of many kinds and Inf are in them; where `a` discards, the picture
// before the previous one shows. The picture hashes the bits.
constexpr std::string_view kEveryKind =
    "uniform sampler2D a; //@ pass mainA size=33x17 filter=mipmap\n"
    "uniform sampler2D b; //@ pass mainA size=33x17\n"
    "uniform sampler2D h; //@ pass mainH format=rgba16f size=5x7\n"
    "uniform sampler2D e; //@ pass mainE format=rgba8 scale=0.5\n"
    "uniform sampler2D n; //@ pass mainN format=r8 size=5x3\n"
    "uniform sampler2D o; //@ pass mainO format=rg16f size=3x5\n"
    "uniform sampler2D q; //@ pass mainQ format=r32f size=7x1 filter=mipmap\n"
    "uniform samplerCube sky; //@ pass mainSky size=8\n"
    "uniform sampler2D steps; //@ pass mainSteps size=9x9 step=1/240\n"
    "uniform sampler2D keys; //@ keyboard\n"
    "uniform vec2 held; //@ (0.1, 0.2)\n"
    "uniform float rate; //@ 0.5 [0, 1]\n"
    "uint hash(uvec3 v) {\n"
    "    v = v * 1664525u + 1013904223u;\n"
    "    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y; v ^= v >> 16u;\n"
    "    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y; return v.x ^ v.z;\n"
    "}\n"
    "uint bits(vec4 v) { uvec4 u = floatBitsToUint(v); return hash(u.xyz) ^ u.w; }\n"
    "void mainA(out vec4 to_a, out vec4 to_b, in vec2 p) {\n"
    "    ivec2 i = ivec2(p);\n"
    "    if ((i.x + iFrame) % 3 == 0) discard;\n"
    "    uint old = bits(texelFetch(a, i, 0));\n"
    "    to_a = uintBitsToFloat(uvec4(hash(uvec3(old, i)), old, 0x7fc12345u + old % 99u,\n"
    "                                 0xff800000u));\n"
    "    to_b = texelFetch(b, i, 0) + vec4(1, iMouse.x, texelFetch(keys, ivec2(38, 2), 0).x,\n"
    "                                      iDate.w);\n"
    "}\n"
    "void mainH(out vec4 c, in vec2 p) {\n"
    "    c = texelFetch(h, ivec2(p), 0) + texelFetch(b, ivec2(p), 0) * 0.01;\n"
    "    if (p.x < 1.0) c = vec4(uintBitsToFloat(0x7fc00000u), 1.0 / 0.0, -1.0 / 0.0, 0.0 / 0.0);\n"
    "}\n"
    "void mainE(out vec4 c, in vec2 p) {\n"
    "    c = fract(texelFetch(e, ivec2(p), 0) + vec4(1.0 / 255.0, 3.0 / 255.0, 0.1, iTimeDelta));\n"
    "}\n"
    "void mainN(out vec4 c, in vec2 p) { c = fract(texelFetch(n, ivec2(p), 0) + 0.3); }\n"
    "void mainO(out vec4 c, in vec2 p) { c = texelFetch(o, ivec2(p), 0) + vec4(0.1, 1.0 / p.yxx); "
    "}\n"
    "void mainQ(out vec4 c, in vec2 p) { c = texelFetch(q, ivec2(p), 0) * rate + vec4(p, p); }\n"
    "void mainSky(out vec4 c, in vec2 p, in vec3 ro, in vec3 rd) {\n"
    "    c = texture(sky, rd) * rate + vec4(rd, iTime);\n"
    "}\n"
    "void mainSteps(out vec4 c, in vec2 p) {\n"
    "    c = texelFetch(steps, ivec2(p), 0) + vec4(1, iTime, iMouse.y, iFrame);\n"
    "}\n"
    "void mainImage(out vec4 c, in vec2 p) {\n"
    "    ivec2 i = ivec2(p);\n"
    "    uint all = bits(texelFetch(a, i, 0)) + 3u * bits(texelFetch(b, i, 0)) +\n"
    "        5u * bits(texelFetch(h, i % ivec2(5, 7), 0)) + 7u * bits(texelFetch(e, i / 2, 0)) +\n"
    "        11u * bits(texelFetch(steps, i % 9, 0)) + 13u * bits(textureLod(a, vec2(0.5), 2.0)) "
    "+\n"
    "        19u * bits(texelFetch(n, i % ivec2(5, 3), 0)) + 23u * bits(texelFetch(o, i % ivec2(3, "
    "5), "
    "0)) +\n"
    "        29u * bits(texelFetch(q, i % ivec2(7, 1), 0)) +\n"
    "        17u * bits(texture(sky, vec3(p / iResolution.xy - 0.5, 0.3)));\n"
    "    c = vec4(uvec4(all, all >> 8u, all >> 16u, 255) & 255u) / 255.0;\n"
    "}\n";

// One buffer that counts, for what is no question of kinds: each pass of the scene above costs
// every run some 20 ms.
constexpr std::string_view kOneKind =
    "uniform sampler2D a; //@ pass mainA size=33x17\n"
    "uniform float rate; //@ 0.5 [0, 1]\n"
    "void mainA(out vec4 c, in vec2 p) {\n"
    "    c = texelFetch(a, ivec2(p), 0) + vec4(rate, iMouse.x, p);\n"
    "}\n"
    "void mainImage(out vec4 c, in vec2 p) { c = fract(texelFetch(a, ivec2(p), 0) * 0.013); }\n";

constexpr std::string_view kPreset =
    "scene = \"scene.frag\"\nsize = [32, 16]\ndate = 2026-12-24T23:59:59\n"
    "[[events]]\nt = 0.1\nkey = \"up\"\ndown = true\n"
    "[[events]]\nt = 0.3\nmouse = [0.3, 0.6]\ndown = true\n";

class State : public SequenceTest {
protected:
    State() : SequenceTest({"sequence", "scene.toml"}, "32x16") {
        write("scene.frag", kEveryKind);
        write("scene.toml", kPreset);
    }
    void expect_same_frames(std::string_view one, std::string_view other, int first, int last) {
        for (int k = first; k <= last; ++k) {
            const std::string frame = bytes(fmt::format("{}{}.png", one, k));
            EXPECT_FALSE(frame.empty());
            EXPECT_EQ(frame, bytes(fmt::format("{}{}.png", other, k))) << k;
        }
    }
};

TEST_F(State, TwoHalvesAreTheBytesOfTheWhole) {
    result({"-o", "one%d.png", "--frames", "0:39"});
    EXPECT_NE(bytes("one20.png"), bytes("one21.png"));
    result({"-o", "two%d.png", "--frames", "0:20", "--save-state", "middle.exr"});
    fs::remove(folder() / "two20.png");
    const Json half =
        result({"-o", "two%d.png", "--frames", "20:39", "--from-state", "middle.exr"});
    EXPECT_EQ(half["simulated"], 0) << "the state is the one that frame 20 is drawn from";
    expect_same_frames("one", "two", 0, 39);
}

TEST_F(State, EveryBufferOfAStillHasItsBits) {
    result({"--frames", "0:20", "--save-state", "middle.exr"});
    for (const std::string pass : {"a", "b", "h", "e", "n", "o", "q", "sky", "steps"}) {
        SCOPED_TRACE(pass);
        still({"scene.toml", "--size", "32x16", "--frame", "31", "--pass", pass, "-o", "one.exr"});
        still({"scene.toml", "--size", "32x16", "--frame", "31", "--pass", pass, "-o", "two.exr",
               "--from-state", "middle.exr"});
        EXPECT_EQ(bytes("one.exr"), bytes("two.exr"));
    }
}

TEST_F(State, OtherProgramsCanShowWhatIsInIt) {
    result({"--frames", "0:20", "--save-state", "middle.exr"});
    const Image first = read_image(folder() / "middle.exr");
    EXPECT_EQ(first.size, glm::ivec2(33, 17)) << "buffer a";
    EXPECT_EQ(first.channels, 4);
    EXPECT_EQ(first.type, ChannelType::f32);
}

TEST_F(State, SettlingGoesOnWhereItStood) {
    const std::vector<std::string> words = {"scene.toml", "--size", "32x16", "--time", "0.405"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), words.begin(), words.end());
        still(more);
    };
    with({"--settle", "20", "-o", "one.png"});
    with({"--settle", "9", "-o", "early.png", "--save-state", "settled.exr"});
    with({"--settle", "20", "-o", "two.png", "--from-state", "settled.exr"});
    EXPECT_EQ(bytes("one.png"), bytes("two.png"));
    const Outcome other = glint(
        {"still", "scene.toml", "--frame", "40", "-o", "two.png", "--from-state", "settled.exr"});
    EXPECT_EQ(other.code, 2) << "frame 33 of that run stood still, of this one it moves";
    EXPECT_NE(other.err.find("0.405"), std::string::npos) << other.err;
}

TEST_F(State, AWalkLeavesStatesForOthersAndDrawsNothing) {
    write("scene.frag", kOneKind);
    result({"-o", "one%d.png", "--frames", "0:34"});
    const Json walk =
        result({"--frames", "0:30", "--save-state", "s%04d.exr", "--save-state-every", "10"});
    EXPECT_EQ(walk["states_saved"], 3);
    EXPECT_EQ(walk["frames"], 0);
    for (const std::string share : {"20:29", "30:34", "0:9", "13:19"}) {
        const Json drawn =
            result({"-o", "two%d.png", "--frames", share, "--from-state", "s%04d.exr"});
        EXPECT_EQ(drawn["simulated"], share == "13:19" ? 3 : 0);
    }
    fs::copy_file(folder() / "one12.png", folder() / "two12.png");
    expect_same_frames("one", "two", 13, 34);
}

// What a preset fills a channel with stands in no text of the scene's.
TEST_F(State, AndPicturesOfAnotherChannelAreOfAnotherLook) {
    const auto with = [&](const std::string& channel) {
        write("look.toml", "scene = \"look.frag\"\n[channels]\niChannel0 = { " + channel + " }\n");
    };
    write("look.frag",
          "uniform sampler2D b; //@ pass mainB\n"
          "void mainB(out vec4 c, in vec2 p) { c = fract(texelFetch(b, ivec2(p), 0)\n"
          "    + texture(iChannel0, p / 9.0) + 0.1); }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(b, ivec2(p), 0); }\n");
    const auto run = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"sequence", "look.toml", "--size", "16x9", "-o", "l%d.png"});
        return glint(std::move(more));
    };
    for (const char* other : {"noise = \"r 64\"", "noise = \"rgba 64\", filter = \"nearest\"",
                              "noise = \"rgba 64\", wrap = \"clamp\"", "keyboard = true"}) {
        with("noise = \"rgba 64\"");
        ASSERT_EQ(run({"--frames", "0:2", "--save-state", "l.exr"}).code, 0);
        const std::string before = bytes("l1.png");
        with(other);
        const Outcome state = run({"--frames", "2:2", "--from-state", "l.exr"});
        EXPECT_EQ(state.code, 2) << other << state.err;
        const Json again = report_of(run({"--frames", "0:2", "--resume", "--json"}));
        EXPECT_EQ(again["frames"], 3) << other;
        EXPECT_NE(bytes("l1.png"), before) << other;
    }
}

TEST_F(State, AShareOfNoFrameNeedsNoneAndLeavesNone) {
    result({"-o", "all%d.png", "--frames", "0:20", "--save-state", "half.exr"});
    const std::string half = bytes("half.exr");
    const Json from = result(
        {"-o", "a%d.png", "--frames", "20:22", "--shard", "5/7", "--from-state", "half.exr"});
    EXPECT_EQ(from["frames"], 0);
    result({"-o", "a%d.png", "--frames", "20:22", "--shard", "5/7", "--save-state", "half.exr"});
    EXPECT_EQ(bytes("half.exr"), half);
}

TEST_F(State, OfASceneWithNothingToSimulateIsThereAtOnce) {
    write("scene.frag", "void mainImage(out vec4 c, in vec2 p) { c = vec4(iTime); }\n");
    write("scene.toml", "scene = \"scene.frag\"\n");
    const Json walk = result(
        {"--frames", "1000000:1000020", "--save-state", "w%08d.exr", "--save-state-every", "10"});
    EXPECT_EQ(walk["simulated"], 0);
    EXPECT_LE(walk["states_saved"], 1);
}

TEST_F(State, KilledARunGoesOnFromItsNewestState) {
    result({"-o", "one%02d.png", "--frames", "0:99"});
    const std::vector<std::string> words = {"-o",      "two%02d.png",        "--frames",
                                            "0:99",    "--resume",           "--save-state",
                                            "now.exr", "--save-state-every", "8"};
    auto killed = words;
    killed.insert(killed.begin(), {"sequence", "scene.toml"});
    Process process(command(killed));
    while (process.runs() && !fs::exists(folder() / "two50.png")) std::this_thread::sleep_for(1ms);
    process.signal(SIGKILL);
    process.wait();
    fs::remove(folder() / "two50.png");
    fs::remove(folder() / "two51.png");
    // The state that was saved last may stand behind the gap; then it is of no use.
    const Json resumed = result(words);
    // Pictures overtake each other: each worker may have had an earlier one in hand.
    EXPECT_GE(resumed["skipped"], 50 - static_cast<int>(std::thread::hardware_concurrency()));
    EXPECT_LE(resumed["simulated"], 100);
    for (int k = 0; k < 100; ++k) {
        const std::string frame = fmt::format("{:02}.png", k);
        EXPECT_EQ(bytes("one" + frame), bytes("two" + frame)) << k;
    }
    // With states under names of their own, the newest before the gap is found.
    auto many = words;
    many[6] = "now%d.exr";
    result(many);
    result({"--frames", "0:99", "--save-state", "now%d.exr", "--save-state-every", "8"});
    fs::remove(folder() / "two75.png");
    const Json gap = result(many);
    EXPECT_EQ(gap["frames"], 1);
    EXPECT_EQ(gap["simulated"], 3 + 99 - 76) << "from 72 to the gap, and on to the last state";
    EXPECT_EQ(bytes("one75.png"), bytes("two75.png"));
}

TEST_F(State, WhatBelongsToAnotherRunIsRefusedWithItsName) {
    write("scene.frag", kOneKind);
    result({"--frames", "0:20", "--save-state", "good.exr"});
    const std::pair<std::vector<std::string>, std::string_view> cases[] = {
        {{"--size", "33x16"}, "--size 32x16, and this run has 33x16"},
        {{"--fps", "30"}, "--fps 60, and this run has 30"},
        {{"--tweak", "rate=0.25"}, "tweaks rate=0.5, and this run has rate=0.25"},
        {{"--no-specialise"}, "specialisation on, and this run has off"},
        {{"--frames", "10:30"}, "stands before frame 20, and frame 10 is asked for"},
    };
    for (const auto& [options, text] : cases) {
        std::vector<std::string> words = {"-o", "out%d.png", "--from-state", "good.exr"};
        words.insert(words.end(), options.begin(), options.end());
        if (options[0] != "--frames") words.insert(words.end(), {"--frames", "20:30"});
        const Outcome outcome = sequence(words);
        EXPECT_EQ(outcome.code, 2) << outcome.err;
        EXPECT_TRUE(outcome.err.starts_with("good.exr: error: ")) << outcome.err;
        EXPECT_NE(outcome.err.find(text), std::string::npos) << outcome.err;
    }
    const std::vector<std::string> words = {"-o",    "out%d.png",    "--frames",
                                            "20:21", "--from-state", "good.exr"};
    write("scene.frag", std::string(kOneKind) + "// changed\n");
    EXPECT_NE(sequence(words).err.find("scene text"), std::string::npos);
    write("scene.frag", kOneKind);
    write("scene.toml", std::string(kPreset) + "[[events]]\nt = 0.2\nkey = \"a\"\ndown = true\n");
    EXPECT_NE(sequence(words).err.find("events"), std::string::npos);
    EXPECT_FALSE(fs::exists(folder() / "out20.png"));
}

TEST_F(State, WhatIsNoWholeStateIsRefused) {
    write("scene.frag", kOneKind);
    result({"--frames", "0:20", "--save-state", "good.exr"});
    const std::string good = bytes("good.exr");
    const auto refused = [&](const std::string& content) {
        write("bad.exr", content);
        const Outcome outcome =
            sequence({"-o", "out%d.png", "--frames", "20:21", "--from-state", "bad.exr"});
        EXPECT_EQ(outcome.code, 4) << outcome.err;
        EXPECT_TRUE(outcome.err.starts_with("bad.exr: error: ")) << outcome.err;
    };
    for (const std::size_t length : {0, 5, 13, 14, 40, 1000, 5000}) refused(good.substr(0, length));
    refused(good.substr(0, good.size() - 1));
    const std::size_t number = good.find("\"frame\":20") + 9;
    for (const std::size_t at : {number, good.size() / 2, good.size() - 3}) {
        std::string flipped = good;
        flipped[at] ^= 1;
        refused(flipped);
    }
    refused("scene = \"scene.frag\"\n");
    EXPECT_EQ(sequence({"-o", "out%d.png", "--frames", "20:21", "--from-state", "absent"}).code, 4);
    EXPECT_EQ(sequence({"-o", "out%d.png", "--frames", "20:21", "--from-state", "."}).code, 4);
    EXPECT_FALSE(fs::exists(folder() / "out20.png"));
}

TEST_F(State, OfManyOnlyWholeOnesAreTaken) {
    write("scene.frag", kOneKind);
    result({"-o", "one%d.png", "--frames", "0:25"});
    result({"--frames", "0:20", "--save-state", "s%d", "--save-state-every", "10"});
    write("s20", bytes("s20").substr(0, 3000));
    write("s15x", "foreign");
    const Outcome outcome =
        sequence({"-o", "two%d.png", "--frames", "20:25", "--from-state", "s%d"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_TRUE(outcome.err.starts_with("s20: warning: It is cut short or damaged")) << outcome.err;
    expect_same_frames("one", "two", 20, 25);
}

TEST_F(State, ADiskThatFillsUpKeepsTheOldStateAndThePicturesBefore) {
    result({"--frames", "0:8", "--save-state", "now.exr"});
    const std::string before = bytes("now.exr");
    Command full = command({"sequence", "scene.toml", "-o", "out%d.png", "--frames", "0:20",
                            "--save-state", "now.exr", "--save-state-every", "10"});
    full.largest_file = 20'000;
    const Outcome outcome = run(full);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(outcome.err.starts_with("error: Cannot write now.exr: ")) << outcome.err;
    EXPECT_EQ(bytes("now.exr"), before);
    for (int k = 0; k < 10; ++k) EXPECT_TRUE(fs::exists(folder() / fmt::format("out{}.png", k)));
    EXPECT_EQ(names().size(), 3u + 10) << "nothing else lies about";
    EXPECT_EQ(sequence({"--frames", "0:8", "--save-state", "nowhere/now.exr"}).code, 1);
}

}  // namespace
}  // namespace glint::cli::state_test
