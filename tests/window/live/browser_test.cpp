// What the browser lists, and under which names.
#include "window/live/browser.h"

#include "../../base/test_folder.h"

#include <gtest/gtest.h>

#include <chrono>

namespace glint::browser_test {
namespace {

TEST(BrowserList, TellsAPresetFromTheSceneOfItsName) {
    Browser browser("");
    browser.list({{"Here", {"presets/sea.toml", "fragments/sea.frag"}}});
    ASSERT_EQ(browser.looks().size(), 2u);
    EXPECT_EQ(browser.looks()[0].title, "sea");
    EXPECT_EQ(browser.looks()[1].title, "sea.frag");
}

// A picture of what a scene was would stand for what it is.
TEST(BrowserList, APresetHasAnotherThumbnailOnceAnythingHasChangedThatItIsDrawnFrom) {
    namespace fs = std::filesystem;
    const TestFolder folder;
    const std::vector<fs::path> files{
        folder.write("look.toml", "scene = \"scene.frag\"\n"),
        folder.write("scene.frag",
                     "#include \"colour.glsl\"\n"
                     "uniform sampler2D wood; //@ image wood.png\n"
                     "void mainImage(out vec4 c, vec2 p) { c = colour(p); }\n"),
        folder.write("colour.glsl", "vec4 colour(vec2 p) { return vec4(p, 0, 1); }\n"),
        folder.write("wood.png", "")};
    const fs::path other = folder.write("other.glsl", "");
    std::string name = thumbnail_name(files.front());
    for (const fs::path& file : files) {
        EXPECT_EQ(thumbnail_name(files.front()), name);
        fs::last_write_time(file, fs::last_write_time(file) + std::chrono::seconds(1));
        const std::string next = thumbnail_name(files.front());
        EXPECT_NE(next, name) << file;
        name = next;
    }
    fs::last_write_time(other, fs::last_write_time(other) + std::chrono::seconds(1));
    EXPECT_EQ(thumbnail_name(files.front()), name);
    EXPECT_NE(thumbnail_name(files[1]), name) << "the scene without the preset";
}

}  // namespace
}  // namespace glint::browser_test
