// Pictures of every size and shape: drawn, or refused in one sentence before anything is.
#include "command.h"

#include <cstdint>
#include <cstring>

namespace glint::cli::size_test {
namespace {

class Size : public InAFolder {
protected:
    Size() { write("scene.frag", kGradient); }

    // Red of the pixel at the right, green of the one at the top: the last that are drawn. (Our own
    // reader stops where textures do.)
    std::pair<int, int> last_values(const fs::path& name, int width, int height) const {
        const std::string crop = "cd '" + folder().string() +
                                 "' && ffmpeg -nostdin -loglevel error -i " + name.string() +
                                 " -vf crop=1:1:" + std::to_string(width - 1) +
                                 ":0:exact=1,format=rgb24 -f rawvideo -y raw && test -s raw";
        EXPECT_EQ(std::system(crop.c_str()), 0) << height;
        const std::string raw = bytes("raw");
        if (raw.size() != 3) return {-1, -1};
        return {static_cast<unsigned char>(raw[0]), static_cast<unsigned char>(raw[1])};
    }

    // Of an EXR, by its head.
    std::pair<int, int> exr_size(const fs::path& name) const {
        const std::string head = bytes(name).substr(0, 4096), mark("dataWindow\0box2i\0", 17);
        std::int32_t window[4] = {};
        const std::size_t at = head.find(mark);
        if (at == std::string::npos) return {};
        std::memcpy(window, head.data() + at + mark.size() + 4, sizeof window);
        return {window[2] + 1, window[3] + 1};
    }
};

TEST_F(Size, PicturesWiderOrHigherThanATextureAreDrawn) {
    const std::tuple<const char*, int, int> cases[] = {
        {"a.png", 20000, 40}, {"a.png", 16385, 16}, {"a.png", 65535, 1},  {"a.png", 1'000'000, 1},
        {"a.png", 16, 16385}, {"a.jpg", 65500, 2},  {"a.jpg", 16, 20000}, {"a.png", 1, 100'000}};
    for (const auto& [name, width, height] : cases) {
        const std::string size = std::to_string(width) + "x" + std::to_string(height);
        SCOPED_TRACE(size + " " + name);
        still({"scene.frag", "-o", name, "--size", size});
        const auto [red, green] = last_values(name, width, height);
        EXPECT_NEAR(red, width > 1 ? 255 : 128, width < 100 ? 9 : 1);
        EXPECT_NEAR(green, height > 1 ? 255.0 * (1.0 - 0.5 / height) : 128, 2);
    }
}

TEST_F(Size, EveryKindOfFileHoldsThem) {
    for (const std::string name : {"a.exr", "a.tif", "a.hdr"}) {
        for (const auto& [width, height] : {std::pair(20000, 8), {8, 20000}}) {
            SCOPED_TRACE(name);
            still({"scene.frag", "-o", name, "--size",
                   std::to_string(width) + "x" + std::to_string(height)});
            if (name == "a.exr") {
                EXPECT_EQ(exr_size(name), std::pair(width, height));
            }
        }
    }
}

TEST_F(Size, SamplesAreAveragedAndBuffersOfTheirOwnSizeReadThere) {
    write("small.frag",
          "uniform sampler2D a; //@ pass mainA size=4x4\n"
          "void mainA(out vec4 c, in vec2 p) { c = texelFetch(a, ivec2(p), 0) + 1.0 / 8.0; }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(a, ivec2(0), 0); }\n");
    still({"small.frag", "-o", "a.png", "--size", "20000x3", "--time", "1", "--fps", "4",
           "--samples", "2"});
    const auto [red, green] = last_values("a.png", 20000, 3);
    EXPECT_NEAR(red, 159, 2);  // five eighths
    EXPECT_EQ(red, green);
}

TEST_F(Size, APresetMayAskForThem) {
    write("wide.toml", "scene = \"scene.frag\"\nsize = [20000, 20]\n");
    const Outcome outcome = glint({"still", "wide.toml", "-o", "a.png"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    EXPECT_NE(outcome.out.find("20000x20"), std::string::npos) << outcome.out;
}

TEST_F(Size, TilesOfEverySizeGiveTheSameBytes) {
    const std::vector<std::string> base = {"scene.frag", "--size", "20000x6", "-o"};
    const auto with = [&](std::vector<std::string> words) {
        words.insert(words.begin(), base.begin(), base.end());
        return words;
    };
    still(with({"auto.png"}));
    for (const std::string tile : {"5", "1000", "16382", "16383", "16384"}) {
        still(with({"tiled.png", "--tile", tile}));
        EXPECT_EQ(bytes("tiled.png") == bytes("auto.png"), true) << tile;
    }
    // As wide as a texture, whole: here both are possible.
    still({"scene.frag", "--size", "16384x4", "-o", "whole.exr"});
    still({"scene.frag", "--size", "16384x4", "-o", "tiled.exr", "--tile", "16384"});
    EXPECT_EQ(bytes("tiled.exr") == bytes("whole.exr"), true);
}

TEST_F(Size, WhatCannotBeDrawnIsRefusedInOneSentenceThatSaysWhy) {
    write("buffer.frag",
          "uniform sampler2D waves; //@ pass mainWaves\n"
          "void mainWaves(out vec4 c, in vec2 p) { c = texelFetch(waves, ivec2(p), 0) + 1.0; }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(waves, ivec2(p), 0); }\n");
    const std::set<std::string> before = names();
    const std::tuple<std::vector<std::string>, const char*> cases[] = {
        // The end of the simulation would be days away.
        {{"still", "buffer.frag", "-o", "a.jpg", "--size", "70000x9", "--time", "1e6"}, "65500"},
        {{"still", "scene.frag", "-o", "a.png", "--size", "1000001x1"}, "1000000"},
        {{"still", "buffer.frag", "-o", "a.png", "--size", "20000x40"},
         "waves is 20000x40 pixels; this driver draws up to"},
        {{"still", "buffer.frag", "-o", "a.exr", "--size", "20000x40", "--pass", "waves"},
         "waves is 20000x40 pixels; this driver draws up to"},
        {{"sequence", "scene.frag", "-o", "a.%04d.png", "--size", "20000x40"},
         "image is 20000x40 pixels; this driver draws up to"},
        {{"sequence", "scene.frag", "-o", "a.%04d.jpg", "--size", "70000x4"}, "65500"},
        {{"sequence", "scene.frag", "-o", "a.mp4", "--size", "16386x4"},
         "a side has at most 16384"},
        {{"sequence", "scene.frag", "-o", "a.webm", "--size", "16386x4"},
         "a side has at most 16384"},
        {{"sequence", "scene.frag", "-o", "a.gif", "--size", "70000x4"},
         "a side has at most 65535"},
    };
    for (const auto& [arguments, words] : cases) {
        const Outcome outcome = glint(arguments);
        EXPECT_EQ(outcome.code, 1) << words;
        EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
        EXPECT_EQ(names(), before) << words;
    }
}

}  // namespace
}  // namespace glint::cli::size_test
