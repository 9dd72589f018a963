// `%` becomes a function, around the whole of its operands, wherever GLSL asks for no constant.
#include "glsl/remainder.h"

#include <gtest/gtest.h>

#include <string>
#include <string_view>

namespace glint::remainder_test {
namespace {

std::string mended(std::string_view text) {
    const Reading reading = read_glsl(text, {});
    Edits edits(reading);
    mend_remainders(find_remainders(reading, edits), edits);
    return edits.apply().text;
}

// Of an expression within a function.
std::string of(const std::string& expression) {
    const std::string before = "void f() { x = ", behind = "; }";
    const std::string text = mended(before + expression + behind);
    return text.substr(before.size(), text.size() - before.size() - behind.size());
}

void expect_alone(const std::string& text) {
    EXPECT_EQ(mended(text), text);
}

TEST(Remainder, TakesTheWholeProductBeforeItAndTheFactorBehindIt) {
    EXPECT_EQ(of("a % b"), "glint_rem(a , b)");
    EXPECT_EQ(of("1 + a * b % c + d"), "1 + glint_rem(a * b , c) + d");
    EXPECT_EQ(of("a % b * c % d"), "glint_rem(glint_rem(a , b) * c , d)");
    EXPECT_EQ(of("(a + b) % v[i].x / 2"), "glint_rem((a + b) , v[i].x) / 2");
    EXPECT_EQ(of("f(a, b) % g(c).y"), "glint_rem(f(a, b) , g(c).y)");
    EXPECT_EQ(of("(a % n + n) % n"), "glint_rem((glint_rem(a , n) + n) , n)");
}

TEST(Remainder, TakesSignsThatBindCloserAndNoOthers) {
    EXPECT_EQ(of("-a % b"), "glint_rem(-a , b)");
    EXPECT_EQ(of("~a % -b"), "glint_rem(~a , -b)");
    EXPECT_EQ(of("c - a % b"), "c - glint_rem(a , b)");
    EXPECT_EQ(of("c - -a % b"), "c - glint_rem(-a , b)");
    EXPECT_EQ(of("c * -a % b"), "glint_rem(c * -a , b)");
    EXPECT_EQ(of("i++ % 3 + ++i % 4"), "glint_rem(i++ , 3) + glint_rem(++i , 4)");
    EXPECT_EQ(of("c ? -a % b : 1"), "c ? glint_rem(-a , b) : 1");
    EXPECT_EQ(mended("int f() { return -a % 3; }"), "int f() { return glint_rem(-a , 3); }");
}

TEST(Remainder, OfAnAssignmentNamesWhatIsChangedTwice) {
    EXPECT_EQ(mended("void f() { a %= b + 1, c++; v[i].x %= 3; }"),
              "void f() { a = glint_rem(a, b + 1), c++; v[i].x = glint_rem(v [ i ] . x, 3); }");
    expect_alone("void f() { a[i++] %= 3; }");
    expect_alone("void f() { a[g(i)] %= 3; }");
}

TEST(Remainder, StaysWhereGlslWantsAConstant) {
    expect_alone("const int k = -7 % 3;\nint g = 7 % 4, a[5 % 3];\nstruct S { int a[5 % 3]; };\n");
    expect_alone("void f(int a[5 % 3]) { const int k = 7 % 4; int b[9 % 5]; }");
    expect_alone("void f() { switch (a) { case 7 % 4: b = 1; break; } }");
    EXPECT_EQ(mended("void f() { int a[2] = int[5 % 3](i % 2, 1); a[i % 2] = 1; }"),
              "void f() { int a[2] = int[5 % 3](glint_rem(i , 2), 1); a[glint_rem(i , 2)] = 1; }");
}

// Offsets of textures and indices of samplers are constants, too.
TEST(Remainder, OfNumbersAndConstantsIsTheCompilers) {
    expect_alone(
        "const int k = 2;\nvoid f() { x = textureOffset(s, p, ivec2(5 % 3 - 1, k % 2)); }");
    expect_alone("#define TAP(k) textureOffset(s, p, ivec2(k % 3))\nvoid f() { x = TAP(7); }");
}

TEST(Remainder, OfVariablesThatAreCalledLikeTypesOrConstantsIsMended) {
    EXPECT_EQ(of("interval % 3"), "glint_rem(interval , 3)");
    EXPECT_EQ(of("int(7) % 3"), "int(7) % 3");
    const std::string other = "const int n = 5;\nvoid g(int n) { x = ";
    EXPECT_EQ(mended(other + "n % 3; }"), other + "glint_rem(n , 3); }");
}

TEST(Remainder, TakesNothingOfAHeadBeforeIt) {
    EXPECT_EQ(mended("void f() { if (a > 0) ++k % 4 == 0 ? b : c; }"),
              "void f() { if (a > 0) glint_rem(++k , 4) == 0 ? b : c; }");
    EXPECT_EQ(mended("void f() { while (g(a)) (k) % 2 == 1 ? b : c; }"),
              "void f() { while (g(a)) glint_rem((k) , 2) == 1 ? b : c; }");
}

TEST(Remainder, LeavesAloneATextOfVeryMany) {
    std::string text = "void f() { x = a";
    for (int i = 0; i < 100'000; ++i) text += " % b";
    expect_alone(text + "; }");
}

TEST(Remainder, LeavesAloneAUseThatIsWrittenOutAlready) {
    const std::string text = "#define R(a, b) a % b\nvoid f() { x = R(i, n); }";
    const Reading reading = read_glsl(text, {});
    Edits edits(reading);
    edits.replace_bytes(reading.uses.front().span, "i % n");
    EXPECT_TRUE(find_remainders(reading, edits).empty());
}

TEST(Remainder, IsMendedWithinMacros) {
    EXPECT_EQ(mended("#define WRAP(a, n) (((a) % (n) + (n)) % (n))\nvoid f() { x = WRAP(i, 3); }"),
              "#define WRAP(a, n) (((a) % (n) + (n)) % (n))\n"
              "void f() { x = ( glint_rem(( glint_rem((i) , (3)) + (3) ) , (3)) ); }");
}

TEST(Remainder, OfAnExpressionAloneIsMended) {
    EXPECT_EQ(with_mended_remainders("2 * (a % 3)"), "2 * (glint_rem(a , 3))");
}

}  // namespace
}  // namespace glint::remainder_test
