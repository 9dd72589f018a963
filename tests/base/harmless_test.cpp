#include "base/words.h"

#include <gtest/gtest.h>

namespace glint {
namespace {

TEST(Harmless, LeavesNothingThatATerminalObeys) {
    EXPECT_EQ(harmless("a\x1b[31m\n\x7f", '?'), "a?[31m??");
    EXPECT_EQ(harmless("a\n\tb", '?', "\n\t"), "a\n\tb");
    EXPECT_EQ(harmless("\u009b31m\u0085", '?'), "?31m?") << "C1";
    EXPECT_EQ(harmless("a\u202eb\u2066c\u061cd\u200f", '?'), "a?b?c?d?") << "directions";
}

TEST(Harmless, LeavesLettersAsTheyAre) {
    const std::string text = "\u00e9 \u00a0 \u2014 \u20ac \u2022 \U0001F4A1 \xff \xc2";
    EXPECT_EQ(harmless(text, '?'), text);
}

}  // namespace
}  // namespace glint
