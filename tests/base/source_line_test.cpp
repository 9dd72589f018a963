// The line that a diagnostic speaks of, with a caret where it points to, and what a terminal adds.
#include "base/source_line.h"

#include "base/terminal.h"
#include "test_folder.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace glint::source_line_test {
namespace {

namespace fs = std::filesystem;

TEST(SourceLine, TheCaretStandsUnderTheColumn) {
    const SourceLine plain = shown_line("float a = b;", 11, 80);
    EXPECT_EQ(plain.text, "float a = b;");
    EXPECT_EQ(plain.text.at(static_cast<std::size_t>(plain.caret)), 'b');
    const SourceLine tabs = shown_line("\tx\ty;", 4, 80);
    EXPECT_EQ(tabs.text, "    x   y;");
    EXPECT_EQ(tabs.caret, 8);
    EXPECT_EQ(shown_line("\xc3\xa9 = b", 5, 80).caret, 4) << "columns count characters";
    EXPECT_EQ(shown_line("ab", 9, 80).caret, 2) << "past the end is the end";
    EXPECT_EQ(shown_line("ab", 0, 80).caret, -1);
}

TEST(SourceLine, ALongLineIsCutRoundTheColumn) {
    const std::string line = std::string(300, 'a') + "HERE" + std::string(300, 'b');
    const SourceLine shown = shown_line(line, 301, 60);
    EXPECT_NE(shown.text.find("HERE"), std::string::npos);
    EXPECT_TRUE(shown.text.starts_with("\u2026") && shown.text.ends_with("\u2026"));
    // The mark of the cut takes three bytes and one character.
    EXPECT_EQ(shown.text.at(static_cast<std::size_t>(shown.caret) + 2), 'H');
}

TEST(SourceLine, OnATerminalWideCharactersTakeTwoCells) {
    const SourceLine wide = shown_line("/* \u6c34 */ x = y;", 10, 80, Cells::terminal);
    EXPECT_EQ(wide.text, "/* \u6c34 */ x = y;");
    EXPECT_EQ(wide.caret, 10) << "one more than the characters before it";
    const SourceLine over = shown_line("a\u0301 = b", 5, 80, Cells::terminal);
    EXPECT_EQ(over.caret, 3) << "an accent over a letter takes none";
    const SourceLine tab = shown_line("\u6c34\tx", 3, 80, Cells::terminal);
    EXPECT_EQ(tab.text, "\u6c34  x");
    EXPECT_EQ(tab.caret, 4);
}

TEST(SourceLine, NothingInItMovesATerminalsCursor) {
    const SourceLine shown = shown_line("a\033[2Jb\x80\xffz\u009bq", 0, 80, Cells::terminal);
    EXPECT_EQ(shown.text, "a?[2Jb??z?q");
}

TEST(SourceLine, ACutThroughAWideCharacterKeepsTheCaretInPlace) {
    std::string line;
    for (int i = 0; i < 100; ++i) line += "\u6c34";
    line += "HERE";
    for (const int width : {40, 41}) {
        const SourceLine shown = shown_line(line, 101, width, Cells::terminal);
        const std::size_t here = shown.text.find("HERE");
        ASSERT_NE(here, std::string::npos);
        int cells = 0;
        for (std::size_t i = 0; i < here; ++i) {
            const auto byte = static_cast<unsigned char>(shown.text[i]);
            if (byte >= 0xc0) cells += shown.text.compare(i, 3, "\u6c34") == 0 ? 2 : 1;
            if (byte < 0x80) ++cells;
        }
        EXPECT_EQ(shown.caret, cells) << width;
    }
}

class OnATerminal : public testing::Test {
protected:
    Diagnostic complaint() const {
        return {Severity::error, {file_.string(), 2, 12}, "'y' is unknown"};
    }

    TestFolder folder_;
    fs::path file_ = folder_.write("a.frag", "one\n\tfloat x = y;\n");
};

TEST_F(OnATerminal, TheLineAndACaretFollowTheMessage) {
    const std::string first = file_.string() + ":2:12: error: 'y' is unknown";
    EXPECT_EQ(shown(complaint(), {}), first);
    EXPECT_EQ(shown(complaint(), {.is_there = true}), first +
                                                          "\n    2 |     float x = y;"
                                                          "\n      |               ^");
}

TEST_F(OnATerminal, ColoursChangeNoLetter) {
    const std::string plain = shown(complaint(), {.is_there = true});
    std::string coloured = shown(complaint(), {.is_there = true, .has_colours = true});
    EXPECT_NE(coloured, plain);
    for (std::size_t at = 0; (at = coloured.find("\033[")) != std::string::npos;)
        coloured.erase(at, coloured.find('m', at) + 1 - at);
    EXPECT_EQ(coloured, plain);
}

TEST_F(OnATerminal, WhatHasNoLineIsTheMessageAlone) {
    const Terminal terminal{.is_there = true};
    EXPECT_EQ(shown({Severity::warning, {}, "cold"}, terminal), "warning: cold");
    EXPECT_EQ(shown({Severity::error, {"gone.frag", 1, 1}, "no"}, terminal),
              "gone.frag:1:1: error: no");
}

}  // namespace
}  // namespace glint::source_line_test
