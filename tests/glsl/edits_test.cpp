// Changing a text by its tokens.
#include "glsl/edits.h"

#include <gtest/gtest.h>

#include <string>

namespace glint::edits_test {
namespace {

// The first token of this spelling, of those that a compiler sees.
std::uint32_t find(const Reading& reading, std::string_view word) {
    std::uint32_t at = 0;
    while (at < reading.tokens.size() && !reading.tokens[at].is(word)) ++at;
    return at;
}

TEST(Edits, KeepAllElseAndTheWayBack) {
    const std::string text = "float a; // one\nfloat b;\n";
    const Reading reading = read_glsl(text, {});
    Edits edits(reading);
    EXPECT_TRUE(edits.after(find(reading, "a"), " = 0."));
    EXPECT_TRUE(edits.before(find(reading, "b"), "c, "));
    const EditedText edited = edits.apply();
    EXPECT_EQ(edited.text, "float a = 0.; // one\nfloat c, b;\n");
    EXPECT_EQ(edited.map.origin(edited.text.find("one")), text.find("one"));
    EXPECT_EQ(edited.map.origin(edited.text.find("b;")), text.find("b;"));
    EXPECT_EQ(edited.map.origin(edited.text.find("= 0.")), text.find("; //"));
}

TEST(Edits, WriteOutAMacroThatTheyFallInto) {
    const std::string text = "#define TWO(t) t a; \\\n  t b\nTWO(\nfloat); // two\nint c;\n";
    const Reading reading = read_glsl(text, {});
    Edits edits(reading);
    EXPECT_TRUE(edits.after(find(reading, "a"), " = 0."));
    EXPECT_TRUE(edits.after(find(reading, "b"), " = 1."));
    EXPECT_TRUE(edits.after(find(reading, "c"), " = 2"));
    const EditedText edited = edits.apply();
    EXPECT_EQ(edited.text,
              "#define TWO(t) t a; \\\n  t b\nfloat a = 0.; float b\n = 1.; // two\nint c = 2;\n")
        << "on as many lines; what stands at its edge stands outside";
    EXPECT_EQ(edited.map.origin(edited.text.find("a = 0.")), text.find("TWO(\n"));
    EXPECT_EQ(edited.map.origin(edited.text.find("c = 2")), text.find("c;"));
}

TEST(Edits, AreKeptWithinAMacroThatIsWrittenOut) {
    const std::string text = "#define INV(a) a / 0. -\nfloat x = INV(1.)-1.;\n";
    const Reading reading = read_glsl(text, {});
    Edits edits(reading);
    edits.write_out(reading.uses.front());
    EXPECT_TRUE(edits.after(find(reading, "0."), " + zero"));
    EXPECT_TRUE(edits.after(find(reading, "0.") + 1, " "));
    EXPECT_EQ(edits.apply().text, "#define INV(a) a / 0. -\nfloat x = 1. / 0. + zero - -1.;\n");
}

TEST(Edits, StandBesideAMacro) {
    const std::string text = "#define FLOAT float\nFLOAT a;\n";
    const Reading reading = read_glsl(text, {});
    Edits edits(reading);
    EXPECT_TRUE(edits.before(find(reading, "float"), "{ "));
    EXPECT_TRUE(edits.after(find(reading, "float"), "[2]"));
    EXPECT_EQ(edits.apply().text, "#define FLOAT float\n{ FLOAT[2] a;\n");
}

TEST(Edits, TouchNoMacroThatWouldBeExpandedOnceMore) {
    const std::string text = "#define mix(a, b) mix(a, clamp(b))\nfloat x = mix(1, 2);\n";
    const Reading reading = read_glsl(text, {});
    Edits edits(reading);
    EXPECT_FALSE(edits.before(find(reading, "clamp"), "0 + "));
    EXPECT_EQ(edits.apply().text, text);
}

TEST(Edits, TouchNoMacroThatIsNotCertain) {
    const std::string text =
        "#ifdef GL_x\n#define T(a) float a;\n#else\n#define T(a) int a;\n#endif\nT(b)\n";
    const Reading reading = read_glsl(text, known_of_driver());
    Edits edits(reading);
    EXPECT_FALSE(edits.after(find(reading, "b"), " = 0"));
}

TEST(Edits, ReplaceRanges) {
    const std::string text = "#define AB a b\nx AB y\nz;";
    const Reading reading = read_glsl(text, {});
    const std::uint32_t a = find(reading, "a");
    Edits whole(reading);
    EXPECT_TRUE(whole.replace({a - 1, a + 4}, "q"));
    EXPECT_EQ(whole.apply().text, "#define AB a b\nq\n;") << "with its line ends";
    Edits half(reading);
    EXPECT_TRUE(half.replace({a, a + 1}, "q"));
    EXPECT_EQ(half.apply().text, "#define AB a b\nx q b y\nz;");
}

}  // namespace
}  // namespace glint::edits_test
