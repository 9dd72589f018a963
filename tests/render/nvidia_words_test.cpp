// What NVIDIA's driver 580.159 said of these texts, with a line and no column, as a person is told
// it.
#include "fixture.h"
#include "render/driver_log.h"

namespace glint::nvidia_words_test {
namespace {

// Of a complaint about a line of the text.
std::string told(const std::string& text, int line, const std::string& words) {
    const TestFolder folder;
    const ReadPreset read = read_scene_text(folder, text, {});
    const PassText source = pass_text(*read.preset, kImagePass, {});
    const auto user = source.text.begin() + static_cast<std::ptrdiff_t>(source.user_begin);
    const auto before = std::count(source.text.begin(), user, '\n');
    const Diagnostics list = read_driver_log(
        read.preset->scene,
        words.empty() ? "" : fmt::format("0({}) : error C0000: {}\n", before + line, words),
        source);
    if (list.empty()) return "";
    const Place& place = list.front().place;
    return fmt::format("{}:{}: {}", place.line, place.column, list.front().text);
}

std::string in_image(const std::string& statements) {
    return "void mainImage(out vec4 c, in vec2 p) {\n" + statements + "\nc = vec4(1);\n}\n";
}

TEST(NvidiaWords, OfNamesHaveTheirColumnAndTheNearest) {
    EXPECT_EQ(told(in_image("c.x = 2.0 * densty;"), 2, "undefined variable \"densty\""),
              "2:13: `densty' undeclared");
    EXPECT_EQ(told("float density = 1.0;\n" + in_image("c.x = densty;"), 3,
                   "undefined variable \"densty\""),
              "3:7: `densty' undeclared; did you mean 'density'?");
    EXPECT_EQ(told(in_image("c.x = nrmalize(p).x;"), 2, "undefined variable \"nrmalize\""),
              "2:7: no function with name 'nrmalize'; did you mean 'normalize'?");
    EXPECT_EQ(told(in_image("c.x = lerp(0.0, 1.0, 0.5);"), 2,
                   "OpenGL does not define the global function lerp"),
              "2:7: no function with name 'lerp'; GLSL's is mix");
    EXPECT_EQ(told(in_image("/* \xE6\xB0\xB4 */ c.x = wrong;"), 2, "undefined variable \"wrong\""),
              "2:15: `wrong' undeclared");
}

TEST(NvidiaWords, OfAMacroTellOfItsUseAndItsDefinition) {
    const std::string words = told("#define A 1.0 + nowhere\n" + in_image("c.x = 2.0 * A;"), 3,
                                   "undefined variable \"nowhere\"");
    EXPECT_TRUE(words.starts_with("3:13: `nowhere' undeclared (in what A stands for, ")) << words;
}

TEST(NvidiaWords, OfTypesSayWhatToDo) {
    EXPECT_EQ(told(in_image("float x = 1;"), 2, "implicit cast from \"int\" to \"float\""),
              "2:11: a value of type int cannot stand for one of type float; GLSL ES makes no int "
              "a float by itself: write 1.0 for 1, or float(i)");
    EXPECT_EQ(told(in_image("int i = p.x;"), 2, "implicit cast from \"float\" to \"int\""),
              "2:0: a value of type float cannot stand for one of type int; write int(x)");
    EXPECT_EQ(told(in_image("c.x = max(0, p.x);"), 2,
                   "unable to find compatible overloaded function \"max(int, mediump float)\""),
              "2:7: no matching function for call to `max(int, float)'; GLSL ES makes no int a "
              "float by itself: write 2.0 for 2, or float(i)");
    EXPECT_EQ(told(in_image("c.x = p.x % 2.0;"), 2,
                   "unable to find compatible overloaded function \"glint_rem(float, float)\""),
              "2:7: LHS of operator % must be an integer; of floats mod(a, b) is left");
    EXPECT_EQ(told(in_image("const float x = 3.0 % 2.0;"), 2, "operands to \"%\" must be integral"),
              "2:21: each operand of operator % must be an integer; of floats mod(a, b) is left");
    EXPECT_EQ(
        told(in_image("c.x = c.xyq.x;"), 2, "swizzle mask element not present in operand \"xyq\""),
        "2:9: invalid swizzle / mask `xyq'; components are called by letters of one set: xyzw, "
        "rgba or stpq");
    EXPECT_EQ(told(in_image("int i = 09;"), 2, "invalid digit '9' in octal constant"),
              "2:9: '09' is no number of GLSL; a leading 0 means octal: write 9");
    EXPECT_EQ(told(in_image("c.x = 1f;"), 2,
                   "floating point constant must have exponent when no decimal point is present"),
              "2:7: '1f' is no number of GLSL; write 1.0");
}

TEST(NvidiaWords, OfSyntaxSayWhatIsMissing) {
    const struct {
        std::string statement, said, expected;
        int line = 2;
    } cases[] = {
        {"float x = 1.0   // one\n", "unexpected identifier, expecting ',' or ';' at token \"c\"",
         "2:14: ';' is missing here", 4},
        {"float x = 1.0 2.0;",
         "unexpected floating point constant, expecting ',' or ';' at token \"<float-const>\"",
         "2:15: ';' or ',' is missing before '2.0'"},
        {"c.rgb = vec3(1.0, 2.0 3.0);",
         "unexpected floating point constant, expecting ',' or ')' at token \"<float-const>\"",
         "2:23: ')' or ',' is missing before '3.0'"},
        {"if c.x < 1.0 c = vec4(0);", "unexpected identifier, expecting '(' at token \"c\"",
         "2:4: '(' is missing before 'c'"},
        {"c = vec4(1.0) * ;", "unexpected ';', expecting \"::\" at token \";\"",
         "2:17: ';' is not expected behind '*'"},
        {"for (int i = 0; i < 3; i++) c.x += 1.0 * ;",
         "unexpected ';', expecting \"::\" at token \";\"", "2:42: ';' is not expected behind '*'"},
        {"c.x = p.y\nc.y = 1.0;", "unexpected identifier, expecting ',' or ';' at token \"c\"",
         "2:10: ';' is missing here", 3},
        {"c = vec4(1));", "unexpected ')', expecting ',' or ';' at token \")\"",
         "2:12: no '(' is open that this ')' closes; take it out, or write the '(' that is "
         "missing"},
        {"floa x = 1.0;", "unexpected '=', expecting \"::\" at token \"=\"",
         "2:1: 'floa' is no type; did you mean 'float'?"},
        {"const floa x = 1.0;", "unexpected identifier, expecting \"::\" at token \"floa\"",
         "2:7: 'floa' is no type; did you mean 'float'?"},
        {"let x = 1.0;", "unexpected '=', expecting \"::\" at token \"=\"",
         "2:1: 'let' is no type; write the type, such as float"},
        {"if (p.x => 1.0) c = vec4(0);", "unexpected '>', expecting \"::\" at token \">\"",
         "2:10: '=>' is no operator; did you mean '>='?"},
        {"else c = vec4(0);", "unexpected reserved word \"else\" at token \"else\"",
         "2:1: no 'if' stands before this 'else'; several statements of an 'if' stand in { }"},
        {"c.x = 1.0;\n}\n}", "unexpected '}' at token \"}\"",
         "4:1: no '{' is open that this '}' closes; take it out, or write the '{' that is missing",
         4},
    };
    for (const auto& c : cases)
        EXPECT_EQ(told(in_image(c.statement), c.line, "syntax error, " + c.said), c.expected);
    EXPECT_EQ(told("struct S { floa x; };\n" + in_image(""), 1,
                   "syntax error, unexpected ';', expecting \"::\" at token \";\""),
              "1:12: 'floa' is no type; did you mean 'float'?");
    EXPECT_EQ(told(in_image("float3 x;"), 2, "OpenGL does not define the global type float3"),
              "2:1: 'float3' is no type; GLSL's is vec3");
    EXPECT_EQ(told(in_image("float in = 1.0;"), 2,
                   "OpenGL does not allow 'inout' after a type specifier"),
              "2:7: 'in' is a word of GLSL, and a name is expected");
    EXPECT_EQ(told(in_image("float f(float x) { return x; }"), 2,
                   "f: function declaration in non global scope not allowed"),
              "2:1: a function begins within another one, which GLSL has not; is a '}' missing "
              "before it?");
}

TEST(NvidiaWords, OfFunctionsThatCallThemselvesOrHaveNoBodyStandAtThem) {
    EXPECT_EQ(told("float f(float x) { return f(x); }\n" + in_image("c.x = f(p.x);"), 1,
                   "recursive call to function \"float f(float){"),
              "1:7: f calls itself, at once or by way of others; GLSL has no recursion, write a "
              "loop");
    EXPECT_EQ(told("float f(float x);\n" + in_image("c.x = f(p.x);"), 3,
                   "call to undefined function \"float f(float);\""),
              "1:7: f is declared and called, but has no body; write one");
}

TEST(NvidiaWords, OfItsOwnWorkAreNotPassedOn) {
    EXPECT_EQ(told(in_image("for (int i = 0; i < 70000; ++i) c += 1e-6;"), 2,
                   "not unrolling loop that executes 70000 times since maximum loop unroll count "
                   "is 4096"),
              "");
}

TEST(NvidiaWords, ThatAreNotThereAreOursOfABracketThatIsNeverClosed) {
    const TestFolder folder;
    const ReadPreset read =
        read_scene_text(folder, "void mainImage(out vec4 c, in vec2 p) {\n  c = vec4(1);\n\n", {});
    const Diagnostic said =
        refusal_without_words(read.preset->scene, pass_text(*read.preset, kImagePass, {}));
    EXPECT_EQ(said.text, "this '{' is never closed; write '}'");
    EXPECT_EQ(said.place.line, 1);
    EXPECT_EQ(said.place.column, 39);
}

}  // namespace
}  // namespace glint::nvidia_words_test
