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
    const std::vector<bool> reached = reading.reached_from({"f"});
    leave_out_functions(reading, reached, edits);
    leave_out_constants(reading, unused_constants(reading, reached, {}), edits);
    return without_comments(edits.apply().text);
}

TEST(Lean, LeavesOutFunctionsThatAreNotCalled) {
    EXPECT_EQ(lean("float unused() { return 1.; }\nfloat g() { return 2.; }\n"
                   "float h();\nvoid f() { g(); }\nfloat h() { return unused(); }\n"),
              "float g() { return 2.; }\nvoid f() { g(); }\n");
}

TEST(Lean, KeepsGlobalsStructsAndMacros) {
    const std::string text =
        "#define TWO 2.\nstruct S { float a; };\nuniform float t;\nfloat g = 1.;\n"
        "void f() { }\n";
    EXPECT_EQ(lean(text), text);
}

TEST(Lean, LeavesOutConstantsThatNothingAsksForWhichStays) {
    EXPECT_EQ(lean("const float a = 1.;\nconst float b = 2. * a, c = 3.;\nconst float d = b;\n"
                   "const int n = 4, m = 5;\nconst int size = 6;\nconst float unused = d;\n"
                   "const float gone = 7.;\nfloat kept[size];\n"
                   "void g() { gone; }\nvoid f() { a; }\n"),
              "const float a = 1.;\nconst float b = 2. * a, c = 3.;\n"
              "const int n = 4, m = 5;\nconst int size = 6;\nfloat kept[size];\nvoid f() { a; }\n");
    const std::string within = "#define EDGE 2. * k\nconst float k = 1.;\nvoid f() { x = EDGE; }\n";
    EXPECT_EQ(lean(within), within);
    const std::string defines = "const float k =\n#define TWO 2.\nTWO;\nvoid f() { x = TWO; }\n";
    EXPECT_EQ(lean(defines), defines);
}

TEST(Lean, UniformsThatWillBeConstantsAreToldWithThem) {
    const Reading reading = read_glsl(
        "uniform float a; uniform float b; uniform float c; void f() { b; }", known_of_driver());
    using Names = std::unordered_set<std::string_view>;
    EXPECT_EQ(unused_constants(reading, reading.reached_from({"f"}), {"a", "b"}), Names({"a"}));
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
