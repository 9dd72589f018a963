// Loops that are tested at their end.
#include "glsl/loops.h"

#include <gtest/gtest.h>

#include <string>

namespace glint::loops_test {
namespace {

std::string in_function(const std::string& words) {
    return "int n(int i) { return i; }\nvoid f() {\n" + words + "\n}\n";
}
std::string changed(const std::string& words) {
    return test_loops_at_end(in_function(words));
}

TEST(Loops, AreTestedOnceBeforeAndThenAtTheirEnd) {
    EXPECT_EQ(
        changed("for (int i = 0; i < 4; ++i) { a += i; }"),
        in_function("{int i = 0; bool glint_go = ( i < 4); do { if (glint_go) { { a += i; } } } "
                    "while (glint_go && ((++i), (i < 4))); }"));
    EXPECT_EQ(changed("for (; a < 4 && b; ) a++;"),
              in_function("{; bool glint_go = ( a < 4 && b); do { if (glint_go) { a++; } } "
                          "while (glint_go && (a < 4 && b)); }"));
    EXPECT_EQ(changed("for (int i = 0, j = 9; i < j; ++i, --j) if (i < 2) a++; else b++;"),
              in_function("{int i = 0, j = 9; bool glint_go = ( i < j); do { if (glint_go) { "
                          "if (i < 2) a++; else b++; } } "
                          "while (glint_go && ((++i, --j), (i < j))); }"));
}

TEST(Loops, ThatNothingEndsGetATestThatIsAlwaysTrue) {
    const std::string uniform = "uniform float iSampleRate;\n", test = "iSampleRate > -1.0";
    const auto now = [&](const std::string& words) {
        return test_loops_at_end(uniform + in_function(words));
    };
    const auto same = [&](const std::string& words) { return uniform + in_function(words); };
    EXPECT_EQ(now("while (true) { a++; }"), same("while (" + test + ") { a++; }"));
    EXPECT_EQ(now("do { a++; } while (true);"), same("do { a++; } while (" + test + ");"));
    EXPECT_EQ(now("for (;;) a++;"), same("for (;" + test + ";) a++;"));
    EXPECT_EQ(now("while (true) { while (b) { break; } switch (a) { case 1: break; } }"),
              same("while (" + test + ") { while (b) { break; } switch (a) { case 1: break; } }"));
    for (const char* ends :
         {"while (true) { if (b) break; }", "for (;;) { a++; if (b) { return; } }",
          "do { if (b) discard; } while (true);", "while (b) a++;"})
        EXPECT_EQ(now(ends), same(ends));
    EXPECT_EQ(changed("while (true) { a++; }"), in_function("while (true) { a++; }"));
}

TEST(Loops, WithinLoopsAreChangedToo) {
    EXPECT_EQ(changed("for (int i = 0; i < 4; ++i) for (int j = 0; j < i; ++j) a++;"),
              in_function("{int i = 0; bool glint_go = ( i < 4); do { if (glint_go) { {int j = 0; "
                          "bool glint_go = ( j < i); do { if (glint_go) { a++; } } "
                          "while (glint_go && ((++j), (j < i))); } } } "
                          "while (glint_go && ((++i), (i < 4))); }"));
}

TEST(Loops, KeepTheirLinesAndMacros) {
    const std::string lines = "#define N 4\nfor (int i = 0;\n i < N;\n ++i // one\n ) {\n a++;\n}";
    EXPECT_EQ(changed(lines),
              in_function("#define N 4\n{int i = 0; bool glint_go = (\n i < N); do { if (glint_go) "
                          "{\n\n {\n a++;\n} } } while (glint_go && ((++i), (i < N))); }"));
}

TEST(Loops, StayWhereTheirTestHasNoSecondPlace) {
    for (const char* words :
         {"for (;;) { break; }", "for (int i = 0; i < n(4); ++i) a++;",
          "for (int i = 0; bool b = i < 4; ++i) a++;", "while (a < 4) a++;",
          "#define UP(i) for (int i = 0; i < 4; ++i)\nUP(k) a++;", "for (int i = 0; i < 4; ++i",
          "#define LESS i < 4; ++i\nfor (int i = 0; LESS) a++;"}) {
        EXPECT_EQ(changed(words), in_function(words));
    }
}

}  // namespace
}  // namespace glint::loops_test
