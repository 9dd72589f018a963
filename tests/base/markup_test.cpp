#include "base/markup.h"

#include <gtest/gtest.h>

namespace glint {
namespace {

TEST(Markup, KeepsWhatMeansSomethingToATagFromMeaningIt) {
    EXPECT_EQ(markup_escaped("a < b && \"c\" > 'd'"),
              "a &lt; b &amp;&amp; &quot;c&quot; &gt; &#39;d&#39;");
    EXPECT_EQ(markup_escaped("a\nb\tc"), "a&#10;b&#9;c");
}

TEST(Markup, KeepsEveryCharacterThatXmlAllows) {
    const std::string text = "\u00e9 \u20ac \U0001F4A1 \ud7ff \ue000 \ufffd";
    EXPECT_EQ(markup_escaped(text), text);
    EXPECT_EQ(markup_escaped(""), "");
}

TEST(Markup, ReplacesWhatXmlCannotHold) {
    const std::string lost = "\ufffd";
    for (const char* bad : {"\x01", "\x1b", "\x7f", "\x80", "\xff", "\xc3", "\xc0", "\xf5"})
        EXPECT_EQ(markup_escaped(bad), lost);
    EXPECT_EQ(markup_escaped(std::string_view("a\0b", 3)), "a" + lost + "b");
    EXPECT_EQ(markup_escaped("\xc3x"), lost + "x") << "what follows half a character stays";
    EXPECT_EQ(markup_escaped("\xed\xa0\x80"), lost + lost + lost) << "half a pair of UTF-16";
    EXPECT_EQ(markup_escaped("\xe0\x80\x80"), lost + lost + lost) << "longer than it need be";
    EXPECT_EQ(markup_escaped("\xef\xbf\xbf"), lost + lost + lost) << "U+FFFF";
}

}  // namespace
}  // namespace glint
