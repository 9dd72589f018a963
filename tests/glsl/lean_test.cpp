// Texts without what they do not need.
#include "glsl/lean.h"

#include <gtest/gtest.h>

#include <string>

namespace glint::lean_test {
namespace {

std::string lean(std::string_view text) {
    const Reading reading = read_glsl(text, known_of_driver());
    if (!can_be_lean(reading)) return "not understood";
    Edits edits(reading);
    leave_out_functions(reading, reading.reached_from({"f"}), edits);
    return without_comments(edits.apply().text);
}

TEST(Lean, LeavesOutFunctionsThatAreNotCalled) {
    EXPECT_EQ(lean("float unused() { return 1.; }\nfloat g() { return 2.; }\n"
                   "float h();\nvoid f() { g(); }\nfloat h() { return unused(); }\n"),
              "float g() { return 2.; }\nvoid f() { g(); }\n");
}

TEST(Lean, KeepsGlobalsStructsAndMacros) {
    const std::string text =
        "#define TWO 2.\nstruct S { float a; };\nconst float k = 1.;\nuniform float t;\n"
        "void f() { }\n";
    EXPECT_EQ(lean(text), text);
}

// An edit of these leaves the text as it was.
TEST(Lean, CommentsBlankLinesAndSpacesDoNotCount) {
    EXPECT_EQ(lean("// a tree\n\n\nvoid f()   { /* well */ a = 1.;  // so\n\n  b = 2.; }\n"),
              "void f() { a = 1.;\nb = 2.; }\n");
    EXPECT_EQ(lean("void f() { a /**/ = 1.; }\nvoid g() { b = 2.; }\n"),
              lean("void f() { a /*?*/ = 1.; }\nvoid g() { b = 3.; c = 4.; }\n"));
    EXPECT_EQ(lean("uniform float t; //@ 1 [0, 2]\nvoid f() {}\n"),
              lean("uniform float t; //@ 1 [0, 3] \"how long\"\nvoid f() {}\n"));
}

TEST(Lean, DirectivesStayOnLinesOfTheirOwn) {
    const std::string text =
        "#if 1\n#define SUM(a, b) \\\n    (a + b)\n#endif\nvoid f() { x = SUM(1., 2.); }\n";
    EXPECT_EQ(lean(text), text);
}

// Its end would go with it, or the definition of what others use.
TEST(Lean, AFunctionStaysWhereSomethingElseWouldGoWithIt) {
    const std::string across =
        "#ifdef A\nvoid g() {\n#else\nvoid g(int i) {\n#endif\n}\nvoid f() {}\n";
    EXPECT_EQ(lean(across), across);
    const std::string defines = "void g() {\n#define TWO 2.\n}\nvoid f() { x = TWO; }\n";
    EXPECT_EQ(lean(defines), defines);
    EXPECT_EQ(lean("void g() {\n#ifdef A\na = 1.;\n#else\nb = 1.;\n#endif\n}\nvoid f() {}\n"),
              "void f() {}\n");
}

TEST(Lean, WhatIsNotUnderstoodOrAsksForItsLineStaysWhole) {
    EXPECT_EQ(lean("void f() { a = (1.; }\n"), "not understood");
    EXPECT_EQ(lean("void f() { a = float(__LINE__); }\n"), "not understood");
    EXPECT_EQ(lean("void f() { } /* no end"), "not understood");
}

}  // namespace
}  // namespace glint::lean_test
