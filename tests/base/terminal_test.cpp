// What a terminal is told.
#include "base/terminal.h"

#include <gtest/gtest.h>

namespace glint::terminal_test {
namespace {

// Marks that turn the direction of writing are shown as one letter each.
TEST(Terminal, ColoursAMessageThatIsShorterThanWhatWasSaid) {
    const Terminal terminal{.is_there = true, .has_colours = true};
    std::string name;
    for (int i = 0; i < 40; ++i) name += "\u200f";
    const std::string text = shown({Severity::error, {}, "Cannot read " + name}, terminal);
    EXPECT_NE(text.find("error:"), text.npos) << text;
    EXPECT_NE(text.find("Cannot read ????"), text.npos) << text;
    EXPECT_EQ(text.find("error:"), text.rfind("error:")) << text;
}

}  // namespace
}  // namespace glint::terminal_test
