// Numbers that may be fed from outside.
#include "glsl/numbers.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace glint::numbers_test {
namespace {

using Fed = std::pair<std::string, std::vector<float>>;

// All functions that f() reaches, and with them the constants, where these are wanted.
Fed fed(std::string_view text, bool constants = false) {
    const Reading reading = read_glsl(text, known_of_driver());
    Edits edits(reading);
    std::vector<float> numbers =
        feed_numbers(reading, reading.reached_from({"f"}), "n", constants, edits);
    return {edits.apply().text, std::move(numbers)};
}

TEST(Numbers, OfFunctionsAreFedFourToAnElement) {
    EXPECT_EQ(fed("void f() { a = .5 * b + 2.25e-1 - 3.f * vec2(4., 5e2); }"),
              Fed("void f() { a = n[0].x * b + n[0].y - n[0].z * vec2(n[0].w, n[1].x); }",
                  {0.5f, 0.225f, 3.0f, 4.0f, 500.0f}));
    EXPECT_EQ(fed("float g() { return 2.5; } void f() { for (float t = 0.1; t < 8.5; t += g()); }"),
              Fed("float g() { return n[0].x; } "
                  "void f() { for (float t = n[0].y; t < n[0].z; t += g()); }",
                  {2.5f, 0.1f, 8.5f}));
}

TEST(Numbers, ThatMustBeConstantOrWholeAreLeft) {
    for (const char* text : {
             "const float k = 2.5; void f() { a = k; }",
             "void f() { const float k = 2.5, l[2] = float[2](3.5, 4.5); }",
             "void f() { int i = 3; uint u = 7u; i = 0x1E; b[2] = c; switch (i) { case 5: break; } "
             "}",
             "void f() { a = ivec2(2, 3).x + g(4) + vec2(2 + 3, b[2]).x + vec2(012, 0x1).x; }",
             "float k = 2.5; layout(location = 0) out vec4 o; void f() { float a[4]; }",
             "float g() { return 2.5; } void f() {}",
         })
        EXPECT_EQ(fed(text), Fed(text, {})) << text;
}

// What compilers fold into what stands around them, and what they make of exponents and divisors.
TEST(Numbers, ThatCompilersFoldAreLeft) {
    const std::string text =
        "void f() { a = 1.0 - max(0., b) + pow(c, 2.0) / 0.0 + pow(c, g(4.)); }";
    EXPECT_EQ(fed(text), Fed(text, {}));
    EXPECT_EQ(fed("void f() { a = pow(0.5, 2.0); }"),
              Fed("void f() { a = pow(n[0].x, 2.0); }", {0.5f}));
}

// A float holds them as they are.
TEST(Numbers, ThatAreWholeAreFedWhereAConstructorMakesThemFloats) {
    EXPECT_EQ(fed("void f() { a = vec3(2, -7, 1) * float(3) + vec2(0, g(5)).x; }"),
              Fed("void f() { a = vec3(n[0].x, -n[0].y, 1) * float(n[0].z) + vec2(0, g(5)).x; }",
                  {2.0f, 7.0f, 3.0f}));
    for (const char* text : {"void f() { a = matId(3); }", "void f() { a = vec3_of(2) + mat(7); }"})
        EXPECT_EQ(fed(text), Fed(text, {})) << "functions of the text";
}

TEST(Numbers, ThatAreBrokenAreFedAsExponents) {
    EXPECT_EQ(fed("void f() { a = pow(b, 2.2) + pow(b, -1.25) + pow(b, 0.5) + pow(b, -3.0); }"),
              Fed("void f() { a = pow(b, n[0].x) + pow(b, -n[0].y) + pow(b, 0.5) + pow(b, -3.0); }",
                  {2.2f, 1.25f}));
}

TEST(Numbers, OfGlobalConstantsAreFedWhereTheyAreUsed) {
    EXPECT_EQ(fed("const float k = -2.5;\nconst vec3 sun = vec3(1.0, 0.9, 0.7);\n"
                  "void f() { a = -k * sun.x + 3.5; b = sun; }",
                  true),
              Fed("\n\nvoid f() { a = -(-n[0].x) * (vec3(1.0, n[0].y, n[0].z)).x + n[0].w; "
                  "b = (vec3(1.0, n[0].y, n[0].z)); }",
                  {2.5f, 0.9f, 0.7f, 3.5f}));
    EXPECT_EQ(fed("const float k = 2.5; float g() { return k; } void f() { a = k; }", true),
              Fed(" float g() { return k; } void f() { a = (n[0].x); }", {2.5f}))
        << "what f() does not call is gone by then";
}

TEST(Numbers, OfConstantsThatAreAskedForElsewhereAreLeft) {
    for (const char* text : {
             "const float k = 2.5; const float l = k; void f() { a = k; }",
             "const float k = 2.5; void f() { const float l = k; a = k; }",
             "const float k = 2.5; float l = k; void f() { a = k; }",
             "const float k = 2.5; void f() { float k = b; a = k; }",
             "const float k = 2.5; void f() { a = b.k + k; }",
             "const float k = 2.5; void f() { a = pow(b, k); }",
             "const float k = 2.5, l = 3.5; void f() { a = k; }",
             "const float k = 2.5 * PI; void f() { a = k; }",
             "const float k = 1.0; const vec2 l = vec2(0.0, 1.0); void f() { a = k + l.x; }",
             "const float k[2] = float[2](2.5, 3.5); void f() { a = k[0]; }",
             "const int k = 2; void f() { a = k; }",
         })
        EXPECT_EQ(fed(text, true), Fed(text, {})) << text;
}

TEST(Numbers, WithinMacrosAreFedWhereTheUseCanBeWrittenOut) {
    EXPECT_EQ(fed("#define HALF(x) (x * 0.5)\nvoid f() { a = HALF(b) + HALF(3.5); }"),
              Fed("#define HALF(x) (x * 0.5)\nvoid f() { a = (b * n[0].x) + (n[0].y * n[0].z); }",
                  {0.5f, 3.5f, 0.5f}));
}

// So that the same programs draw both.
TEST(Numbers, OfTwoTextsThatDifferInThemAloneLeaveTheSameText) {
    const auto text = [](const char* number) {
        return std::string("float g(float x) { return x * ") + number + "; } void f() { g(2.); }";
    };
    EXPECT_EQ(fed(text("0.25")).first, fed(text("1.75")).first);
    EXPECT_NE(fed(text("0.25")).second, fed(text("1.75")).second);
    EXPECT_NE(fed(text("0.25")).first, fed(text("1.0")).first) << "which is folded";
    EXPECT_NE(fed(text("0.25")).first, fed(text("-0.25")).first) << "a sign is no number";
}

TEST(Numbers, BeyondAllFloatsAreLeft) {
    const std::string text = "void f() { a = 1e99; }";
    EXPECT_EQ(fed(text), Fed(text, {}));
}

}  // namespace
}  // namespace glint::numbers_test
