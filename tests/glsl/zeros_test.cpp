// Zeros for what is read before it has a value.
#include "glsl/zeros.h"

#include <gtest/gtest.h>

#include <string>

namespace glint::zeros_test {
namespace {

std::string zeroed(const std::string& text) {
    const Reading reading = read_glsl(text, known_of_driver());
    Edits edits(reading);
    write_zeros(reading, edits);
    return edits.apply().text;
}

// What becomes of a function's body.
std::string in_function(const std::string& body) {
    const std::string head =
        "struct Hit { float t; vec3 n; }; void put(out float a, float b); void f() { ";
    const std::string text = zeroed(head + body + " }");
    EXPECT_TRUE(text.starts_with(head)) << text;
    return text.substr(head.size(), text.size() - head.size() - 2);
}

TEST(Zeros, AreOfEveryType) {
    const std::pair<std::string, std::string> cases[] = {{"float", "0."},
                                                         {"int", "0"},
                                                         {"uint", "0u"},
                                                         {"bool", "false"},
                                                         {"vec2", "vec2(0.)"},
                                                         {"vec4", "vec4(0.)"},
                                                         {"ivec3", "ivec3(0)"},
                                                         {"uvec2", "uvec2(0u)"},
                                                         {"bvec4", "bvec4(false)"},
                                                         {"mat2", "mat2(0)"},
                                                         {"mat4", "mat4(0)"},
                                                         {"mat2x3", "mat2x3(0)"},
                                                         {"mat3x3", "mat3x3(0)"},
                                                         {"highp vec3", "vec3(0.)"},
                                                         {"Hit", "Hit(0.,vec3(0.))"}};
    for (const auto& [type, zero] : cases) {
        const std::string text = type + " a", use = "; g(a);";
        EXPECT_EQ(in_function(text + use), text + " = " + zero + use);
    }
}

TEST(Zeros, AreOfArrays) {
    EXPECT_EQ(in_function("float a[3]; g(a);"), "float a[3] = float[3](0.,0.,0.); g(a);");
    EXPECT_EQ(in_function("int[2] a; g(a);"), "int[2] a = int[2](0,0); g(a);");
    EXPECT_EQ(in_function("Hit a[2]; g(a);"),
              "Hit a[2] = Hit[2](Hit(0.,vec3(0.)),Hit(0.,vec3(0.))); g(a);");
    EXPECT_EQ(in_function("const int N = 3; float a[N * 2 - (1 + 3)]; g(a);"),
              "const int N = 3; float a[N * 2 - (1 + 3)] = float[2](0.,0.); g(a);");
    EXPECT_EQ(zeroed("#define N 2\nconst int M = N - 1; bool a[M]; void f() { g(a); }"),
              "#define N 2\nconst int M = N - 1; bool a[M] = bool[1](false); void f() { g(a); }");
}

TEST(Zeros, AreOfStructsWithinOneAnother) {
    const std::string structs =
        "struct A { vec2 p, q[2]; }; struct B { A a[2]; int n; };\nvoid f() { ";
    EXPECT_EQ(zeroed(structs + "B b; g(b); }"),
              structs +
                  "B b = B(A[2](A(vec2(0.),vec2[2](vec2(0.),vec2(0.))),"
                  "A(vec2(0.),vec2[2](vec2(0.),vec2(0.)))),0); g(b); }");
    EXPECT_EQ(in_function("struct L { int i; } l, m; g(l, m);"),
              "struct L { int i; } l = L(0), m = L(0); g(l, m);");
    EXPECT_EQ(zeroed("struct { float a; } box, two[2]; void f() { g(box, two); }"),
              "struct glint_unnamed0 { float a; } box = glint_unnamed0(0.), "
              "two[2] = glint_unnamed0[2](glint_unnamed0(0.),glint_unnamed0(0.)); "
              "void f() { g(box, two); }");
    // Of two with one name the one is meant that is seen.
    EXPECT_EQ(
        zeroed("void e() { struct L { int i; }; } void f() { struct L { bool b; }; L l; g(l); }"),
        "void e() { struct L { int i; }; } void f() { struct L { bool b; }; L l; "
        "l.b = false; g(l); }");
    const std::string shadowed =
        "struct L { int i; }; struct M { L l; }; void f() { L l; { struct L { bool b; }; M m; "
        "g(m); } "
        "g(l); }";
    EXPECT_EQ(zeroed(shadowed),
              "struct L { int i; }; struct M { L l; }; void f() { L l; l.i = 0; { struct L { bool "
              "b; }; M m; m.l.i = 0; g(m); } g(l); }");
}

TEST(Zeros, AreOfEachNameOfADeclaration) {
    EXPECT_EQ(in_function("float a, b = 1., c[2]; a += b; g(c);"),
              "float a = 0., b = 1., c[2] = float[2](0.,0.); a += b; g(c);");
    EXPECT_EQ(in_function("float a, b = a;"), "float a = 0., b = a;");
    EXPECT_EQ(in_function("for (float i, d; i++ < 9.; d += 1.) g(i);"),
              "for (float i = 0., d = 0.; i++ < 9.; d += 1.) g(i);");
    EXPECT_EQ(in_function("for (int i; i < 3; ) { vec2 p; p.x += 1.; }"),
              "for (int i = 0; i < 3; ) { vec2 p = vec2(0.); p.x += 1.; }");
    EXPECT_EQ(in_function("switch (n) { case 0: float x; g(x); }"),
              "switch (n) { case 0: float x = 0.; g(x); }");
}

TEST(Zeros, AreOfGlobals) {
    EXPECT_EQ(
        zeroed("float a; vec2 b[2]; uniform float u; out vec4 o; const float c = 1.; in vec2 i;\n"
               "int unused; void f() { a += b[0].x * u; o = vec4(c); }"),
        "float a = 0.; vec2 b[2] = vec2[2](vec2(0.),vec2(0.)); uniform float u; out vec4 o; "
        "const float c = 1.; in vec2 i;\n"
        "int unused; void f() { a += b[0].x * u; o = vec4(c); }");
}

TEST(Zeros, AreOfOutParameters) {
    EXPECT_EQ(zeroed("void f(out vec3 c, inout float a, out float n[2], out int) { a += c.x; }"),
              "void f(out vec3 c, inout float a, out float n[2], out int) { c = vec3(0.); "
              "n = float[2](0.,0.); glint_parameter3 = 0; a += c.x; }");
    EXPECT_EQ(zeroed("bool f(out float t) { if (x) return false; t = 1.; return true; }"),
              "bool f(out float t) { t = 0.; if (x) return false; t = 1.; return true; }");
    for (const char* whole :
         {"bool f(out float t) { t = 1.; if (x) return false; return true; }",
          "bool f(out float t) { if (x) { t = 2.; return false; } t = 1.; return true; }",
          "void f(out float t) { if (x) t = 2.; else { t = 3.; } }", "void f(out float t);"})
        EXPECT_EQ(zeroed(whole), whole);
    EXPECT_EQ(zeroed("void f(out float t) { for (int i = 0; i < n; ++i) t = 1.; }"),
              "void f(out float t) { t = 0.; for (int i = 0; i < n; ++i) t = 1.; }");
}

TEST(Zeros, AreReturnedWhereAPathLacksAReturn) {
    EXPECT_EQ(zeroed("float f() { if (x) return 1.; }"),
              "float f() { if (x) return 1.;  return 0.; }");
    EXPECT_EQ(zeroed("mat2x3 f() { for (;;) { if (x) break; return m; } // end\n}"),
              "mat2x3 f() { for (;;) { if (x) break; return m; } // end\n return mat2x3(0); }");
    for (const char* whole :
         {"float f() { if (x) return 1.; else return 2.; }",
          "float f() { for (;;) { return 1.; } }", "float f() { while (true) if (x) return 1.; }",
          "void f() { if (x) return; }",
          "float f() { g(); }"})  // without any, which a driver refuses
        EXPECT_EQ(zeroed(whole), whole);
}

TEST(Zeros, AreNotWrittenForWhatHasAValueBeforeItIsRead) {
    for (const char* body :
         {"float a; a = 1.; g(a);", "float a, b; a = b = 1.; g(a, b);",
          "float a; g(); a = x, g(a);", "float a; if (x) a = 1.; else a = 2.; g(a);",
          "float a; if (x) return; a = 1.; g(a);",
          "float a; if (x) { a = 1.; } else { return; } g(a);", "float a; put(a, 1.); g(a);",
          "float a; float b = h(put(a, 1.)) + a;", "float a; do { a = 1.; } while (a < x);",
          "float a; for (int i = 0; i < 3; ++i) { a = 1.; g(a); }", "float a; { a = 1.; } g(a);",
          "for (int i = 0; i < 3; ++i) { float a; a = x; g(a); }", "float a;", "const float a;",
          "float a; g(b.a); a = 1.;", "Hit a; a = h(); g(a.t);",
          "float a; for (int i = 0; i < 3; g(a)) { a = 1.; }"})
        EXPECT_EQ(in_function(body), body);
}

TEST(Zeros, AreNotWrittenForStacks) {
    const std::string stack =
        "float a[4]; int n = 0; for (;;) { if (x) { a[n] = y; ++n; } if (n == 0) break; ";
    EXPECT_EQ(in_function(stack + "--n; z = a[n]; if (w) { g(a[n]); } }"),
              stack + "--n; z = a[n]; if (w) { g(a[n]); } }");
    for (const char* rest :
         {"z = a[n]; --n; }", "--n; if (y) ++n; z = a[n]; }", "++n; --n; z = a[n]; }",
          "n -= 1; z = a[n]; }", "--n; z = a[n + 1]; }", "--n; for (;;) { z = a[n]; --n; } }",
          "--n; z = a[n]; g(n); }", "--n; z = a[n]; } g(a);", "n = 3; --n; z = a[n]; }",
          "a[n].x = 1.; ++n; --n; z = a[n]; }", "if (y) a[n] = 1.; ++n; --n; z = a[n]; }",
          "{ int n = 2; --n; z = a[n]; } }", "--n; y < n++ ? z : x; z = a[n]; }",
          "while (n > 0) { --n; } z = a[n]; }"})
        EXPECT_TRUE(in_function(stack + rest).starts_with("float a[4] = float[4](")) << rest;
    for (const char* other : {"int n = 1; float a[4]; for (;;) { a[n] = y; ++n; --n; z = a[n]; }",
                              "int n = 0; for (;;) { float a[4]; a[n] = y; ++n; --n; z = a[n]; }",
                              "float a[4]; for (int n = 0;;) { a[n] = y; ++n; --n; z = a[n]; }"})
        EXPECT_NE(in_function(other).find("a[4] = float[4]("), std::string::npos) << other;
}

TEST(Zeros, AreWrittenWhereAValueIsNotCertain) {
    for (const char* rest :
         {"if (x) a = 1.; g(a);", "a += 1.;", "a = a + 1.;", "x && (a = 1.) > 0.; g(a);",
          "for (int i = 0; i < n; ++i) a = 1.; g(a);", "while (x) { a = 1.; } g(a);", "put(b, a);",
          "switch (n) { case 0: a = 1.; break; default: a = 2.; } g(a);",
          "for (int i = 0; i < n; ++i) { if (i > 0) g(a); a = 1.; }", "x ? put(a, 1.) : y; g(a);",
          "for (int i = 0; i < n; g(a)) { if (x) continue; a = 1.; }",
          "do { if (x) break; a = 1.; } while (y); g(a);", "put(a, a);", "h(a);",
          "{ float a = 1.; } g(a);", "\n#ifdef GL_some\na = 1.;\n#endif\ng(a);"})
        EXPECT_EQ(in_function(std::string("float a; ") + rest),
                  std::string("float a = 0.; ") + rest);
    EXPECT_EQ(in_function("vec2 a; a.x = 1.; g(a);"), "vec2 a = vec2(0.); a.x = 1.; g(a);");
    EXPECT_EQ(in_function("Hit a; a.t = 1.; g(a);"), "Hit a = Hit(0.,vec3(0.)); a.t = 1.; g(a);");
}

TEST(Zeros, AreWrittenPartByPartWhereALengthIsTheCompilersToKnow) {
    const std::string zeros =
        " for (int glint_part0 = 0; glint_part0 < int(a.length()); ++glint_part0) { "
        "a[glint_part0] = 0.; }";
    for (const char* length :
         {"int(4.)", "x ? 2 : 3", "s.x", "z.length()", "max(1, 2)", "33", "2000"}) {
        const std::string declared = "float a[" + std::string(length) + "];";
        EXPECT_EQ(in_function(declared + " g(a);"), declared + zeros + " g(a);");
    }
    const std::string parts =
        " for (int glint_part0 = 0; glint_part0 < int(q.length()); ++glint_part0) { "
        "q[glint_part0].t = vec2(0.); for (int glint_part2 = 0; glint_part2 < "
        "int(q[glint_part0].v.length()); ++glint_part2) { q[glint_part0].v[glint_part2] = 0; } }";
    const std::string structure = "struct Q { vec2 t; int v[int(2.)]; }; Q q[int(3.)];";
    EXPECT_EQ(in_function(structure + " g(q);"), structure + parts + " g(q);");
    EXPECT_EQ(zeroed("void f(out float a[int(2.)]) { g(a); }"),
              "void f(out float a[int(2.)]) {" + zeros + " g(a); }");
    EXPECT_EQ(zeroed("float[int(2.)] f() { if (x) return y; }"),
              "float[int(2.)] f() { if (x) return y;  float[ int ( 2. ) ] glint_result; for (int "
              "glint_part0 = 0; glint_part0 < int(glint_result.length()); ++glint_part0) { "
              "glint_result[glint_part0] = 0.; } return glint_result; }");
}

// A driver takes 20 s for a constructor of 256 vec4, and nothing for a loop.
TEST(Zeros, OfLongArraysAreListedWhereNoStatementCanStand) {
    std::string list = "0.";
    for (int i = 1; i < 33; ++i) list += ",0.";
    EXPECT_EQ(in_function("float a[33], b = a[0]; g(b);"),
              "float a[33] = float[33](" + list + "), b = a[0]; g(b);");
    EXPECT_EQ(in_function("float a[32]; g(a);"),
              "float a[32] = float[32](" + list.substr(3) + "); g(a);");
}

// One driver ends all loops of a pixel after 65,535 turns, and the text's own are to have these.
TEST(Zeros, OfLongArraysThatAreMadeOftenAreListed) {
    const auto has_loop = [](const std::string& text) {
        const Reading reading = read_glsl(text, known_of_driver());
        Edits edits(reading);
        write_zeros(reading, edits, "main");
        return edits.apply().text.find("glint_part0") != std::string::npos;
    };
    const std::string array = "float a[64]; g(a); ",
                      call = "void f() { " + array + "} void main() ";
    EXPECT_TRUE(has_loop("void main() { " + array + "}"));
    EXPECT_TRUE(has_loop(call + "{ f(); f(); }"));
    EXPECT_FALSE(has_loop(call + "{ f(); f(); f(); f(); f(); }"));
    EXPECT_FALSE(has_loop(call + "{ for (int i = 0; i < 9; ++i) f(); }"));
    EXPECT_FALSE(has_loop(call + "{ while (x) if (y) f(); }"));
    EXPECT_FALSE(has_loop("void main() { do { " + array + "} while (x); }"));
    EXPECT_FALSE(
        has_loop("void f() { " + array + "} void h() { f(); } void main() { for (;;) h(); }"));
    EXPECT_FALSE(has_loop("void f(out float a[64]) { g(a); } void main() { for (;;) f(b); }"));
}

TEST(Zeros, OfLongGlobalsAreListedWhereTheEntryMayNotKnowThem) {
    for (const char* text :
         {"vec2 u[64]; void f() { g(u); } void mainImage(out vec4 o, vec2 u) { f(); }",
          "float q[64]; void f() { g(q); }\n#define q 3.0\nvoid mainImage(out vec4 o, vec2 u) { "
          "f(); }",
          "float d[64]; float mainImage(vec2 p, float k) { g(d); } void mainImage(out vec4 o, vec2 "
          "u) { mainImage(u, 1.); }",
          "#ifdef GL_EXT_x\nfloat w[64]; void f() { g(w); }\n#endif\nvoid mainImage(out vec4 o, "
          "vec2 u) { o = vec4(1); }",
          "float w[64];\n#ifdef GL_EXT_x\nvoid mainImage(out vec4 o, vec2 u) { g(w); "
          "}\n#else\nvoid mainImage(out vec4 o, vec2 u) { g(w); }\n#endif\n"}) {
        const Reading reading = read_glsl(text, known_of_driver());
        Edits edits(reading);
        write_zeros(reading, edits, "mainImage");
        const std::string result = edits.apply().text;
        EXPECT_NE(result.find("[64] = "), std::string::npos) << result;
        EXPECT_EQ(result.find("glint_part0"), std::string::npos) << result;
    }
}

TEST(Zeros, OfAStructThatABranchDefinesOtherwiseAreLeftAlone) {
    const std::string text =
        "#ifndef GL_EXT_x\nstruct S { float a; };\n#else\nstruct S { vec2 b; };\n#endif\n"
        "void f() { S s; g(s); }";
    EXPECT_EQ(zeroed(text), text);
}

TEST(Zeros, OfAGlobalWhoseLengthIsTheCompilersToKnowAreWrittenInTheEntry) {
    const std::string text = "float a[int(2.)]; void late(); void main() { g(a); }";
    const Reading reading = read_glsl(text, known_of_driver());
    Edits edits(reading);
    write_zeros(reading, edits, "main");
    EXPECT_EQ(edits.apply().text,
              "float a[int(2.)]; void late(); void main() { for (int glint_part0 = 0; glint_part0 "
              "< int(a.length()); ++glint_part0) { a[glint_part0] = 0.; } g(a); }");
}

// Two functions may each have a constant of a name, and each its own value.
TEST(Zeros, AreNotMistakenInTheLengthByAConstantOfAnotherFunction) {
    const std::string text =
        "float f() { const int N = 4; float w[N]; return w[0]; }"
        "float h() { const int N = 8; float w[N]; return w[0]; }";
    const std::string result = zeroed(text);
    EXPECT_EQ(result.find("float["), std::string::npos) << result;
    EXPECT_NE(result.find("float w[N]; for ("), result.rfind("float w[N]; for (")) << result;
}

TEST(Zeros, LeaveAloneWhatNoValueCanBeWrittenFor) {
    for (const char* body :
         {"sampler2D s; g(s);", "float a[]; g(a);", "float a[2][2]; g(a);", "Nothing a; g(a);",
          "for (float a[int(2.)]; x;) g(a);", "float a[int(2.)], b = a[0]; g(b);"})
        EXPECT_EQ(in_function(body), body);
    for (const char* text :
         {"struct S { S s; }; void f() { S s; g(s); }",
          "struct S { sampler2D s; }; void f(S p) { S s; g(s); }", "void f() { float a; g(a); "})
        EXPECT_EQ(zeroed(text), text);
}

TEST(Zeros, AreWrittenWithinMacros) {
    EXPECT_EQ(zeroed("#define V vec3 a\nvoid f() { V; g(a); }"),
              "#define V vec3 a\nvoid f() { V = vec3(0.); g(a); }");
    EXPECT_EQ(zeroed("#define V(t) t a; t b\nvoid f() { V(vec3); g(a, b); }"),
              "#define V(t) t a; t b\nvoid f() { vec3 a = vec3(0.); vec3 b = vec3(0.); g(a, b); }");
    EXPECT_EQ(zeroed("#define vec3 vec2\nvoid f() { vec3 a; g(a); }"),
              "#define vec3 vec2\nvoid f() { vec3 a = vec2(0.); g(a); }");
}

TEST(Zeros, NameWhatWasUnset) {
    const std::string text = "float f() { float a, b = 2.; if (b > a) return nowhere; }\n";
    const Reading reading = read_glsl(text, {});
    Edits edits(reading);
    const std::vector<Unset> unset = write_zeros(reading, edits);
    const EditedText edited = edits.apply();
    EXPECT_EQ(edited.map.origin(edited.text.find("nowhere")), text.find("nowhere"));
    ASSERT_EQ(unset.size(), 2u);
    EXPECT_EQ(unset[0].name, "f");
    EXPECT_TRUE(unset[0].is_result);
    EXPECT_EQ(unset[1].name, "a");
    EXPECT_EQ(unset[1].at, text.find("a,"));
}

TEST(Zeros, LeaveTheOutputsOfTheEntryToTheHostButForMarks) {
    const std::string text = "void f(out vec4 c) {} void g(out vec4 c) {}\n";
    const Reading reading = read_glsl(text, {});
    Edits edits(reading), marked(reading), all(reading);
    EXPECT_EQ(write_zeros(reading, edits, "f").size(), 2u);
    EXPECT_EQ(edits.apply().text, "void f(out vec4 c) {} void g(out vec4 c) { c = vec4(0.);}\n");
    const std::size_t at = text.find("c)");
    write_zeros(reading, all, "f", {{{0, text.find("g(")}, FirstValue::large}});
    EXPECT_EQ(all.apply().text, "void f(out vec4 c) {} void g(out vec4 c) { c = vec4(0.);}\n")
        << "it is no variable";
    write_zeros(reading, marked, "f", {{{at, at + 1}, FirstValue::large, true}});
    EXPECT_EQ(marked.apply().text,
              "void f(out vec4 c) { c = vec4(1e9);} void g(out vec4 c) { c = vec4(0.);}\n");
}

// Each call begins at 0, as of any other function.
TEST(Zeros, AreOfTheOutputsOfAnEntryThatTheTextCallsItself) {
    const std::string text =
        "void f(out vec4 c, float t) { c += t; } void f(out vec4 c) { f(c, 1.); }";
    const Reading reading = read_glsl(text, {});
    Edits edits(reading);
    write_zeros(reading, edits, "f");
    EXPECT_EQ(
        edits.apply().text,
        "void f(out vec4 c, float t) { c = vec4(0.); c += t; } void f(out vec4 c) { f(c, 1.); }");
}

TEST(Zeros, AreMarksWhereTheyAreWantedToShow) {
    const std::string text =
        "void f() { float a; int b; bool c; mat2x3 d; ivec2 e; g(a, b, c, d, e); }\n";
    const Reading reading = read_glsl(text, {});
    Edits edits(reading);
    write_zeros(reading, edits, {}, Marked{{0, text.find("e;")}});
    EXPECT_EQ(
        edits.apply().text,
        "void f() { float a = uintBitsToFloat(0x7FC0DEADu); int b = 0x7FC0DEAD; bool c = true; "
        "mat2x3 d = mat2x3(vec3(uintBitsToFloat(0x7FC0DEADu)),"
        "vec3(uintBitsToFloat(0x7FC0DEADu))); ivec2 e = ivec2(0); g(a, b, c, d, e); }\n");
}

TEST(Zeros, TakeNoSecondsForAVastText) {
    std::string text = "void f() {\n", uses;
    for (int i = 0; i < 20000; ++i) {
        text += "float a" + std::to_string(i) + ";\n";
        uses.insert(0, "g(a" + std::to_string(i) + ");\n");
    }
    text += uses + "}\n";
    const Reading reading = read_glsl(text, {});
    Edits edits(reading);
    EXPECT_EQ(write_zeros(reading, edits).size(), 20000u);
}

}  // namespace
}  // namespace glint::zeros_test
