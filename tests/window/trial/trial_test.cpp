// A candidate that never ends, is too slow or takes its process down is told of, and the next one
// is tried as if nothing had happened.
#include "window/trial/trial.h"

#include "../../base/test_folder.h"
#include "../../crowd.h"
#include "scene/blame.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <thread>

namespace glint::trial_test {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

// A scene as read from a file, without one on the disk afterwards.
Preset preset_of(const std::string& text) {
    const TestFolder folder;
    ReadPreset read = read_preset(folder.write("scene.frag", text));
    for (const Diagnostic& diagnostic : read.diagnostics) ADD_FAILURE() << to_string(diagnostic);
    return std::move(read.preset).value();
}

TrialOptions options(double draw_seconds = 20.0) {
    return {.device = "", .program = GLINT_BINARY, .draw_seconds = draw_seconds};
}

// The answer, however long it takes.
Verdict verdict(Trial& trial) {
    while (trial.poll().state == TrialState::running) {
        pollfd descriptor{.fd = trial.descriptor(), .events = POLLIN, .revents = 0};
        poll(&descriptor, 1, 10);
    }
    return trial.poll();
}

Verdict try_text(Trial& trial, const std::string& text) {
    const Preset preset = preset_of(text);
    trial.start({.preset = preset, .compile = {}, .images = {}});
    return verdict(trial);
}

void wait_until_ready(Trial& trial) {
    while (trial.renderer().empty() && trial.poll().state != TrialState::unavailable) {
        std::this_thread::sleep_for(5ms);
    }
}

std::string words(const Verdict& verdict) {
    std::string text;
    for (const Diagnostic& diagnostic : verdict.diagnostics) text += to_string(diagnostic) + "\n";
    return text;
}

int line_of(const Verdict& verdict) {
    return verdict.diagnostics.empty() ? -1 : verdict.diagnostics.front().place.line;
}

constexpr const char* kTrivial = "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5); }\n";

constexpr const char* kTwoPasses = R"(uniform float speed; //@ 1 [0, 2]
uniform sampler2D waves; //@ pass mainWaves size=64x64 step=1/240
uniform sampler2D grain; //@ noise rgba 64
void mainWaves(out vec4 c, in vec2 p) { c = texture(waves, p / 64.0) + texture(grain, p); }
void mainImage(out vec4 c, in vec2 p) { c = texture(waves, p / iResolution.xy) * speed * iTime; }
)";

// Some seconds a pixel anywhere: nothing in it can be left out.
constexpr const char* kHeavy = R"(
void mainImage(out vec4 c, in vec2 p) {
    float a = p.x;
    for (int i = 0; i < 1000000000; ++i) {
        for (int k = 0; k < 8; ++k) a = sin(a * 1.1 + exp(cos(a + float(k)))) + pow(abs(a), 0.3);
        if (a > 100.0) break;
    }
    c = vec4(a);
}
)";

TEST(Trial, PassesAGoodSceneWithTimings) {
    Trial trial(options());
    const Verdict result = try_text(trial, kTwoPasses);
    EXPECT_EQ(result.state, TrialState::passed) << words(result);
    ASSERT_EQ(result.passes.size(), 2u);
    EXPECT_EQ(result.passes[0].name, "waves");
    EXPECT_EQ(result.passes[1].name, "image");
    for (const PassTrial& pass : result.passes) {
        EXPECT_GT(pass.compile_ms, 0.0);
        EXPECT_GT(pass.first_ms, 0.0);
        EXPECT_GT(pass.second_ms, 0.0);
    }
    EXPECT_GT(result.total_ms, 0.0);
    EXPECT_FALSE(trial.renderer().empty());
}

// Two passes that take a driver long to read and to compile, and that it has never seen.
std::string long_text() {
    std::string text = "uniform sampler2D waves; //@ pass mainWaves size=64x64\n";
    for (int i = 0; i < 8000; ++i)
        text += fmt::format("float f{0}(float x) {{ return x * {0}.5; }}\n", i);
    const auto now = std::chrono::steady_clock::now().time_since_epoch().count();
    for (const char* name : {"Waves", "Image"}) {
        text +=
            fmt::format("void main{}(out vec4 c, in vec2 p) {{\n    c = vec4(p, iTime, {:.9f});\n",
                        name, static_cast<double>(now % 1000000007) * 1e-9);
        for (int i = 0; i < 30; ++i)
            text +=
                fmt::format("    c = sin(c.yzwx * {}.5 + pow(abs(c), vec4(0.{})));\n", i, i + 1);
        text += name == std::string("Image") ? "    c += texture(waves, p);\n}\n" : "}\n";
    }
    return text;
}

// What is compiled on all processors belongs to the first draw as well: what a person is told, and
// whether a save is sketched, goes by it.
TEST(Trial, TheFirstTextIsTimedAsAnyOther) {
    std::vector<double> first_ms;
    for (const bool is_first : {false, true}) {
        Trial trial(options());
        const Preset preset = preset_of(long_text());
        trial.start({.preset = preset, .compile = {.side_by_side = is_first}, .images = {}});
        const Verdict result = verdict(trial);
        ASSERT_EQ(result.state, TrialState::passed) << words(result);
        ASSERT_EQ(result.passes.size(), 2u);
        first_ms.push_back(result.passes[0].first_ms + result.passes[1].first_ms);
    }
    // Processor time, of which a machine's pace and a second loading take some.
    EXPECT_GT(first_ms[1], 0.5 * first_ms[0]);
    EXPECT_LT(first_ms[1], 2.5 * first_ms[0]);
}

// Programs are made of what is called; a text is judged as a whole.
TEST(Trial, ALeanTextIsJudgedWithWhatNobodyCalls) {
    Trial trial(options());
    const Preset preset = preset_of(std::string(kTrivial) + "// unused\nfloat g() { return x; }\n");
    const CompileOptions lean{.program = {.specialise = true, .lean = true}};
    trial.start({.preset = preset, .compile = lean, .images = {}});
    const Verdict refused = verdict(trial);
    EXPECT_EQ(refused.state, TrialState::rejected);
    EXPECT_EQ(line_of(refused), 3) << words(refused);
    EXPECT_NE(words(refused).find("x"), std::string::npos);
    trial.start({.preset = preset, .compile = lean, .images = {}, .is_text = false});
    EXPECT_EQ(verdict(trial).state, TrialState::passed) << "the same programs, judged before";
}

TEST(Trial, WhatIsWrongWithALeanTextHasItsPlace) {
    Trial trial(options());
    const Preset preset = preset_of(
        "// a comment\n\nfloat unused() { return 1.0; }\nuniform float level; //@ 0.5 [0, 1]\n"
        "void mainImage(out vec4 c, in vec2 p) { /* here */ c = vec4(level * nonsense); }\n");
    trial.start({.preset = preset,
                 .compile = {.program = {.specialise = true, .lean = true}},
                 .images = {}});
    const Verdict lean = verdict(trial);
    trial.start({.preset = preset, .compile = {.program = {.specialise = false}}, .images = {}});
    EXPECT_EQ(words(lean), words(verdict(trial)));
    EXPECT_EQ(line_of(lean), 5) << words(lean);
}

// A scene that was refused because the machine was busy for a moment was a save that never showed.
TEST(Trial, ABusyMachineDoesNotMakeASceneLookSlow) {
    Trial trial(options());
    wait_until_ready(trial);
    const Preset preset = preset_of(kTwoPasses);
    for (int i = 0; i < 10; ++i) {
        trial.start({.preset = preset, .compile = {}, .images = {}});
        // It gets 1 ms in 31.
        while (trial.poll().state == TrialState::running) {
            kill(trial.process(), SIGSTOP);
            std::this_thread::sleep_for(30ms);
            kill(trial.process(), SIGCONT);
            std::this_thread::sleep_for(1ms);
        }
        EXPECT_LT(trial.poll().expected_ms, 1000.0) << words(trial.poll());
    }
}

// As beside a compiler, or other window tests. How long it draws is measured first, so that the
// limit is one that any machine keeps, and the crowd one that makes it too late on any.
TEST(Trial, OneThatIsGivenNoProcessorIsWaitedFor) {
    const std::string text = R"(void mainImage(out vec4 c, in vec2 p) {
    float a = p.x;
    for (int i = 0; i < 20000; ++i) a = sin(a * 1.1 + exp(cos(a)));
    c = vec4(a);
}
)";
    Trial alone(options());
    const Verdict quiet = try_text(alone, text);
    ASSERT_EQ(quiet.state, TrialState::passed) << words(quiet);
    const double draw_ms = quiet.passes[0].second_ms;

    Trial trial(options(4.0 * draw_ms / 1000.0));
    wait_until_ready(trial);
    Crowd::bring(trial.process());
    const Crowd crowd(11);
    const Verdict result = try_text(trial, text);
    EXPECT_EQ(result.state, TrialState::passed) << words(result) << draw_ms << " ms when alone";
    EXPECT_GT(result.total_ms, 8.0 * draw_ms) << "two draws, both late";
}

// It takes a second at most; the chance in the time of a draw of 600 pixels, scaled up to 67
// million of them, was half a minute.
TEST(Trial, AHugeButCheapBufferDoesNotLookSlow) {
    Trial trial(options());
    wait_until_ready(trial);
    for (int i = 0; i < 10; ++i) {
        const Verdict result = try_text(
            trial,
            "uniform sampler2D a; //@ pass mainA size=8192x8192\n"
            "void mainA(out vec4 c, in vec2 p) { c = vec4(" +
                std::to_string(i) +
                "); }\n"
                "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(a, ivec2(p), 0); }\n");
        EXPECT_EQ(result.state, TrialState::passed) << words(result);
        EXPECT_LT(result.expected_ms, 5000.0) << words(result);
    }
}

TEST(Trial, SaysWhereASceneDoesNotCompile) {
    Trial trial(options());
    const Verdict result =
        try_text(trial, "void mainImage(out vec4 c, in vec2 p) {\n    c = nothing;\n}\n");
    EXPECT_EQ(result.state, TrialState::rejected);
    EXPECT_EQ(line_of(result), 2) << words(result);
    EXPECT_EQ(try_text(trial, kTrivial).state, TrialState::passed);
}

TEST(Trial, SaysWhereASoundAloneDoesNotCompileAndPassesThePicture) {
    Trial trial(options());
    const Preset preset = preset_of(R"(void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5); }
#ifdef PASS_sound
vec2 mainSound(int samp, float time) {
    return nothing;
}
#endif
)");
    trial.start({.preset = preset, .compile = {.program = {.specialise = false}}, .images = {}});
    const Verdict result = verdict(trial);

    EXPECT_EQ(result.state, TrialState::passed);
    EXPECT_EQ(line_of(result), 4) << words(result);
}

TEST(Trial, StopsOrWarnsOfALoopThatNeverEnds) {
    Trial trial(options(0.5));
    const Verdict result = try_text(trial, R"(void mainImage(out vec4 c, in vec2 p) {
    // for (;;) in a comment is none
    float a = p.x;
    for (;;) { a = fract(a * 1.7 + 0.1); if (a > 2.0) break; }
    c = vec4(a);
}
)");
    // Mesa's software renderer ends such a loop by itself after 65,535 rounds.
    EXPECT_TRUE(result.state == TrialState::too_slow ||
                (result.state == TrialState::passed && result.expected_ms > 500.0))
        << static_cast<int>(result.state) << " " << result.expected_ms;
    EXPECT_EQ(line_of(result), 4) << words(result);
    EXPECT_EQ(try_text(trial, kTrivial).state, TrialState::passed);
}

TEST(Trial, StopsAVerySlowScene) {
    Trial trial(options(0.05));
    wait_until_ready(trial);
    const Verdict result = try_text(trial, kHeavy);
    EXPECT_EQ(result.state, TrialState::too_slow) << words(result);
    EXPECT_EQ(line_of(result), 4) << words(result);
    EXPECT_NE(words(result).find("pass image: no frame within 0.05 s at 36x18"), std::string::npos)
        << words(result);
    const pid_t process = trial.process();
    wait_until_ready(trial);
    EXPECT_EQ(trial.process(), process);  // the new one is there before it is needed
}

TEST(Trial, RefusesWhatWouldTakeTheDriverGigabytes) {
    ::setenv("GLINT_COMPILE_GIB", "0.2", 1);
    Trial trial(options());
    ::unsetenv("GLINT_COMPILE_GIB");
    const Verdict result = try_text(trial, R"(void mainImage(out vec4 c, in vec2 p) {
    float a[100000000];
    for (int i = 0; i < 100000000; ++i) a[i] = float(i) * p.x;
    c = vec4(a[int(p.y) * 7]);
}
)");
    EXPECT_EQ(result.state, TrialState::rejected) << words(result);
    EXPECT_NE(words(result).find(":1:6: error: pass image: the driver took more than 0.2 GiB"),
              std::string::npos)
        << words(result);
    EXPECT_EQ(try_text(trial, kTrivial).state, TrialState::passed);
}

TEST(Trial, TellsOfAProcessThatIsKilledInTheMiddle) {
    Trial trial(options());
    wait_until_ready(trial);
    const Preset heavy = preset_of(kHeavy);
    trial.start({.preset = heavy, .compile = {}, .images = {}});
    std::this_thread::sleep_for(300ms);  // it draws by now, for a second or more
    kill(trial.process(), SIGKILL);
    const Verdict result = verdict(trial);
    EXPECT_EQ(result.state, TrialState::crashed) << words(result);
    EXPECT_NE(words(result).find("pass image: the driver was ended by signal 9"), std::string::npos)
        << words(result);
    EXPECT_EQ(try_text(trial, kTrivial).state, TrialState::passed);
}

TEST(Trial, IsReplacedWhenItIsKilledWhileIdle) {
    Trial trial(options());
    wait_until_ready(trial);
    const pid_t process = trial.process();
    kill(process, SIGKILL);
    EXPECT_EQ(try_text(trial, kTrivial).state, TrialState::passed);
    EXPECT_NE(trial.process(), process);
}

TEST(Trial, GivesWayToANewerCandidate) {
    Trial trial(options());
    wait_until_ready(trial);
    const Preset heavy = preset_of(kHeavy),
                 broken = preset_of("void mainImage(out vec4 c, in vec2 p) { c = none; }");
    trial.start({.preset = heavy, .compile = {}, .images = {}});
    trial.start({.preset = broken, .compile = {}, .images = {}});
    const Verdict result = try_text(trial, kTrivial);
    EXPECT_EQ(result.state, TrialState::passed) << words(result);
}

TEST(Trial, GoesOnWithoutAContext) {
    TrialOptions impossible = options();
    impossible.device = "no such device";
    Trial trial(impossible);
    EXPECT_EQ(try_text(trial, kTrivial).state, TrialState::unavailable);
    impossible.program = "/nonexistent";
    Trial nothing(impossible);
    EXPECT_EQ(try_text(nothing, kTrivial).state, TrialState::unavailable);
}

// As a system that has no room for a process, for a moment.
TEST(Trial, OneThatDidNotStartIsStartedForALaterCandidate) {
    const TestFolder folder;
    TrialOptions later = options();
    later.program = folder.path() / "glint";
    Trial trial(later);
    EXPECT_EQ(try_text(trial, kTrivial).state, TrialState::unavailable);
    fs::create_symlink(GLINT_BINARY, later.program);
    EXPECT_EQ(try_text(trial, kTrivial).state, TrialState::passed);
}

long resident_kib(pid_t process) {
    std::ifstream status(fmt::format("/proc/{}/status", process));
    for (std::string line; std::getline(status, line);) {
        if (line.starts_with("VmRSS:")) return std::stol(line.substr(6));
    }
    return 0;
}

std::vector<std::string> descriptors(pid_t process) {
    std::vector<std::string> list;
    for (const auto& entry : fs::directory_iterator(fmt::format("/proc/{}/fd", process))) {
        std::error_code gone;
        list.push_back(fs::read_symlink(entry.path(), gone).string());
    }
    return list;
}

TEST(Trial, LeavesNothingBehindAfterManyCandidates) {
    const auto before = descriptors(getpid()).size();
    {
        Trial trial(options());
        long after_ten = 0;
        const auto candidate = [&](int i) {
            return fmt::format(
                "void mainImage(out vec4 c, in vec2 p) {{ c = vec4({}.5, sin(p), 1); }}\n", i);
        };
        for (int i = 0; i < 50; ++i) {
            EXPECT_EQ(try_text(trial, candidate(i)).state, TrialState::passed);
            if (i == 9) after_ten = resident_kib(trial.process());
        }
        const long after_fifty = resident_kib(trial.process());
        fmt::print("resident: {} MB after 10 candidates, {} MB after 50\n", after_ten / 1024,
                   after_fifty / 1024);
#ifndef __SANITIZE_ADDRESS__  // which keeps what was freed, to catch its use
        EXPECT_LT(after_fifty, after_ten + 8 * 1024);  // malloc keeps some
#endif
        for (int i = 0; i < 5; ++i) {  // replaced each time
            kill(trial.process(), SIGKILL);
            EXPECT_EQ(try_text(trial, candidate(i)).state, TrialState::passed);
        }
        EXPECT_EQ(descriptors(getpid()).size(), before + 1);
    }
    EXPECT_EQ(descriptors(getpid()).size(), before);
#ifndef __SANITIZE_ADDRESS__  // whose memory may take longer to give back than a second is waited
    EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);  // no child is left, living or dead
    EXPECT_EQ(errno, ECHILD);
#endif
}

TEST(Trial, InheritsNothingAndHasNoTerminal) {
    const TestFolder folder;
    const fs::path file = folder.path() / "stray";
    const int stray = open(file.c_str(), O_RDWR | O_CREAT, 0600);  // not close-on-exec
    Trial trial(options());
    wait_until_ready(trial);
    for (const std::string& target : descriptors(trial.process())) EXPECT_NE(target, file);
    EXPECT_EQ(getsid(trial.process()), trial.process());
    close(stray);
}

TEST(Trial, EndsWithItsParent) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    const pid_t parent = fork();
    if (parent == 0) {
        Trial trial(options(60.0));
        wait_until_ready(trial);
        const Preset heavy = preset_of(kHeavy);
        trial.start({.preset = heavy, .compile = {}, .images = {}});
        const pid_t process = trial.process();
        if (write(ends[1], &process, sizeof process) < 0) _exit(1);
        std::this_thread::sleep_for(200ms);
        raise(SIGKILL);
    }
    pid_t process = 0;
    ASSERT_EQ(read(ends[0], &process, sizeof process), static_cast<ssize_t>(sizeof process));
    waitpid(parent, nullptr, 0);
    bool gone = false;
    for (int i = 0; i < 1000 && !gone; ++i) {
        std::ifstream status(fmt::format("/proc/{}/stat", process));
        std::stringstream text;
        text << status.rdbuf();
        gone = text.str().empty() || text.str().find(") Z ") != std::string::npos;
        std::this_thread::sleep_for(10ms);
    }
    EXPECT_TRUE(gone);
    close(ends[0]);
    close(ends[1]);
}

struct LoopCase {
    const char* text;
    int line;  // 0: none stands out
};

TEST(LikelyEndlessLoop, IsTheOneThatStandsOut) {
    const LoopCase cases[] = {
        {"void mainImage(out vec4 c, in vec2 p) {\nfor (int i = 0; i < 99; ++i) c += p.x;\n}\n", 0},
        {"void mainImage(out vec4 c, in vec2 p) {\n\nwhile (true) c += 1.0;\n}\n", 3},
        {"void f() {\nfor(;;) { break; }\n}\nvoid g() {\nfor ( ; ; ) { }\n}\n"
         "void mainImage(out vec4 c, in vec2 p) { f(); g(); }\n",
         5},
        {"void mainImage(out vec4 c, in vec2 p) {\nint i = 0;\ndo { ++i; }\n"
         "while (i < 1000000);\n}\n",
         3},
        {"// for(;;)\nvoid mainImage(out vec4 c, in vec2 p) { int waitfor = 3; c = vec4(1); }\n",
         0},
        {"void mainImage(out vec4 c, in vec2 p) {\nfor (int i = 0; i < 20000; ++i)\n"
         "for (float k = 0.0; k < 1e9; ++k) c += k;\n}\n",
         3},
    };
    for (const LoopCase& tested : cases) {
        const auto place = likely_endless_loop(preset_of(tested.text).scene);
        EXPECT_EQ(place ? place->line : 0, tested.line) << tested.text;
    }
}

}  // namespace
}  // namespace glint::trial_test
