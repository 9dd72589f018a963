// `glint import FOLDER`: tabs in files of their own become a scene.
#include "command.h"
#include "media/image.h"

namespace glint::cli::import_folder_test {
namespace {

class ImportOfAFolder : public InAFolder {
protected:
    // The last pixel.
    std::array<int, 3> draw(const std::string& file) {
        const Outcome drawn =
            glint({"still", file, "-o", "out.png", "--size", "64x36", "--frame", "0"});
        EXPECT_EQ(drawn.code, 0) << drawn.err;
        const Image image = read_image(folder() / "out.png");
        const auto at = [&](std::size_t i) { return std::to_integer<int>(image.pixels[i]); };
        return {at(0), at(1), at(2)};
    }
};

TEST_F(ImportOfAFolder, InAnySpellingBecomesAScene) {
    write("tabs/Common.glsl", "#define HALF 0.5\n");
    write("tabs/Buffer A.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(HALF); }");
    write("tabs/bufB.GLSL",
          "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p) * "
          "HALF; }\n");
    write("tabs/Image.glsl",
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(texture(iChannel0, "
          "p).x, texture(iChannel1, p).x, 0, 1); }\n");
    write("tabs/notes.md", "not a tab\n");
    write("tabs/bufferE.glsl", "float e;\n");
    const Outcome made = glint({"import", "tabs", "-o", "scene.frag"});
    ASSERT_EQ(made.code, 0) << made.err;
    EXPECT_TRUE(made.err.starts_with("tabs/bufferE.glsl: warning: it is no tab")) << made.err;
    EXPECT_EQ(draw("scene.frag"), (std::array{128, 64, 0}));
}

TEST_F(ImportOfAFolder, ReadsItsCubeWhereATabReadsOne) {
    write("tabs/cubeA.glsl",
          "void mainCubemap(out vec4 c, in vec2 p, in vec3 ro, in vec3 rd) { c = "
          "vec4(step(0.9, rd), 1); }\n");
    write("tabs/common.glsl", "vec4 sky(samplerCube s, vec3 d) { return texture(s, d); }\n");
    write("tabs/bufferA.glsl", "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.2); }\n");
    write("tabs/image.glsl",
          "void mainImage(out vec4 c, in vec2 p) { c = sky(iChannel2, vec3(0, 1, 0)) + "
          "texture(iChannel0, p); }\n");
    const Outcome made = glint({"import", "tabs", "-o", "scene.frag"});
    EXPECT_EQ(made.err, "");
    EXPECT_EQ(draw("scene.frag"), (std::array{51, 255, 51}));
}

// Which would join the next line to it.
TEST_F(ImportOfAFolder, ATabMayEndWithABackslashInAComment) {
    write("tabs/bufferA.glsl",
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.2); }\n// the end \\\n");
    write("tabs/image.glsl",
          "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p); }\n// so \\");
    EXPECT_EQ(glint({"import", "tabs", "-o", "scene.frag"}).err, "");
    EXPECT_EQ(draw("scene.frag")[0], 51);
}

// Which stands beside the tabs, and not beside the scene.
TEST_F(ImportOfAFolder, FindsWhatATabIncludes) {
    write("tabs/lib/two.h", "float two() { return 0.4; }\n");
    write("tabs/image.glsl",
          "#include \"lib/two.h\"\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(two()); }\n");
    write("outside.h", "float x;\n");
    for (const char* scene : {"scene.frag", "tabs/scene.frag", "other/scene.frag"}) {
        fs::create_directories(folder() / "other");
        const Outcome made = glint({"import", "tabs", "-o", scene});
        EXPECT_EQ(made.err, "") << scene;
        EXPECT_EQ(draw(scene)[0], 102) << bytes(scene);
    }
    write("tabs/image.glsl",
          "#include \"../outside.h\"\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n");
    EXPECT_EQ(glint({"import", "tabs", "-o", "no.frag"}).code, 4);
    EXPECT_EQ(glint({"import", "tabs", "-o", "yes.frag", "--anywhere"}).err, "");
}

}  // namespace
}  // namespace glint::cli::import_folder_test
