// Zeros that divide are hidden from the compiler; all others stay.
#include "glsl/hidden_zero.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace glint::hidden_zero_test {
namespace {

std::string hidden(std::string_view text) {
    const Reading reading = read_glsl(text, {});
    Edits edits(reading);
    hide_zeros(reading, write_zeros(reading, edits), {}, edits);
    return edits.apply().text;
}

void expect_alone(const std::string& text) {
    EXPECT_EQ(hidden(text), text);
}

TEST(HiddenZero, IsAddedWhereAVariableThatDividesIsGivenZero) {
    EXPECT_EQ(hidden("void f() { float z = 0.; float a = w / z; }"),
              "void f() { float z = 0. + glint_zero; float a = w / z; }");
    EXPECT_EQ(hidden("void f() { vec3 z = vec3(0), y = vec3(1); y /= z; z = vec3(0., 0, 0.0); }"),
              "void f() { vec3 z = vec3(0) + glint_zero, y = vec3(1); y /= z; z = vec3(0., 0, 0.0) "
              "+ glint_zero; }");
    EXPECT_EQ(hidden("void f() { for (int i = 0; i < 4; i++) a += w / float(i); }"),
              "void f() { for (int i = 0 + glint_zero_i; i < 4; i++) a += w / float(i); }");
    EXPECT_EQ(hidden("void f() { vec2 z = vec2(0.0); a = w / length(z * 2.0).x; }"),
              "void f() { vec2 z = vec2(0.0) + glint_zero; a = w / length(z * 2.0).x; }");
}

// Of uniforms that become constants of 0.
TEST(HiddenZero, IsAddedToUniformsInWhatDivides) {
    const auto with_zeros = [](const std::string& body) {
        const std::string head =
            "uniform float z; uniform vec2 v; float par(float p, float d) { return p / d; }\n";
        const std::string text = head + "void f() { " + body + " }";
        const Reading reading = read_glsl(text, {});
        Edits edits(reading);
        hide_zeros(reading, {}, {"z", "v"}, edits);
        return edits.apply().text.substr(head.size() + 11);
    };
    EXPECT_EQ(with_zeros("a = w / (z * 0.1);"), "a = w / ((z+glint_zero) * 0.1); }");
    EXPECT_EQ(with_zeros("a = w / v.x + w / v;"),
              "a = w / (v+glint_zero).x + w / (v+glint_zero); }");
    EXPECT_EQ(with_zeros("a = w / max(z, 0.0);"), "a = w / max((z+glint_zero), 0.0); }");
    EXPECT_EQ(with_zeros("float l = z * 2.0, m = l; a = w / m;"),
              "float l = (z+glint_zero) * 2.0, m = l; a = w / m; }");
    EXPECT_EQ(with_zeros("float l; l = z; a = w / l;"),
              "float l; l = (z+glint_zero); a = w / l; }");
    EXPECT_EQ(with_zeros("a = par(w, z);"), "a = par(w, (z+glint_zero)); }");
    for (const char* alone :
         {"a = w / z;", "a = w / (z);", "a = w / vec2(z);", "a = w / (z + 1.0);", "a = w * z;",
          "float z = 1.0; a = w / (z * 2.0);", "bool b = z > 0.0; a = w / float(b);",
          "float l = z + 0.1; a = w / l;"})
        EXPECT_EQ(with_zeros(alone), std::string(alone) + " }");
}

TEST(HiddenZero, IsAddedToConstantsOfZeroThatAreGivenAwayOrOfSeveralComponents) {
    const std::string head =
        "const float NIL = 0.0; const vec2 NONE = vec2(0.0), UP = vec2(0, 1);\n";
    const auto in_text = [&](const std::string& body) {
        return hidden(head + "void f() { " + body + " }").substr(head.size() + 11);
    };
    EXPECT_EQ(in_text("float l = NIL; a = w / l;"), "float l = NIL + glint_zero; a = w / l; }");
    EXPECT_EQ(in_text("a = w / NONE;"), "a = w / (NONE+glint_zero); }");
    EXPECT_EQ(in_text("a = w / NONE.x;"), "a = w / (NONE+glint_zero).x; }");
    for (const char* alone : {"a = w / NIL;", "a = w * NONE;", "a = w / UP;"})
        EXPECT_EQ(in_text(alone), std::string(alone) + " }");
}

TEST(HiddenZero, IsAddedToTheZeroOfWhatIsUnset) {
    EXPECT_EQ(hidden("void f() { float z; a = w / z; z += 1.0; }"),
              "void f() { float z = 0. + glint_zero; a = w / z; z += 1.0; }");
}

TEST(HiddenZero, IsAddedToAnArgumentByWhichTheFunctionDivides) {
    const std::string function = "float f(float x, float z) { return x / z; }\n";
    EXPECT_EQ(hidden(function + "void g() { f(0.0, 0.0); f(0.0, 1.0); }"),
              function + "void g() { f(0.0, 0.0 + glint_zero); f(0.0, 1.0); }");
    expect_alone(function + "const float c = f(1.0, 0.0);\n");
}

TEST(HiddenZero, LeavesAloneWhatIsNoZeroOrDividesNothing) {
    expect_alone("void f() { float z = 0.0; float a = z / 2.0 + z; }");
    expect_alone("void f() { float z = 0.0; float a = w / (z + 1.0); }");
    expect_alone("void f() { float z = 0.5; float a = w / z; }");
    expect_alone("void f() { const float z = 0.0; float a = w / z; }");
    expect_alone("float z = 0.0;\nvoid f() { float a = w / z; }");
    expect_alone("struct S { float z; };\nvoid f(S s) { s.z = 0.0; float a = w / s.z; }");
    expect_alone("void f() { float[2] z = float[2](0.0, 0.0); float a = w / z[0]; }");
}

TEST(HiddenZero, LeavesAloneSeveralNamesOfOneMacro) {
    const std::string text =
        "#define VARS float t, d\nvoid f() { VARS; d = 1.0; a = t / d; t += a; }";
    EXPECT_EQ(hidden(text).find("glint_zero"), std::string::npos);
}

TEST(HiddenZero, TakesNoSecondsForAVastText) {
    std::string chain = "void f() { ";
    for (int i = 0; i < 100'000; ++i) chain += "z /= ";
    hidden(chain + "b; }");
    chain = "void f() { float z = 0.0; ";
    for (int i = 0; i < 100'000; ++i) chain += "z = ";
    hidden(chain + "0.0; b = 1.0 / z; }");
}

TEST(HiddenZero, LeavesAloneANameOfBothKindsOfNumbersInOneFunction) {
    expect_alone("void f() { int z = 0; int a = 4 / z; { float z = 0.0; b = w / z; } }");
    expect_alone("void g() { b = w / z; }\nvoid f() { float z = 0.0; b = z; }");
}

}  // namespace
}  // namespace glint::hidden_zero_test
