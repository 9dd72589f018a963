// What a person is told of a text that is no GLSL: what is missing, and where.
#include "fixture.h"

namespace glint::syntax_error_test {
namespace {

using SyntaxErrors = GlTest;

std::string first_complaint(const std::string& text) {
    const TestFolder folder;
    const ReadPreset read = read_scene_text(folder, text, {});
    const Diagnostics list =
        read.preset ? compile_scene(*read.preset, {.root = kImagePass, .program = {}}).diagnostics
                    : read.diagnostics;
    if (list.empty()) return "";
    const Place& place = list.front().place;
    return fmt::format("{}:{}: {}", place.line, place.column, list.front().text);
}

std::string in_image(const std::string& statements) {
    return "void mainImage(out vec4 c, in vec2 p) {\n" + statements + "\nc = vec4(1);\n}\n";
}

TEST_F(SyntaxErrors, StandWhereSomethingIsMissing) {
    EXPECT_EQ(first_complaint(in_image("float x = 1.0   // one\n")), "2:14: ';' is missing here");
    EXPECT_EQ(first_complaint(in_image("float x = f(1.0")), "2:16: ')' is missing here");
    EXPECT_EQ(first_complaint(in_image("float x = 1.0 2.0;")),
              "2:15: ';' or ',' is missing before '2.0'");
    EXPECT_EQ(first_complaint(in_image("c.rgb = vec3(1.0, 2.0 3.0);")),
              "2:23: ')' or ',' is missing before '3.0'");
    EXPECT_EQ(first_complaint(in_image("if c.x < 1.0 c = vec4(0);")),
              "2:4: '(' is missing before 'c'");
    EXPECT_EQ(first_complaint(in_image("c = vec4(1.0) * ;")),
              "2:17: ';' is not expected behind '*'");
    EXPECT_EQ(first_complaint("struct S { float a }; " + in_image("")),
              "1:20: ';' or ',' is missing before '}'");
    EXPECT_EQ(first_complaint("vec3 a = vec3(1)\n" + in_image("")), "1:17: ';' is missing here");
    EXPECT_EQ(first_complaint(in_image("") + "int a"), "5:6: ';' is missing here");
    EXPECT_EQ(first_complaint(in_image("") + "int a ="),
              "5:8: the text ends here, and something is missing");
    EXPECT_EQ(first_complaint(in_image("c = c.;")),
              "2:7: a component, such as x, is missing before ';'");
}

TEST_F(SyntaxErrors, OfAnElseTellWhatIsMissingBeforeIt) {
    EXPECT_EQ(first_complaint(in_image("if (p.x > 1.)\nc.x = 1.\nelse\nc.x = 2.;")),
              "3:9: ';' is missing here");
    EXPECT_EQ(
        first_complaint("vec3 f(float x) {\nif (x > 1.) return vec3(1)\nelse return vec3(0);\n}\n" +
                        in_image("")),
        "2:27: ';' is missing here");
    EXPECT_EQ(first_complaint(in_image("if (p.x > 1.); { c.x = 1.; } else { c.x = 2.; }")),
              "2:14: this ';' ends the 'if' before its block; take it out");
    EXPECT_EQ(
        first_complaint(in_image("c.x = 1.; else c.x = 2.;")),
        "2:11: no 'if' stands before this 'else'; several statements of an 'if' stand in { }");
    EXPECT_EQ(first_complaint(in_image("if (p.x > 1.) { c.x = 1.; else c.x = 2.;")),
              "2:27: '}' is missing before 'else'");
    const std::string condition = "an 'else' has no condition; write else if (\u2026)";
    EXPECT_EQ(
        first_complaint(in_image("if (p.x > 1.) { c.x = 1.; } else (p.y > 1.) { c.x = 2.; }")),
        "2:34: " + condition);
    EXPECT_EQ(first_complaint(in_image("if (p.x > 1.) c.x = 1.; else (p.y > 1.) return;")),
              "2:30: " + condition);
}

TEST_F(SyntaxErrors, TellOfCommasWhereArgumentsGoOnOnTheNextLine) {
    EXPECT_EQ(first_complaint(in_image("vec3 q = vec3(1.0,\n2.0\n3.0);")),
              "3:4: ',' or ')' is missing here");
    EXPECT_EQ(first_complaint(in_image("vec3 q = mix(c.rgb,\nc.bgr\nvec3(0.5));")),
              "3:6: ',' or ')' is missing here");
    EXPECT_EQ(first_complaint(in_image("float q = max(1.0, 2.0\nfloat r = 1.0;")),
              "2:23: ')' is missing here");
}

TEST_F(SyntaxErrors, OfAnArrowTellThePoint) {
    EXPECT_EQ(first_complaint(in_image("c.x = p->x;")),
              "2:9: a member stands behind a '.': write p.x");
}

TEST_F(SyntaxErrors, OfAMembersValueTellThatItHasNone) {
    EXPECT_EQ(first_complaint("struct P { float m = 1.0; };\n" + in_image("")),
              "1:20: no member has a value of its own here; give it where a variable is made");
}

TEST_F(SyntaxErrors, OfAFunctionInAStructTellWhereItStands) {
    EXPECT_EQ(first_complaint("struct P { float x; float get() { return x; } };\n" + in_image("")),
              "1:30: GLSL's structs hold no functions; write 'get' outside, and give it the "
              "struct as an argument");
}

TEST_F(SyntaxErrors, OfACaseOutsideOfASwitchTellThatThereIsNone) {
    const std::string words = " stands right within the braces of a switch, and here is none";
    EXPECT_EQ(first_complaint(in_image("case 1: c.x = 1.0; break;")), "2:1: 'case'" + words);
    EXPECT_EQ(first_complaint(in_image("switch (1) { case 1: { default: c.x = 1.0; } }")),
              "2:24: 'default'" + words);
}

TEST_F(SyntaxErrors, NameBracketsWithoutTheirPartner) {
    const std::string array = "float a[3];\n";
    EXPECT_EQ(first_complaint(array + in_image("c = vec4(a[1);")),
              "3:13: ']' is missing before ')'");
    EXPECT_EQ(first_complaint(array + in_image("c = vec4(max(a[0, a[1]));")),
              "3:23: ']' is missing before ')'");
    EXPECT_EQ(first_complaint(array + in_image("c = vec4(a[(1 + 1]);")),
              "3:18: ')' is missing before ']'");

    EXPECT_EQ(first_complaint("void mainImage(out vec4 c, in vec2 p) {\n  c = vec4(1);\n\n"),
              "1:39: this '{' is never closed; write '}'");
    EXPECT_EQ(first_complaint(in_image("") + "}"),
              "5:1: no '{' is open that this '}' closes; take it out, or write the '{' that is "
              "missing");
    EXPECT_EQ(first_complaint(in_image("c = vec4(1));")),
              "2:12: no '(' is open that this ')' closes; take it out, or write the '(' that is "
              "missing");
}

TEST_F(SyntaxErrors, NameTypesThatAreNone) {
    const std::string in_function = "2:1: 'floa' is no type; did you mean 'float'?";
    EXPECT_EQ(first_complaint(in_image("floa x = 1.0;")), in_function);
    EXPECT_EQ(first_complaint(in_image("const floa x = 1.0;")),
              "2:7: 'floa' is no type; did you mean 'float'?");
    const std::string at_the_start = "1:1: 'floa' is no type; did you mean 'float'?";
    EXPECT_EQ(first_complaint("floa f(float x) { return x; }\n" + in_image("")), at_the_start);
    EXPECT_EQ(first_complaint("float f(in floa x) { return x; }\n" + in_image("")),
              "1:12: 'floa' is no type; did you mean 'float'?");
    EXPECT_EQ(first_complaint("struct S { floa x; };\n" + in_image("")),
              "1:12: 'floa' is no type; did you mean 'float'?");
    EXPECT_EQ(first_complaint(in_image("float3 x;")), "2:1: 'float3' is no type; GLSL's is vec3");
    EXPECT_EQ(first_complaint(in_image("let x = 1.0;")),
              "2:1: 'let' is no type; write the type, such as float");
    EXPECT_EQ(first_complaint("struct Ray { vec3 o; };\n" + in_image("Ray float;")),
              "3:5: 'float' is a word of GLSL, and a name is expected");
}

TEST_F(SyntaxErrors, NameWhatGlslHasNot) {
    EXPECT_EQ(first_complaint(in_image("float f(float x) { return x; }")),
              "2:1: a function begins within another one, which GLSL has not; is a '}' missing "
              "before it?");
    EXPECT_EQ(first_complaint(in_image("if (p.x => 1.0) c = vec4(0);")),
              "2:10: '=>' is no operator; did you mean '>='?");
    EXPECT_EQ(first_complaint(in_image("else c = vec4(0);")),
              "2:1: no 'if' stands before this 'else'; several statements of an 'if' stand in { }");
    EXPECT_EQ(first_complaint(in_image("float in = 1.0;")),
              "2:7: 'in' is a word of GLSL, and a name is expected");
    EXPECT_EQ(first_complaint(in_image("") + "speed = 3.0;"),
              "5:1: outside of functions only declarations stand; move this into one, or write its "
              "type before it");
}

TEST_F(SyntaxErrors, TellWhoThinksOfCppWhatGlslWrites) {
    const std::string first = "2:7: a first value stands behind '=': write vec3 v = vec3(\u2026)";
    EXPECT_EQ(first_complaint(in_image("vec3 v(1.0, 2.0, 3.0);")), first);
    EXPECT_EQ(first_complaint(in_image("vec3 v(p, 2.0);")), first);
    EXPECT_EQ(first_complaint(in_image("vec3 v(vec2(1.0), 2.0);")), first);
    EXPECT_EQ(first_complaint("float f(float a, float b = 1.0) { return a * b; }\n" + in_image("")),
              "1:26: no parameter has a value of its own here; write a second function of this "
              "name, without it");
    EXPECT_EQ(first_complaint("float f(const float& a) { return a; }\n" + in_image("")),
              "1:20: GLSL has no references; a parameter that is to change is inout float");
    EXPECT_EQ(first_complaint("void f(vec3 *a) {}\n" + in_image("")),
              "1:13: GLSL has no pointers; a parameter that is to change is inout vec3");
}

TEST_F(SyntaxErrors, NameATypeABracketAndAPointThatAreMissing) {
    EXPECT_EQ(first_complaint("uniform speed;\n" + in_image("")),
              "1:9: 'speed' has no type; write it, such as uniform float speed");
    EXPECT_EQ(first_complaint(in_image("c = vec4(sin p.x);")), "2:10: '(' is missing behind 'sin'");
    EXPECT_EQ(first_complaint(in_image("float a = 0,5;")), "2:13: numbers have a point: write 0.5");
    EXPECT_EQ(first_complaint(in_image("float a = std::max(0.0, 1.0);")),
              "2:14: GLSL has no '::'; write what stands behind it alone");
    EXPECT_EQ(first_complaint(in_image("vec3 a = new vec3(1.0);")),
              "2:14: GLSL has no 'new'; leave it out");
}

TEST_F(SyntaxErrors, NameNumbersHeadsOfForAndNamesThatAreTaken) {
    EXPECT_EQ(first_complaint(in_image("float a = 1.0h;")),
              "2:11: '1.0h' is no number of GLSL; write 1.0");
    EXPECT_EQ(first_complaint(in_image("int a = 0b101;")),
              "2:9: '0b101' is no number of GLSL; write 5");
    EXPECT_EQ(first_complaint("const k = 3.0;\n" + in_image("")),
              "1:7: 'k' has no type; write it, such as const float k");
    EXPECT_EQ(first_complaint(in_image("p.x + p.y = 3.0;")),
              "2:11: what stands left of this '=' is no variable; == compares");
    EXPECT_EQ(first_complaint(in_image("for (int i = 0, i < 4, i++) c.x += 1.0;")),
              "2:19: the parts of a for stand between ';': for (int i = 0; i < 4; ++i)");
    EXPECT_EQ(first_complaint(in_image("for (float x : list) c.x += x;")),
              "2:14: GLSL counts: write for (int i = 0; i < list.length(); ++i), and list[i]");
    EXPECT_EQ(first_complaint("float iTime = 1.0;\n" + in_image("")),
              "1:7: `iTime' redeclared; it is the host's, and there already: take this out, or "
              "give yours another name");
    const std::string told = first_complaint("#define x 3.0\n" + in_image("c = vec4(p.x);"));
    EXPECT_NE(told.find("what the macro x stands for does not fit here"), told.npos) << told;
}

TEST_F(SyntaxErrors, SayWhatVectorsAndPowersAreWrittenLike) {
    EXPECT_EQ(first_complaint(in_image("c = (1.0, 0.0, 0.0, 1.0);")),
              "2:1: value of type float cannot be assigned to variable of type vec4; of numbers in "
              "brackets the last alone counts: write vec4(\u2026)");
    EXPECT_EQ(first_complaint(in_image("vec2 a = (p.x, 1.0);")),
              "2:1: initializer of type float cannot be assigned to variable of type vec2; of "
              "numbers in brackets the last alone counts: write vec2(\u2026)");
    EXPECT_EQ(first_complaint(in_image("c.x = p.x ^ 2.0;")),
              "2:7: LHS of `^' must be an integer; a power is pow(a, b)");
    EXPECT_EQ(
        first_complaint(in_image("if (p > vec2(1)) c = vec4(0);")),
        "2:5: operands to relational operators must be scalar and numeric; of vectors compare "
        "one component, or write all(lessThan(a, b)) and its like");
}

TEST_F(SyntaxErrors, NameTheLanguageOfATextThatIsNoGlsl) {
    const std::string help =
        ", and Glint draws GLSL: write it anew, from void mainImage(out vec4 fragColor, in vec2 "
        "fragCoord)";
    EXPECT_EQ(first_complaint("@fragment\nfn main(@location(0) uv: vec2<f32>) -> vec4<f32> {\n"
                              "    return vec4<f32>(uv, 0.0, 1.0);\n}\n"),
              "1:1: this is WGSL" + help);
    EXPECT_EQ(first_complaint("shader_type canvas_item;\n"
                              "void fragment() { COLOR = vec4(UV, 0.0, 1.0); }\n"),
              "1:1: this is Godot's language" + help);
    EXPECT_EQ(first_complaint("float4 Pixel(float2 uv : TEXCOORD0) : SV_Target {\n"
                              "    return float4(uv, 0, 1);\n}\n"),
              "1:39: this is HLSL" + help);
    EXPECT_EQ(first_complaint("float fn(float metal) { return metal; }\n").find("this is"),
              std::string::npos)
        << "names of GLSL's texts";
}

TEST_F(SyntaxErrors, NameAKeywordThatIsMistyped) {
    EXPECT_EQ(first_complaint("float f(float x) { retrun x; }\n" + in_image("")),
              "1:20: 'retrun' is no type; did you mean 'return'?");
    EXPECT_EQ(first_complaint(in_image("int i = 0; whlie (i < 3) i++;")),
              "2:12: 'whlie' is no word of GLSL; did you mean 'while'?");
    EXPECT_EQ(first_complaint(in_image("fro (int i = 0; i < 3; ++i) c.x += 1.0;")),
              "2:1: 'fro' is no word of GLSL; did you mean 'for'?");
    EXPECT_EQ(first_complaint(in_image("If (p.x > 1.0) c = vec4(0);")),
              "2:1: 'If' is no word of GLSL; did you mean 'if'?");
    EXPECT_EQ(first_complaint("cosnt float k = 1.0;\n" + in_image("")),
              "1:1: 'cosnt' is no word of GLSL; did you mean 'const'?");
    EXPECT_EQ(first_complaint("void f(vec2 p) {}\n" + in_image("f(p)")), "3:5: ';' is missing here")
        << "and no 'if'";
    EXPECT_EQ(first_complaint("float dist = 1.0;\n" + in_image("c = vec4(dist (p.x + 1.0));")),
              "3:10: no function with name 'dist'; it is a variable: write an operator, such as *, "
              "before the '('");
}

TEST_F(SyntaxErrors, TellOfThePreprocessorsLines) {
    EXPECT_EQ(
        first_complaint("#ifdef A\n#else if B\n#endif\n" + in_image("")),
        "2:7: the line's end is expected here; a condition stands behind #if and #elif alone");
    EXPECT_EQ(first_complaint("# A title\n" + in_image("")),
              "1:1: Illegal non-directive after #; a comment begins with //");
    EXPECT_EQ(first_complaint("#import \"a.glsl\"\n" + in_image("")),
              "1:1: Illegal non-directive after #; a file is taken in by #include \"FILE\"");
    EXPECT_EQ(first_complaint("#define F(x,\n" + in_image("")),
              "1:13: the line ends too soon: a name is missing");
    EXPECT_EQ(first_complaint("#if 1 +\n#endif\n" + in_image("")), "1:8: the line ends too soon");
    EXPECT_EQ(first_complaint("#ifdef 3\n#endif\n" + in_image("")), "1:8: a name is expected here");
    EXPECT_EQ(first_complaint(in_image("c = vec4(1 + #2);")),
              "2:14: '#' stands at the beginning of a line alone");
    EXPECT_EQ(first_complaint("#if 1.5 > 1\n#endif\n" + in_image("")),
              "1:5: this is not expected here; behind #if stand whole numbers, names, operators "
              "and defined()");
    for (const auto& [condition, column] :
         std::initializer_list<std::pair<const char*, int>>{{"A ? 1 : 0", 7},
                                                            {"defined(A) = A", 16},
                                                            {"-1 - !A 2", 13},
                                                            {"(A && \"b\")", 11},
                                                            {"A == 1.0 // #", 10},
                                                            {"F(1) == 1.0", 13},
                                                            {"1e5 > A", 5}})
        EXPECT_TRUE(first_complaint(
                        fmt::format("#define A 1\n#define F(x) x\n#if {}\n#endif\n", condition) +
                        in_image(""))
                        .starts_with(fmt::format("3:{}: this is not", column)))
            << condition;
}

TEST_F(SyntaxErrors, StandWhereTheMistakeIsAndSayWhatToWrite) {
    EXPECT_EQ(first_complaint(in_image("c = texture(iChannel0 p);")),
              "2:23: ')' or ',' is missing before 'p'");
    EXPECT_EQ(first_complaint(in_image("float a = 1.0, b = max(p.x, a a);")),
              "2:31: ')' or ',' is missing before 'a'");
    EXPECT_EQ(first_complaint(in_image("if (p.x > 9.0) { c = vec4(1); }\nelseif (p.x > 5.0) { }")),
              "3:1: 'elseif' is no word of GLSL; write else if");
    EXPECT_EQ(first_complaint(in_image("float a = 1.0lf;")),
              "2:11: '1.0lf' is no number of GLSL; write 1.0");
    EXPECT_EQ(
        first_complaint("float f(vec3 n, float k,\n  float k) { return k; }\n" + in_image("")),
        "2:9: parameter `k' redeclared");
    EXPECT_EQ(first_complaint(in_image("if (0.0 < p.x < 3.0) c = vec4(1);")),
              "2:5: operands to relational operators must be scalar and numeric; two are compared "
              "at a time: write a < b && b < c");
    EXPECT_EQ(first_complaint(in_image("vec3 a = vec3(0); a.xx = p;")),
              "2:19: 'xx' names a component twice, and cannot be given a value");
    EXPECT_EQ(first_complaint("void f(out float x) { x = 1.0; }\n" + in_image("f(1.0);")),
              "3:3: function parameter 'out x' gives a value back: pass a variable");
    EXPECT_EQ(first_complaint(in_image("c.r = 1;")),
              "2:1: value of type int cannot be assigned to variable of type float; GLSL ES makes "
              "no int a float by itself: write 1.0 for 1, or float(i)");
}

TEST_F(SyntaxErrors, OfParenthesesWithoutNumberTheStackIsNotFilled) {
    const std::string open(200'000, '('), close(200'000, ')');
    EXPECT_NE(first_complaint(in_image(open + "c" + close + " = vec4(1);")), "");
}

TEST_F(SyntaxErrors, OfTypesThatDoNotFitSayWhatFits) {
    const std::pair<const char*, const char*> cases[] = {
        {"float a = p;", "; take one of its components, such as .x"},
        {"vec2 a = c;", "; leave components out: .xy"},
        {"c = p;", "; add what is missing: vec4(v, 0.0, 0.0)"},
        {"vec3 a = p.x;", "; write vec3(x)"},
        {"bool a = p.x;", "; compare it, such as x > 0"},
        {"float a = p.x > 1.0;", "; write float(b)"},
        {"return 1;", "; write return; alone, or another type for the function"},
        {"vec3 a = vec3(p);", "; add what is missing, such as vec3(v, 0.0)"},
        {"p = p.xyz;", "; a vec2 has x and y, a vec3 z as well, and a vec4 w"},
        {"c.rgx = vec3(1.0);", "; components are called by letters of one set: xyzw, rgba or stpq"},
        {"while (p.x) c.x += 1.0;", "; compare, such as x > 0.0"},
        {"switch (p.x) { case 1: c = vec4(1); }", "; write int(x)"},
        {"if (p.x > 1.0) then c = vec4(1);", "; the statement follows right behind the ')'"}};
    for (const auto& [statement, help] : cases) {
        const std::string told = first_complaint(in_image(statement));
        EXPECT_TRUE(told.ends_with(help)) << statement << ": " << told;
    }
}

TEST_F(SyntaxErrors, OfDirectivesThatAreMistypedNameTheRightOne) {
    EXPECT_EQ(first_complaint("#ifdeff A\n#endif\n" + in_image("")),
              "1:1: '#ifdeff' is no directive; did you mean '#ifdef'?");
    EXPECT_EQ(first_complaint("#if defined(A\n#endif\n" + in_image("")),
              "1:5: 'defined' takes one name: write defined(A)");
    EXPECT_TRUE(
        first_complaint("#verison 300 es\n" + in_image("")).ends_with("did you mean 'version'?"));
    EXPECT_EQ(first_complaint("struct S { float a; vec2 a; };\n" + in_image("")),
              "1:26: a second member 'a'; give it another name");
}

TEST_F(SyntaxErrors, OfValuesInThePlaceOfVariablesAreToldThoughTheDriverTakesThem) {
    const std::string functions =
        "vec3 tone(vec3 v) { return v; }\nvoid twice(inout vec3 v) { v *= 2.0; }\n";
    const std::string why =
        " is a value, and no variable that can be given another one; keep it in a variable first";
    const std::pair<const char*, const char*> cases[] = {
        {"tone(vec3(1)) *= 2.0;", "4:1: 'tone(vec3(1))'"},
        {"tone(vec3(1)).x = 2.0;", "4:1: 'tone(vec3(1)).x'"},
        {"twice(tone(vec3(1)));", "4:7: 'tone(vec3(1))'"},
        {"min(p.x, 1.0)++;", "4:1: 'min(p.x, 1.0)'"},
        {"(p.x > 1.0 ? c.x : c.y) = 3.0;", "4:1: '(p.x > 1.0 ? c.x : c.y)'"},
        {"(c.x = 1.0) += 2.0;", "4:1: '(c.x = 1.0)'"}};
    for (const auto& [statement, place] : cases)
        EXPECT_EQ(first_complaint(functions + in_image(statement)), place + why) << statement;
    EXPECT_EQ(
        first_complaint("#define SET(a, b) (a) = (b)\nstruct S { vec3 a[2]; };\n" + functions +
                        in_image("S s; vec2 q = p; (c).x = 1.0; SET(c.y, tone(c.xyz).x);\n"
                                 "s.a[int(tone(c.xyz).x)].xy += q; twice((s.a)[0]);\n"
                                 "for (int i = 0; i < 3; i++) (q) += p; float w;\n"
                                 "if (tone(c.xyz).x > 1.0) q.x = modf(q.y, w); else --q.x;")),
        "");
}

// Mesa's grammar knows tokens by names of its own.
TEST_F(SyntaxErrors, NeverSpeakOfADriversTokens) {
    for (const std::string statement :
         {"1 2", "x 1u", "float 3", "for for", "c = true false;", "c += += 1.0;", "c = vec4(&&);",
          "int[ x", "return return", "void void", "switch (1) { case: }", "do { } c;", "c.1;",
          "layout layout", "struct struct", "const const", "c = (1.0 ? : 2.0);", "++ ++;",
          "<< 1"}) {
        const std::string told = first_complaint(in_image(statement));
        EXPECT_FALSE(told.empty()) << statement;
        EXPECT_EQ(told.find("syntax error"), told.npos) << statement << ": " << told;
        for (const char* name : {"_TOK", "_OP", "IDENTIFIER", "CONSTANT", "SELECTION", "ASSIGN"})
            EXPECT_EQ(told.find(name), told.npos) << statement << ": " << told;
    }
}

TEST_F(SyntaxErrors, OfWhatAMacroStandsForTellOfBoth) {
    const std::string told = first_complaint("#define ONE 1.0;\n" + in_image("c = vec4(ONE);"));
    EXPECT_TRUE(
        told.starts_with("3:10: ')' or ',' is missing before ';' (in what ONE stands for, "))
        << told;
}

}  // namespace
}  // namespace glint::syntax_error_test
