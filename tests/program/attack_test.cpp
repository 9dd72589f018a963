// What a stranger's files hold is no command, and is written nowhere but where the person says.
#include "command.h"

#include <algorithm>
#include <cstdlib>

namespace glint::cli::attack_test {
namespace {

using Attack = InAFolder;

constexpr const char* kStudied =
    "uniform int n; //@ 4 [1, 16] quality\n"
    "void mainImage(out vec4 c, in vec2 p) {\n"
    "    float sum = 0.0;\n"
    "    for (int i = 0; i < n; ++i) sum += sin(p.x * float(i)) / float(n);\n"
    "    c = vec4(vec3(sum), 1);\n"
    "}\n";

// A shader of the site whose only tab has this code.
std::string toy(const std::string& code) {
    return R"({"Shader": {"info": {}, "renderpass": [{"type": "image", "name": "Image",)"
           R"("inputs": [], "code": ")" +
           code + R"("}]}})";
}

TEST_F(Attack, TheNameOfASceneIsNoCommandOfThePlotter) {
    for (const char* name : {"a\nsystem \"touch taken\"\n#.frag", "b\n!touch taken\n#.frag"}) {
        write(name, kStudied);
        const Outcome outcome = glint(
            {"study", std::string("./") + name, "--size", "16x8", "--seconds", "0", "-o", "out"});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_FALSE(fs::exists(folder() / "taken"));
    }
}

TEST_F(Attack, ANameThatThePlotterDoesNotTakeHasItsDiagramToo) {
    if (std::system("gnuplot --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no gnuplot";
    for (const char* name : {"my scene.frag", "a.b.frag", "\u00fcml'aut.frag"}) {
        write(name, kStudied);
        const Outcome outcome =
            glint({"study", name, "--size", "16x8", "--seconds", "0", "-o", "out"});
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_NE(bytes("out/index.html").find("<svg"), std::string::npos) << name;
        fs::remove_all(folder() / "out");
    }
}

TEST_F(Attack, AnImportWritesThroughNoLink) {
    write("toy.json", toy("void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }"));
    fs::create_directory(folder() / "home");
    fs::create_symlink("home/profile", folder() / "toy.frag");
    const Outcome outcome = glint({"import", "toy.json", "-o", "toy.frag"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_NE(outcome.err.find("it is there already"), std::string::npos) << outcome.err;
    EXPECT_TRUE(fs::is_empty(folder() / "home"));
}

// A folder from a stranger may hold them under the names that Glint gives its files itself.
TEST_F(Attack, NoFileThatGlintNamesItselfIsWrittenThroughALink) {
    write("s.frag", kStudied);
    const char* const names[] = {"tabs/image.glsl", "tabs/shadertoy.json", "rep/study.csv",
                                 "rep/index.html", "glint-check/s-age-1-day.png"};
    const auto victim = [&](std::string name) {
        std::ranges::replace(name, '/', '-');
        return name;
    };
    for (const char* name : names) {
        fs::create_directories((folder() / name).parent_path());
        write(victim(name), "precious");
        fs::create_symlink(folder() / victim(name), folder() / name);
    }
    EXPECT_EQ(glint({"export", "s.frag", "-o", "tabs"}).code, 0);
    EXPECT_EQ(glint({"study", "s.frag", "--size", "16x8", "--seconds", "0", "-o", "rep"}).code, 0);
    glint({"check", "s.frag", "--size", "16x8", "--case", "age 1 day"});
    for (const char* name : names) EXPECT_EQ(bytes(victim(name)), "precious") << name;
    EXPECT_FALSE(fs::is_symlink(folder() / "tabs/image.glsl"));
}

TEST_F(Attack, AStateTakesNoScenesPlace) {
    write("s.frag", kGradient);
    write("other.frag", kGradient);
    const Outcome outcome = glint(
        {"sequence", "s.frag", "--save-state", "other.frag", "--frames", "0:1", "--size", "16x8"});
    EXPECT_EQ(outcome.code, 2) << outcome.err;
    EXPECT_EQ(bytes("other.frag"), kGradient);
}

TEST_F(Attack, AnImportOfManyObjectsTakesNoLongerThanToReadThem) {
    std::string text = R"({"Shader": {"renderpass": [], "x": [{})";
    for (int i = 0; i < 300'000; ++i) text += ",{}";  // a minute where each looks at all before it
    write("toy.json", text + "]}}");
    Command call = command({"import", "toy.json", "-o", "toy.frag"});
    call.limit = std::chrono::seconds(20);
    EXPECT_EQ(run(call).code, 4);
}

TEST_F(Attack, TextThatIsNoneIsNoScene) {
    write("toy.json", toy("void \\u0000 mainImage(out vec4 c, in vec2 p) { c = vec4(1); }"));
    const Outcome outcome = glint({"import", "toy.json", "-o", "toy.frag"});
    EXPECT_EQ(outcome.code, 4);
    EXPECT_NE(outcome.err.find("there is a NUL in it"), std::string::npos) << outcome.err;
}

// Macros that only the validator expands, each twice the one before.
TEST_F(Attack, AToolThatInfoAsksIsNotWaitedForForEver) {
    if (std::system("glslangValidator --version >/dev/null 2>&1") != 0)
        GTEST_SKIP() << "no glslangValidator";
    std::string text = "#ifdef GL_OES_standard_derivatives\n#define A0 +1.0\n";
    for (int i = 1; i < 40; ++i)
        text += "#define A" + std::to_string(i) + " A" + std::to_string(i - 1) + " A" +
                std::to_string(i - 1) + "\n";
    write("s.frag", text + "float boom() { return A39; }\n#endif\n" + std::string(kGradient));
    Command call = command({"info", "s.frag", "--size", "16x8"});
    call.environment = {{"GLINT_COMPILE_SECONDS", "1"}};
    call.limit = std::chrono::seconds(60);
    const Outcome outcome = run(call);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.out.find("glslangValidator took more time or memory"), std::string::npos)
        << outcome.out;
}

TEST_F(Attack, ALongLineOfALogIsRead) {
    write("s.frag", "#ifdef GL_OES_standard_derivatives\n#error " + std::string(100'000, 'a') +
                        "\n#endif\n" + std::string(kGradient));
    EXPECT_EQ(glint({"info", "s.frag", "--size", "16x8"}).code, 0);
    write("n.frag", "void mainImage(out vec4 c, in vec2 p) { c = vec4(" +
                        std::string(100'000, '9') + "abc); }\n");
    const Outcome outcome = glint({"still", "n.frag", "--size", "16x8", "-o", "n.png"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_EQ(outcome.err.find("crashed"), std::string::npos) << outcome.err.substr(0, 300);
}

// What is quadratic would take minutes here.
TEST_F(Attack, AChainOfSignsIsReadInLinearTime) {
    std::string signs;
    for (int i = 0; i < 100'000; ++i) signs += "++ ";
    for (const std::string& chain : {signs + "x", "x" + signs}) {
        write("s.frag", "void mainImage(out vec4 c, in vec2 p) { int x; " + chain + "; }\n");
        EXPECT_EQ(glint({"still", "s.frag", "--size", "16x8", "-o", "s.png"}).code, 3);
    }
}

TEST_F(Attack, NoErrorIsToldWithoutEnd) {
    for (const auto& [word, code] : {std::pair{" x", 0}, {" step=0", 3}}) {
        std::string words;
        for (int i = 0; i < 10'000; ++i) words += word;
        write("s.frag", "uniform float a; //@ 1" + words + "\n" + std::string(kGradient));
        const Outcome outcome = glint({"still", "s.frag", "--size", "16x8", "-o", "s.png"});
        EXPECT_EQ(outcome.code, code);
        EXPECT_LT(outcome.err.size(), 100'000u);
    }
}

}  // namespace
}  // namespace glint::cli::attack_test
