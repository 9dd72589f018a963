// What a text may be made of: odd bytes, includes, branches that are not compiled, macros.
#include "read_text.h"

#include <algorithm>
#include <string>
#include <vector>

namespace glint::text_test {
namespace {

std::string lines(int count, std::string_view line) {
    std::string text;
    for (int i = 0; i < count; ++i) text += line;
    return text;
}

TEST(OddText, EveryKindOfLineEndIsOne) {
    const std::string plain = "// one\n\nuniform float a; //@ 0.5 [0, 1] \"x\"\n" + kImage;
    const std::string expected = good(plain).text;
    for (const std::string& end : {std::string("\r\n"), std::string("\r")}) {
        std::string text;
        for (const char c : plain) text += c == '\n' ? end : std::string(1, c);
        const Scene scene = good(text);
        EXPECT_EQ(scene.text, expected);
        EXPECT_EQ(scene.origins.size(), 4u);
        EXPECT_EQ(scene.tweaks.at(0).place.line, 3);
        EXPECT_EQ(scene.tweaks.at(0).description, "x");
    }
    EXPECT_EQ(good("\xEF\xBB\xBF" + plain).text, expected);
    EXPECT_EQ(good(plain.substr(0, plain.size() - 1)).text, expected);
}

TEST(OddText, IsReadWithoutHarm) {
    const struct {
        const char* name;
        std::string text;
        const char* tweaks;
    } cases[] = {
        {"a note in a block comment", "/*\nuniform float a; //@ 1\n*/", ""},
        {"a comment in a comment", "// /*\nuniform float a; //@ 1\n// */", "a "},
        {"a comment within a declaration", "uniform /* // */ float // x\n a; //@ 1", "a "},
        {"a note within a declaration", "uniform float //@ 1\n a;", "a "},
        {"a joined comment", "// \\\nuniform float a; //@ 1", ""},
        {"a joined note", "uniform vec2 a; //@ 1, \\\n 2 [0, \\\n 3]", "a "},
        {"a joined declaration", "uniform \\\n float a; //@ 1", "a "},
        {"a macro's body", "#define U uniform float a; \\\n uniform float b; //@ 1\n", ""},
        {"a dead branch", "#if 0\nuniform float a; //@ 1\n#include \"none\"\n#endif", ""},
        {"Latin-1 in a comment", "// gr\xFC\xDF\nuniform float a; //@ 1 \"gr\xFC\xDF\"", "a "},
        {"a precision statement", "precision mediump float;\nuniform float a; //@ 1", "a "},
        {"a block's members", "struct S { float uniformity; }; uniform float a; //@ 1", "a "},
        {"tabs and form feeds", "\tuniform\tfloat\fa\v;\t//@\t1\t[0,\t1]", "a "},
    };
    for (const auto& c : cases) {
        ReadScene result = read(c.text + "\n" + kImage);
        ASSERT_TRUE(result.scene) << c.name << "\n" << all(result.diagnostics);
        EXPECT_EQ(tweak_names(*result.scene), c.tweaks) << c.name;
    }
}

TEST(OddText, ANulByteIsAnErrorAtItsPlace) {
    const ReadScene result = read(std::string("// ab\nx\0y\n", 10) + kImage);
    EXPECT_FALSE(result.scene);
    EXPECT_NE(all(result.diagnostics).find("a.frag:2:2: error: a NUL byte"), std::string::npos)
        << all(result.diagnostics);
}

// Mesa takes a character beyond ASCII for the end of the text, and says that mainImage is missing.
TEST(OddText, ACharacterThatGlslDoesNotHaveIsAnErrorAtItsPlace) {
    const struct {
        std::string text;
        const char* words;
    } cases[] = {
        {"float a = 1.0;\u00A0\n", "a.frag:1:15: error: GLSL has no '\u00A0' (U+00A0)"},
        {"float \u03C0 = 3.0;\n", "a.frag:1:7: error: GLSL has no '\u03C0' (U+03C0)"},
        {"float a = \u201C1\u201D;\n", "a.frag:1:11: error: GLSL has no '\u201C' (U+201C)"},
        {"/* \u03C0 */ int \U0001F384;\n",
         "a.frag:1:13: error: GLSL has no '\U0001F384' (U+1F384)"},
        {"```glsl\n", "a.frag:1:1: error: GLSL has no `"},
        {"float $a;\n", "a.frag:1:7: error: GLSL has no '$'"},
        {"float gr\xFC = 1.0;\n", "a.frag:1:9: error: this byte is not UTF-8"},
        {"float a = 1.0;\x1A\n", "a.frag:1:15: error: GLSL has no control character 26"},
        {"#define F(x) \\ \n\nfloat a = F(1.0);\n",
         "a.frag:1:14: error: a line goes on behind a '\\' at its"},
    };
    for (const auto& c : cases) {
        const ReadScene result = read(c.text + kImage);
        EXPECT_FALSE(result.scene) << c.text;
        EXPECT_NE(all(result.diagnostics).find(c.words), std::string::npos)
            << all(result.diagnostics);
    }
    good("#if 0\n\u03C0 `$`\n#endif\n#define PI \u03C0\n// \u03C0 `$`\n" + kImage);
}

TEST(OddText, MainImageMayStandBehindAMacro) {
    good("#define main_image mainImage\nvoid main_image(out vec4 c, in vec2 f) { c = vec4(1); }\n");
}

// What is quadratic would take minutes here.
TEST(OddText, AnEndlessLineIsReadInLinearTime) {
    const std::string endless(1 << 20, 'x');
    for (const std::string& text :
         {endless, "// " + endless, "//@ " + endless, "/*" + endless + "*/",
          "uniform float a; //@ 1 " + endless, "uniform float a; //@ 1 \"" + endless + "\"",
          "uniform float a; //@ " + lines(1 << 16, "1, "), "#include " + lines(1 << 16, "< \" "),
          lines(1 << 14, "uniform float a;"), lines(1 << 14, "uniform "), lines(1 << 16, "/**/ "),
          lines(1 << 14, "//@ 1\n"), "uniform float " + lines(1 << 16, "a, ") + "b;",
          "uniform int a; //@ 0 {" + lines(1 << 16, "a, ") + "b}", lines(1 << 17, "\\\n"),
          lines(1 << 17, "{ "), "uniform float a" + lines(1 << 17, "["),
          lines(1 << 14, "#if 0\n")}) {
        const ReadScene result = read(text + "\n" + kImage);
        EXPECT_EQ(result.scene.has_value(), !has_errors(result.diagnostics));
    }
}

TEST(Include, StandsInPlaceAndKeepsEveryLinesOrigin) {
    const TestFolder folder;
    folder.write("lib/noise.glsl", "float n;\n#include \"hash.glsl\"\nuniform float a; //@ x");
    folder.write("lib/hash.glsl", "float h;\n");
    const auto file =
        folder.write("a.frag", "int one;\n  #include <lib/noise.glsl> // hi\n" + kImage);
    const ReadScene wrong = read_scene(file);
    EXPECT_EQ(wrong.diagnostics.size(), 1u);
    EXPECT_EQ(wrong.diagnostics.at(0).place.file, (folder.path() / "lib/noise.glsl").string());
    EXPECT_EQ(wrong.diagnostics.at(0).place.line, 3);
    EXPECT_EQ(wrong.diagnostics.at(0).place.column, 22);

    folder.write("lib/noise.glsl", "float n;\n#include \"hash.glsl\"\nuniform float a; //@ 1");
    const ReadScene result = read_scene(file);
    ASSERT_TRUE(result.scene) << all(result.diagnostics);
    const Scene& scene = *result.scene;
    EXPECT_EQ(scene.text,
              "int one;\nfloat n;\nfloat h;\n                    \n"
              "uniform float a; //@ 1\n                            // hi\n" +
                  kImage);
    ASSERT_EQ(scene.files.size(), 3u);
    EXPECT_EQ(scene.files[2], folder.path() / "lib/hash.glsl");
    const struct {
        std::size_t file;
        int line;
    } origins[] = {{0, 1}, {1, 1}, {2, 1}, {1, 2}, {1, 3}, {0, 2}, {0, 3}};
    ASSERT_EQ(scene.origins.size(), std::size(origins));
    for (std::size_t i = 0; i < std::size(origins); ++i) {
        EXPECT_EQ(scene.origins[i].file, origins[i].file) << i;
        EXPECT_EQ(scene.origins[i].line, origins[i].line) << i;
    }
    EXPECT_EQ(scene.place(5, 9).file, (folder.path() / "lib/noise.glsl").string());
    EXPECT_EQ(scene.place(5, 9).line, 3);
    EXPECT_EQ(scene.place(5, 9).column, 9);
    EXPECT_EQ(scene.place(999, 1).line, 3);
    EXPECT_EQ(scene.place(0, 0).line, 0);
    const Tweak& tweak = scene.tweaks.at(0);
    EXPECT_EQ(scene.text.substr(tweak.declarations.at(0).begin, 16), "uniform float a;");
}

TEST(Include, ImagesAreNamedFromTheFileThatNamesThem) {
    const TestFolder folder;
    folder.write("lib/wood.glsl", "uniform sampler2D wood; //@ image wood.png\n");
    const ReadScene result =
        read_scene(folder.write("a.frag", "#include \"lib/wood.glsl\"\n" + kImage));
    ASSERT_TRUE(result.scene) << all(result.diagnostics);
    EXPECT_EQ(result.scene->samplers.at(0).files.at(0), folder.path() / "lib/wood.png");
}

TEST(Include, AMissingFileIsReportedWhereItIsNamed) {
    const TestFolder folder;
    folder.write("b.glsl", "int b;\n   #include \"none.glsl\"\n");
    const ReadScene result = read_scene(folder.write("a.frag", "#include \"b.glsl\"\n"));
    EXPECT_FALSE(result.scene);
    ASSERT_EQ(result.diagnostics.size(), 1u) << all(result.diagnostics);
    EXPECT_TRUE(result.diagnostics[0].missing_file);
    EXPECT_EQ(result.diagnostics[0].place.file, (folder.path() / "b.glsl").string());
    EXPECT_EQ(result.diagnostics[0].place.line, 2);
    EXPECT_EQ(result.diagnostics[0].place.column, 4);
    // A reload watches for the missing file too.
    EXPECT_EQ(result.files.size(), 3u);
}

TEST(Branches, ThatAreNotTakenSayNothing) {
    const std::string text =
        "#define IN_SHADERTOY\n"
        "#ifdef NOPE\n#include \"none.glsl\"\nuniform float a; //@ 1\n#endif\n"
        "#ifndef IN_SHADERTOY\n#include \"none.glsl\"\n#endif\n"
        "#ifndef HW_PERFORMANCE\nuniform vec4 iResolution;\n//@ nonsense\n#endif\n"
        "#if __VERSION__ < 300 || defined(IN_SHADERTOY) && 0\nuniform int iTime;\n#endif\n" +
        kImage;
    const Scene scene = good(text);
    EXPECT_EQ(scene.text, text) << "what is not compiled stays as it is";
    EXPECT_TRUE(scene.tweaks.empty());
}

TEST(Branches, OfWhatIsDefinedInAnIncludeAreKnown) {
    const TestFolder folder;
    folder.write("b.glsl", "#ifndef GUARD\n#define GUARD\nuniform float a; //@ 1\n#endif\n");
    const ReadScene result =
        read_scene(folder.write("a.frag",
                                "#include \"b.glsl\"\n#include \"b.glsl\"\n#ifndef GUARD\n#include "
                                "\"none.glsl\"\n#endif\n" +
                                    kImage));
    ASSERT_TRUE(result.scene) << all(result.diagnostics);
    EXPECT_EQ(tweak_names(*result.scene), "a ");
}

TEST(Branches, OfAPassMayBeTaken) {
    const std::string text =
        "uniform sampler2D a; //@ pass mainA\n"
        "#ifdef PASS_a\nuniform sampler2D iChannel0; //@ noise rgba 64\n"
        "void mainImage(out vec4 c, in vec2 f) { c = vec4(1); }\n#else\nuniform float b; //@ 1\n" +
        kImage + "#endif\n";
    const Scene scene = good(text);
    EXPECT_EQ(scene.samplers.at(1).tab, "a");
    EXPECT_EQ(tweak_names(scene), "b ");
}

TEST(Blanked, ArePragmas) {
    const Scene scene = good("#pragma optimize(off);  // fast\n" + kImage);
    EXPECT_EQ(scene.text, "                        // fast\n" + kImage);
}

// A text has to do without those that it enables; one that it requires is not here.
TEST(Blanked, AreExtensions) {
    const std::string text = good(
                                 "#extension GL_OES_standard_derivatives : require\n"
                                 "#extension GL_X : enable\n#extension all : warn\n" +
                                 kImage)
                                 .text;
    EXPECT_EQ(text.find("#extension"), std::string::npos);
    const ReadScene required = read("\n#extension GL_X : require\n" + kImage);
    ASSERT_EQ(required.diagnostics.size(), 1u);
    EXPECT_EQ(required.diagnostics[0].place.line, 2);
    EXPECT_TRUE(required.diagnostics[0].text.starts_with("GL_X is not here"));
}

TEST(Uniforms, MayComeFromMacros) {
    const Scene scene = good("#define KNOB uniform float\nKNOB a; //@ 1\n" + kImage);
    EXPECT_EQ(tweak_names(scene), "a ");
    EXPECT_EQ(scene.text.substr(scene.tweaks.at(0).declarations.at(0).begin, 7), "KNOB a;");
    const ReadScene both =
        read("#define KNOBS uniform float a; uniform float b\nKNOBS; //@ 1\n" + kImage);
    EXPECT_FALSE(both.scene) << "nothing tells which of them is meant";
}

TEST(Include, ACircleIsAnErrorThatNamesIt) {
    const TestFolder folder;
    folder.write("b.glsl", "#include \"c.glsl\"\n");
    folder.write("c.glsl", "\n#include \"./b.glsl\"\n");
    const ReadScene result = read_scene(folder.write("a.frag", "#include \"b.glsl\"\n" + kImage));
    ASSERT_EQ(result.diagnostics.size(), 1u) << all(result.diagnostics);
    EXPECT_EQ(result.diagnostics[0].place.file, (folder.path() / "c.glsl").string());
    EXPECT_EQ(result.diagnostics[0].place.line, 2);
    EXPECT_NE(result.diagnostics[0].text.find("c.glsl -> "), std::string::npos);
}

TEST(Include, TwiceIsTwiceUnlessPragmaOnce) {
    const TestFolder folder;
    const auto file = folder.write("a.frag", "#include \"b\"\n#include \"b\"\n" + kImage);
    folder.write("b", "int b;\n");
    EXPECT_EQ(read_scene(file).scene->origins.size(), 5u);
    folder.write("b", "#pragma once\n#include \"b\"\nuniform float a; //@ 1\n");
    const ReadScene result = read_scene(file);
    ASSERT_TRUE(result.scene) << all(result.diagnostics);
    EXPECT_EQ(result.scene->tweaks.size(), 1u);
    EXPECT_EQ(result.scene->files.size(), 2u);
}

TEST(Include, FilesThatDoubleThemselvesEnd) {
    const TestFolder folder;
    for (int i = 0; i < 30; ++i) {
        const std::string next = "#include \"" + std::to_string(i + 1) + "\"\n";
        folder.write(std::to_string(i), next + next);
    }
    folder.write("30", "");
    const ReadScene result = read_scene(folder.write("a.frag", "#include \"0\"\n" + kImage));
    EXPECT_EQ(result.diagnostics.size(), 1u);
    EXPECT_NE(all(result.diagnostics).find("too many includes"), std::string::npos);
}

TEST(Include, IsReadOnlyWhereItIsOne) {
    const TestFolder folder;
    folder.write("b", "int b;\n");
    folder.write("c//d", "int d;\n");
    const struct {
        const char* text;
        bool expanded;
        bool error;
    } cases[] = {
        {"// #include \"none\"\n", false, false},
        {"/*\n#include \"none\"\n*/\n", false, false},
        {"/*\n*/ #include \"b\" /* x\n */\n", true, false},
        {"#define X \\\n#include \"none\"\n", false, false},
        {"#  include \"b\"\n", true, false},
        {"#include \"c//d\"\n", true, false},
        {"#include \"b\" int x;\n", true, true},
        {"#include\n", false, true},
        {"#include \"\"\n", false, true},
        {"#include \"b\n", false, true},
        {"#include \".\"\n", false, true},
    };
    for (const auto& c : cases) {
        const ReadScene result = read_scene(folder.write("a.frag", c.text + kImage));
        EXPECT_EQ(has_errors(result.diagnostics), c.error) << c.text << all(result.diagnostics);
        if (result.scene) {
            EXPECT_EQ(result.scene->files.size(), c.expanded ? 2u : 1u) << c.text;
            EXPECT_EQ(result.scene->text.find("#include \"b\""), std::string::npos);
        }
    }
}

}  // namespace
}  // namespace glint::text_test
