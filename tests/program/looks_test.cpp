// `glint study A B`: two looks beside each other.
#include "media/image.h"
#include "report.h"

#include <cmath>

namespace glint::cli {
namespace {

using Json = nlohmann::json;

class Looks : public InAFolder {
protected:
    Looks() {
        write("a.frag",
              "uniform float level; //@ 0.5 [0, 1]\n"
              "void mainImage(out vec4 c, in vec2 p) {\n"
              "    c = vec4(level, p / iResolution.xy, 1);\n"
              "    if (ivec2(p) == ivec2(5, 3)) c.r = 1.0;\n"
              "}\n");
        write("b.toml", "scene = \"a.frag\"\n[tweaks]\nlevel = 0.6\n");
    }

    Json compare(const std::string& a, const std::string& b, std::vector<std::string> more = {}) {
        std::vector<std::string> arguments = {"study", a, b, "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = glint(std::move(arguments));
        EXPECT_EQ(outcome.err, "");
        return report_of(outcome);
    }
};

double to_light(double v) {
    return std::pow((v + 0.055) / 1.055, 2.4);
}

// Red of 0.5 and 0.6 in all pixels but one: the root of a third of the square of the difference.
TEST_F(Looks, TellHowFarTheyDifferAndWhichIsFaster) {
    const Json json = compare("a.frag", "b.toml", {"--size", "64x36"});
    const double off = to_light(0.6) - to_light(0.5);
    EXPECT_NEAR(json["rmse"].get<double>(), off / std::sqrt(3.0), 1e-4);
    EXPECT_NEAR(json["max"].get<double>(), off, 1e-5);
    EXPECT_GT(json["flip"].get<double>(), 0.01);
    EXPECT_EQ(json["size"], Json({64, 36}));
    EXPECT_NEAR(json["worst"]["a"][0].get<double>(), 0.5, 1e-6);
    EXPECT_NEAR(json["worst"]["b"][0].get<double>(), 0.6, 1e-6);
    EXPECT_GT(json["a"]["ms_low"].get<double>(), 0.0);
    EXPECT_LE(json["a"]["ms_low"], json["a"]["ms"]);
    EXPECT_LE(json["ms_ratio_low"], json["ms_ratio"]);
    EXPECT_LE(json["ms_ratio"], json["ms_ratio_high"]);
    EXPECT_FALSE(json["verdict"].get<std::string>().empty());
    EXPECT_EQ(json["b"]["file"], "b.toml");
}

TEST_F(Looks, TheWorstPixelIsCountedFromTheTop) {
    still({"a.frag", "-o", "a.png", "--size", "20x10", "--tweak", "level=1"});
    const Json json = compare("a.png", "a.frag");
    EXPECT_EQ(json["size"], Json({20, 10})) << "the picture's own";
    EXPECT_FALSE(json.contains("verdict")) << "a picture takes no time";
    still({"a.frag", "-o", "b.png", "--size", "20x10", "--tweak", "level=0.5"});
    still({"b.toml", "-o", "c.png", "--size", "20x10", "--tweak", "level=1"});
    write("spot.frag",
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = vec4(ivec2(p) == ivec2(5, 3) ? 1.0 : 0.5, p / iResolution.xy, 1);\n"
          "}\n");
    write("plain.frag",
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5, p / iResolution.xy, 1); }\n");
    EXPECT_EQ(compare("spot.frag", "plain.frag", {"--size", "20x10"})["worst"]["pixel"],
              Json({5, 6}))
        << "the fourth row from below";
}

TEST_F(Looks, APictureOfALookIsThatLook) {
    for (const char* file : {"b.png", "b.exr"}) {
        still({"b.toml", "-o", file, "--size", "33x21"});
        const Json json = compare(file, "b.toml");
        EXPECT_EQ(json["max"], 0.0) << file;
        EXPECT_EQ(json["flip"], 0.0) << file;
    }
    EXPECT_NE(glint({"study", "b.png", "b.exr"}).out.find("The pictures are the same."),
              std::string::npos);
}

TEST_F(Looks, TheWorstPixelIsOneOfThoseThatAreFinite) {
    write("nan.frag",
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    ivec2 i = ivec2(p);\n"
          "    c = vec4(vec3(i == ivec2(5, 2) ? 1.0 : i == ivec2(12, 7) ? 0.52 : 0.5), 1);\n"
          "    if (i == ivec2(9, 5)) c.r = sqrt(-1.0 - float(iFrame));\n"
          "}\n");
    write("plain.frag", "void mainImage(out vec4 c, in vec2 p) { c = vec4(vec3(0.5), 1); }\n");
    for (const bool is_first : {true, false}) {
        const Json json = compare(is_first ? "nan.frag" : "plain.frag",
                                  is_first ? "plain.frag" : "nan.frag", {"--size", "20x10"});
        EXPECT_EQ(json["worst"]["pixel"], Json({5, 7}));
        EXPECT_EQ(json["worst"][is_first ? "a" : "b"], Json({1.0, 1.0, 1.0}));
    }
    write("none.frag",
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(sqrt(-1.0 - float(iFrame))); }\n");
    const Outcome none = glint({"study", "none.frag", "plain.frag", "--size", "20x10"});
    EXPECT_NE(none.out.find("No pixel is finite in both."), std::string::npos) << none.out;
}

// Red of 4 and 8, and alpha of 1 and 2.
TEST_F(Looks, AnExrIsComparedAsWhatItSaysThatItHolds) {
    write("buffer.frag",
          "uniform float level; //@ 4 [0, 9]\n"
          "uniform sampler2D b; //@ pass mainB size=5x4\n"
          "void mainB(out vec4 c, in vec2 p) { c = vec4(level, 0, 0, level / 4.0); }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(b, ivec2(0), 0); }\n");
    still({"buffer.frag", "-o", "a.exr", "--pass", "b", "--size", "5x4"});
    still({"buffer.frag", "-o", "b.exr", "--pass", "b", "--size", "5x4", "--tweak", "level=8"});
    const Json buffers = compare("a.exr", "b.exr");
    EXPECT_NEAR(buffers["rmse"].get<double>(), std::sqrt((16.0 + 1.0) / 4.0), 1e-6);
    EXPECT_EQ(buffers["worst"]["b"], Json({8.0, 0.0, 0.0, 2.0}));
    const Outcome mixed = glint({"study", "a.exr", "buffer.frag"});
    EXPECT_EQ(mixed.code, 2);
    EXPECT_NE(mixed.err.find("a.exr holds the buffer 'b', and no picture"), std::string::npos)
        << mixed.err;
}

TEST_F(Looks, OfAlphaItIsSaidThatItDiffers) {
    Image image{.size = {5, 4}, .channels = 4, .pixels = std::vector(80, std::byte{128})};
    write_image(folder() / "a.png", image);
    for (std::size_t i = 3; i < 40; i += 4) image.pixels[i] = std::byte{255};
    write_image(folder() / "b.png", image);
    const Json json = compare("a.png", "b.png");
    EXPECT_EQ(json["max"], 0.0);
    EXPECT_EQ(json["alpha_off"], 10);
}

TEST_F(Looks, ThePageWipesBetweenThemWithoutANetwork) {
    const Outcome outcome = glint({"study", "a.frag", "b.toml", "--size", "64x36", "-o", "looks"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("FLIP"), std::string::npos) << outcome.out;
    const std::string page = bytes("looks/index.html");
    for (const char* name : {"a.png", "b.png", "difference.png", "flip.png"}) {
        EXPECT_TRUE(fs::exists(folder() / "looks" / name)) << name;
        EXPECT_NE(page.find("src=\"" + std::string(name)), std::string::npos) << name;
    }
    EXPECT_NE(page.find("type=range"), std::string::npos);
    for (const char* tag : {"src=\"http", "href=\"http", "url(http", "<script", "@import"})
        EXPECT_EQ(page.find(tag), std::string::npos) << tag;
    EXPECT_EQ(Json::parse(bytes("looks/looks.json"))["b"]["file"], "b.toml");
    write("looks/looks.json", "cut");
    EXPECT_EQ(glint({"study", "a.frag", "b.toml", "--size", "64x36", "-o", "looks"}).code, 0)
        << "its page tells whose it is";
}

TEST_F(Looks, WhatCannotBeComparedIsSaid) {
    still({"a.frag", "-o", "a.png", "--size", "20x10"});
    still({"a.frag", "-o", "b.png", "--size", "10x20"});
    write("wrong.frag", "void mainImage(out vec4 c, in vec2 p) { c = wrong; }\n");
    const Outcome sizes = glint({"study", "a.png", "b.png"});
    EXPECT_EQ(sizes.code, 2);
    EXPECT_NE(sizes.err.find("b.png is 10x20, not 20x10"), std::string::npos) << sizes.err;
    EXPECT_EQ(glint({"study", "a.png", "a.frag", "--size", "64x36"}).code, 2);
    EXPECT_EQ(glint({"study", "a.png"}).code, 2);
    EXPECT_EQ(glint({"study", "a.png", "gone.png"}).code, 4);
    EXPECT_EQ(glint({"study", "a.frag", "gone.frag"}).code, 4);
    EXPECT_EQ(glint({"study", "a.frag", "wrong.frag"}).code, 3);
    EXPECT_EQ(glint({"study", "a.frag", "b.toml", "--csv"}).code, 2);
    EXPECT_EQ(glint({"study", "a.png", "b.toml", "-o", "."}).code, 2) << "a.png would go";
    write("cut.png", bytes("a.png").substr(0, 60));
    const Outcome cut = glint({"study", "a.png", "cut.png"});
    EXPECT_EQ(cut.code, 4);
    EXPECT_TRUE(cut.err.starts_with("cut.png: error: ")) << cut.err;
    // What makes no sense of pictures.
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"--vary", "x"},
                                               {"--ms", "8"},
                                               {"--over", "presets"},
                                               {"--tweak", "x=1"},
                                               {"--quality", "best"},
                                               {"-o", "best.toml"}}) {
        std::vector<std::string> all = {"study", "a.png", "a.png"};
        all.insert(all.end(), words.begin(), words.end());
        EXPECT_EQ(glint(std::move(all)).code, 2) << words[0];
    }
    EXPECT_FALSE(fs::exists(folder() / "best.toml"));
}

// Where the driver puts a program in memory is as good as drawn by lot, and in some places it takes
// a fifth longer. About one call of fifty tells two looks of one preset apart; seven of forty would
// be once in a hundred thousand runs.
TEST_F(Looks, OfOnePresetAreHardlyEverToldApart) {
    const std::string preset = std::string(GLINT_REPOSITORY) + "/presets/christmas.toml";
    int told = 0;
    for (int call = 0; call < 40; ++call)
        told += compare(preset, preset, {"--size", "96x54"})["verdict"] != "not told apart";
    EXPECT_LE(told, 6);
}

}  // namespace
}  // namespace glint::cli
