// What one function needs of a text.
#include "glsl/reachable.h"

#include <gtest/gtest.h>

#include <string>

namespace glint::reachable_test {
namespace {

std::string reached(std::string_view text, Known known = known_of_driver()) {
    const EditedText result = reachable_text(read_glsl(text, known), "mainImage", "PASS_");
    for (std::size_t at = 0; at < result.text.size(); ++at)  // every byte knows where it stood
        EXPECT_EQ(result.text[at], text[result.map.origin(at)]);
    return result.text;
}

const std::string kImage = "void mainImage(out vec4 c, in vec2 p) { c = f(p.x); }\n";

TEST(Reachable, IsWhatTheEntryNames) {
    EXPECT_EQ(
        reached("// a file\n\nuniform float u; //@ 1\nconst float kA = 1.0; // a\n"
                "float unused() { return kB; }\nconst float kB = 2.0;\n"
                "/* of f */ vec4 f(float x) { return vec4(kA); }\n" +
                kImage),
        "const float kA = 1.0; // a\n/* of f */ vec4 f(float x) { return vec4(kA); }\n" + kImage);
}

TEST(Reachable, FollowsMacrosAndStructs) {
    const std::string text =
        "#define F(x) g(x)\nstruct S { float x; };\nS g(float x) { return S(x); }\n"
        "vec4 f(float x) { return vec4(F(x).x); }\n" +
        kImage;
    EXPECT_EQ(reached(text), text);
}

TEST(Reachable, KeepsFunctionsWithHalfABracketInAMacro) {
    const std::string text = "#define S max(0.,\nvec4 f(float x) { return vec4(S x)); }\n" + kImage;
    EXPECT_EQ(reached(text), text);
}

TEST(Reachable, KeepsAllWhereBracketsDoNotBalance) {
    const std::string text =
        "#ifdef GL_x\nfloat a() {\n#endif\nfloat unused;\nvec4 f(float x) { return vec4(1); }\n" +
        kImage;
    EXPECT_EQ(reached(text), text);
    EXPECT_EQ(reached("uniform float u;\n" + text), text);
}

TEST(Reachable, KeepsWhatMayBeSwitchedOnAgain) {
    const std::string text =
        "const float kA = 1.0;\n#define LEVEL 1\n#if LEVEL > 1\nvec4 f(float x) { return vec4(kA); "
        "}\n#else\n"
        "vec4 f(float x) { return vec4(2.0); }\n#endif\n" +
        kImage;
    EXPECT_EQ(reached(text), text);
}

TEST(Reachable, KeepsTheEndOfALineWhoseLastPartGoes) {
    EXPECT_EQ(
        reached("const float kA = 1.0; float unused() { return 1.0; }  // last\n"
                "#define B kA\nvec4 f(float x) { return vec4(B); }\n" +
                kImage),
        "const float kA = 1.0;\n#define B kA\nvec4 f(float x) { return vec4(B); }\n" + kImage);
}

TEST(Reachable, KeepsADirectiveWithTheFunctionAroundIt) {
    for (const char* unused :
         {"float unused() {\n#define Q .75\nreturn Q; }\n",
          "#if 1\nfloat unused() {\n#else\nfloat unused() { \n#endif\n}\n",
          "float unused() {\n#if 1\nreturn 1.; }\n#else\nreturn 2.; }\n#endif\n"}) {
        const std::string text = unused + ("vec4 f(float x) { return vec4(x); }\n" + kImage);
        EXPECT_EQ(reached(text), text);
    }
    EXPECT_EQ(reached("float unused() {\n#if 1\nreturn 1.;\n#else\nreturn 2.;\n#endif\n}\n"
                      "vec4 f(float x) { return vec4(x); }\n" +
                      kImage),
              "vec4 f(float x) { return vec4(x); }\n" + kImage);
}

// A comment goes on behind the line's end, and a line behind a backslash.
TEST(Reachable, LeavesOutCommentsToTheirEnds) {
    const std::string rest = "vec4 f(float x) { return vec4(x); }\n" + kImage;
    for (const char* comment : {"/* older,\n   slower */", "// older, \\\n   slower",
                                "/* a\n#define Q 1\n//*/", "// a /* b", "/* a */ // b \\\n */"})
        EXPECT_EQ(reached("float unused() { return 1.0; } " + (comment + ("\n" + rest))), rest)
            << comment;
    EXPECT_EQ(reached("float unused() { return 1.0; } /* of\nf */ " + rest),
              " /* of\nf */ " + rest);
    const std::string kept =
        "const float kA = 1.0; // a \\\n b\nfloat unused() { return 1.0; }\n"
        "vec4 f(float x) { return vec4(kA); }\n";
    EXPECT_EQ(reached(kept + kImage),
              "const float kA = 1.0; // a \\\n b\nvec4 f(float x) { return vec4(kA); }\n" + kImage);
}

TEST(Reachable, LeavesOutOtherTabs) {
    const std::string text =
        "#ifdef PASS_bufferB\nfloat only_b() { return 1.0; }\nvoid mainImage(out vec4 c) { c = "
        "vec4(only_b()); }\n"
        "#endif\n#ifdef PASS_image // the picture\nvec4 f(float x) { return vec4(x); }\n" +
        kImage + "#endif // image\n";
    Known known = known_of_driver();
    known.macros.push_back({"PASS_image", "1"});
    EXPECT_EQ(reached(text, known), "vec4 f(float x) { return vec4(x); }\n" + kImage);
}

}  // namespace
}  // namespace glint::reachable_test
