// `glint import`: shaders of the site become scene files that draw the same.
#include "command.h"
#include "media/image.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace glint::cli::import_test {
namespace {

using Json = nlohmann::json;

Json input(int channel, const Json& id, const std::string& kind, const std::string& filter) {
    return {{"channel", channel},
            {"id", id},
            {"ctype", kind},
            {"src", ""},
            {"sampler", {{"filter", filter}, {"wrap", "clamp"}, {"vflip", "true"}}}};
}

Json pass(const std::string& kind, const std::string& name, const Json& output,
          const std::string& code, const Json& inputs = Json::array()) {
    return {{"type", kind},
            {"name", name},
            {"code", code},
            {"inputs", inputs},
            {"outputs", Json::array({{{"id", output}, {"channel", 0}}})}};
}

// Buffer A counts frames in red; Buffer B, which stands before it in the file, halves what A was in
// the last frame; each calls another buffer iChannel0. Red is B's, green what Common says, blue the
// width of iChannel1 over 256.
Json chain(const Json& a, const Json& b, const Json& image) {
    return Json::array(
        {pass("image", "Image", image,
              "void mainImage(out vec4 c, in vec2 p) { c = vec4(texelFetch(iChannel0, ivec2(0), 0)"
              ".r / 16.0, shared_green(), iChannelResolution[1].x / 256.0, 1); }",
              Json::array({input(0, b, "buffer", "nearest"), input(1, a, "buffer", "linear")})),
         pass("buffer", "Strange name", b,
              "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel0, ivec2(0), 0) / "
              "2.0; }\r\n",
              Json::array({input(0, a, "buffer", "nearest")})),
         pass("buffer", "Another", a,
              "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(iChannel3, ivec2(p), 0) + "
              "vec4(1); }",
              Json::array({input(3, a, "buffer", "nearest")})),
         pass("common", "Common", "", "float shared_green() { return 0.4; }")});
}

class Import : public InAFolder {
protected:
    std::array<int, 3> draw(const std::string& file, int frame) {
        const Outcome drawn = glint(
            {"still", file, "-o", "out.png", "--size", "64x36", "--frame", std::to_string(frame)});
        EXPECT_EQ(drawn.code, 0) << drawn.err;
        const Image image = read_image(folder() / "out.png");
        const auto at = [&](std::size_t i) { return std::to_integer<int>(image.pixels[i]); };
        return {at(0), at(1), at(2)};
    }
};

TEST_F(Import, AFunctionMayBearTheNameOfABufferOrOfItsPass) {
    Json passes = chain(257, 258, 37);
    passes[3]["code"] =
        "float bufferA() { return 0.4; }\n"
        "float shared_green() { return bufferA(); }\n"
        "void mainBufferB(out vec4 c, in vec2 p) { c = vec4(0.9); }";
    write("a.json", Json{{"info", Json::object()}, {"renderpass", passes}}.dump());
    ASSERT_EQ(glint({"import", "a.json", "-o", "a.frag"}).code, 0);
    EXPECT_EQ(draw("a.frag", 7), (std::array{56, 102, 64}));
}

TEST_F(Import, BothDialectsDrawTheSame) {
    write("api.json", Json{{"Shader",
                            {{"ver", "0.1"},
                             {"info",
                              {{"name", "A \\ chain\n"},
                               {"id", "XxXxXx"},
                               {"username", "somebody"},
                               {"description", "first\\\nsecond */"}}},
                             {"renderpass", chain(257, 258, 37)}}}}
                          .dump());
    Json download = {{"info", Json::object()}, {"renderpass", chain("4dXGR8", "XsXGR8", "4dfGRr")}};
    write("download.json", Json{{"shaders", Json::array({download})}}.dump());
    for (const std::string name : {"api", "download"}) {
        const Outcome made = glint({"import", name + ".json", "-o", name + ".frag"});
        ASSERT_EQ(made.code, 0) << made.err;
        EXPECT_EQ(made.out, name + ".frag\n");
        EXPECT_EQ(made.err, "");
        // Frame 7 is the eighth: A was 7 and B is 3.5.
        EXPECT_EQ(draw(name + ".frag", 7), (std::array{56, 102, 64})) << bytes(name + ".frag");
    }
    EXPECT_TRUE(bytes("api.frag")
                    .starts_with("// A   chain, by somebody\n"
                                 "// https://www.shadertoy.com/view/XxXxXx\n"
                                 "// first\n// second */\n"))
        << bytes("api.frag");
}

TEST_F(Import, AShaderOfOneTabStaysAsItIs) {
    const std::string code = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n";
    write("one.json",
          Json::array({{{"renderpass", Json::array({pass("image", "Image", 37, code)})}}}).dump());
    ASSERT_EQ(glint({"import", "one.json", "-o", "one.frag"}).code, 0);
    EXPECT_EQ(bytes("one.frag"), "\n" + code);
}

TEST_F(Import, WhatTheSiteDoesNotShipIsNamedAndNoiseOfItsSizeStandsInItsPlace) {
    Json inputs = Json::array({input(0, 30, "texture", "mipmap"), input(1, 31, "cubemap", "mipmap"),
                               input(2, 32, "volume", "linear"), input(3, 33, "music", "linear")});
    inputs[0]["src"] =
        "/media/a/f735bee5b64ef98879dc618b016ecf7939a5756040c2cde21ccb15e69a6e1cfb.png";
    const Json shader = {
        {"renderpass",
         Json::array(
             {pass("image", "Image", 37,
                   "void mainImage(out vec4 c, in vec2 p) {\n"
                   "    vec4 x = texture(iChannel1, vec3(1)) + texture(iChannel2, vec3(0.3))"
                   " + texture(iChannel3, vec2(0.1));\n"
                   "    c = vec4(iChannelResolution[0].x / 512.0, dot(x, x) > 0.0, "
                   "iChannelResolution[2].z / 64.0, 1);\n}\n",
                   inputs)})}};
    write("media.json", shader.dump());
    const Outcome made = glint({"import", "media.json", "-o", "media.frag"});
    ASSERT_EQ(made.code, 0);
    EXPECT_NE(made.err.find("media.json: warning: image, iChannel0: 'RGBA Noise Medium' is not in "
                            "this file; noise rgba 256 stands in its place"),
              std::string::npos)
        << made.err;
    EXPECT_NE(made.err.find("iChannel3: 'music'"), std::string::npos) << made.err;
    EXPECT_EQ(draw("media.frag", 0), (std::array{128, 255, 128}));
}

// A text of one tab with one input.
Json one_input(const std::string& code, const Json& read) {
    return {{"renderpass", Json::array({pass("image", "Image", 37, code, Json::array({read}))})}};
}

TEST_F(Import, TheSitesCubesAreKnownByTheirFiles) {
    const std::pair<const char*, const char*> cubes[] = {
        {"585f9546c092f53d", "'Uffizi Gallery' is not in this file; noise rgb 512 "},
        {"793a105653fbdada", "'Uffizi Gallery Blurred' is not in this file; noise rgb 64 "},
        {"488bd40303a2e2b9", "'St. Peter's Basilica' is not in this file; noise rgb 256 "},
        {"550a8cce1bf40386", "'St. Peter's Blurred' is not in this file; noise rgb 64 "}};
    for (const auto& [hash, said] : cubes) {
        Json cube = input(0, 30, "cubemap", "mipmap");
        cube["src"] =
            fmt::format("/media/a/{}2b343144396c0b2d70d9965f585ebc172080d8aa58.jpg", hash);
        write("cube.json", one_input("void mainImage(out vec4 c, in vec2 p) {}\n", cube).dump());
        const Outcome made = glint({"import", "cube.json", "-o", fmt::format("{}.frag", hash)});
        EXPECT_EQ(made.code, 0);
        EXPECT_NE(made.err.find(said), std::string::npos) << made.err;
    }
}

TEST_F(Import, ACameraAndAMicrophoneAreSaidInWordsWithWhatStandsInTheirPlace) {
    const std::pair<const char*, const char*> kinds[] = {
        {"webcam",
         "warning: image, iChannel0: no camera is read here; noise rgb 640x360 stands in its "
         "place; a picture of yours does with //@ image FILE\n"},
        {"mic",
         "warning: image, iChannel0: no microphone is read here; noise r 512x2 stands in its "
         "place; a sound of yours does with //@ sound FILE\n"}};
    for (const auto& [kind, said] : kinds) {
        write("live.json",
              one_input("void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p); }\n",
                        input(0, 30, kind, "linear"))
                  .dump());
        const Outcome made = glint({"import", "live.json", "-o", fmt::format("{}.frag", kind)});
        EXPECT_EQ(made.code, 0);
        EXPECT_NE(made.err.find(said), std::string::npos) << made.err;
    }
}

TEST_F(Import, MissingMusicPlaysWithTheTimeThereAndBack) {
    Json music = input(0, 30, "music", "linear");
    music["src"] = "https://soundcloud.com/somebody/something";
    music.erase("sampler");
    write("song.json", one_input("void mainImage(out vec4 c, in vec2 p) {\n"
                                 "    c = vec4(iChannelTime[0], texture(iChannel0, vec2(0)).r, 0, "
                                 "1);\n}\n",
                                 music)
                           .dump());
    ASSERT_EQ(glint({"import", "song.json", "-o", "song.frag"}).code, 0);
    EXPECT_EQ(draw("song.frag", 30)[0], 128);
    // The site reads a sound linearly and at its edges, and so is what stands in its place.
    EXPECT_NE(bytes("song.frag").find("//@ noise r 512x2 plays=on filter=linear wrap=clamp"),
              std::string::npos)
        << bytes("song.frag");
    const Outcome out = glint({"export", "song.frag", "-o", "tabs"});
    ASSERT_EQ(out.code, 0) << out.err;
    const Outcome back = glint({"import", "tabs/shadertoy.json", "-o", "back.frag"});
    ASSERT_EQ(back.code, 0) << back.err;
    EXPECT_EQ(draw("back.frag", 30), draw("song.frag", 30)) << bytes("back.frag");
}

TEST_F(Import, ATabThatIsThereTwiceIsTakenOnceWithAWarning) {
    const Json red = pass("image", "Image", 37,
                          "void mainImage(out vec4 c, in vec2 p) { c = vec4(RED, 0, 0, 1); }\n");
    const Json common = pass("common", "Common", "", "const float RED = 0.2;\n");
    write("twice.json", Json{{"renderpass", Json::array({common, red, common})}}.dump());
    const Outcome made = glint({"import", "twice.json", "-o", "twice.frag"});
    EXPECT_EQ(made.code, 0);
    EXPECT_EQ(
        made.err,
        "twice.json: warning: the tab 'common' is there twice, word for word; one is taken\n");
    EXPECT_EQ(draw("twice.frag", 0), (std::array{51, 0, 0}));

    fs::create_directories(folder() / "tabs");
    write("tabs/image.glsl", red["code"].get<std::string>());
    write("tabs/Common.glsl", common["code"].get<std::string>());
    write("tabs/common.txt", common["code"].get<std::string>());
    const Outcome folder_made = glint({"import", "tabs", "-o", "folder.frag"});
    EXPECT_EQ(folder_made.code, 0) << folder_made.err;
    EXPECT_EQ(draw("folder.frag", 0), (std::array{51, 0, 0}));
    write("tabs/common.txt", "const float RED = 0.4;\n");
    const Outcome differs = glint({"import", "tabs", "-o", "differs.frag"});
    EXPECT_EQ(differs.code, 4);
    EXPECT_NE(differs.err.find("two tabs are 'common' and differ"), std::string::npos)
        << differs.err;
}

// As there, where every shader has all buffers.
TEST_F(Import, ABufferWithoutATabIsBlack) {
    Json inputs = Json::array({input(0, 258, "buffer", "linear")});
    const Json image = pass("image", "Image", 37,
                            "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p) + "
                            "vec4(0.2, 0.4, 0.6, 1); }",
                            inputs);
    write("one.json", Json{{"renderpass", Json::array({image})}}.dump());
    const Outcome outcome = glint({"import", "one.json", "-o", "one.frag"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("warning: image, iChannel0: 'bufferB' is not in this file; it is "
                               "black"),
              std::string::npos)
        << outcome.err;
    EXPECT_EQ(draw("one.frag", 0), (std::array{51, 102, 153}));
}

TEST_F(Import, WithoutAnImageThereIsNothingToDraw) {
    const Json buffer =
        pass("buffer", "Buffer A", 257, "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }",
             Json::array());
    write("one.json", Json{{"renderpass", Json::array({buffer})}}.dump());
    const Outcome outcome = glint({"import", "one.json", "-o", "one.frag"});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_NE(outcome.err.find("there is no image tab in it"), std::string::npos) << outcome.err;
    EXPECT_FALSE(fs::exists(folder() / "one.frag"));
}

TEST_F(Import, AnImageBesideTheFileIsUsed) {
    write("flat.frag", "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.2, 0.4, 0.6, 1); }\n");
    fs::create_directories(folder() / "media/a");
    ASSERT_EQ(glint({"still", "flat.frag", "-o", "media/a/wood.png", "--size", "8x8"}).code, 0);
    Json inputs = Json::array({input(0, 30, "texture", "nearest")});
    inputs[0]["src"] = "/media/a/wood.png";
    write("local.json",
          Json{{"renderpass",
                Json::array({pass("image", "Image", 37,
                                  "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, "
                                  "p); }\n",
                                  inputs)})}}
              .dump());
    const Outcome made = glint({"import", "local.json", "-o", "local.frag"});
    ASSERT_EQ(made.code, 0);
    EXPECT_EQ(made.err, "");
    EXPECT_EQ(draw("local.frag", 0), (std::array{51, 102, 153}));
}

TEST_F(Import, CubesVolumesAndMusicBesideTheFileAreUsed) {
    write("flat.frag",
          "uniform float red; //@ 0 [0, 1]\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(red, 0.4, 0.6, 1); }\n"
          "vec2 mainSound(int samp, float time) { return vec2(sin(6.2831853 * 441.0 * time)); }\n");
    for (int i = 0; i < 6; ++i) {
        const std::string name = i == 0 ? "sky.png" : fmt::format("sky_{}.png", i);
        ASSERT_EQ(glint({"still", "flat.frag", "-o", name, "--size", "4x4", "--tweak",
                         fmt::format("red={}", 0.2 * i)})
                      .code,
                  0);
    }
    ASSERT_EQ(glint({"sound", "flat.frag", "-o", "tune.ogg", "--seconds", "1"}).code, 0);
    write("grey.bin", std::string("BIN\0\1\0\0\0\1\0\0\0\1\0\0\0\1\0\0\0\x66", 21));
    Json inputs = Json::array({input(0, 30, "cubemap", "linear"), input(1, 31, "volume", "linear"),
                               input(2, 32, "music", "linear")});
    inputs[0]["src"] = "/media/a/sky.png";
    inputs[0]["sampler"]["vflip"] = "false";
    inputs[1]["src"] = "/media/a/grey.bin";
    inputs[2]["src"] = "/media/a/tune.ogg";
    write("local.json",
          Json{{"renderpass",
                Json::array({pass("image", "Image", 37,
                                  "void mainImage(out vec4 c, in vec2 p) {\n"
                                  "    c = vec4(texture(iChannel0, vec3(0, 0, -1)).r,\n"
                                  "             texture(iChannel1, vec3(0.5)).r,\n"
                                  "             texelFetch(iChannel2, ivec2(0, 1), 0).r, 1);\n}\n",
                                  inputs)})}}
              .dump());
    const Outcome made = glint({"import", "local.json", "-o", "local.frag"});
    ASSERT_EQ(made.code, 0);
    EXPECT_EQ(made.err, "");
    EXPECT_EQ(draw("local.frag", 0), (std::array{255, 102, 128})) << bytes("local.frag");
}

TEST_F(Import, SeveralShadersBecomeSeveralFilesAndNothingIsOverwritten) {
    const auto red = [](const char* r) {
        const std::string code = "void mainImage(out vec4 c, in vec2 p) { c.rgb = vec3(";
        return Json{{"renderpass", {pass("image", "Image", 37, code + r + ", 0, 0); }\n")}}};
    };
    write("two.json", Json::array({red("0.2"), red("0.4")}).dump());
    ASSERT_EQ(glint({"import", "two.json", "-o", "two.frag"}).out, "two.frag\ntwo-2.frag\n");
    EXPECT_EQ(draw("two.frag", 0)[0], 51);
    EXPECT_EQ(draw("two-2.frag", 0)[0], 102);
    write("two.frag", "// mine\n");
    const Outcome again = glint({"import", "two.json", "-o", "two.frag"});
    EXPECT_EQ(again.code, 1);
    EXPECT_NE(again.err.find("it is there already"), std::string::npos) << again.err;
    EXPECT_EQ(bytes("two.frag"), "// mine\n");
    write("bad.json", Json::array({red("0.2"), Json{{"info", {{"name", "Fog"}}}}}).dump());
    const std::string said = glint({"import", "bad.json", "-o", "bad.frag"}).err;
    EXPECT_EQ(said.find("bad.json: error: shader 2, 'Fog': there is no shader in it"), 0) << said;
}

TEST_F(Import, WhatIsNoShaderIsSaidWithItsPlace) {
    write("cut.json", "{\n  \"Shader\": {\n");
    write("other.json", "{\"name\": \"x\"}");
    write("odd.json",
          "[{\"renderpass\": [{\"code\": 7, \"inputs\": 3, \"outputs\": {}}]}, 4, null]");
    fs::create_directories(folder() / "empty");
    Outcome outcome = glint({"import", "cut.json", "-o", "a.frag"});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_NE(outcome.err.find("cut.json:3:1: error: this is no JSON"), std::string::npos)
        << outcome.err;
    outcome = glint({"import", "other.json", "-o", "a.frag"});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_NE(outcome.err.find("\"renderpass\" is missing"), std::string::npos) << outcome.err;
    EXPECT_EQ(glint({"import", "odd.json", "-o", "a.frag"}).code, 4);
    EXPECT_EQ(glint({"import", "none.json", "-o", "a.frag"}).code, 4);
    EXPECT_EQ(glint({"import", "empty", "-o", "a.frag"}).code, 4);
    EXPECT_EQ(glint({"import", "cut.json", "-o", "a.png"}).code, 2);
    EXPECT_FALSE(fs::exists(folder() / "a.frag"));
}

// A file that an export was cut off, or that somebody made by hand: never a crash, never a scene
// that is not what the file says.
TEST_F(Import, BadJsonOfEveryKindIsSaid) {
    const Json good = {
        {"ver", "0.1"}, {"info", {{"id", "x"}}}, {"renderpass", chain(257, 258, 37)}};
    const std::string text = good.dump(1);
    const auto with = [&](const auto& change) {
        Json json = good;
        change(json);
        return json.dump();
    };
    const auto deep = [](char open, char close, std::size_t count) {
        return std::string(count, open) + std::string(count, close);
    };
    struct Bad {
        std::string name, text, said;
    };
    const std::vector<Bad> cases = {
        {"nothing", "", "this is no JSON"},
        {"cut in a string", text.substr(0, text.find("Strange") + 3), "this is no JSON"},
        {"cut at the end", text.substr(0, text.size() - 2), "this is no JSON"},
        {"not UTF-8", "{\"renderpass\": \"\xff\xfe\"}", "is missing"},
        {"a number too large", "{\"ver\": 2e807}", "a number in it is too large"},
        {"a number", "12", "\"renderpass\" is missing"},
        {"an empty list", "[]", "there is no shader in it"},
        {"renderpass is text", with([](Json& j) { j["renderpass"] = "x"; }), "is missing"},
        {"code is a number", with([](Json& j) { j["renderpass"][0]["code"] = 7; }),
         "the tab 'image' has no \"code\" that is text"},
        {"code is missing", with([](Json& j) { j["renderpass"][1].erase("code"); }),
         "the tab 'bufferB' has no \"code\""},
        {"a pass is a number", with([](Json& j) { j["renderpass"][0] = 3; }), "error: "},
        {"eight passes", with([](Json& j) {
             for (int k = 0; k < 4; ++k) {
                 j["renderpass"].push_back(j["renderpass"][1]);
                 j["renderpass"].back()["code"] = fmt::format("// {}\n", k);
             }
         }),
         "two tabs are 'bufferB'"},
        {"a fifth buffer", with([](Json& j) {
             for (const char* name : {"Buf C", "Buf D", "Buf E"}) {
                 j["renderpass"].push_back(pass("buffer", name, name, "", Json::array()));
             }
         }),
         "the tab 'Buf E' is none that the site has"},
        {"a tab of another kind", with([](Json& j) {
             j["renderpass"].push_back(pass("vertex", "Vertex", "9", "", Json::array()));
         }),
         "the tab 'Vertex' is none that the site has"},
        {"deep lists", deep('[', ']', 200'000), "nested as no shader is"},
        {"deep within a shader", "{\"renderpass\": " + deep('[', ']', 300) + "}",
         "nested as no shader is"},
        {"deep and cut", std::string(1'000'000, '['), "nested as no shader is"},
    };
    for (const Bad& bad : cases) {
        write("bad.json", bad.text);
        const Outcome outcome = glint({"import", "bad.json", "-o", "bad.frag"});
        EXPECT_EQ(outcome.code, 4) << bad.name << ": " << outcome.err;
        EXPECT_NE(outcome.err.find(bad.said), std::string::npos) << bad.name << ": " << outcome.err;
        EXPECT_TRUE(outcome.err.starts_with("bad.json:")) << bad.name << ": " << outcome.err;
        EXPECT_FALSE(fs::exists(folder() / "bad.frag")) << bad.name;
    }
}

TEST_F(Import, WhatIsStrangeInAnInputLeavesTheRestAsItIs) {
    Json json = {{"renderpass", chain(257, 258, 37)}};
    Json& inputs = json["renderpass"][0]["inputs"];
    inputs.push_back(input(7, 259, "buffer", "nearest"));  // no such channel
    inputs.push_back("text");
    inputs.push_back(nullptr);
    inputs.push_back(input(0, 258, "buffer", "nearest"));  // taken already
    inputs[0]["sampler"] = 3;
    inputs[1]["sampler"]["filter"] = "trilinear";
    json["renderpass"][3]["inputs"] = 5;
    write("odd.json", json.dump());
    const Outcome outcome = glint({"import", "odd.json", "-o", "odd.frag"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    for (const char* told : {"the tab 'image': an input has no channel from 0 to 3",
                             "the tab 'image': channel 0 has more than one input",
                             "the tab 'image': channel 1 has the filter 'trilinear'"})
        EXPECT_NE(outcome.err.find(told), std::string::npos) << outcome.err;
    write("good.json", Json{{"renderpass", chain(257, 258, 37)}}.dump());
    ASSERT_EQ(glint({"import", "good.json", "-o", "good.frag"}).code, 0);
    EXPECT_EQ(draw("odd.frag", 3), draw("good.frag", 3));
}

TEST_F(Import, AFileOfAHundredMegabytesIsRefused) {
    write("huge.json", "[]");
    fs::resize_file(folder() / "huge.json", 100'000'000);  // zeros, which take no room
    const Outcome outcome = glint({"import", "huge.json", "-o", "huge.frag"});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_NE(outcome.err.find("huge.json: error: cannot read it: it is larger"), std::string::npos)
        << outcome.err;
}

// A picture of one colour outside the folder `in`, and a shader within that names it.
class ImportOfAStranger : public Import {
protected:
    ImportOfAStranger() {
        const Image red{.size = {1, 1},
                        .channels = 3,
                        .type = ChannelType::u8,
                        .pixels = {std::byte{255}, std::byte{0}, std::byte{0}}};
        write("secret.glsl", "float secret() { return 1.0; }\n");
        fs::create_directory(folder() / "in");
        write_image(folder() / "outside.png", red);
        write_image(folder() / "in/inside.png", red);
        fs::create_symlink("../outside.png", folder() / "in/link.png");
        fs::create_symlink("inside.png", folder() / "in/inner_link.png");
        fs::create_symlink("..", folder() / "in/folder");
    }

    Outcome import_one(const std::string& file, const std::string& code,
                       std::vector<std::string> options = {}) const {
        Json inputs = Json::array({input(0, 30, "texture", "mipmap")});
        inputs[0]["src"] = file;
        const Json image = pass("image", "Image", 37, code, inputs);
        write("in/one.json", Json{{"renderpass", Json::array({image})}}.dump());
        fs::remove(folder() / "in/one.frag");
        options.insert(options.begin(), {"import", "in/one.json", "-o", "in/one.frag"});
        return glint(std::move(options));
    }
};

constexpr const char* kShowsIt =
    "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p); }\n";

TEST_F(ImportOfAStranger, WhatItNamesStaysWithinItsFolderUnlessAPersonSaysOtherwise) {
    for (const std::string name : {"../outside.png", "link.png", "folder/outside.png",
                                   "/../outside.png", "folder/in/../outside.png"}) {
        SCOPED_TRACE(name);
        const Outcome refused = import_one(name, kShowsIt);
        EXPECT_EQ(refused.code, 0) << refused.err;
        EXPECT_NE(refused.err.find("in/one.json: warning: image, iChannel0: '" + name +
                                   "' is outside this file's folder; noise rgba 512 stands in its "
                                   "place, and --anywhere takes it\n"),
                  std::string::npos)
            << refused.err;
        EXPECT_NE(bytes("in/one.frag").find("//@ noise rgba 512"), std::string::npos);

        const Outcome taken = import_one(name, kShowsIt, {"--anywhere"});
        EXPECT_EQ(taken.code, 0) << taken.err;
        EXPECT_EQ(taken.err, "");
        EXPECT_NE(bytes("in/one.frag").find("//@ image "), std::string::npos);
    }
    EXPECT_EQ(draw("in/one.frag", 0), (std::array{255, 0, 0}));
    for (const std::string name : {"inside.png", "inner_link.png", "/media/a/inside.png",
                                   "../inside.png", "folder/in/inside.png"}) {
        const Outcome taken = import_one(name, kShowsIt);
        EXPECT_EQ(taken.err, "") << name;
        EXPECT_NE(bytes("in/one.frag").find("//@ image "), std::string::npos) << name;
    }
}

TEST_F(ImportOfAStranger, ItsCodeNamesNothingElseEither) {
    const std::string codes[] = {
        "#include \"../secret.glsl\"\n" + std::string(kGradient),
        "uniform sampler2D s; //@ image ../outside.png\n" + std::string(kGradient),
        "uniform sampler2D s; //@ image link.png\n" + std::string(kGradient),
        "#iChannel1 \"file://../outside.png\"\n" + std::string(kGradient),
        // Somebody may mend the mistake.
        "uniform float a; //@ 0.5 [1, 0]\nuniform sampler2D s; //@ image ../outside.png\n",
        "#include \"/dev/null\"\n" + std::string(kGradient)};
    for (const std::string& code : codes) {
        SCOPED_TRACE(code);
        const Outcome refused = import_one("", code);
        EXPECT_EQ(refused.code, 4) << refused.err;
        EXPECT_NE(refused.err.find("in/one.json: error: its code names '"), std::string::npos)
            << refused.err;
        EXPECT_NE(refused.err.find("; --anywhere imports it"), std::string::npos) << refused.err;
        EXPECT_FALSE(fs::exists(folder() / "in/one.frag"));
        const Outcome drawn = glint({"still", "in/one.json", "-o", "o.png", "--size", "8x8"});
        EXPECT_EQ(drawn.code, 4) << drawn.err;
        EXPECT_NE(drawn.err.find("`glint import --anywhere`"), std::string::npos) << drawn.err;
        EXPECT_EQ(import_one("", code, {"--anywhere"}).code, 0);
        EXPECT_TRUE(fs::exists(folder() / "in/one.frag"));
    }
}

// So that folder and scene may move together.
TEST_F(ImportOfAStranger, AFileIsNamedFromTheFolderOfTheScene) {
    import_one("inside.png", kShowsIt);
    EXPECT_NE(bytes("in/one.frag").find("//@ image \"inside.png\""), std::string::npos);
    ASSERT_EQ(glint({"import", "in/one.json", "-o", "one.frag"}).code, 0);
    EXPECT_NE(bytes("one.frag").find("//@ image \"in/inside.png\""), std::string::npos)
        << bytes("one.frag");
}

TEST_F(ImportOfAStranger, ATabThatLeadsOutOfItsFolderIsLeftOut) {
    write("in/tabs/image.glsl", kGradient);
    fs::create_symlink("../../secret.glsl", folder() / "in/tabs/Common.GLSL");
    const Outcome made = glint({"import", "in/tabs", "-o", "tabs.frag"});
    EXPECT_EQ(made.code, 0) << made.err;
    EXPECT_EQ(made.err,
              "in/tabs/Common.GLSL: warning: it leads out of this folder and is left out; "
              "--anywhere takes it\n");
    EXPECT_EQ(bytes("tabs.frag").find("secret"), std::string::npos);
    EXPECT_EQ(glint({"import", "in/tabs", "-o", "all.frag", "--anywhere"}).err, "");
    EXPECT_NE(bytes("all.frag").find("secret"), std::string::npos);
}

TEST_F(Import, EveryVerbTakesTheFileOfTheSiteAndDrawsWhatTheImportDraws) {
    write("toy.json",
          Json{{"Shader", {{"info", Json::object()}, {"renderpass", chain(257, 258, 37)}}}}.dump());
    const auto before = draw("toy.json", 7);
    EXPECT_EQ(before, (std::array{56, 102, 64}));
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"sequence", "toy.json", "--size", "64x36", "--frames", "7:7", "-o", "p%d.png"},
             {"info", "toy.json"},
             {"bench", "toy.json", "--size", "16x9", "--frames", "2"},
             {"check", "toy.json", "--size", "16x9", "--case", "size", "-o", "failures"},
             {"export", "toy.json", "-o", "tabs"}}) {
        SCOPED_TRACE(words[0]);
        const Outcome outcome = glint(words);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
    }
    EXPECT_EQ(read_image(folder() / "p7.png").pixels, read_image(folder() / "out.png").pixels);
    // No scene is left behind; a preset may name the file, too.
    EXPECT_FALSE(fs::exists(folder() / "toy.frag"));
    write("look.toml", "scene = \"toy.json\"\n");
    EXPECT_EQ(draw("look.toml", 7), before);
    ASSERT_EQ(glint({"import", "toy.json", "-o", "toy.frag"}).code, 0);
    EXPECT_EQ(draw("toy.frag", 7), before);
}

TEST_F(Import, MistakesOfAFileOfTheSiteHaveThePlacesThatItsSceneWouldHave) {
    const auto toy = [&](const std::string& code) {
        write("toy.json",
              Json{{"renderpass", Json::array({pass("image", "Image", 37, code)})}}.dump());
        return glint({"still", "toy.json", "-o", "out.png", "--size", "8x8"});
    };
    const Outcome wrong = toy("void mainImage(out vec4 c, in vec2 p) { c = wrong; }");
    EXPECT_EQ(wrong.code, 3);
    EXPECT_TRUE(wrong.err.starts_with("toy.frag:")) << wrong.err;
    ASSERT_EQ(glint({"import", "toy.json", "-o", "toy.frag"}).code, 0);
    EXPECT_EQ(glint({"still", "toy.frag", "-o", "out.png", "--size", "8x8"}).err, wrong.err);
    write("toy.json", "{");
    EXPECT_EQ(glint({"still", "toy.json", "-o", "out.png"}).code, 4);
    EXPECT_EQ(glint({"still", "gone.json", "-o", "out.png"}).code, 4);
    EXPECT_FALSE(fs::exists(folder() / "out.png"));
}

}  // namespace
}  // namespace glint::cli::import_test
