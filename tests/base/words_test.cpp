// Words that stand in a text.
#include "base/words.h"

#include <gtest/gtest.h>

namespace glint::words_test {
namespace {

TEST(Words, ThatAreWholeAreNoPartOfLongerOnes) {
    EXPECT_EQ(find_whole_word("uniform float for_it; for (;;)", "for"), 22u);
    EXPECT_EQ(find_whole_word("for", "for"), 0u);
    EXPECT_EQ(find_whole_word("for for", "for", 1), 4u);
    EXPECT_EQ(find_whole_word("uniform before 2for", "for"), std::string_view::npos);
}

}  // namespace
}  // namespace glint::words_test
