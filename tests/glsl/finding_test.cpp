// What a compiler takes, and a reader would want to know.
#include "glsl/finding.h"

#include "glsl/loop_bound.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace glint::finding_test {
namespace {

// "shadowed-name at `b`: the text's end" for each finding.
std::vector<std::string> found(std::string_view text,
                               const std::unordered_map<std::string_view, double>& known = {}) {
    const Reading reading = read_glsl(text, known_of_driver());
    const std::vector<bool> all(reading.functions.size(), true);
    std::vector<std::string> list;
    auto findings = find_shadowed_names(reading, all);
    std::ranges::copy(find_long_loops(reading, all, known), std::back_inserter(findings));
    for (const Finding& one : findings) {
        const auto line = std::count(text.begin(), text.begin() + static_cast<long>(one.at), '\n');
        list.push_back(std::string(one.name) + " " + std::to_string(line + 1));
    }
    return list;
}
using List = std::vector<std::string>;

TEST(ShadowedNames, OfLocalsParametersGlobalsAndFunctions) {
    EXPECT_EQ(found("float g;\n"
                    "float f(float a) { return a; }\n"
                    "float h(float g) { return g; }\n"
                    "void k(float a) {\n"
                    "    { float a = 1.0; }\n"
                    "    float b; for (int b = 0; b < 3; ++b) { }\n"
                    "    float f = f(b);\n"
                    "    for (int i = 0; i < 3; ++i)\n"
                    "        for (int i = 0; i < 3; ++i) g = b;\n"
                    "}\n"),
              (List{"shadowed-name 3", "shadowed-name 5", "shadowed-name 6", "shadowed-name 7",
                    "shadowed-name 9"}));
}

TEST(ShadowedNames, NotInScopesSideBySideNorOfMembersNorBeforeTheOther) {
    EXPECT_EQ(found("struct S { float x, y; };\n"
                    "float before(float later) { float x = later; return x; }\n"
                    "float later;\n"
                    "float f(vec2 x);\n"
                    "float f(vec2 x) { { float t; } { float t; } float t; return t; }\n"
                    "void g(S s) { for (int i = 0; i < 3; ++i) { float x = s.x; }\n"
                    "    for (int i = 0; i < 3; ++i) { float x = s.x; }\n"
                    "    if (s.x > 0.0) float y = 1.0; else float y = 2.0;\n"
                    "    switch (1) { case 0: { int y; } case 1: { int y; } } int y; }\n"),
              List{});
}

TEST(ShadowedNames, OfAFunctionThatGlslHas) {
    EXPECT_EQ(found("float sinc(float x) { return sin(x) / x; }\n"
                    "float mix(int a) { return 1.0; }\n"),
              List{"shadowed-name 2"});
}

TEST(ShadowedNames, OfWhatTheHostDeclaresUnlessTheTextDoesItself) {
    const auto found_in = [](const std::string& text) {
        const Reading reading = read_glsl(text, known_of_driver());
        return find_shadowed_names(reading, std::vector<bool>(reading.functions.size(), true),
                                   [](std::string_view name) { return name == "iTime"; })
            .size();
    };
    EXPECT_EQ(found_in("float f(float iTime) { return iTime; }\n"), 1u);
    EXPECT_EQ(found_in("void f() { float iTime = 1.0, time = iTime; }\n"), 1u);
    EXPECT_EQ(found_in("struct S { float iTime; };\nfloat f(S s) { return s.iTime; }\n"), 0u);
}

TEST(ShadowedNames, InAMacroStandAtItsUse) {
    EXPECT_EQ(
        found("#define TWICE { float t = 1.0; { float t = 2.0; } }\nvoid f() {\n  TWICE\n}\n"),
        List{"shadowed-name 3"});
}

TEST(ReservedNames, AreToldOnce) {
    const std::string text =
        "float a__b;\nvoid f() { float __x = a__b, y_ = float(__LINE__), webgl_z; }\n";
    const Reading reading = read_glsl(text, known_of_driver());
    const auto findings = find_reserved_names(reading, {true});
    ASSERT_EQ(findings.size(), 3u);
    EXPECT_EQ(findings[0].at, text.find("a__b"));
    EXPECT_EQ(findings[1].at, text.find("__x"));
    EXPECT_EQ(findings[2].at, text.find("webgl_z"));
    EXPECT_TRUE(find_reserved_names(reading, {false}).size() == 1);
}

std::vector<std::string> refused(const std::string& text) {
    const Reading reading = read_glsl(text, known_of_driver());
    std::vector<std::string> list;
    for (const Finding& one :
         find_refused_by_browsers(reading, std::vector<bool>(reading.functions.size(), true)))
        list.push_back(text.substr(one.at, 12) + " " + one.text.substr(0, 40));
    return list;
}

TEST(BrowserRules, RefuseAChoiceOfWhatIsNoNumber) {
    const std::string head = "struct S { float a; };\nS f(bool c, S s, S t) { ";
    using Words = std::vector<std::string>;
    const Words choice = {"? s : t; ret browsers refuse ?: for structures, which"};
    EXPECT_EQ(refused(head + "S u = c ? s : t; return u; }"), choice);
    EXPECT_EQ(refused(head + "S u; u = (c ? s : t); return u; }").size(), 1u);
    EXPECT_EQ(refused(head + "return c ? s : t; }").size(), 1u);
    EXPECT_EQ(refused(head + "float x = c ? s.a : t.a; x = c ? 1.0 : g(c ? 1 : 2); return s; }"),
              Words());
    EXPECT_EQ(refused("void f(bool c) { float a[2], b[2]; float d[2] = c ? a : b; }").size(), 1u);
    for (const char* use : {"u = (c ? s : t);", "g((c ? s : t).a);", "g(c ? (s) : t);",
                            "g((c ? f(c, s, t) : s).a);", "g((c ? S(1.0) : s).a);"})
        EXPECT_EQ(refused(head + "S u; " + use + " return u; }").size(), 1u) << use;
    const std::string arrays =
        "struct A { float m[2]; };\nvoid f(bool c) { float a[2], b[2]; A s; ";
    for (const char* use : {"a = c ? a : b;", "g((c ? a : b)[0]);", "g(c ? a : b);",
                            "g((c ? s.m : b)[0]);", "a = c ? float[2](1.0, 2.0) : a;"})
        EXPECT_EQ(refused(arrays + use + " }").size(), 1u) << use;
    for (const char* use : {"g(c ? a[0] : b[1]);", "g(c ? s.m[1] : 1.0);",
                            "g(c ? float[2](1.0, 2.0)[1] : 1.0);", "c = c ? c : !c;"})
        EXPECT_EQ(refused(arrays + use + " }"), Words()) << use;
    EXPECT_EQ(refused("void g() {}\nvoid f(bool c) { c ? g() : g(); }").size(), 1u);
    EXPECT_EQ(refused("float g() { return 1.0; }\nvoid f(bool c) { c ? g() : g(); }"), Words());
}

// As Chromium does.
TEST(BrowserRules, RefuseALoopWithoutAnEnd) {
    const auto loops = [](const std::string& loop) {
        return refused("void f() { float x; " + loop + " }").size();
    };
    for (const char* endless :
         {"for (;;) {}", "while (true) { for (;;) break; }", "for (int i = 0;; i++) x += 1.;",
          "for (;;) { if (x > 1.) discard; }", "for (; (true);) { switch (1) { case 1: break; } }"})
        EXPECT_EQ(loops(endless), 1u) << endless;
    for (const char* ends :
         {"for (;;) { break; }", "while (true) { if (x > 1.) { x = 2.; break; } }",
          "for (;;) { for (;;) { return; } }", "do {} while (true);", "while (x < 1.) x += 1.;"})
        EXPECT_EQ(loops(ends), 0u) << ends;
}

TEST(BrowserRules, RefuseADeepExpression) {
    const auto chain = [](int count, const std::string& begin, const std::string& end) {
        std::string text = "float f(float v) { return ";
        for (int i = 0; i < count; ++i) text += begin;
        text += "v";
        for (int i = 0; i < count; ++i) text += end;
        return refused(text + "; }\nfloat g(float v) { return f(-v); }").size();
    };
    for (const auto& [begin, end] : {std::pair("", " + v"),
                                     {"", " + v * v"},
                                     {"sin(", ")"},
                                     {"(", " + v)"},
                                     {"", " * -v"},
                                     {"max(v, 1. + ", ")"}}) {
        const int levels = std::string_view(begin).starts_with("max") ? 2 : 1;
        EXPECT_EQ(chain(260 / levels, begin, end), 1u) << begin << end;
        EXPECT_EQ(chain(240 / levels, begin, end), 0u) << begin << end;
    }
    for (const auto& [begin, end] : {std::pair("~", ""),
                                     {"", " && v"},
                                     {"", " ^ v"},
                                     {"- ", ""},
                                     {"", " << v"},
                                     {"v ? v : ", ""},
                                     {"v = ", ""}}) {
        EXPECT_EQ(chain(260, begin, end), 1u) << begin << end;
        EXPECT_EQ(chain(240, begin, end), 0u) << begin << end;
    }
    EXPECT_EQ(chain(300, "(", ")"), 0u);
    EXPECT_EQ(chain(300, "", "; v *= 0.5"), 0u);
    EXPECT_EQ(chain(300, "0.001 + ", ""), 0u) << "numbers are added up at once";
    EXPECT_EQ(chain(300, "", "; v += v"), 0u);
}

TEST(BrowserRules, RefuseASecondNameOfALoop) {
    const auto loops = [](const std::string& loop) {
        return refused("void f() { float x; " + loop + " }").size();
    };
    EXPECT_EQ(loops("for (int i = 0; i < 3; i++) { x += 1.; int i = 2; }"), 1u);
    EXPECT_EQ(loops("for (int i = 0; i < 3; i++) int i = 2;"), 1u);
    EXPECT_EQ(loops("while (bool b = x < 1.) { bool b = true; }"), 1u);
    for (const char* others :
         {"for (int i = 0; i < 3; i++) { { int i = 2; } }", "for (int i = 0; i < 3; i++) int k;",
          "for (int i = 0; i < 3; i++) for (int i = 0; i < 3; i++) x += 1.;",
          "for (int i = 0; i < 3; i++) { int j = i; } int j;"})
        EXPECT_EQ(loops(others), 0u) << others;
}

TEST(BrowserRules, RefuseAConstPlace) {
    EXPECT_EQ(refused("void mainImage(out vec4 c, const in vec2 p) { c = vec4(1); }").size(), 1u);
}

TEST(BrowserRules, RefuseAColourThatIsInout) {
    EXPECT_EQ(refused("void mainImage(inout vec4 c, in vec2 p) { c = vec4(1); }").size(), 1u);
    EXPECT_TRUE(refused("void mainImage(out vec4 c, vec2 p) { c = vec4(1); }").empty());
}

TEST(BrowserRules, RefuseAnOutputBesideTheSites) {
    const std::string entry = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n";
    EXPECT_EQ(refused("out vec4 colour;\n" + entry).size(), 1u);
    EXPECT_TRUE(refused("layout(location = 0) out vec4 colour;\n" + entry).empty());
    EXPECT_TRUE(refused("vec4 colour;\nvoid f(out vec4 x) { x = colour; }\n" + entry).empty());
    EXPECT_TRUE(refused("out vec4 colour;\nvoid main() { colour = vec4(1); }\n").empty());
}

struct Loop {
    const char* text;
    LoopBound::Kind kind;
    double turns;
};

TEST(LoopBounds, AreReadFromTheHeadAndFromBreaks) {
    using Kind = LoopBound::Kind;
    const Loop loops[] = {
        {"for (int i = 0; i < 10; ++i) ;", Kind::number, 10},
        {"for (int i = 2; i <= 10; i += 2) ;", Kind::number, 5},
        {"for (int i = 9; i >= 0; i--) ;", Kind::number, 10},
        {"for (float t = 0.; t < 1.; t += .1) ;", Kind::number, 10},
        {"for (int i; i++ < 1e2; ) ;", Kind::number, 100},
        {"for (int i = 5; i --> 0; ) ;", Kind::number, 5},
        {"for (int i = 0; kMany > i; i++) ;", Kind::number, 64},
        {"for (int i = 0; i < kMany * 2 + 1; i++) ;", Kind::number, 129},
        {"for (int i = 0; i < min(n, 7); i++) ;", Kind::number, 7},
        {"for (int i = 0; i < steps; i++) ;", Kind::number, 48},
        {"for (int i = 0; n > 3 && i < 9; i++) ;", Kind::number, 9},
        {"int i; while (i < 20) { i += 2; }", Kind::number, 10},
        {"do { } while (false);", Kind::number, 1},
        {"int i; for (;;) { if (++i > 30) break; }", Kind::number, 31},
        {"vec4 v; for (; v.w++ < 40.; ) ;", Kind::number, 40},
        {"for (int i = 0; i < n; i++) ;", Kind::some, 0},
        {"for (float t = 1.; t < 100.; t *= 2.) ;", Kind::some, 0},
        {"for (float t = 0.; t < 9.; t += x) ;", Kind::some, 0},
        {"for (int bits = n; bits != 0; bits &= bits - 1) ;", Kind::some, 0},
        {"int i = 1; while (i < n) i = 2 * i + 1;", Kind::some, 0},
        {"for (float t = 0.; t < 8.; ) t += clamp(x, .5, 9.);", Kind::number, 16},
        {"for (float t = 0.; t < 8.; ) t += max(x, .5);", Kind::number, 16},
        {"for (;;) ;", Kind::none, 0},
        {"while (true) { if (x > 3.) break; }", Kind::none, 0},
        {"float t; while (t < 20.) { t += sin(x); }", Kind::none, 0},
        {"bool done; while (!done) done = x > 1.;", Kind::none, 0},
        {"for (int i = 0; i < 9 || x > 1.; i++) ;", Kind::none, 0},
    };
    for (const Loop& loop : loops) {
        SCOPED_TRACE(loop.text);
        const std::string text =
            "const int kMany = 64; uniform int steps;\nvoid f(int n, float x) { " +
            std::string(loop.text) + " }\n";
        const Reading reading = read_glsl(text, known_of_driver());
        const Constants constants(reading, {{"steps", 48.0}});
        for (std::uint32_t i = 0; i < reading.statements.size(); ++i) {
            const StatementKind kind = reading.statements[i].kind;
            if (kind != StatementKind::for_ && kind != StatementKind::while_ &&
                kind != StatementKind::do_)
                continue;
            const LoopBound bound = loop_bound(reading, constants, i);
            EXPECT_EQ(bound.kind, loop.kind);
            if (bound.kind == loop.kind) {
                EXPECT_EQ(bound.turns, loop.turns);
            }
        }
    }
}

TEST(LongLoops, AreThoseWhoseTurnsTogetherPassTheBudget) {
    EXPECT_EQ(found("void f() {\n"
                    "    for (int i = 0; i < 65000; ++i) ;\n"
                    "    for (int i = 0; i < 70000; ++i) ;\n"
                    "    for (int i = 0; i < 300; ++i)\n"
                    "        for (int j = 0; j < 300; ++j) ;\n"
                    "}\n"
                    "void g() { for (int i = 0; i < 300; ++i) ; }\n"
                    "void h() {\n"
                    "    for (int i = 0; i < 300; ++i) g();\n"
                    "    for (int i = 0; i < 2; ++i) f();\n"
                    "}\n"),
              (List{"long-loop 3", "long-loop 4", "long-loop 9"}));
    EXPECT_EQ(found("uniform int n;\nvoid f() { for (int i = 0; i < n; ++i) ; }\n", {{"n", 1e5}}),
              List{"long-loop 2"});
    EXPECT_EQ(found("void f(bool b) {\n"
                    "    for (int i = 0; i < (b ? 0 : 70000); ++i) ;\n"
                    "    for (int i = 0; i < (b ? 0 : 60000); ++i) ;\n"
                    "}\n"),
              List{"long-loop 2"});
    const char* of_a_clock = "void f() { for (float t = iTime; t < iTime + 1.0; t += 0.01) ; }\n";
    EXPECT_EQ(found(of_a_clock, {{"iTime", 86400.0}}), List{});
    EXPECT_EQ(found(of_a_clock, {{"iTime", 2592000.0}}), List{"long-loop 1"})
        << "a float of that age holds no such steps";
    for (const char* none : {"void f() { for (float t = iTime; t < 10.0; t += 0.01) ; }\n",
                             "void f() { for (float t = iTime; t < iTime + 0.05; t += 0.01) ; }\n"})
        EXPECT_EQ(found(none, {{"iTime", 2592000.0}}), List{}) << none;
    EXPECT_EQ(found("void f() {\n for (;;) ;\n}\n"), List{"loop-without-bound 2"});
    EXPECT_EQ(found("void f() {\n float x = 0.0; while (x < 3.0) { x = 1.0; }\n}\n"),
              List{"loop-without-bound 2"});
    for (const char* ends : {"for (int i = 0; i < 10; i++) { if (i == 3) i = 8; }",
                             "for (int i = 0; i < 10; i++) { if (h < 0.1) { i = 100; continue; } }",
                             "for (vec2 v = vec2(0); v.x < 4.0; v += 1.0) h += v.x;",
                             "int i = 0; while (!(i > 4)) i++;",
                             "int i = 0; do { i++; } while (!(i == 4 || h > 1.0));"})
        EXPECT_EQ(found("float h;\nvoid f() {\n" + std::string(ends) + "\n}\n"), List{}) << ends;
    EXPECT_EQ(found("void f() { f(); for (int i = 0; i < 3; ++i) f(); }\n"), List{});
}

}  // namespace
}  // namespace glint::finding_test
