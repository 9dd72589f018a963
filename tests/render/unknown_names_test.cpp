// What a person is told of a name that nothing declares where it stands.
#include "fixture.h"

namespace glint::unknown_names_test {
namespace {

using UnknownNames = GlTest;

// The only one.
std::string complaint(const std::string& text) {
    const TestFolder folder;
    const ReadPreset read = read_scene_text(folder, text, {});
    if (!read.preset) return to_text(read.diagnostics);
    const Diagnostics list =
        compile_scene(*read.preset, {.root = kImagePass, .program = {}}).diagnostics;
    return list.size() == 1 ? list[0].text : to_text(list);
}

TEST_F(UnknownNames, ThatAreMistypedHaveTheNearest) {
    const std::string text =
        "#define PIXEL 3.0\nuniform float density; //@ 1 \"d\"\n"
        "float turbulence(vec2 p) { return p.x; }\n";
    const std::pair<const char*, const char*> cases[] = {
        {"densty", "`densty' undeclared; did you mean 'density'?"},
        {"itime", "`itime' undeclared; did you mean 'iTime'?"},
        {"PIXL", "`PIXL' undeclared; did you mean 'PIXEL'?"},
        {"turbulense(u)", "no function with name 'turbulense'; did you mean 'turbulence'?"},
        {"nrmalize(u).x", "no function with name 'nrmalize'; did you mean 'normalize'?"},
        {"turbulence", "`turbulence' undeclared; it is a function: call it, turbulence(\u2026)"},
        {"foo", "`foo' undeclared"},
        {"unlikeAnything", "`unlikeAnything' undeclared"},
    };
    for (const auto& [expression, words] : cases) {
        EXPECT_EQ(
            complaint(fmt::format("{}void mainImage(out vec4 c, in vec2 u) {{ for (;;) break; "
                                  "c = vec4({} * density * PIXEL * turbulence(u)); }}\n",
                                  text, expression)),
            words);
    }
}

TEST_F(UnknownNames, ThatHaveEndedWithTheirBlockAreToldOfIt) {
    const char* const scopes[] = {
        "\n{ float glow = 1.0; }\nc = vec4(glow);",
        "float a = 2.0; if (u.x < a) { float b = a,\nglow = b; }\nc = vec4(glow);",
        "\nfor (int glow = 0; glow < 3; ++glow) c.x += 0.1; c = vec4(glow);",
        "\nfor (int glow = 0; glow < 3; ++glow) { c.x += 0.1; } c = vec4(glow);",
        "\nfor (int glow = 0; glow < 3; ++glow) for (int j = 0; j < 2; ++j) c.x += 0.1;\n"
        "c = vec4(glow);",
    };
    const std::string ends =
        "`glow' undeclared; that of line 2 ends with its block: declare it "
        "before, outside";
    for (const std::string scope : scopes)
        EXPECT_EQ(
            complaint("void mainImage(out vec4 c, in vec2 u) { c = vec4(0);" + scope + " }\n"),
            ends)
            << scope;
    for (const char* function : {"float f(float glow) {\nreturn glow; }\n",
                                 "float f(float x) {\nfloat glow = x; return x; }\n"})
        EXPECT_TRUE(complaint(function + std::string("void mainImage(out vec4 c, in vec2 u) { c = "
                                                     "vec4(glow); }\n"))
                        .ends_with("is another function's: hand it over as an argument"))
            << function;
}

TEST_F(UnknownNames, ThatAreMistypedAreNoneThatIsKnownElsewhereAlone) {
    const std::string elsewhere =
        "float first(float shade) { float shape = shade; return shape; }\n";
    EXPECT_EQ(
        complaint(elsewhere + "void mainImage(out vec4 c, in vec2 u) { { float shake = 1.0; } "
                              "c = vec4(shae); }\nfloat last(float shame) { return shame; }\n"),
        "`shae' undeclared");
    EXPECT_EQ(
        complaint(elsewhere + "void mainImage(out vec4 c, in vec2 u) { float shake = 1.0; { for "
                              "(int i = 0; i < 3; ++i) c = vec4(shae); } }\n"),
        "`shae' undeclared; did you mean 'shake'?");
}

TEST_F(UnknownNames, OfStructsAndDirectivesHaveTheNearest) {
    const auto in_image = [](const std::string& statement) {
        return "struct Light { vec3 col; };\nvoid mainImage(out vec4 c, in vec2 u) { Light "
               "lights[2]; "
               "lights[0].col = lights[1].col = vec3(u, 0); c = vec4(1); " +
               statement + " }\n";
    };
    EXPECT_EQ(complaint(in_image("c = vec4(light[0].col, 1);")),
              "`light' undeclared; did you mean 'lights'?");
    EXPECT_EQ(complaint(in_image("Ligth l;")), "'Ligth' is no type; did you mean 'Light'?");
    EXPECT_EQ(complaint(in_image("c.x = dist(u, u);")),
              "no function with name 'dist'; GLSL's is distance");
    EXPECT_EQ(complaint(in_image("for (;;) { if (c.x > 0.0) brek; }")),
              "`brek' undeclared; did you mean 'break'?");
    EXPECT_EQ(complaint("struct S { float x; S next; };\n" + in_image("")),
              "'S' is no type yet: a struct cannot hold itself");
    EXPECT_EQ(complaint("vec3 f(vec2 p) { retrun vec3(p, 1); }\n" + in_image("")),
              "'retrun' is no word of GLSL; did you mean 'return'?");
    const std::string illegal = "Illegal non-directive after #; ";
    EXPECT_EQ(complaint("#iuniform float k = 1.0\n" + in_image("")),
              illegal + "did you mean 'iUniform'?");
    EXPECT_EQ(complaint("#iChannel5 \"self\"\n" + in_image("")),
              illegal + "there are four channels, iChannel0 to iChannel3");
}

// The only complaint of a picture with these statements, below these lines.
std::string complaint_of(const std::string& statements, const std::string& above = "") {
    return complaint(above + "void mainImage(out vec4 c, in vec2 p) { c = vec4(0); " + statements +
                     " }\n");
}

TEST_F(UnknownNames, BehindAnIfTellWhatAPreprocessorKnows) {
    const std::string begins = "undefined macro QUALITY in expression (illegal in GLES); ",
                      condition = "#if QUALITY > 1\n#endif\n";
    EXPECT_EQ(complaint_of("", condition),
              begins + "write #define QUALITY 0 above, or #if defined(QUALITY)");
    EXPECT_EQ(complaint_of("", "#define QUALTY 1\n" + condition),
              begins + "did you mean 'QUALTY'?");
    EXPECT_EQ(
        complaint_of("c.x = float(QUALITY);", "uniform int QUALITY;  //@ 1 [0, 2]\n" + condition),
        begins +
            "a preprocessor knows macros alone: of a variable or a uniform write if "
            "(\u2026)");
    for (const char* wrong :
         {"#ifndef A\n#if 1.0\n#endif\n#endif\n", "#ifdef A\n#elif 1 ? 2 : 3\n#endif\n"})
        EXPECT_TRUE(complaint_of("", wrong).starts_with("this is not expected here")) << wrong;
}

TEST_F(UnknownNames, OfKeysTellTheLineThatHasThem) {
    const std::string help = "; a line '#iKeyboard' above has it, as VS Code's Shader Toy does";
    EXPECT_EQ(complaint_of("if (isKeyDown(65)) c.x = 1.0;"),
              "no function with name 'isKeyDown'" + help);
    EXPECT_EQ(complaint_of("int key = Key_A;"), "`Key_A' undeclared" + help);
}

TEST_F(UnknownNames, ThatAreDeclaredTwiceTellOfTheFirst) {
    const std::string help =
        "; line 1 declares it: give this one another name, or leave out its "
        "type";
    EXPECT_EQ(complaint_of("float a = 1.0; float a = 2.0;"), "`a' redeclared" + help);
    EXPECT_EQ(complaint_of("", "float f(float x) { float x = 1.0; return x; }\n"),
              "`x' redeclared" + help);
}

TEST_F(UnknownNames, OfOtherLanguagesMethodsTellTheFunction) {
    const std::string above = "uniform sampler2D wood;  //@ noise r 4x4\n";
    EXPECT_EQ(complaint_of("c = wood.Sample(s, p);", above),
              "GLSL has no methods; write texture(\u2026) of what stands before the '.'");
}

TEST_F(UnknownNames, AreNotToldOfWhereTheirDeclarationIsRefused) {
    EXPECT_EQ(complaint_of("float q[2]; q[0] = 1.0; q[1] = 1.0; c.x = f(q);",
                           "float f(float a[]) { return a[0]; }\n"),
              "arrays passed as parameters must have a declared size, such as float a[4]");
    EXPECT_EQ(complaint_of("", "#define 2D(p) p.xy\n"),
              "a macro's name begins with a letter or _; '2D(p)' does not");
    EXPECT_EQ(complaint_of("5 = c.x;"), "what stands left of this '=' is no variable");
}

TEST_F(UnknownNames, OfAMacroWithACommaForAPointAreSaidSo) {
    const std::string told = complaint_of("c.x = sin(PI * p.x);", "#define PI 3,14\n");
    EXPECT_TRUE(told.ends_with(":1:14); numbers have a point: write 3.14")) << told;
}

}  // namespace
}  // namespace glint::unknown_names_test
