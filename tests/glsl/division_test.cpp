// Divisions by a zero that is written in the text.
#include "glsl/division.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace glint::division_test {
namespace {

std::string mended(std::string_view text) {
    const Reading reading = read_glsl(text, {});
    Edits edits(reading);
    mend_division_by_zero(reading, {"soft"}, edits);
    return edits.apply().text;
}

TEST(Division, ByAFloatingZeroIsMultiplication) {
    EXPECT_EQ(mended("a / 0.0 * b / .0 / 0.0f"), "a * 1e39 * b * 1e39 * 1e39");
    EXPECT_EQ(mended("a /= (0.); b / vec3(0.0);"), "a *= (1e39); b * vec3 (1e39);")
        << "with what stands between";
    EXPECT_EQ(mended("a / 0 + b / 0.5 / 10.0 / (0. + c) / vec2(0., 1.) / 0x0"),
              "a / 0 + b / 0.5 / 10.0 / (0. + c) / vec2(0., 1.) / 0x0");
    EXPECT_EQ(mended("a / vec2(0) + b / float(0) / (0)"),
              "a * vec2 (1e39) + b * float (1e39) / (0)");
    EXPECT_EQ(mended("a / vecLen(0.0) / vector(0.);"), "a / vecLen(0.0) / vector(0.);")
        << "functions of the text";
    EXPECT_EQ(mended("#define NONE 0.\na / NONE;"), "#define NONE 0.\na * 1e39;");
}

TEST(Division, ByAConstantThatIsZeroIsMultiplication) {
    EXPECT_EQ(
        mended("const float Z = 0.0;\nvoid f() { a / Z; a / (Z); a / Z.x; a / Z(); a / Zz; }"),
        "const float Z = 0.0;\nvoid f() { a * 1e39; a * (1e39); a / Z.x; a / Z(); a / Zz; }")
        << "its own name alone";
    const std::string hidden = "const float Z = 0.0;\nvoid f(float Z) { a / Z; }";
    EXPECT_EQ(mended(hidden), hidden) << "another variable has the name";
    EXPECT_EQ(
        mended(
            "struct S { float k; };\nvoid f() { const float k = 0.; a / k; { float k; a / k; } a / "
            "k; }\nvoid g(float k) { a / k; }\nvoid h() { a / k; }"),
        "struct S { float k; };\nvoid f() { const float k = 0.; a * 1e39; { float k; a / k; } a * "
        "1e39; }\nvoid g(float k) { a / k; }\nvoid h() { a / k; }")
        << "the one that is meant at its place";
    EXPECT_EQ(mended("void f() { for (const float k = 0.; ;) { a / k; } a / k; }"),
              "void f() { for (const float k = 0.; ;) { a * 1e39; } a / k; }");
    EXPECT_EQ(mended("uniform float soft, hard;\nvoid f() { a / soft / hard; }"),
              "uniform float soft, hard;\nvoid f() { a * 1e39 / hard; }")
        << "a tweak that is written in as 0";
}

TEST(Division, ByAUniformHasNamesForWhoeverKnowsItsValue) {
    const Reading reading =
        read_glsl("uniform float soft;\nvoid f() { a / vec2(soft); a /= soft; a / 0.; }", {});
    Edits edits(reading);
    name_divisions(reading, {{"soft", 3}}, edits);
    EXPECT_EQ(edits.apply().text,
              "uniform float soft;\nvoid f() { a  glint_over3 vec2 ( glint_divisor3); a  glint_by3 "
              " glint_divisor3; a / 0.; }");
}

}  // namespace
}  // namespace glint::division_test
