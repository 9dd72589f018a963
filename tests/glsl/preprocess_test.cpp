// Tokens, macros and conditions.
#include "glsl/preprocess.h"

#include <gtest/gtest.h>

#include <string>

namespace glint::preprocess_test {
namespace {

// The tokens that a compiler sees, a space between them.
std::string seen(std::string_view text, const Known& known = known_of_driver()) {
    const Preprocessed read = preprocess(text, known);
    std::string words;
    for (const Token& token : read.tokens) {
        if (!words.empty()) words += ' ';
        words += token.text;
    }
    return words;
}

TEST(Tokens, AreThoseOfTheLanguage) {
    EXPECT_EQ(seen("a+=b<<=1.5e-3f^^x1;"), "a += b <<= 1.5e-3f ^^ x1 ;");
    EXPECT_EQ(seen("0x1Fu .5 1. 1..x 3e 0x1E+3"), "0x1Fu .5 1. 1. . x 3 e 0x1E + 3");
    EXPECT_EQ(seen("a/*b*/c//d\ne"), "a c e");
    EXPECT_EQ(seen("a \\ b @ \xC3\xA4"), "a \\ b @ \xC3\xA4") << "strange bytes stay";
}

TEST(Tokens, OfJoinedLinesKnowTheirBytes) {
    const std::string text = "fl\\\noat x; // not \\\n this\nint\\\n y;";
    const Preprocessed read = preprocess(text, {});
    ASSERT_EQ(read.tokens.size(), 6u);
    EXPECT_EQ(read.tokens[0].text, "float");
    EXPECT_EQ(read.tokens[0].begin, 0u);
    EXPECT_EQ(read.tokens[0].end, 7u);
    EXPECT_EQ(text.substr(read.tokens[1].begin, 1), "x");
    EXPECT_EQ(text.substr(read.tokens[3].begin, 3), "int");
    EXPECT_EQ(text.substr(read.tokens[4].begin, 1), "y");
    ASSERT_EQ(read.comments.size(), 1u);
    EXPECT_EQ(text.substr(read.comments[0].span.begin, 8), "// not \\");
    EXPECT_EQ(text[read.comments[0].span.end], '\n');
}

TEST(Tokens, TellAnUnclosedComment) {
    std::deque<std::string> spellings;
    EXPECT_EQ(scan("a /* b", spellings).unclosed, 2u);
}

TEST(Macros, AreExpandedWithinEachOther) {
    EXPECT_EQ(seen("#define A B B\n#define B c\nA;"), "c c ;");
    EXPECT_EQ(seen("#define F(x, y) (x + y)\n#define G(x) F(x, F(1, x))\nG(a*b)"),
              "( a * b + ( 1 + a * b ) )");
    EXPECT_EQ(seen("#define F(x) x\nF((a, b)) F() F"), "( a , b ) F");
    EXPECT_EQ(seen("#define F (x)\nF"), "( x )") << "a space ends the name";
    EXPECT_EQ(seen("#define A 1\n#undef A\nA"), "A");
}

TEST(Macros, AreNotExpandedWithinThemselves) {
    EXPECT_EQ(seen("#define mix(a, b) mix(a, clamp(b))\nmix(x, mix(y, z))"),
              "mix ( x , clamp ( mix ( y , clamp ( z ) ) ) )");
    EXPECT_EQ(seen("#define A B\n#define B A\nA B"), "A B");
}

TEST(Macros, TakeArgumentsFromBehindTheirUse) {
    EXPECT_EQ(seen("#define F(x) [x]\n#define G F\nG (1)"), "[ 1 ]");
    EXPECT_EQ(seen("#define F(x) [x]\nF\n(\n1 // one\n)"), "[ 1 ]");
    EXPECT_EQ(seen("#define F(x) [x]\nF(1"), "F ( 1") << "which never ends";
}

TEST(Macros, MayHoldHalfABracket) {
    EXPECT_EQ(seen("#define S max(0., \nS x)"), "max ( 0. , x )");
}

TEST(Macros, PutNoNamesTogether) {
    const Preprocessed read = preprocess("#define CAT(a, b) a##b\nCAT(x, y)", {});
    ASSERT_EQ(read.not_understood.size(), 1u);
    EXPECT_EQ(read.not_understood[0].span.begin, 19u);
    EXPECT_EQ(seen("#define CAT(a, b) a##b\nCAT(x, y)"), "x ## y");
}

TEST(Macros, LineAndVersionAreNumbers) {
    EXPECT_EQ(seen("a __LINE__\n__LINE__ __VERSION__ GL_ES"), "a 1 2 300 1");
    EXPECT_EQ(seen("#line 70\n__LINE__\n__LINE__"), "70 71");
    EXPECT_EQ(seen("#define HERE __LINE__\n\nHERE"), "3");
}

TEST(Macros, ATokenKnowsItsUseAndItsDefinition) {
    const std::string text = "#define TWICE(x) (x + x)\nfloat a = TWICE(b);";
    const Preprocessed read = preprocess(text, {});
    ASSERT_EQ(read.uses.size(), 1u);
    const MacroUse& use = read.uses[0];
    EXPECT_EQ(text.substr(use.span.begin, use.span.end - use.span.begin), "TWICE(b)");
    EXPECT_EQ(use.tokens, (TokenRange{3, 8}));
    EXPECT_EQ(read.macros[use.macro].definition.end, text.find('\n'));
    EXPECT_EQ(read.tokens[4].text, "b");
    EXPECT_EQ(read.tokens[4].begin, text.rfind('b')) << "an argument stands in the use";
    EXPECT_EQ(read.tokens[5].begin, text.find('+')) << "the rest in the definition";
    EXPECT_EQ(read.tokens[8].use, kNone);
}

TEST(Conditions, LeaveOutWhatIsNotTaken) {
    EXPECT_EQ(seen("#ifdef NOPE\na\n#else\nb\n#endif\nc"), "b c");
    EXPECT_EQ(seen("#if 0\na\n#elif 1\nb\n#elif 1\nc\n#else\nd\n#endif"), "b");
    EXPECT_EQ(seen("#if 0\n#if 1\na\n#endif\n#define X\n#else\n#ifndef X\nb\n#endif\n#endif"), "b");
}

TEST(Conditions, Reckon) {
    const auto holds = [](const std::string& condition) {
        return seen("#define TWO 2\n#define F(x) (x*2)\n#if " + condition + "\nyes\n#endif") ==
               "yes";
    };
    EXPECT_TRUE(holds("1 + TWO * 3 == 7"));
    EXPECT_TRUE(holds("(1 + TWO) * 3 == 9 && !(4 < 3)"));
    EXPECT_TRUE(holds("defined TWO && defined(F) && !defined(NOPE)"));
    EXPECT_TRUE(holds("F(3) == 6"));
    EXPECT_TRUE(holds("0x10 == 16 && 010 == 8 && (1 << 4) == 16 && -1 < 0 && ~0 == -1"));
    EXPECT_TRUE(holds("1 /* one */ // and no more"));
    EXPECT_TRUE(holds("7 % 4 == 3 && 7 / 2 == 3 && (6 & 3) == 2 && (6 ^ 3) == 5 && (6 | 1) == 7"));
    EXPECT_FALSE(holds("TWO > 2"));
    EXPECT_FALSE(holds("defined(NOPE) && NOPE > 2"));
}

TEST(Conditions, OfWhatIsNotKnownMayHold) {
    const Known known = {.macros = {}, .open = {"PASS_"}};
    EXPECT_EQ(seen("#ifdef PASS_a\na\n#else\nb\n#endif", known), "a b");
    EXPECT_EQ(seen("#if defined(PASS_a) && defined(NOPE)\na\n#endif", known), "");
    EXPECT_EQ(seen("#ifdef PASS_a\n#define X 1\n#endif\n#if X\na\n#else\nb\n#endif", known), "a b");
    EXPECT_EQ(seen("#ifdef PASS_a\n#define X 1\n#ifdef X\na\n#else\nb\n#endif\n#endif", known), "a")
        << "within the branch it is certain";
    EXPECT_EQ(seen("#if NOPE\na\n#endif", known), "a") << "the driver refuses it";
    const Preprocessed read =
        preprocess("#ifdef PASS_a\n#define X 1\n#else\n#define X 2\n#endif\nX", known);
    ASSERT_EQ(read.uses.size(), 1u);
    EXPECT_FALSE(read.uses[0].is_certain);
}

TEST(Conditions, BranchesAreListed) {
    const std::string text = "#ifdef PASS_a\na\n#else\nb\n#endif\nc";
    const Preprocessed read = preprocess(text, {.macros = {{"PASS_a", "1"}}});
    ASSERT_EQ(read.branches.size(), 2u);
    EXPECT_EQ(read.branches[0].live, Live::yes);
    EXPECT_EQ(read.branches[1].live, Live::no);
    EXPECT_EQ(read.branches[0].group, read.branches[1].group);
    const Span inside = read.inside(read.branches[0]);
    EXPECT_EQ(text.substr(inside.begin, inside.end - inside.begin), "\na\n");
    EXPECT_EQ(read.live_at(text.find('b')), Live::no);
    EXPECT_EQ(read.live_at(text.find('c')), Live::yes);
    EXPECT_TRUE(read.mentions("a"));
    EXPECT_FALSE(read.mentions("b"));
}

TEST(Directives, ThatAreNoneOfGlslHoldQuotes) {
    const Preprocessed read = preprocess(
        "#include \"a//b.glsl\"\n# iChannel0 \"file://x.png\"\n#include <c>\n#error \"x\n", {});
    ASSERT_EQ(read.directives.size(), 4u);
    const auto rest = [&](std::size_t i) { return read.written[read.directives[i].rest.begin]; };
    EXPECT_EQ(rest(0).text, "\"a//b.glsl\"");
    EXPECT_EQ(rest(0).kind, TokenKind::quoted);
    EXPECT_EQ(read.directives[1].word, "iChannel0");
    EXPECT_EQ(rest(1).text, "\"file://x.png\"");
    EXPECT_EQ(rest(2).text, "<c>");
    EXPECT_EQ(rest(3).text, "\"");
}

TEST(Directives, WithoutTheirPartnersAreTold) {
    EXPECT_EQ(preprocess("#else\n", {}).not_understood.size(), 1u);
    EXPECT_EQ(preprocess("#if 1\na", {}).not_understood.size(), 1u);
    EXPECT_EQ(preprocess("#define (\n", {}).not_understood.size(), 1u);
}

}  // namespace
}  // namespace glint::preprocess_test
