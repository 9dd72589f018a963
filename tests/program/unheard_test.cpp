// Messages and results that cannot be written: they cost nothing but themselves.
#include "command.h"

#include <fmt/format.h>

#include <array>

namespace glint::cli::unheard_test {
namespace {

// A picture, a film, and so on: a call, what it leaves behind, and its exit code.
struct Call {
    std::string words;
    std::string leaves;
    int code = 0;
};

// The scene warns, which is a message; what fails by itself keeps its exit code.
const std::array<Call, 13> kCalls = {{
    {"still s.frag --size 16x9 --tweak a=9 -o out.png", "out.png"},
    {"still wrong.frag --size 16x9 -o wrong.png", "", 3},
    {"still absent.frag --size 16x9 -o absent.png", "", 4},
    {"sequence s.frag --size 16x9 --tweak a=9 --frames 0:1 -o p%d.png", "p1.png"},
    {"sequence s.frag --size 16x9 --tweak a=9 --frames 0:1 -o film.mp4", "film.mp4"},
    {"sequence s.frag --size 16x9 --frames 0:1 --from-pictures none/%d.png", "", 6},
    {"sound s.frag --tweak a=9 --seconds 0.1 -o out.wav", "out.wav"},
    {"export s.frag --tweak a=9 -o tabs", "tabs/shadertoy.json"},
    {"import toy.json -o toy.frag", "toy.frag"},
    {"info s.frag --tweak a=9", ""},
    {"check s.frag --size 16x9 --tweak a=9 --case start --frames 2 -o failures", "", 2},
    {"check s.frag --size 16x9 --tweak a=9 --case age --frames 2 -o failures", ""},
    {"study s.frag --size 16x9 --tweak a=9 --vary a=0,1 --reference a=0.5 -o report",
     "report/index.html"},
}};

class Unheard : public InAFolder {
protected:
    Unheard() {
        write("s.frag",
              "uniform float a; //@ 0.5 [0, 1]\n"
              "vec2 mainSound(int samp, float time) { return vec2(a); }\n"
              "void mainImage(out vec4 c, in vec2 p) { c = vec4(a); }\n");
        write("wrong.frag", "void mainImage(out vec4 c, in vec2 p) { c = wrong; }\n");
        write("toy.json",
              R"({"Shader":{"info":{},"renderpass":[{"type":"image","name":"Image","inputs":[],)"
              R"("outputs":[{"id":37,"channel":0}],"code":)"
              R"("void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }"}]}})");
    }

    // As a shell does it: "2>/dev/full", "2>&-"; what stands in `before` is done first.
    int shell(const std::string& words, const std::string& where,
              const std::string& before = "true") const {
        write("script", fmt::format("cd '{}' && {} && '{}' {} {}\n", folder().string(), before,
                                    GLINT_BINARY, words, where));
        const int status = std::system(("bash '" + (folder() / "script").string() + "'").c_str());
        return WEXITSTATUS(status);
    }

    void expect_left(const Call& call) const {
        if (call.leaves.empty()) return;
        EXPECT_GT(bytes(call.leaves).size(), 0u);
        fs::remove_all(folder() / fs::path(call.leaves).begin()->string());
    }
};

TEST_F(Unheard, MessagesThatCannotBeWrittenCostNeitherFileNorExitCode) {
    for (const Call& call : kCalls) {
        for (const std::string where : {">out.txt 2>/dev/full", ">out.txt 2>&-"}) {
            SCOPED_TRACE(call.words + " " + where);
            EXPECT_EQ(shell(call.words, where), call.code);
            expect_left(call);
        }
    }
}

TEST_F(Unheard, ResultsThatCannotBeWrittenFailAndLeaveWhatIsWritten) {
    for (const Call& call : kCalls) {
        for (const std::string where : {">/dev/full", ">&-"}) {
            SCOPED_TRACE(call.words + " " + where);
            EXPECT_EQ(shell(call.words, where + " 2>err.txt"), call.code == 0 ? 1 : call.code);
            if (call.code == 0) {
                EXPECT_NE(bytes("err.txt").find("error: Cannot write to stdout: "),
                          std::string::npos)
                    << bytes("err.txt");
            }
            expect_left(call);
        }
    }
}

TEST_F(Unheard, AReaderThatGoesAwayEndsItOnceItsFilesAreWritten) {
    for (const Call& call : kCalls) {
        if (call.code != 0) continue;
        SCOPED_TRACE(call.words);
        // A pipe whose only reader has gone before anything is written.
        EXPECT_EQ(
            shell(call.words, ">&4 2>&1", "rm -f pipe && mkfifo pipe && exec 3<>pipe 4>pipe 3<&-"),
            128 + SIGPIPE);
        expect_left(call);
    }
}

TEST_F(Unheard, NoPictureGetsTheNumberOfAClosedDescriptor) {
    still({"s.frag", "-o", "wanted.png", "--size", "16x9", "--tweak", "a=1"});
    for (const std::string closed : {"<&- 2>&-", "<&- >&- 2>&-", "2>&-"}) {
        SCOPED_TRACE(closed);
        shell("still s.frag --size 16x9 --tweak a=9 -o out.png", closed);
        EXPECT_EQ(bytes("out.png"), bytes("wanted.png"));
    }
    fs::remove(folder() / "out.png");
    EXPECT_EQ(shell("still s.frag --size 16x9 -o out.png", "<&- >out.txt"), 0);
}

TEST_F(Unheard, AFileThatMayNotGrowIsTheReasonThatIsGiven) {
    const std::pair<std::string, std::string> cases[] = {
        {"still n.frag --size 256x256 -o out.png", "out.png"},
        {"sequence n.frag --size 256x256 --frames 0:0 -o p%d.png", "p0.png"},
        {"sequence n.frag --size 128x128 --frames 0:3 -o film.mp4", "film.mp4"},
        {"sequence n.frag --size 128x128 --frames 0:3 -o film.gif", "film.gif"},
        {"sequence n.frag --size 256x256 --frames 0:1 --save-state state.exr", "state.exr"},
        {"sound n.frag --seconds 1 -o out.wav", "out.wav"},
        {"study n.frag --size 128x128 --vary a=0,1 --reference a=0.5 -o report", "report/"},
    };
    write(
        "n.frag",
        "uniform float a; //@ 0.5 [0, 1]\n"
        "uniform sampler2D b; //@ pass mainB\n"
        "vec3 noise(vec2 p) {\n"
        "    uvec3 v = uvec3(p, 1) * 1664525u + 1013904223u;\n"
        "    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y; v ^= v >> 16u;\n"
        "    v.x += v.y * v.z; v.y += v.z * v.x; v.z += v.x * v.y;\n"
        "    return vec3(v >> 8u) / 16777216.0;\n"
        "}\n"
        "vec2 mainSound(int samp, float time) { return noise(vec2(samp, 0)).xy; }\n"
        "void mainB(out vec4 c, in vec2 p) {\n"
        "    c = texelFetch(b, ivec2(p), 0) + vec4(noise(p), 0);\n"
        "}\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    c = vec4(noise(p + 10.0 * iTime), 1) + 1e-6 * texelFetch(b, ivec2(p), 0) + 0.0 * a;\n"
        "}\n");
    for (const auto& [words, file] : cases) {
        SCOPED_TRACE(words);
        // 16 blocks of 1024 bytes; the signal is not ignored, as where a person calls.
        write("script", fmt::format("cd '{}' && export MESA_SHADER_CACHE_DISABLE=true\n"
                                    "ulimit -f 16 && '{}' {} >out.txt 2>err.txt\n",
                                    folder().string(), GLINT_BINARY, words));
        const int status = std::system(("bash '" + (folder() / "script").string() + "'").c_str());
        EXPECT_EQ(WEXITSTATUS(status), 1);
        const std::string said = bytes("err.txt");
        EXPECT_NE(said.find("error: Cannot write " + file), std::string::npos) << said;
        EXPECT_NE(said.find(": File too large."), std::string::npos) << said;
        if (!file.ends_with('/')) {
            EXPECT_FALSE(fs::exists(folder() / file));
        }
    }
}

// What a library writes of a small one as it closes it fails without a word.
TEST_F(Unheard, AStateThatALimitCutsLeavesTheOneBefore) {
    write("one.frag",
          "uniform sampler2D b; //@ pass mainB size=1 format=r8\n"
          "void mainB(out vec4 c, in vec2 p) { c = texelFetch(b, ivec2(0), 0) + 0.1; }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(b, ivec2(0), 0); }\n");
    const std::string words = "sequence one.frag --size 8x8 --save-state state.exr --frames 0:";
    EXPECT_EQ(shell(words + "2", ">out.txt 2>err.txt"), 0) << bytes("err.txt");
    const std::string before = bytes("state.exr");
    ASSERT_GT(before.size(), 1024u);
    EXPECT_EQ(shell(words + "3", ">out.txt 2>err.txt", "ulimit -f 1"), 1);
    EXPECT_NE(bytes("err.txt").find("Cannot write state.exr: File too large."), std::string::npos);
    EXPECT_EQ(bytes("state.exr"), before);
}

}  // namespace
}  // namespace glint::cli::unheard_test
