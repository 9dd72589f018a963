// What a scene's author is told though all compiles.
#include "scene/lint.h"

#include "read_text.h"

#include <filesystem>
#include <string>
#include <vector>

namespace glint::lint_test {
namespace {

using List = std::vector<std::string>;

// "a.frag:3:7 unused-function" for each finding; what is not looked into, too.
List found_in(const std::filesystem::path& file) {
    const ReadPreset read = read_preset(file);
    EXPECT_EQ(all(read.diagnostics), "");
    if (!read.preset) return {"no scene"};
    const Lint result = lint(*read.preset);
    List list;
    const auto place_of = [](const Place& place) {
        return std::filesystem::path(place.file).filename().string() + ":" +
               std::to_string(place.line) + ":" + std::to_string(place.column);
    };
    for (const PlacedFinding& one : result.findings)
        list.push_back(place_of(one.place) + " " + one.name);
    for (const Unread& one : result.unread) list.push_back(place_of(one.place) + " " + one.why);
    return list;
}

List found(std::string_view text) {
    const TestFolder folder;
    return found_in(folder.write("a.frag", text));
}

TEST(Lint, AFunctionIsUnusedWhereNoPassReachesIt) {
    EXPECT_EQ(found("float one(float x) { return x; }\n"
                    "float two(float x) { return one(x); }\n"
                    "float three(float x) { return three(x); }\n"
                    "float four(float x) { return x; }\n"
                    "float four(vec2 x) { return x.x; }\n"
                    "float four(float x, float y) { return x; }\n"
                    "float five = four(1.0, 2.0);\n"
                    "void mainVR(out vec4 c, in vec2 p, in vec3 o, in vec3 d) { c = vec4(1); }\n" +
                    kImage),
              (List{"a.frag:1:7 unused-function", "a.frag:2:7 unused-function",
                    "a.frag:3:7 unused-function", "a.frag:4:7 unused-function",
                    "a.frag:5:7 unused-function"}));
}

TEST(Lint, OneTabsFunctionsAreUsedByThatTab) {
    EXPECT_EQ(found("uniform sampler2D bufferA; //@ pass mainA\n"
                    "float both(float x) { return x; }\n"
                    "#ifdef PASS_bufferA\n"
                    "float only_a(float x) { return both(x); }\n"
                    "float nobody(float x) { return x; }\n"
                    "void mainImage(out vec4 c, in vec2 p) { c = vec4(only_a(p.x)); }\n"
                    "#endif\n"
                    "#ifdef PASS_image\n"
                    "void mainImage(out vec4 c, in vec2 p) { c = texture(bufferA, p); }\n"
                    "#endif\n"
                    "#ifdef NEVER\nfloat dead() { return 1.0; }\n#endif\n"),
              List{"a.frag:5:7 unused-function"});
}

TEST(Lint, WhatMacrosMakeStandsAtTheirUse) {
    EXPECT_EQ(found("#define MAKE(name, value) float name() { return value; }\n"
                    "MAKE(one, 1.0)\n"
                    "  MAKE(two, 2.0)\n"
                    "#define CALL(f) f()\n"
                    "#define mainImage(c, p) void mainImage(out vec4 c, in vec2 p)\n"
                    "mainImage(c, p) { c = vec4(CALL(one)); }\n"),
              List{"a.frag:3:3 unused-function"});
}

TEST(Lint, AnIncludeMayHoldMoreThanIsUsed) {
    const TestFolder folder;
    folder.write("lib.glsl",
                 "float lib_one(float x) { { float x = 1.0; } return x; }\n"
                 "float lib_two(float x) { return x; }\n");
    EXPECT_EQ(found_in(folder.write("a.frag",
                                    "#include \"lib.glsl\"\n"
                                    "float own() { return 1.0; }\n"
                                    "void mainImage(out vec4 c, in vec2 p) { c = "
                                    "vec4(lib_one(p.x)); }\n")),
              (List{"a.frag:2:7 unused-function", "lib.glsl:1:34 shadowed-name"}));
}

TEST(Lint, APassIsReadByWhatThePictureNeeds) {
    EXPECT_EQ(
        found("uniform sampler2D one;    //@ pass mainOne\n"
              "uniform sampler2D two;    //@ pass mainTwo\n"
              "uniform sampler2D three;  //@ pass mainThree\n"
              "uniform sampler2D second; //@ pass mainOne\n"
              "uniform sampler2D again;  //@ buffer one\n"
              "uniform sampler2D grain;  //@ noise r 8\n"
              "uniform float level;      //@ 0.5 [0, 1]\n"
              "uniform bool on;          //@ off \"what it does\"\n"
              "vec4 unused(vec2 p) { return texture(grain, p) * float(on); }\n"
              "void mainOne(out vec4 c, out vec4 d, in vec2 p) { c = d = vec4(level); }\n"
              "void mainTwo(out vec4 c, in vec2 p) { c = texture(two, p) + texture(three, p); }\n"
              "void mainThree(out vec4 c, in vec2 p) { c = texture(two, p); }\n"
              "void mainImage(out vec4 c, in vec2 p) { if (false) c = texture(again, p); }\n"),
        (List{"a.frag:2:19 unused-pass", "a.frag:3:19 unused-pass", "a.frag:4:19 unused-uniform",
              "a.frag:6:19 unused-uniform", "a.frag:7:15 undescribed-tweak",
              "a.frag:8:14 unused-uniform", "a.frag:9:6 unused-function"}));
}

TEST(Lint, ALoopsTurnsAreThoseAtThePresetsValues) {
    const TestFolder folder;
    folder.write("a.frag",
                 "uniform int steps; //@ 100 [1, 1000000] \"how many\"\n"
                 "void mainImage(out vec4 c, in vec2 p) {\n"
                 "    for (int i = 0; i < steps; ++i) c += 1.0;\n"
                 "}\n");
    EXPECT_EQ(found_in(folder.path() / "a.frag"), List{});
    EXPECT_EQ(found_in(folder.write("b.toml", "scene = \"a.frag\"\n[tweaks]\nsteps = 100000\n")),
              List{"a.frag:3:5 long-loop"});
}

TEST(Lint, IsSilentWhereTheTextAllowsIt) {
    EXPECT_EQ(found("float one() { return 1.0; } //@ allow unused-function\n"
                    "float two() { return 1.0; } // why //@ allow long-loop, unused-function\n"
                    "//@ allow unused-function\n"
                    "float three() { return 1.0; }\n"
                    "float four() { return 1.0; } //@ allow long-loop\n"
                    "uniform float five; //@ 0.5 [0, 1] \"x\" //@ allow unused-uniform\n"
                    "uniform float six;  //@ 0.5 [0, 1] //@ allow undescribed-tweak\n" +
                    kImage),
              (List{"a.frag:5:7 unused-function", "a.frag:7:15 unused-uniform"}));
    const std::string told =
        all(read("float f() { return 1.0; } //@ allow unused-funtion\n" + kImage).diagnostics);
    EXPECT_EQ(told.substr(told.find("a.frag")),
              "a.frag:1:37: warning: no finding of glint info is called 'unused-funtion'; did you "
              "mean 'unused-function'?\n");
}

TEST(Lint, SaysNothingOfTextsThatAreNotUnderstood) {
    EXPECT_EQ(found("float unused() { return 1.0; }\nfloat 3 x;\n" + kImage),
              List{"a.frag:2:1 this declaration is not understood"});
}

TEST(Lint, EndsSoonForManyFunctions) {
    std::string text;
    for (int i = 0; i < 2000; ++i) {
        const std::string n = std::to_string(i);
        text += "float f" + n + "(float x) { for (int i = 0; i < 3; ++i) x += " +
                (i > 0 ? "f" + std::to_string(i - 1) + "(x)" : "x") + "; return x; }\n";
    }
    EXPECT_EQ(found(text + kImage).size(), 2000u);
}

}  // namespace
}  // namespace glint::lint_test
