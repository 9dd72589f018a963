// A scene with a mistake: the place of the mistake, exit code 3 or 4, and nothing else happens.
#include "command.h"
#include "media/image.h"

#include <fmt/format.h>

namespace glint::cli::broken_scene_test {
namespace {

struct Mistake {
    std::string_view what, text;
    int code;
    std::string_view message;  // how a line of stderr starts
};

class BrokenScene : public InAFolder {
protected:
    // Draws scene.frag over a picture that is there already: the picture stays, and nothing else
    // comes.
    void expect_refused(std::string_view what, int code, std::string_view message,
                        const std::string& file = "scene.frag") const {
        SCOPED_TRACE(what);
        write("out.png", "precious");
        const auto before = names();
        const Outcome outcome = glint({"still", file, "-o", "out.png", "--size", "64x36"});
        EXPECT_EQ(outcome.code, code);
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(("\n" + outcome.err).find("\n" + std::string(message)), std::string::npos)
            << "wanted: " << message << "\nstderr: " << outcome.err.substr(0, 2000);
        EXPECT_EQ(bytes("out.png"), "precious");
        EXPECT_EQ(names(), before);
    }
};

TEST_F(BrokenScene, TellsTheLineAndColumnOfASyntaxError) {
    const Mistake cases[] = {
        {"on the first line",
         "void mainImage(out vec4 c, in vec2 p) { c = vec4(wrong); }\n"
         "float unused() { return 1.0; }\n",
         3, "scene.frag:1:50: error: `wrong' undeclared"},
        {"of a value that is given in a condition",
         "void mainImage(out vec4 c, in vec2 p) {\n    if (p.x = .5) c = vec4(1);\n}\n", 3,
         "scene.frag:2:9: error: if-statement condition must be scalar boolean; == compares"},
        {"of a mistyped directive",
         "#inlcude \"x.glsl\"\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n", 3,
         "scene.frag:1:1: error: Illegal non-directive after #; did you mean 'include'?"},
        {"on the last line, which has no end",
         "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n\nfloat f() { return 1.0", 3,
         "scene.frag:3:"},
        {"after a line of one megabyte", "1 MB", 3, "scene.frag:2:50: error: `wrong' undeclared"},
        {"after a comment with letters of several bytes",
         "void mainImage(out vec4 c, in vec2 p) { /* äöü€𝄞 */ c = wrong; }\n", 3,
         "scene.frag:1:57: error: `wrong' undeclared"},
        {"after CRLF line ends",
         "// one\r\n\r\nvoid mainImage(out vec4 c, in vec2 p) {\r\n  c = wrong;\r\n}\r\n", 3,
         "scene.frag:4:7: error: `wrong' undeclared"},
        {"below a tweak, which is written in as a constant",
         "uniform vec3 tint; //@ #ff8000\nvoid mainImage(out vec4 c, in vec2 p) {\n"
         "  c.rgb = tint; c = wrong; }\n",
         3, "scene.frag:3:21: error: `wrong' undeclared"},
        {"in a tab of its own",
         "uniform sampler2D bufferA; //@ pass bufferA\n"
         "#ifdef PASS_bufferA\n"
         "void mainImage(out vec4 c, in vec2 p) { c = vec4(wrong); }\n"
         "#endif\n"
         "#ifdef PASS_image\n"
         "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(bufferA, ivec2(p), 0); }\n"
         "#endif\n",
         3, "scene.frag:3:50: error: `wrong' undeclared"},
        {"in #error, with what a terminal would obey",
         "#error \033[2J\033]0;hi\a\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n", 3,
         "scene.frag:1:1: error: #error ?[2J?]0;hi?"},
        {"in an annotation", std::string_view("uniform float a; //@ 0.5 [1, 0\n"), 3,
         "scene.frag:1:"},
    };
    for (const Mistake& mistake : cases) {
        const bool long_line = mistake.text == "1 MB";
        write("scene.frag", long_line ? std::string("//").append(1'000'000, 'x') + "\n" +
                                            std::string(cases[0].text)
                                      : std::string(mistake.text));
        expect_refused(mistake.what, mistake.code, mistake.message);
    }
}

// Whatever looks for words in a text takes no stack for its characters.
TEST_F(BrokenScene, VeryLongLinesAndNamesAreLinesAndNames) {
    const std::string image = "void mainImage(out vec4 c, in vec2 p) { c = vec4(0); }\n";
    const std::string sound = "vec2 mainSound(int s, float t) { return vec2(0); }\n" + image;
    const std::string blanks(300'000, ' '), name(300'000, 'x');
    const std::pair<std::string, std::string> drawn[] = {
        {"a macro that nobody uses", "#define LONG " + name + " iGlobalTime\n" + image},
        {"blanks before a macro's word", "#" + blanks + "define packed 1\n" + image},
        {"blanks in the head of a function",
         "vec4" + blanks + "texture2D(vec2 a) { return vec4(0); }\n" + image},
        {"the name of a condition", "#ifdef PASS_" + name + "\n#endif\n" + image},
    };
    for (const auto& [what, text] : drawn) {
        SCOPED_TRACE(what);
        write("long.frag", text);
        const Outcome still = glint({"still", "long.frag", "-o", "long.png", "--size", "8x8"});
        EXPECT_EQ(still.code, 0) << still.err.substr(0, 2000);
        const Outcome tabs = glint({"export", "long.frag", "-o", "tabs"});
        EXPECT_EQ(tabs.code, 0) << tabs.err.substr(0, 2000);
    }
    const std::pair<std::string, std::string> heard[] = {
        {"a macro", "#define LONG " + name + "\n" + sound},
        {"blanks in a declaration", "const" + blanks + "float" + blanks + "iTime = 1.0;\n" + sound},
        {"blanks in the old head of a sound",
         "vec2 mainSound" + blanks + "(" + blanks + "float t) { return vec2(0); }\n" + image},
    };
    for (const auto& [what, text] : heard) {
        SCOPED_TRACE(what);
        write("long.frag", text);
        const Outcome outcome = glint({"sound", "long.frag", "-o", "long.wav", "--seconds", "0.1"});
        EXPECT_EQ(outcome.code, 0) << outcome.err.substr(0, 2000);
    }
    const std::pair<std::string, std::string> refused[] = {
        {"an error of its own", "#error " + name + "\n" + image},
        {"an unknown name", "void mainImage(out vec4 c, in vec2 p) { c = vec4(" + name + "); }\n"},
    };
    for (const auto& [what, text] : refused) {
        SCOPED_TRACE(what);
        write("long.frag", text);
        const Outcome outcome = glint({"still", "long.frag", "-o", "long.png", "--size", "8x8"});
        EXPECT_EQ(outcome.code, 3);
        EXPECT_TRUE(outcome.err.starts_with("long.frag:1:")) << outcome.err.substr(0, 2000);
        EXPECT_EQ(outcome.err.find("driver crashed"), outcome.err.npos);
        EXPECT_LT(outcome.err.size(), 5000u);
    }
}

TEST_F(BrokenScene, TellsTheLineOfTheIncludedFile) {
    write("scene.frag",
          "// one\n#include \"lib/a.glsl\"\n"
          "void mainImage(out vec4 c, in vec2 p) { c = a(); }\n");
    write("lib/a.glsl", "// one\n// two\nvec4 a() { return wrong; }\n");
    expect_refused("in an include", 3, "lib/a.glsl:3:19: error: `wrong' undeclared");
    write("lib/a.glsl", "vec4 a() { return vec4(1); }\n");
    write("scene.frag",
          "#include \"lib/a.glsl\"\n#include \"lib/a.glsl\"\n"
          "void mainImage(out vec4 c, in vec2 p) { c = a(); }\n");
    expect_refused("in a file that is included twice", 3, "lib/a.glsl:1:");
    write("scene.frag",
          "#include \"lib/a.glsl\"\nvoid mainImage(out vec4 c, in vec2 p) { c = wrong; }\n");
    expect_refused("below an include", 3, "scene.frag:2:45: error: `wrong' undeclared");
}

TEST_F(BrokenScene, TellsWhatDoesNotLink) {
    const Mistake cases[] = {
        {"a function without a body",
         "float missing(float x);\n"
         "void mainImage(out vec4 c, in vec2 p) { c = vec4(missing(p.x)); }\n",
         3, "scene.frag:1:7: error: missing is declared and called, but has no body"},
        {"no mainImage", "float f() { return 1.0; }\n", 3,
         "scene.frag:1:1: error: there is no mainImage here; write void mainImage("},
        {"an #ifdef that takes mainImage with it",
         "#define A\n#ifdef B\nfloat b;\n\n"
         "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n",
         3, "scene.frag:2:1: error: this #if is never ended; write #endif"},
        {"an #if that takes a pass with it",
         "uniform sampler2D a; //@ pass mainA\n#ifdef FAST\n"
         "void mainA(out vec4 c, in vec2 p) { c = vec4(1); }\n"
         "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(a, ivec2(p), 0); }\n",
         3, "scene.frag:2:1: error: this #if is never ended; write #endif"},
        {"an #endif mistyped",
         "#ifdef A\n#ednif\nvoid mainImage(out vec4 c, in vec2 p) { c = vec4(1); }\n", 3,
         "scene.frag:2:1: error: this was to be #endif, which ends an #if"},
        {"mainImage mistyped", "// x\nvoid mainimage(out vec4 c, in vec2 p) { c = vec4(1); }\n", 3,
         "scene.frag:2:6: error: there is no mainImage here; did you mean this one?"},
        {"an input", "in vec2 uv;\nvoid mainImage(out vec4 c, in vec2 p) { c = uv.xyxy; }\n", 3,
         "scene.frag:1:9: error: nothing feeds uv"},
        {"mainImage in a comment only", "// mainImage\nfloat f() { return 1.0; }\n", 3,
         "scene.frag:1:1: error: there is no mainImage here; write void mainImage("},
        {"an empty file", "", 3, "scene.frag:1:1: error: this file holds no shader; write "},
        {"a byte order mark and nothing else", "\xEF\xBB\xBF", 3,
         "scene.frag:1:1: error: this file holds no shader; write "},
        {"a mainImage that is declared only", "void mainImage(out vec4 c, in vec2 p);\n", 3,
         "scene.frag: error: "},
        {"sound alone", "vec2 mainSound(int s, float t) { return vec2(0); }\n", 3,
         "scene.frag: error: there is no `void mainImage("},
    };
    for (const Mistake& mistake : cases) {
        write("scene.frag", mistake.text);
        expect_refused(mistake.what, mistake.code, mistake.message);
    }
}

TEST_F(BrokenScene, TellsWhichFileIsMissingAndWhoNamesIt) {
    const Mistake cases[] = {
        {"an include", "\n  #include \"gone.glsl\"\n", 4,
         "scene.frag:2:3: error: cannot read 'gone.glsl': No such file or directory"},
        {"an include that is a folder", "#include \".\"\n", 4,
         "scene.frag:1:1: error: cannot read"},
        {"a picture",
         "\nuniform sampler2D wood; //@ image gone.png\n"
         "void mainImage(out vec4 c, in vec2 p) { c = texture(wood, p); }\n",
         4, "scene.frag:2:19: error: Cannot read gone.png: No such file or directory"},
        {"a picture that is a folder",
         "uniform sampler2D wood; //@ image .\n"
         "void mainImage(out vec4 c, in vec2 p) { c = texture(wood, p); }\n",
         4, "scene.frag:1:19: error: Cannot read "},
        {"a picture that is the scene",
         "uniform sampler2D wood; //@ image scene.frag\n"
         "void mainImage(out vec4 c, in vec2 p) { c = texture(wood, p); }\n",
         4,
         "scene.frag:1:19: error: Cannot read scene.frag: It is not a png, jpg, exr, hdr or tif"},
    };
    for (const Mistake& mistake : cases) {
        write("scene.frag", mistake.text);
        expect_refused(mistake.what, mistake.code, mistake.message);
    }
    expect_refused("the scene itself", 4, "gone.frag: error: cannot read 'gone.frag'", "gone.frag");
    fs::create_directory(folder() / "folder.frag");
    expect_refused("a folder", 4, "folder.frag: error: cannot read 'folder.frag': it is a folder",
                   "folder.frag");
}

TEST_F(BrokenScene, AnIncludeThatIncludesItselfIsACircleAndNotAHang) {
    write("scene.frag", "#include \"b.glsl\"\n");
    write("b.glsl", "//\n#include \"scene.frag\"\n");
    expect_refused("two files", 3, "b.glsl:2:1: error: this include closes a circle");
    write("scene.frag", "#include \"scene.frag\"\n");
    expect_refused("one file", 3, "scene.frag:1:1: error: this include closes a circle");
}

TEST_F(BrokenScene, ATruncatedPictureIsRefusedAtTheLineThatNamesIt) {
    Image image{.size = {32, 32}, .channels = 3, .type = ChannelType::u8, .pixels = {}};
    for (int i = 0; i < 32 * 32 * 3; ++i) {
        image.pixels.push_back(static_cast<std::byte>(i * i % 251));
    }
    write_image(folder() / "whole.png", image);
    const std::string whole = bytes("whole.png");
    write("scene.frag",
          "uniform sampler2D wood; //@ image cut.png\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texture(wood, p); }\n");
    for (const std::size_t length :
         {std::size_t{0}, std::size_t{8}, std::size_t{40}, whole.size() / 2, whole.size() - 13}) {
        write("cut.png", whole.substr(0, length));
        expect_refused(std::to_string(length) + " bytes are left", 4,
                       "scene.frag:1:19: error: Cannot read cut.png: ");
    }
}

// Libraries speak of themselves; first stands what it means.
TEST_F(BrokenScene, ADamagedPictureOrSoundIsSaidToBe) {
    const std::pair<const char*, std::string> files[] = {
        {"a.exr", "\x76\x2f\x31\x01"},      {"a.png", "\x89PNG\r\n\x1a\n"},
        {"a.jpg", "\xff\xd8\xff\xe0"},      {"a.hdr", "#?RADIANCE\n"},
        {"a.tif", std::string("II*\0", 4)}, {"a.wav", "RIFF"}};
    for (const auto& [name, head] : files) {
        const bool is_sound = std::string(name).ends_with("wav");
        write(name, head + std::string(300, 'x'));
        write("scene.frag",
              fmt::format("uniform sampler2D a; //@ {} {}\n"
                          "void mainImage(out vec4 c, in vec2 p) {{ c = texture(a, p); }}\n",
                          is_sound ? "sound" : "image", name));
        expect_refused(name, 4,
                       fmt::format("scene.frag:1:19: error: Cannot read {}: It is damaged", name));
    }
}

TEST_F(BrokenScene, APictureThatNothingReadsIsNotAskedFor) {
    write("scene.frag", "uniform sampler2D wood; //@ image gone.png\n" + std::string(kGradient));
    still({"scene.frag", "-o", "out.png"});
}

TEST_F(BrokenScene, BinaryFilesAreRefusedWithTheirPlace) {
    write("scene.frag", std::string(kGradient) + "//" + std::string(1, '\0') + "\n");
    expect_refused("a NUL byte", 3, "scene.frag:2:3: error: a NUL byte stands here");
    fs::copy_file(GLINT_BINARY, folder() / "program.frag");
    fs::resize_file(folder() / "program.frag", 1 << 20);  // with sanitizers it is beyond the limit
    expect_refused("a program", 3, "program.frag:1:", "program.frag");
}

TEST_F(BrokenScene, AFileThatMayNotBeReadIsMissing) {
    write("scene.frag", kGradient);
    fs::permissions(folder() / "scene.frag", fs::perms::none);
    if (::access((folder() / "scene.frag").c_str(), R_OK) == 0) {
        GTEST_SKIP() << "this user may read everything";
    }
    expect_refused("no permission", 4, "scene.frag: error: cannot read 'scene.frag'");
}

// A study draws a text in as many forms as a tweak has values, a check in several processes.
TEST_F(BrokenScene, WhatAShaderIsWarnedOfIsSaidOnceInACall) {
    write("empty.frag",
          "uniform float k; //@ 0.5 [0, 1] quality\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = k * texture(iChannel0, p / iResolution.xy);\n}\n");
    for (const std::vector<std::string>& words : std::vector<std::vector<std::string>>{
             {"study", "empty.frag", "--size", "16x9", "--seconds", "0"},
             {"study", "empty.frag", "empty.frag", "--size", "16x9", "--seconds", "0"},
             {"check", "empty.frag", "--case", "tweak"},
             {"bench", "empty.frag", "--size", "16x9", "--frames", "2", "--compare"},
             {"export", "empty.frag", "-o", "out"}}) {
        const std::string said = glint(words).err, warning = "nothing fills iChannel0";
        const std::size_t first = said.find(warning);
        ASSERT_NE(first, std::string::npos) << words[0] << "\n" << said;
        EXPECT_EQ(said.find(warning, first + 1), std::string::npos) << words[0] << "\n" << said;
    }
}

}  // namespace
}  // namespace glint::cli::broken_scene_test
