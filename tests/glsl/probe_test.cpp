// Texts that tell what happens in them.
#include "glsl/probe.h"

#include <gtest/gtest.h>

#include <string>

namespace glint::probe_test {
namespace {

std::string instrumented(const std::string& text, const ProbeWish& wish = {}) {
    const Reading reading = read_glsl(text, known_of_driver());
    Edits edits(reading);
    instrument(reading, wish, reading.word(reading.functions.back().name), edits);
    return edits.apply().text;
}

// What becomes of a function's body.
std::string in_function(const std::string& body, ProbeKind kind = ProbeKind::values) {
    const std::string head = "void put(out float a, float b); bool get(inout float a); void f() {";
    const std::string text = instrumented(head + " " + body + " }", {.kind = kind});
    EXPECT_TRUE(text.starts_with(head)) << text;
    const std::string inner = text.substr(head.size(), text.size() - head.size() - 2);
    return kind == ProbeKind::cost ? inner : inner.substr(1);
}

TEST(ProbeText, HandsThroughWhatAVariableIsGiven) {
    EXPECT_EQ(in_function("float a = 1.; a += b;"),
              "float a = glint0_v(0,1.); glint0_v(1,a += b);");
    EXPECT_EQ(in_function("p.xz = q[i].yx;"), "glint0_v(0,p.xz = q[i].yx);");
    EXPECT_EQ(in_function("a = b = c;"), "glint0_v(0,a = glint0_v(1,b = c));");
    EXPECT_EQ(in_function("const float a = 1.;"), "const float a = 1.; glint0_v(0,a);");
}

TEST(ProbeText, KeepsWhatIsOnlySometimesEvaluated) {
    EXPECT_EQ(in_function("c ? a = 1. : d;"), "c ? glint0_v(0,a = 1.) : d;");
    EXPECT_EQ(in_function("c && (a = d);"), "c && (glint0_v(0,a = d));");
    EXPECT_EQ(in_function("if (c) a = 1.; else b = 2.;"),
              "if (glint0_v(0,c)) glint0_v(1,a = 1.); else glint0_v(2,b = 2.);");
    EXPECT_EQ(in_function("if (a = b) return;"),
              "if (glint0_v(0,glint0_v(1,a = b))) {glint0_r(2); return;}");
    EXPECT_EQ(in_function("c && get(a);"), "c && glint0_then(get(a),(glint0_v(0,a),true));");
    EXPECT_EQ(in_function("a = c ? b = 1., d : e;"),
              "glint0_v(0,a = c ? glint0_v(1,b = 1.), d : e);");
}

TEST(ProbeText, LooksThroughParentheses) {
    EXPECT_EQ(in_function("(a) = 1.;"), "glint0_v(0,(a) = 1.);");
    EXPECT_EQ(in_function("((a.x))++;"), "glint0_w(0,((a.x))++,a . x);");
    EXPECT_EQ(in_function("++(a);"), "glint0_v(0,++(a));");
}

// What is evaluated once more is to be the same: no call of the text's own, no other index.
TEST(ProbeText, NamesAnElementOnceMoreOnlyWhereItIsTheSame) {
    EXPECT_EQ(in_function("a[int(x)]++;"), "glint0_w(0,a[int(x)]++,a [ int ( x ) ]);");
    EXPECT_EQ(in_function("a[i++]++;"), "a[glint0_w(0,i++,i)]++;");
    EXPECT_EQ(in_function("a[get(x)]++;"), "a[glint0_then(get(x),(glint0_v(0,x),true))]++;");
    EXPECT_EQ(instrumented("int n; void put(out float a, inout int i);\n"
                           "void f(float a[2], int i) { put(a[i], i); put(a[n], i); }"),
              "int n; void put(out float a, inout int i);\n"
              "void f(float a[2], int i) { (glint0_has(0,a.length()*1)&&glint0_l(glint0_id,"
              "2097152+(a.length()<<8),a[(glint0_id>>16)])); glint0_v(1,i); "
              "{put(a[i], i); glint0_v(2,i);} {put(a[n], i); glint0_v(3,i);} }");
}

TEST(ProbeText, TellsASteppedVariableAsItIsAfterwards) {
    EXPECT_EQ(in_function("i++;"), "glint0_w(0,i++,i);");
    EXPECT_EQ(in_function("--i;"), "glint0_v(0,--i);");
    EXPECT_EQ(in_function("if (x) ++i;"), "if (glint0_v(0,x)) glint0_v(1,++i);");
}

TEST(ProbeText, TellsWhatACallHandsOut) {
    EXPECT_EQ(in_function("put(a, 1.);"), "{put(a, 1.); glint0_v(0,a);}");
    EXPECT_EQ(in_function("return get(a);"),
              "return glint0_v(0,glint0_then(get(a),(glint0_v(1,a),true)));");
    EXPECT_EQ(in_function("for (;; put(a, b), ++i) ;"),
              "for (;; (put(a, b),glint0_v(1,a)), glint0_v(0,++i)) ;");
    EXPECT_EQ(
        in_function("for (int i = 0; i < n; i++) break;"),
        "for (int i = glint0_v(0,0); glint0_v(1,i < n); glint0_w(2,i++,i)) {glint0_r(3); break;}");
}

TEST(ProbeText, KeepsCommasTogether) {
    EXPECT_EQ(in_function("while (i++, i < n) break;"),
              "while (glint0_v(0,(glint0_w(1,i++,i), i < n))) {glint0_r(2); break;}");
}

TEST(ProbeText, TellsParametersAndResults) {
    EXPECT_EQ(instrumented("float f(vec2 p, out float q) { return p.x; }"),
              "float f(vec2 p, out float q) { glint0_v(0,p); return glint0_v(1,p.x); }");
    EXPECT_EQ(instrumented("float f(sampler2D s) { return g(s); }"),
              "float f(sampler2D s) { return glint0_v(0,g(s)); }");
}

TEST(ProbeText, HandsAMacrosUseThroughAsAWhole) {
    EXPECT_EQ(instrumented("#define SET(x) x = 1.\nvoid f() { SET(a); }"),
              "#define SET(x) x = 1.\nvoid f() { glint0_v(0,SET(a)); }");
}

TEST(ProbeText, TellsStructsByTheirMembers) {
    const std::string text = instrumented("struct S { float t; mat2 m; };\nvoid f() { s = g(); }");
    EXPECT_NE(text.find("S glint0_v(int i,S v){glint0_l(i+0,320,v.t),glint0_l(i+65536,321,v.m[0]),"
                        "glint0_l(i+131072,321,v.m[1]);return v;}"),
              text.npos)
        << text;
}

TEST(ProbeText, InstrumentsTheLinesAloneThatAreAskedFor) {
    const std::string text = "void f() {\na = 1.;\nb = 2.;\n}";
    const std::size_t line = text.find("b");
    EXPECT_EQ(instrumented(text, {.only = {{line, line + 8}}}),
              "void f() {\na = 1.;\nglint0_v(0,b = 2.);\n}");
}

TEST(ProbeText, PutsAnExpressionBehindItsLine) {
    const std::string text = "void f() {\nfloat a = 1.;\nif (a > 0.) return;\nb = 2.;\n}";
    const auto with = [&](const std::string& line) {
        const std::size_t at = text.find(line);
        return instrumented(text,
                            {.expressions = {{.text = "a*2.", .line = {at, at + line.size()}}}});
    };
    EXPECT_EQ(with("float a = 1.;\n"),
              "void f() {\nfloat a = 1.; glint0_v(0,(a*2.));\nif (a > 0.) return;\nb = 2.;\n}");
    EXPECT_EQ(with("if (a > 0.) return;\n"),
              "void f() {\nfloat a = 1.;\nglint0_v(0,(a*2.)); if (a > 0.) return;\nb = 2.;\n}");
}

TEST(ProbeText, EvaluatesAnExpressionAtALoopInEachTurn) {
    const auto at_loop = [](const std::string& loop) {
        const std::string text = "void f() {\n" + loop + "\n}";
        return instrumented(text, {.expressions = {{.text = "i", .line = {11, 12 + loop.size()}}}});
    };
    EXPECT_EQ(at_loop("for (int i = 0; i < 3; i++) { a += b; }"),
              "void f() {\nfor (int i = 0; i < 3; i++) { glint0_v(0,(i));  a += b; }\n}");
    EXPECT_EQ(at_loop("for (int i = 0; i < 3; i++)\n a += b;"),
              "void f() {\nfor (int i = 0; i < 3; i++)\n {glint0_v(0,(i)); a += b;}\n}");
}

TEST(ProbeText, RefusesWhatIsNoExpression) {
    EXPECT_EQ(refusal_of_expression("dot(nor, rd)"), "");
    for (const char* text : {"", "a; b", "a = 1.", "i++", "f(", "}", "return a", "#if 1", "a // b"})
        EXPECT_NE(refusal_of_expression(text), "") << text;
}

TEST(ProbeText, CountsTurnsReadsAndCalls) {
    EXPECT_EQ(in_function("for (;;) a = texture(s, p);", ProbeKind::cost),
              " glint0_n(0,2); for (;;) {glint0_n(1,0); a = glint0_n(2,texture(s, p));}");
}

TEST(ProbeText, ChecksWhatHasADomain) {
    EXPECT_EQ(in_function("a = sqrt(b) / c;", ProbeKind::faults),
              "glint0_v(0,a = glint0_q(1,glint0_sqrt(2,b) / glint0_d(1,c)));");
    EXPECT_EQ(in_function("f(x - a * -b / c);", ProbeKind::faults),
              "f(x - glint0_q(0,a * -b / glint0_d(0,c)));");
    EXPECT_EQ(in_function("vec3 v; a = v[i];", ProbeKind::faults),
              "vec3 v; glint0_v(0,a = v[glint0_i(1,i,3)]);");
}

}  // namespace
}  // namespace glint::probe_test
