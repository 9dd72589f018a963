// What the driver says about a text, at the user's own lines and columns.
#include "fixture.h"
#include "render/driver_log.h"

#include <unistd.h>

namespace glint::diagnostics_test {
namespace {

using Complaints = GlTest;

// The diagnostics of a text that may not compile.
Diagnostics complaints(const std::string& text, PlayerOptions options = {}) {
    const TestFolder folder;
    const ReadPreset read = read_scene_text(folder, text, options);
    if (!read.preset) return read.diagnostics;
    return compile_scene(*read.preset,
                         {.root = kImagePass, .program = {.specialise = options.specialise}})
        .diagnostics;
}

const Diagnostic* first_error(const Diagnostics& list) {
    for (const Diagnostic& d : list) {
        if (d.severity == Severity::error) return &d;
    }
    return nullptr;
}

// Passes behind the picture are read by the driver without what they do not call.
TEST_F(Complaints, AreToldOfFunctionsThatNoPassCalls) {
    const std::string passes =
        "uniform sampler2D grain; //@ pass mainGrain\n"
        "void mainGrain(out vec4 c, in vec2 p) { c = vec4(1); }\n"
        "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(grain, ivec2(p), 0); }\n";
    const std::string function = "float idle() { return undeclared; }\n";
    for (const std::string& text :
         {passes + function, passes + "#ifdef PASS_grain\n" + function + "#endif\n"}) {
        const Diagnostics list = complaints(text);
        const Diagnostic* error = first_error(list);
        ASSERT_TRUE(error) << text;
        EXPECT_EQ(error->place.column, 23) << to_text(list);
    }
    EXPECT_TRUE(complaints(passes).empty());
}

TEST_F(Complaints, StandAtTheUsersLineAndColumn) {
    const std::string body = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n";
    struct {
        const char* what;
        std::string text;
        int line, column;
    } const cases[] = {
        {"first line", "float f = undeclared;\n" + body, 1, 11},
        {"last line", body + "float f = undeclared;", 2, 11},
        {"behind tweaks",
         "uniform float a; //@ 1\nuniform\nvec3 b; //@ 1, 2, 3\n\nfloat f = undeclared;\n" + body,
         5, 11},
        {"behind blank lines", "\n\n\r\n  float f = undeclared;\n" + body, 4, 13},
        {"behind the entry's out on its line",
         "void mainImage(out vec4 c, in vec2 p) { c = undeclared; }\n", 1, 45},
        {"behind a zero on its line",
         "void mainImage(out vec4 c, in vec2 p) { float x, y[2]; c = vec4(x + y[1]) + undeclared; "
         "}\n",
         1, 77},
        {"between zeros",
         "/* größer */ float g; void mainImage(out vec4 c, in vec2 p) { float x; c += g + "
         "undeclared "
         "+ x; }\n",
         1, 81},
        {"behind a macro that was written out",
         "#define VARIABLES(t) t a; t b;\n"
         "void mainImage(out vec4 c, in vec2 p) { VARIABLES(\nfloat) c = vec4(a + b, undeclared); "
         "}\n",
         3, 24},
        {"before it", "float g = undeclared; " + body, 1, 11},
        {"of a macro that is none", "#if 1 && TAU_ \n#endif\n" + body, 1, 10},
        {"in a syntax error", body + "\nfloat f() {\n    return 1.0 +;\n}\n", 4, 17},
        {"behind host uniforms of its own",
         "uniform float iTime;\nuniform vec3 iResolution;\nfloat f = undeclared;\n" + body, 3, 11},
        {"behind a version",
         "#version 300 es\nprecision highp float;\nfloat f = undeclared;\n" + body, 3, 11},
    };
    for (const auto& c : cases) {
        for (const bool specialise : {false, true}) {
            SCOPED_TRACE(fmt::format("{} {}", c.what, specialise));
            const Diagnostics list = complaints(c.text, {.specialise = specialise});
            const Diagnostic* error = first_error(list);
            ASSERT_TRUE(error) << to_text(list);
            EXPECT_EQ(error->place.line, c.line) << to_text(list);
            EXPECT_EQ(error->place.column, c.column) << to_text(list);
            EXPECT_TRUE(error->place.file.ends_with("scene.frag"));
        }
    }
}

TEST_F(Complaints, StandBehindMacrosAtTheUsersColumn) {
    const std::string macros =
        "#define TWICE(x) (x   +  x)\n#define A  TWICE(1.0) /* a */ + nowhere\n";
    struct {
        const char* what;
        std::string text;
        int line, column;
        const char* words;
    } const cases[] = {
        {"behind a use", "float f =  TWICE( 2.0 )  + undeclared;\n", 3, 28,
         "`undeclared' undeclared"},
        {"in an argument", "float f = TWICE(undeclared);\n", 3, 17, "`undeclared' undeclared"},
        {"in a definition", "  float f = A;\n", 3, 13, "(in what A stands for, "},
        {"in a definition behind its argument",
         "#define DOUBLED(x) \\\n    x * 2\nfloat f = DOUBLED(1.0);\n", 5, 19,
         "(in what DOUBLED stands for, "},
        {"behind an argument that ends a line", "float f = TWICE(1.0\n) + undeclared;\n", 4, 5,
         "`undeclared' undeclared"},
        {"lines below", "float g = TWICE(\n1.0);\n\nfloat f = undeclared;\n", 6, 11,
         "`undeclared' undeclared"},
        {"on a joined line", "float f = \\\n  undeclared;\n", 4, 3, "`undeclared' undeclared"},
        {"below a joined line", "float g = \\\n\\\n1.0;\nfloat f = undeclared;\n", 6, 11,
         "`undeclared' undeclared"},
        {"behind a macro that ends in a comment",
         "#define PI 3.14 // circle\nfloat f = PI+PI * PI + undeclared;\n", 4, 24,
         "`undeclared' undeclared"},
        {"behind one within another",
         "#define PI 3.14 /* circle */\n#define TAU (2.0*PI)\nfloat f = TAU + undeclared;\n", 5, 17,
         "`undeclared' undeclared"},
        {"behind macros without words",
         "#define E\n#define N(x)\nE float f = 1.0 E + N(2) undeclared;\n", 5, 26,
         "`undeclared' undeclared"},
        {"behind a macro at the line's beginning",
         "#define LONG float a = 1.0 + 2.0, b = 3.0\n  LONG; float f = undeclared;\n", 4, 19,
         "`undeclared' undeclared"},
        {"behind a comment that began on another line",
         "float g = 1.0; /* a\nb */ float f = undeclared;\n", 4, 16, "`undeclared' undeclared"},
        {"behind comments", "/* \xC3\xA4 */ float f = TWICE(1.)/**/+ undeclared;\n", 3, 34,
         "`undeclared' undeclared"},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.what);
        const Diagnostics list = complaints(
            macros + c.text + "void mainImage(out vec4 c, in vec2 p) { c = vec4(f); }\n");
        const Diagnostic* error = first_error(list);
        ASSERT_TRUE(error) << to_text(list);
        EXPECT_EQ(error->place.line, c.line) << to_text(list);
        EXPECT_EQ(error->place.column, c.column) << to_text(list);
        EXPECT_NE(error->text.find(c.words), std::string::npos) << to_text(list);
    }
    const Diagnostics list =
        complaints(macros + "float f = A;\n" + "void mainImage(out vec4 c, in vec2 p) {}\n");
    ASSERT_TRUE(first_error(list));
    EXPECT_NE(first_error(list)->text.find("scene.frag:2:33)"), std::string::npos) << to_text(list);
}

TEST_F(Complaints, NameTheIncludedFile) {
    const std::string scene =
        "// one\n#include \"lib.glsl\"\nfloat g() { return f(); }\n"
        "void mainImage(out vec4 c, vec2 p) { c = vec4(g()); }\n";
    const Diagnostics in_include =
        complaints(scene, {.files = {{"lib.glsl", "// lib\nfloat f() { return nowhere; }\n"}}});
    const Diagnostic* error = first_error(in_include);
    ASSERT_TRUE(error);
    EXPECT_TRUE(error->place.file.ends_with("lib.glsl")) << to_text(in_include);
    EXPECT_EQ(error->place.line, 2);

    const Diagnostics behind =
        complaints(scene + "float h = nowhere;\n",
                   {.files = {{"lib.glsl", "// lib\n\n\nfloat f() { return 1.0; }\n"}}});
    error = first_error(behind);
    ASSERT_TRUE(error);
    EXPECT_TRUE(error->place.file.ends_with("scene.frag")) << to_text(behind);
    EXPECT_EQ(error->place.line, 5);
}

TEST_F(Complaints, StandInTheTabThatHasTheMistake) {
    const std::string text =
        "uniform sampler2D a; //@ pass mainA\n"
        "#ifdef PASS_a\n"
        "void mainImage(out vec4 c, vec2 p) { c = nowhere; }\n"
        "#endif\n"
        "#ifdef PASS_image\n"
        "void mainImage(out vec4 c, vec2 p) { c = texture(a, p); }\n"
        "#endif\n";
    const Diagnostics list = complaints(text);
    const Diagnostic* error = first_error(list);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->place.line, 3) << to_text(list);
}

TEST_F(Complaints, SayInWordsWhatIsMissingAtLinking) {
    const std::string text =
        "uniform sampler2D a; //@ pass mainA\n"
        "#ifdef PASS_a\nvoid mainImage(out vec4 c, vec2 p) { c = vec4(1); }\n#endif\n";
    const Diagnostics list = complaints(text);
    const Diagnostic* error = first_error(list);
    ASSERT_TRUE(error);
    EXPECT_NE(error->text.find("void mainImage(out vec4 fragColor, in vec2 fragCoord)"),
              std::string::npos)
        << error->text;
    EXPECT_TRUE(error->place.file.ends_with("scene.frag"));

    const Diagnostics declared_only =
        complaints("float f(float x);\nvoid mainImage(out vec4 c, vec2 p) { c = vec4(f(p.x)); }\n");
    ASSERT_TRUE(first_error(declared_only));
    EXPECT_TRUE(
        to_string(*first_error(declared_only))
            .ends_with(
                "scene.frag:1:7: error: f is declared and called, but has no body; write one"))
        << to_text(declared_only);
}

// Mesa says it of line 0.
TEST_F(Complaints, OfARecursionStandAtTheFunction) {
    const Diagnostics list = complaints(
        "float g(float x);\nfloat f(float x) { return x < 1.0 ? x : g(x - 1.0); }\n"
        "float g(float x) { return f(x); }\n"
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(f(p.x)); }\n");
    const Diagnostic* error = first_error(list);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->place.line, error->text.starts_with("f ") ? 2 : 1) << to_text(list);
    EXPECT_EQ(error->place.column, 7) << to_text(list);
    EXPECT_NE(error->text.find("GLSL has no recursion"), std::string::npos) << to_text(list);
}

TEST_F(Complaints, TellOfMoreOutputsThanAPassCanFill) {
    for (const int count : {8, 9}) {
        std::string samplers, outputs, writes;
        for (int i = 0; i < count; ++i) {
            samplers += fmt::format("uniform sampler2D b{}; //@ pass mainB\n", i);
            outputs += fmt::format("out vec4 c{}, ", i);
            writes += fmt::format("c{0} = vec4({0}); ", i);
        }
        const Diagnostics list =
            complaints(fmt::format("{}void mainB({}vec2 p) {{ {} }}\n"
                                   "void mainImage(out vec4 c, vec2 p) {{ c = texture(b7, p); }}\n",
                                   samplers, outputs, writes));
        ASSERT_EQ(has_errors(list), count == 9) << to_text(list);
        if (count == 9) {
            EXPECT_EQ(first_error(list)->place.line, 9);
        }
    }
}

TEST_F(Complaints, TellWhereMoreSamplersThanAPassHasAreDeclared) {
    std::string declared, read;
    for (int i = 0; i < 200; ++i) {
        declared += fmt::format("uniform sampler2D s{}; //@ noise rgba 4\n", i);
        read += fmt::format(" + texture(s{}, p)", i);
    }
    const Diagnostics list =
        complaints(declared + "void mainImage(out vec4 c, vec2 p) { c = vec4(0)" + read + "; }\n");
    ASSERT_TRUE(has_errors(list));
    EXPECT_EQ(first_error(list)->place.line, 200) << to_text(list);
}

TEST_F(Complaints, OfAnEmptyChannelStandWhereItsPassReadsIt) {
    const std::string read =
        "void mainImage(out vec4 c, in vec2 p) { c = texture(iChannel0, p); }\n";
    struct {
        const char* what;
        std::string text;
        int line, column;  // 0: nothing is said
    } const cases[] = {
        {"read", read, 1, 53},
        {"behind a comment that names it", "// iChannel0 is wood\n" + read, 2, 53},
        {"declared and not filled", "uniform sampler2D iChannel0;\n" + read, 2, 53},
        {"behind a macro that nobody uses", "#define TEX iChannel0\n" + read, 2, 53},
        {"called by a macro",
         "#define TEX iChannel0\nvoid mainImage(out vec4 c, in vec2 p) { c = texture(TEX, p); }\n",
         2, 53},
        {"as the struct of its channel",
         "void mainImage(out vec4 c, in vec2 p) { c = texture(iCh0.sampler, p); }\n", 1, 53},
        {"never read", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n", 0, 0},
        {"read by what nobody calls",
         "vec4 f() { return texture(iChannel0, vec2(0)); }\n"
         "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n",
         0, 0},
        {"filled", "uniform sampler2D iChannel0; //@ noise 8\n" + read, 0, 0},
        {"filled in one tab and not in the other",
         "uniform sampler2D bufferA; //@ pass mainBufferA\n"
         "#ifdef PASS_bufferA\nuniform sampler2D iChannel0; //@ noise 8\n" +
             read +
             "#endif\n#ifdef PASS_image\nuniform sampler2D iChannel1; //@ buffer bufferA\n"
             "void mainImage(out vec4 c, in vec2 p) {\n"
             "    c = texture(iChannel0, p) + texture(iChannel1, p);\n}\n#endif\n",
         9, 17},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.what);
        const Diagnostics list = complaints(c.text);
        if (c.line == 0) {
            EXPECT_TRUE(list.empty()) << to_text(list);
            continue;
        }
        ASSERT_EQ(list.size(), 1u) << to_text(list);
        EXPECT_EQ(list[0].severity, Severity::warning);
        EXPECT_EQ(list[0].place.line, c.line) << to_text(list);
        EXPECT_EQ(list[0].place.column, c.column) << to_text(list);
        EXPECT_TRUE(list[0].text.starts_with("nothing fills iChannel0, which is read here"))
            << to_text(list);
    }
}

// Mesa lists each texture() that there is.
TEST_F(Complaints, OfACallNameTheFunctionsOfItsSamplerAlone) {
    const Diagnostics list = complaints(
        "void mainImage(out vec4 c, in vec2 p) {\n    c = texture(iChannel0, vec3(p, 0));\n"
        "    c += texture(iChannel0, p);\n}\n");
    ASSERT_FALSE(list.empty());
    EXPECT_EQ(list[0].place.line, 2) << to_text(list);
    EXPECT_EQ(list[0].text,
              "no matching function for call to `texture(sampler2D, vec3)'; candidates are:\n"
              "    vec4 texture(sampler2D, vec2)\n    vec4 texture(sampler2D, vec2, float)");
    EXPECT_LE(list.size(), 2u) << to_text(list);
    // Where none takes what the call gives first, all are told.
    const Diagnostics others = complaints(
        "float f(vec2 p) { return p.x; }\nfloat f(vec3 p) { return p.x; }\n"
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(f(mat2(1))); }\n");
    ASSERT_FALSE(others.empty());
    EXPECT_TRUE(others[0].text.ends_with("candidates are:\n    float f(vec2)\n    float f(vec3)"))
        << to_text(others);
}

TEST_F(Complaints, OfACallWithinAMacroAreOneError) {
    const Diagnostics unknown = complaints(
        "#define BIGGER(a, b) max(a, b)\nvoid mainImage(out vec4 c, in vec2 p) {\n"
        "    c = vec4(BIGGER(0.1, nothing));\n}\n");
    ASSERT_EQ(unknown.size(), 1u) << to_text(unknown);
    EXPECT_EQ(unknown[0].place.line, 3);
    const Diagnostics none = complaints(
        "#define S(a, b, c) smoothstep(a, b, c)\nvoid mainImage(out vec4 c, in vec2 p) {\n"
        "    c = vec4(S(0.1, p, 0.2));\n}\n");
    ASSERT_EQ(none.size(), 1u) << to_text(none);
    EXPECT_NE(none[0].text.find("(in what S stands for, "), std::string::npos) << none[0].text;
    EXPECT_NE(none[0].text.find("candidates are:\n    float smoothstep(float, float, float)\n"),
              std::string::npos)
        << none[0].text;
}

TEST_F(Complaints, OfAnArgumentOnALineOfItsOwnStandThere) {
    const Diagnostics macro = complaints(
        "#define SUM(a, b) (a + b)\nvoid mainImage(out vec4 c, in vec2 p) {\n"
        "    c = vec4(SUM(0.1,\n        nothing));\n}\n");
    ASSERT_EQ(macro.size(), 1u) << to_text(macro);
    EXPECT_EQ(macro[0].place.line, 4) << to_text(macro);
    EXPECT_EQ(macro[0].place.column, 9) << to_text(macro);
    // What encloses it begins a line earlier, and fails for its sake alone.
    const Diagnostics call = complaints(
        "void mainImage(out vec4 c, in vec2 p) {\n    c = vec4(max(0.1,\n        nothing));\n}\n");
    ASSERT_EQ(call.size(), 1u) << to_text(call);
    EXPECT_EQ(call[0].place.line, 3) << to_text(call);
}

TEST_F(Complaints, MeanOnlyNamesThatAreThere) {
    const struct {
        std::string code, meant;  // "": nothing is as near
    } cases[] = {
        {"c = vec4(densty);", "density"},
        {"c = vec4(iTme);", "iTime"},
        {"c = vec4(colour);", ""},  // `color` is the host's
        {"c = vec4(light);", ""},   // as is `highp`
        {"c = vec4(y);", ""},       // any letter is as near
        {"c = vec4(bad1 + bad2);", ""},
    };
    for (const auto& c : cases) {
        const Diagnostics list = complaints(
            "precision highp float;\nfloat density = 1.0;\n"
            "void mainImage(out vec4 c, in vec2 p) { " +
            c.code + " }\n");
        ASSERT_FALSE(list.empty()) << c.code;
        const std::string words = "; did you mean '" + c.meant;
        EXPECT_EQ(list[0].text.find(words.substr(0, c.meant.empty() ? 14 : words.npos)) !=
                      std::string::npos,
                  !c.meant.empty())
            << to_text(list);
    }
}

TEST_F(Complaints, ComeOnceHoweverManyPassesShareTheText) {
    // Of a text that its cache on disk has, Mesa does not warn: this one is new each time.
    const Diagnostics list =
        complaints(fmt::format("const int kNew = {};\n", ::getpid()) +
                   "uniform sampler2D a; //@ pass mainA\n"
                   "uniform sampler2D b; //@ pass mainB\n"
                   "float half_used() { return float(4294967295) + float(kNew); }\n"
                   "void mainA(out vec4 c, vec2 p) { c = vec4(half_used()); }\n"
                   "void mainB(out vec4 c, vec2 p) { c = texture(a, p) + half_used(); }\n"
                   "void mainImage(out vec4 c, vec2 p) { c = texture(b, p) + half_used(); }\n");
    for (std::size_t i = 0; i < list.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) EXPECT_NE(to_string(list[i]), to_string(list[k]));
    }
    EXPECT_FALSE(has_errors(list)) << to_text(list);
    EXPECT_FALSE(list.empty()) << "a warning was meant to be told";
}

TEST_F(Complaints, OfATextThatDoesNotCompileLeaveTheContextWell) {
    EXPECT_TRUE(has_errors(complaints("void mainImage(out vec4 c, vec2 p) { c = nowhere; }")));
    EXPECT_NO_THROW(shared_context.context->finish());
    EXPECT_EQ(colour_of("0.5"), glm::vec3(0.5));
}

// A name that is not known leaves all that takes it without a type; it alone is to be mended.
TEST_F(Complaints, DoNotRepeatThemselvesForEachExpressionAroundAMistake) {
    struct {
        const char* statement;
        std::vector<std::string> words;  // of the complaints, in order
    } const cases[] = {
        {"p = 2.0 * sin(unknown * p - 1.0);", {"`unknown' undeclared"}},
        {"p = vec3(1.0, unknown, 2.0) * 2.0;", {"`unknown' undeclared"}},
        {"p = mix(p, clamp(unknown, 0.0, 1.0), 0.5);", {"`unknown' undeclared"}},
        {"if (unknown > 1.0) p = other ? p : -p;", {"`unknown' undeclared", "`other' undeclared"}},
        {"for (int i = 0; i < unknown; ++i) p += 1.0;", {"`unknown' undeclared"}},
        {"p = unknown(p).xyz + 1.0;", {"no function with name 'unknown'"}},
        {"p = p.xyq + 1.0;", {"invalid swizzle"}},
        {"unknown = 3.0;", {"`unknown' undeclared"}},
        {"int n = 1; p = unknown + 1.0; n = 2.0;",
         {"`unknown' undeclared", "value of type float cannot be assigned"}},
        {"p = -true + vec3(unknown);", {"operands to arithmetic", "`unknown' undeclared"}},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.statement);
        const Diagnostics list =
            complaints(fmt::format("void mainImage(out vec4 c, in vec2 u) {{\n    vec3 p = "
                                   "vec3(u, 1);\n    {}\n    c = vec4(p, 1);\n}}\n",
                                   c.statement));
        ASSERT_EQ(list.size(), c.words.size()) << to_text(list);
        for (std::size_t i = 0; i < list.size(); ++i)
            EXPECT_TRUE(list[i].text.starts_with(c.words[i])) << to_text(list);
    }
}

// What the driver read: a prologue of ten lines, and four of a scene, each of sixty characters.
PassText fourteen_lines() {
    PassText text;
    for (int line = 0; line < 14; ++line) {
        if (line == 10) text.user_begin = text.text.size();
        text.text += std::string(60, 'x') + "\n";
    }
    text.user_end = text.text.size();
    return text;
}

// That scene; its second and third lines are included.
Scene four_lines() {
    Scene scene;
    scene.files = {"wave.frag", "lib.glsl"};
    for (int line = 0; line < 4; ++line) scene.text += std::string(60, 'x') + "\n";
    scene.origins = {{0, 1}, {1, 1}, {1, 2}, {0, 3}};
    return scene;
}

TEST(DriverLog, OfEachDriverIsRead) {
    struct {
        const char* driver;
        const char* log;
        std::vector<std::string> expected;
    } const cases[] = {
        {"Mesa 22.3",
         "0:11(13): error: `undeclared' undeclared\n"
         "0:12(7): warning: `x' used uninitialized\n"
         "0:13(9): warning: comparison of something\n"
         "0:14(2): preprocessor error: #if with undefined name\n",
         {"wave.frag:1:13: error: `undeclared' undeclared",
          "lib.glsl:2:9: warning: comparison of something",
          "wave.frag:3:2: error: #if with undefined name"}},
        {"Mesa, of a text that compiles",
         "0:12(7): warning: `x' used uninitialized\n",
         {"lib.glsl:1:7: warning: `x' used uninitialized"}},
        {"Mesa, at linking",
         "error: unresolved reference to function `helper'\n",
         {"wave.frag: error: helper is declared and called, but has no body; write one"}},
        {"NVIDIA 535",
         "0(13) : error C1503: undefined variable \"undeclared\"\n"
         "0(14) : warning C7050: \"x\" might be used before being initialized\n",
         {"lib.glsl:2: error: `undeclared' undeclared",
          "wave.frag:3: warning: \"x\" might be used before being initialized"}},
        {"NVIDIA, at linking",
         "Fragment info\n-------------\n0(11) : error C3002: call to undefined function \"float "
         "helper(float);\"\n",
         {"wave.frag: error: helper is declared and called, but has no body; write one"}},
        {"ANGLE",
         "ERROR: 0:11: 'undeclared' : undeclared identifier\n"
         "WARNING: 0:13: 'x' : used before set\n\n",
         {"wave.frag:1: error: 'undeclared' : undeclared identifier",
          "lib.glsl:2: warning: 'x' : used before set"}},
        {"Intel on Windows",
         "ERROR: 0:14: 'undeclared' : undeclared identifier \r\n"
         "ERROR: 0:14: '' : compilation terminated \r\n"
         "ERROR: 2 compilation errors.  No code generated.\r\n\r\n",
         {"wave.frag:3: error: 'undeclared' : undeclared identifier",
          "wave.frag:3: error: '' : compilation terminated"}},
        {"AMD on Windows",
         "Fragment shader failed to compile with the following errors:\n"
         "ERROR: 0:12: error(#143) Undeclared identifier: undeclared\n"
         "ERROR: error(#273) 1 compilation errors.  No code generated\n",
         {"lib.glsl:1: error: error(#143) Undeclared identifier: undeclared"}},
        {"none", "", {}},
        {"chatter", "\n\nSuccess.\nVertex shader(s) linked.\n", {}},
        {"numbers beyond all lines",
         "0:99999999999999999999(1): error: far\n0:3(1): error: in the prologue\n",
         {"wave.frag:3:1: error: far", "wave.frag: error: in the prologue"}},
    };
    for (const auto& c : cases) {
        SCOPED_TRACE(c.driver);
        std::vector<std::string> read;
        for (const Diagnostic& d : read_driver_log(four_lines(), c.log, fourteen_lines())) {
            read.push_back(to_string(d));
        }
        EXPECT_EQ(read, c.expected);
    }
}

TEST(DriverLog, ColumnsForgetWhatTheHostInserted) {
    PassText text = fourteen_lines();
    for (const std::size_t column : {29u, 15u}) text.text.insert(text.user_begin + column, "in");
    text.user_end += 4;
    text.map.pieces = {
        {0, 0, false}, {15, 15, true}, {17, 15, false}, {31, 29, true}, {33, 29, false}};
    struct {
        int line, column, expected;
    } const cases[] = {{11, 5, 5}, {11, 16, 16}, {11, 20, 18}, {11, 40, 36}, {12, 40, 40}};
    for (const auto& c : cases) {
        const std::string log = fmt::format("0:{}({}): error: x\n", c.line, c.column);
        const Diagnostics list = read_driver_log(four_lines(), log, text);
        ASSERT_EQ(list.size(), 1u);
        EXPECT_EQ(list[0].place.column, c.expected);
    }
}

TEST_F(Complaints, SayWhatToDo) {
    const auto told = [](const std::string& statement, const std::string& below = "") {
        return to_text(complaints("void mainImage(out vec4 c, in vec2 p) { c = vec4(1); " +
                                  statement + " }\n" + below));
    };
    const std::pair<std::string, const char*> cases[] = {
        {told("float x = 1;"), "; GLSL ES makes no int a float by itself: write 1.0 for 1"},
        {told("c.x = max(0, p.x);"),
         "max(int, float)'; GLSL ES makes no int a float by itself: write 2.0 for 2, or float(i); "
         "candidates are:"},
        {told("c *= p.x * 2;"), "; GLSL ES makes no int a float by itself: write 2.0 for 2"},
        {told("c.x = float(uint(p.x) ^ 61);"), "makes no int a uint by itself: write 2u for 2"},
        {told("uint i = 3;"), "; write 1u for 1, or uint(i)"},
        {told("c.x = 1f;"), "'1f' is no number of GLSL; write 1.0"},
        {told("int i = 09;"), "a leading 0 means octal: write 9"},
        {told("int i = p.x;"), "; write int(x)"},
        {told("c.x = p.x % 2.0;"), "; of floats mod(a, b) is left"},
        {told("", "varying vec2 uv;\n"), "; nothing feeds it, for no vertices stand before"},
        {told("c.x = lerp(0.0, 1.0, 0.5);"), "'lerp'; GLSL's is mix"},
        {told("bool b = True;"), "`True' undeclared; GLSL's is true"},
        {told("float a = None;"), "`None' undeclared; GLSL has no empty value"},
        {told("float a = flaot(1);"), "'flaot'; did you mean 'float'?"},
        {told("c.x = p.length();"), "how long a vector is tells length(v)"},
        {told("c.xy = p.normalize();"), "GLSL has no methods; write normalize("},
        {told("\n#define sq (x) ((x) * (x))\nc.x = sq(0.5);"),
         "3:7: error: this is no function: the macro sq takes no arguments, for"},
        {told("", "#if 0\n#elsif 1\n#endif\n"), "3:1: error: '#elsif' is no directive"},
        {told("", "#define A 1\n#undef A;\n"), "3:9: error: the line's end is expected here"},
        {told("", "float k = 1.0 / iTime;\n"), "constant expression; give it its value in a"},
        {told("float a = Math; a = Math;"), "`Math' undeclared"},
        {told("float distance = 1.0; c.x = distance(p, p);"),
         "distance(vec2, vec2)'; a variable of that name hides the function here"},
        {told("c = texture(p, p);"), "; its first argument has to be a sampler, such as iChannel0"},
        {told("gl_FragColor = c;"), "; a mainImage writes its first parameter"},
        {told("vec2 q = p / iResolution;"),
         "; iResolution has three numbers: write iResolution.xy"},
        {told("float s = sin;"), "`sin' undeclared; it is a function: call it, sin("},
        {told("bool b = p.x &lt; 1.0;"), "where &lt; stands for < in what was copied, write that"},
        {told("", "<br>\n"), "2:1: error: outside of functions only declarations stand; take"},
        {told("", "void f(float x);\n{ x = 1.0; }\n"),
         "2:16: error: this ';' ends the function before its body; take it out"},
        {told("c.x = PI * 2.0;\n}\n#define PI 3.14;\nvoid f() {"), "`PI' undeclared"},
        {told("", "int mod(int a, int b) { return a; }\n"),
         "built-in function `mod' in GLSL ES 3.00; give yours another name"},
        {told("c.x = later(0.5);", "float later(float x) { return x; }\n"),
         "'later'; it stands below, and GLSL reads in order: move it up"},
        {told("c.x = kLater;", "const float kLater = 1.0, kLast = 2.0;\n"),
         "`kLater' undeclared; it stands below, and GLSL reads in order: move it up"}};
    for (const auto& [text, advice] : cases) EXPECT_NE(text.find(advice), text.npos) << text;
    const auto lines = [](const std::string& text) { return std::ranges::count(text, '\n'); };
    for (const char* statement :
         {"for (i = 0; i < 9; i++) c.x += 1.0;", "if (foo == 1.0 || !foo) c.x = 1.0;",
          "float a = foo > 1.0 ? foo : 2.0;", "const float k = foo; c.x = k;",
          "switch (foo) { case 1: break; }", "float a[2] = float[2](foo, 1.0);",
          "sampler2D s = iChannel0;", "float d; vec2 d;", "c.x = sampel(sampel(p.x));",
          "int n = 2; float a[n]; a[n] = a[0];",
          "\n#define M(x) ((x) * 2)\nc.xy = vec2(M(p.x), M(p.y));"})
        EXPECT_EQ(lines(told(statement)), 1) << told(statement) << "is one mistake";
    // A parameter of another function is none of this one's.
    const std::string other = told("c.x = inner;", "float f(float inner) { return inner; }\n");
    EXPECT_EQ(other.find("stands below"), other.npos) << other;
}

}  // namespace
}  // namespace glint::diagnostics_test
