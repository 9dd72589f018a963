// GLSL that a driver would compile for minutes, into gigabytes, or until it crashes.
#include "command.h"

namespace glint::cli::compile_limits_test {
namespace {

// A number of 2^`times` terms, by macros that double.
std::string doubling(int times) {
    std::string text = "#define A0 x\n";
    for (int i = 1; i <= times; ++i) {
        const std::string before = "A" + std::to_string(i - 1);
        text += "#define A" + std::to_string(i) + " " + before + "+" + before + "\n";
    }
    return text + "void mainImage(out vec4 c, in vec2 p) {\n    float x = p.x;\n    c = vec4(A" +
           std::to_string(times) + ");\n}\n";
}

class CompileLimits : public InAFolder {
protected:
    Outcome limited(std::vector<std::string> arguments, const std::string& variable,
                    const std::string& value) const {
        Command wanted = command(std::move(arguments));
        wanted.environment.emplace_back(variable, value);
        return run(wanted);
    }
};

TEST_F(CompileLimits, EndEveryVerbThatDrawsWithThePassAndTheReason) {
    write("scene.frag", doubling(40) + "vec2 mainSound(int s, float x) { return vec2(A40); }\n");
    write("out.png", "precious");
    const auto before = names();
    const std::vector<std::vector<std::string>> verbs = {
        {"still", "scene.frag", "-o", "out.png", "--size", "32x18"},
        {"sequence", "scene.frag", "-o", "out.mp4", "--size", "32x18", "--frames", "0:1"},
        {"sound", "scene.frag", "-o", "out.wav", "--seconds", "1"},
        {"bench", "scene.frag", "--size", "32x18"},
        {"study", "scene.frag", "--size", "32x18", "--metric", "time"},
        {"check", "scene.frag"},
        {"info", "scene.frag"},
        {"probe", "scene.frag", "--size", "32x18"},
        {"export", "scene.frag", "-o", "tabs"}};
    for (const auto& verb : verbs) {
        SCOPED_TRACE(verb[0]);
        const Outcome outcome = limited(verb, "GLINT_COMPILE_SECONDS", "0.1");
        EXPECT_EQ(outcome.code, 3) << outcome.signal << outcome.out << outcome.err;
        EXPECT_EQ(outcome.out, "");
        EXPECT_NE(outcome.err.find("scene.frag:4"), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find("error: pass "), std::string::npos) << outcome.err;
        EXPECT_NE(outcome.err.find("the driver took more than 0.1 s"), std::string::npos)
            << outcome.err;
        EXPECT_EQ(bytes("out.png"), "precious");
        EXPECT_EQ(names(), before);
    }
}

// A text that compiles at once, and one of it that tells what each of its statements does.
TEST_F(CompileLimits, BoundWhatAProbeOfManyStatementsTakes) {
    std::string statements;
    for (int i = 0; i < 3000; ++i) statements += "    c = vec4(1);\n";
    write("long.frag", "void mainImage(out vec4 c, in vec2 p) {\n" + statements + "}\n");
    const Outcome outcome =
        limited({"probe", "long.frag", "--size", "32x18"}, "GLINT_COMPILE_SECONDS", "0.6");
    EXPECT_EQ(outcome.code, 3) << outcome.signal << outcome.out;
    EXPECT_NE(outcome.err.find("the driver took more than 0.6 s"), std::string::npos)
        << outcome.err;
}

TEST_F(CompileLimits, BoundTheMemoryThatAHugeArrayTakes) {
    write("scene.frag",
          "void mainImage(out vec4 c, in vec2 p) {\n    float a[100000000];\n"
          "    for (int i = 0; i < 100000000; ++i) a[i] = float(i) * p.x;\n"
          "    c = vec4(a[int(p.y) * 7]);\n}\n");
    const Outcome outcome = limited({"still", "scene.frag", "-o", "out.png", "--size", "32x18"},
                                    "GLINT_COMPILE_GIB", "0.3");
    EXPECT_EQ(outcome.code, 3) << outcome.signal << outcome.err;
    EXPECT_NE(outcome.err.find("scene.frag:1:6: error: pass image: the driver took more than 0.3 "
                               "GiB of memory"),
              std::string::npos)
        << outcome.err;
    EXPECT_EQ(names(), std::set<std::string>{"scene.frag"});
}

TEST_F(CompileLimits, TellOfADriverThatOverflowsItsStack) {
    std::string terms = "x";
    for (int i = 0; i < 150'000; ++i) terms += "+x";
    write("scene.frag",
          "void mainImage(out vec4 c, in vec2 p) {\n    float x = p.x;\n    c = vec4(" + terms +
              ");\n}\n");
    const Outcome outcome = glint({"still", "scene.frag", "-o", "out.png", "--size", "32x18"});
    if (outcome.code == 0) GTEST_SKIP() << "this driver takes 150,000 terms";
    EXPECT_EQ(outcome.code, 3) << outcome.signal << outcome.err;
    EXPECT_NE(outcome.err.find("scene.frag:1:6: error: pass image: the driver crashed"),
              std::string::npos)
        << outcome.err;
}

TEST_F(CompileLimits, TellOfADivisionThatCrashesTheDriver) {
    write("scene.frag",
          "void mainImage(out vec4 c, in vec2 p) {\n    int a = -2147483647 - 1;\n"
          "    c = vec4(a / -1);\n}\n");
    const Outcome outcome = glint({"still", "scene.frag", "-o", "out.png", "--size", "32x18"});
    if (outcome.code == 0) GTEST_SKIP() << "this driver divides";
    EXPECT_EQ(outcome.code, 3) << outcome.signal << outcome.err;
    EXPECT_NE(outcome.err.find("of the int -2147483648 by -1"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace glint::cli::compile_limits_test
