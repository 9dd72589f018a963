// Declarations, functions, statements and calls.
#include "glsl/reading.h"

#include <gtest/gtest.h>

#include <string>

namespace glint::syntax_test {
namespace {

Reading read(std::string_view text) {
    return read_glsl(text, known_of_driver());
}

// "const float a, b[3] = 1.0" for each declaration of a scope.
std::vector<std::string> declared(const Reading& reading, Scope scope) {
    std::vector<std::string> list;
    for (const Declaration& declaration : reading.declarations) {
        if (declaration.scope != scope) continue;
        std::string text = reading.spelled(declaration.qualifiers);
        if (!text.empty()) text += ' ';
        text +=
            std::string(reading.word(declaration.type)) + reading.spelled(declaration.type_array);
        for (const Declarator& one : declaration.names) {
            text += (&one == &declaration.names.front() ? " " : ", ") +
                    std::string(reading.word(one.name)) + reading.spelled(one.array);
            if (!one.initial.empty()) text += " = " + reading.spelled(one.initial);
        }
        list.push_back(text);
    }
    return list;
}
using List = std::vector<std::string>;

TEST(Declarations, OfGlobals) {
    const Reading reading = read(
        "precision highp float;\n"
        "uniform mediump vec3 a;\n"
        "const float[2] b = float[2](1., f(2, 3)), c[2];\n"
        "layout(location = 0) out vec4 d, e;\n"
        "struct Hit { float t; vec3 n, m[2]; } hit, hits[4];\n"
        "uniform Block { vec4 x; } block;\n"
        "invariant gl_Position;;\n");
    EXPECT_EQ(declared(reading, Scope::global),
              (List{"uniform mediump vec3 a",
                    "const float[ 2 ] b = float [ 2 ] ( 1. , f ( 2 , 3 ) ), c[ 2 ]",
                    "layout ( location = 0 ) out vec4 d, e", "Hit hit, hits[ 4 ]",
                    "uniform Block block", "invariant gl_Position"}));
    EXPECT_EQ(declared(reading, Scope::member), (List{"float t", "vec3 n, m[ 2 ]", "vec4 x"}));
    ASSERT_FALSE(reading.structs.empty());
    EXPECT_EQ(reading.word(reading.structs[0].name), "Hit");
    EXPECT_EQ(reading.structs[0].members.size(), 2u);
    EXPECT_TRUE(reading.find_global("block")->is_block);
    EXPECT_TRUE(reading.find_global("a")->is_uniform);
    EXPECT_TRUE(reading.not_understood.empty());
}

TEST(Declarations, OfParametersAndLocals) {
    const Reading reading = read(
        "float f(const in float a, inout Hit h[2], vec3);\n"
        "float f(void) {\n"
        "    float x, y = 1.0, z[3];\n"
        "    struct S { int i; } s;\n"
        "    for (int i = 0, n = 3; i < n; ++i) { vec2 p; }\n"
        "    while (bool more = g()) ;\n"
        "    float[2] w = float[2](1., 2.);\n"
        "    return x;\n"
        "}\n");
    EXPECT_EQ(declared(reading, Scope::parameter),
              (List{"const in float a", "inout Hit h[ 2 ]", "vec3"}));
    EXPECT_EQ(declared(reading, Scope::local),
              (List{"float x, y = 1.0, z[ 3 ]", "S s", "int i = 0, n = 3", "vec2 p",
                    "bool more = g ( )", "float[ 2 ] w = float [ 2 ] ( 1. , 2. )"}));
    ASSERT_EQ(reading.functions.size(), 2u);
    EXPECT_FALSE(reading.functions[0].is_defined());
    EXPECT_EQ(reading.functions[0].parameters.size(), 3u);
    EXPECT_TRUE(reading.functions[1].parameters.empty());
    EXPECT_TRUE(reading.declarations[reading.functions[0].parameters[1]].is_out);
    EXPECT_TRUE(reading.not_understood.empty());
}

// "for(block(expression))", one for each statement of the first function.
std::string shape(const Reading& reading, std::uint32_t from, std::uint32_t to) {
    constexpr const char* kNames[] = {"block", "declaration", "expression", "if",    "for",
                                      "while", "do",          "switch",     "case",  "return",
                                      "break", "continue",    "discard",    "empty", "unknown"};
    std::string text;
    for (std::uint32_t i = from; i < to; i = reading.statements[i].next) {
        const Statement& statement = reading.statements[i];
        if (!text.empty()) text += ' ';
        text += kNames[static_cast<std::size_t>(statement.kind)];
        if (statement.next > i + 1) text += "(" + shape(reading, i + 1, statement.next) + ")";
    }
    return text;
}
std::string shape(const std::string& body) {
    const Reading reading = read("void f() {" + body + "}");
    return shape(reading, 1, static_cast<std::uint32_t>(reading.statements.size()));
}

TEST(Statements, StandWithinEachOther) {
    EXPECT_EQ(shape("a = b; float c; ; return; break;"),
              "expression declaration empty return break");
    EXPECT_EQ(shape("for (;;) a++;"), "for(expression)");
    EXPECT_EQ(shape("if (a) b(); else if (c) { d(); } else { }"),
              "if(expression if(block(expression) block))");
    EXPECT_EQ(shape("do { x; } while (y); z;"), "do(block(expression)) expression");
    EXPECT_EQ(shape("switch (a) { case 1: b; break; default: c; }"),
              "switch(block(case expression break case expression))");
    EXPECT_EQ(shape("while (i++ < 3) discard;"), "while(discard)");
}

TEST(Statements, KnowTheirParts) {
    const Reading reading =
        read("float f() { for (int i = 0; i < 3; i++) continue; return a + 1.; }");
    const Statement& loop = reading.statements[1];
    EXPECT_EQ(reading.spelled(loop.head), "int i = 0 ; i < 3 ; i ++");
    EXPECT_EQ(reading.spelled(loop.condition), "i < 3");
    EXPECT_EQ(reading.spelled(loop.step), "i ++");
    EXPECT_EQ(reading.spelled(reading.declarations[loop.declaration].tokens), "int i = 0 ;");
    EXPECT_EQ(reading.spelled(reading.statements[3].head), "a + 1.");
    EXPECT_EQ(loop.function, 0u);
    EXPECT_EQ(loop.parent, 0u);
}

TEST(Statements, ThatAreNotUnderstoodAreTold) {
    const Reading reading = read("void f() { if x { y; } z; else q; w; } void g() { a; }");
    EXPECT_EQ(reading.not_understood.size(), 2u);
    EXPECT_EQ(reading.functions_named("g").size(), 1u);
}

TEST(Items, ThatAreNotUnderstoodArePassedOver) {
    const Reading reading =
        read("what is this; void f() { } 3 + 4; float x; void g(, { } void h() { }");
    EXPECT_EQ(reading.not_understood.size(), 4u);
    EXPECT_EQ(reading.functions_named("f").size(), 1u);
    EXPECT_NE(reading.find_global("x"), nullptr);
}

TEST(Calls, AreKnownByNameAndArity) {
    const Reading reading = read(
        "float f(float a) { return a; }\n"
        "float f(float a, float b) { return g(a); }\n"
        "float g(float a) { return float[2](a, a)[0]; }\n"
        "float unused() { return f(1., vec2(2., 3.).x); }\n"
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(f(p.x, (p.y, 1.0))); if (p.x > 0.) "
        "return; }\n");
    List calls;
    for (const Call& call : reading.calls)
        calls.push_back(std::string(reading.word(call.name)) + "/" + std::to_string(call.arity));
    EXPECT_EQ(calls, (List{"g/1", "float/2", "f/2", "vec2/2", "vec4/1", "f/2"}));
    const std::vector<bool> reached = reading.reached_from({"mainImage"});
    EXPECT_EQ(reached, (std::vector<bool>{false, true, true, false, true}));
    EXPECT_EQ(reading.spelled(reading.calls[5].brackets), "( p . x , ( p . y , 1.0 ) )");
}

TEST(Calls, OfMacrosAreThoseThatTheyBecome) {
    const Reading reading = read(
        "#define MAP(p) map(p, 1)\nfloat map(vec3 p, int i) { return 0.; }\n"
        "float other(vec3 p) { return 0.; }\nvoid mainImage() { MAP(vec3(0)); }\n");
    EXPECT_EQ(reading.reached_from({"mainImage"}), (std::vector<bool>{true, false, true}));
}

TEST(Brackets, ThatDoNotBalanceAreTold) {
    EXPECT_TRUE(read("#define S max(0.,\nfloat f() { return S 1.); }").is_balanced);
    EXPECT_FALSE(read("float f() { return (1.; }").is_balanced);
    EXPECT_FALSE(read("}").is_balanced);
}

}  // namespace
}  // namespace glint::syntax_test
