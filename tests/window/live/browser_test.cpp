// What the browser lists, and under which names.
#include "window/live/browser.h"

#include <gtest/gtest.h>

namespace glint::browser_test {
namespace {

TEST(BrowserList, TellsAPresetFromTheSceneOfItsName) {
    Browser browser("");
    browser.list({{"Here", {"presets/sea.toml", "fragments/sea.frag"}}});
    ASSERT_EQ(browser.looks().size(), 2u);
    EXPECT_EQ(browser.looks()[0].title, "sea");
    EXPECT_EQ(browser.looks()[1].title, "sea.frag");
}

}  // namespace
}  // namespace glint::browser_test
