// `glint check` finds what was planted in the scenes of tests/scenes, and nothing in a healthy one.
#include "media/image.h"
#include "report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <sstream>

namespace glint::cli::check_test {
namespace {

using Json = nlohmann::json;

class Check : public InAFolder {
protected:
    // The report on one scene of tests/scenes.
    Json check(const std::string& name, std::vector<std::string> more, int expected_code) const {
        std::vector<std::string> arguments = {"check", known_scene(name).string(), "--json"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = glint(std::move(arguments));
        EXPECT_EQ(outcome.err, "");
        return report_of(outcome, expected_code);
    }

    static std::set<std::string> failed(const Json& report) {
        std::set<std::string> names;
        for (const Json& c : report["cases"]) {
            if (c["verdict"] == "fail") names.insert(c["case"]);
        }
        return names;
    }

    static Json case_of(const Json& report, const std::string& name) {
        for (const Json& c : report["cases"]) {
            if (c["case"] == name) return c;
        }
        ADD_FAILURE() << "no case " << name << " in " << report;
        return {};
    }

    // What a failure says to type, typed. The command stands in the case's "reproduce".
    Outcome again(const Json& failure) const {
        std::istringstream words(failure["reproduce"].get<std::string>());
        std::vector<std::string> arguments;
        std::string word;
        words >> word;
        EXPECT_EQ(word, "glint");
        while (words >> word) {
            if (!word.starts_with('\'')) {
                arguments.push_back(word);
                continue;
            }
            std::string rest;
            if (!word.ends_with('\'')) std::getline(words, rest, '\'');
            arguments.push_back(word.substr(1) + rest);
        }
        return glint(arguments);
    }
};

TEST_F(Check, AHealthySceneWithEverySourceOfTroublePasses) {
    const Json report =
        check("healthy", {"--random", "16", "--size", "48x27", "--seconds", "40"}, 0);
    EXPECT_EQ(report["failed"], 0);
    EXPECT_FALSE(report["renderer"].get<std::string>().empty());
    EXPECT_EQ(names(), std::set<std::string>{}) << "only failures leave files";
    // Each group of cases was there.
    for (const char* name :
         {"age 0", "age 1 year", "same phase after 1 year", "size 1x1", "size 1920x1080",
          "mouse outside, high", "frames of 1/1000 s", "frames of 30 s", "frames of mixed lengths",
          "NaN in spring", "Inf in smoke", "1e30 in smoke", "long run", "tweak stiffness=1000",
          "all tweaks at their minimum", "random tweaks 16"}) {
        EXPECT_EQ(case_of(report, name)["verdict"], "pass") << name;
    }
    EXPECT_EQ(case_of(report, "buffers of rgba16f")["verdict"], "report");
    EXPECT_EQ(case_of(report, "tweaks as uniforms")["verdict"], "report");
    EXPECT_EQ(case_of(report, "long run")["note"], "2000 frames");
    for (const Json& c : report["cases"]) {
        EXPECT_EQ(c["scene"], known_scene("healthy").string());
        EXPECT_EQ(c["nan"], 0);
        EXPECT_EQ(c["inf"], 0);
        EXPECT_LE(c["min"].get<double>(), c["max"].get<double>());
    }
}

// It gave values from memory, and crashed the driver.
TEST_F(Check, ALoopThatNothingEndsIsToldAndIsAllThatIsWrong) {
    write(
        "s.frag",
        "int n = 0;\n"
        "void mainImage(out vec4 c, in vec2 p) { do { ++n; } while (true); c = vec4(n == 0); }\n");
    const Outcome budget = glint({"check", "s.frag", "--case", "loop", "--size", "16x9"});
    EXPECT_EQ(budget.code, 6) << budget.out << budget.err;
    EXPECT_NE(budget.out.find("65535 turns"), std::string::npos) << budget.out;
    for (const char* sound : {"size 7x3", "age 0"}) {
        const Outcome other = glint({"check", "s.frag", "--case", sound, "--size", "16x9"});
        EXPECT_EQ(other.code, 0) << other.out << other.err;
    }
}

TEST_F(Check, WhatABufferPromisesIsDrawnOverTheFramesHeldOrBroken) {
    const auto scene = [&](const char* name, const char* promise) {
        write(std::string(name) + ".frag",
              fmt::format(
                  "uniform sampler2D pool; //@ pass mainPool size=8x8 {}\n"
                  "void mainPool(out vec4 s, in vec2 p) {{\n"
                  "    s = vec4(max(texelFetch(pool, ivec2(p), 0).x, 1.0) + 0.001, -0.5, 0, 1);\n"
                  "}}\n"
                  "void mainImage(out vec4 c, in vec2 p) {{ c = texture(pool, p / 64.0); }}\n",
                  promise));
        const Outcome outcome = glint({"check", std::string(name) + ".frag", "--case", "long run",
                                       "--frames", "300", "--json"});
        EXPECT_EQ(outcome.err, "");
        return case_of(Json::parse(outcome.out), "long run");
    };
    const Json held = scene("held", "bounded=[-1, 2]");
    EXPECT_EQ(held["verdict"], "pass");
    ASSERT_EQ(held["curves"].size(), 1u);
    EXPECT_EQ(held["curves"][0]["buffer"], "pool");
    EXPECT_EQ(held["curves"][0]["bounded"], Json({-1.0, 2.0}));
    EXPECT_EQ(held["curves"][0]["points"].back()[0], 299);
    EXPECT_NEAR(held["curves"][0]["points"].back()[2].get<double>(), 1.3, 1e-4) << "300 roundings";
    const Json broken = scene("broken", "conserves=0.01");
    EXPECT_EQ(broken["verdict"], "fail");
    EXPECT_TRUE(broken["reproduce"].get<std::string>().starts_with("glint check ")) << broken;
    for (const Json& found : {held, broken}) {
        if (std::system("gnuplot --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no gnuplot";
        const std::string file = found["diagram"];
        EXPECT_TRUE(file.ends_with("-long-run.svg"));
        EXPECT_TRUE(bytes(file).starts_with("<svg")) << file;
    }
}

// Euler's step of h s grows where (1 - h / 4)^2 + (h^2) (9 - 1/16) > 1: from 1/18 s, 6.67 steps.
TEST_F(Check, AStepIsToldStableUpToWhereAStateBeginsToGrow) {
    const auto told = [&](const std::string& guard) {
        write("spring.frag",
              "uniform sampler2D spring; //@ pass mainSpring size=2x2 step=1/120\n"
              "void mainSpring(out vec4 c, in vec2 p) {\n"
              "    vec2 y = texelFetch(spring, ivec2(p), 0).xy;\n"
              "    if (iFrame == 0" +
                  guard +
                  ") y = vec2(1, 0);\n"
                  "    y += iTimeDelta * vec2(y.y, -9.0 * y.x - 0.5 * y.y);\n"
                  "    c = vec4(y, 0, 1);\n"
                  "}\n"
                  "void mainImage(out vec4 c, in vec2 p) {\n"
                  "    c = vec4(0.4 + 0.2 * texelFetch(spring, ivec2(0), 0).xy, 0.5, 1);\n"
                  "}\n");
        const Outcome outcome =
            glint({"check", "spring.frag", "--size", "16x9", "--json", "--case", "step 1/120 s"});
        const std::string note = case_of(report_of(outcome), "step 1/120 s")["note"];
        EXPECT_TRUE(note.starts_with("stable up to ")) << note;
        return std::atof(note.c_str() + std::strlen("stable up to "));
    };
    EXPECT_NEAR(told(""), 6.67, 0.3 * 6.67);
    EXPECT_NEAR(told(" || !(dot(y, y) < 100.0)"), 6.67, 0.3 * 6.67) << "what is set back has grown";
}

TEST_F(Check, AStepThatIsExactIsToldToBeSo) {
    write("turn.frag",
          "uniform float speed; //@ 1 [0, 4]\n"
          "uniform sampler2D turn; //@ pass mainTurn size=2x2 step=1/240 filter=nearest\n"
          "void mainTurn(out vec4 c, in vec2 p) {\n"
          "    float x = texelFetch(turn, ivec2(p), 0).x;\n"
          "    if (!(x >= 0.0 && x < 1.0)) x = 0.0;\n"
          "    c = vec4(fract(x + speed * iTimeDelta), 0, 0, 1);\n"
          "}\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(turn, ivec2(0), 0); }\n");
    const Outcome outcome = glint({"check", "turn.frag", "--size", "16x9", "--json", "--effort",
                                   "1", "--case", "step 1/240 s"});
    const std::string note = case_of(report_of(outcome), "step 1/240 s")["note"];
    EXPECT_NE(note.find("stable at least up to 64 times"), std::string::npos) << note;
    EXPECT_NE(note.find("exact to rounding"), std::string::npos) << note;
}

// 1.28 Hz: three of 64 frames differ from the one before, or two, as the phase will have it.
TEST_F(Check, WhatBlinksSlowlyAndRightAtEveryAgeStandsStillAtNone) {
    write("scene.frag",
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = vec4(step(0.5, float(83886u * iTick) / 4294967296.0));\n"
          "}\n");
    const Outcome outcome = glint({"check", "scene.frag", "--case", "age", "--json"});
    EXPECT_EQ(failed(report_of(outcome, 0)), std::set<std::string>());
}

TEST_F(Check, PicturesOfFilesOfOneNameAreKeptApart) {
    write("here/a.frag", "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0 / iTime); }\n");
    write("there/a.frag", "void mainImage(out vec4 c, in vec2 p) { c = vec4(2.0 / iTime); }\n");
    const Json report = report_of(
        glint({"check", "here/a.frag", "there/a.frag", "--case", "size 1x512", "--json"}), 6);
    std::set<std::string> pictures;
    for (const Json& failure : report["cases"]) {
        ASSERT_TRUE(failure.contains("picture")) << failure;
        const std::string picture = failure["picture"];
        EXPECT_TRUE(fs::exists(folder() / picture)) << picture;
        pictures.insert(picture);
    }
    EXPECT_EQ(pictures.size(), 2u) << report;
}

TEST_F(Check, AFailureWhosePictureCannotBeKeptIsTheSameFailure) {
    const Json report = check("planted_nan",
                              {"--case", "tweak height=2", "--size", "64x36", "--output",
                               "/proc/no folder can be made here"},
                              6);
    const Json failure = case_of(report, "tweak height=2");
    EXPECT_EQ(failure["nan"], 64 * 36);
    EXPECT_NE(failure["note"].get<std::string>().find("; no picture: Cannot write /proc/no"),
              std::string::npos)
        << failure;
    const std::string again = failure["reproduce"];
    EXPECT_NE(again.find("--size 64x36 --case 'tweak height=2'"), std::string::npos) << again;
    EXPECT_EQ(report["cases"].size(), 1u);
}

TEST_F(Check, TheUniformFedFormIsSeenAtTheSameTimeThoughItAloneHasAState) {
    write("scene.frag",
          "uniform bool trail; //@ off\n"
          "uniform sampler2D sums; //@ pass mainSums size=8x8\n"
          "void mainSums(out vec4 c, in vec2 p) { c = texelFetch(sums, ivec2(p), 0) + 0.1; }\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = vec4(iTime / 20.0);\n"
          "    if (trail) c += texelFetch(sums, ivec2(0), 0);\n"
          "}\n");
    write("preset.toml", "scene = \"scene.frag\"\ntime = 12.0\n");
    const Outcome outcome =
        glint({"check", "preset.toml", "--json", "--random", "0", "--case", "tweaks as uniforms"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::string note = case_of(Json::parse(outcome.out), "tweaks as uniforms")["note"];
    EXPECT_TRUE(note.starts_with("inf dB")) << note;
}

TEST_F(Check, NanIsCountedPaintedMagentaAndReproduced) {
    // With height = 2 the root is of a negative number below y = 1: in all pixels.
    const Json report = check("planted_nan", {"--random", "8", "--size", "64x36"}, 6);
    const Json worst = report["cases"][0];
    EXPECT_EQ(worst["verdict"], "fail");
    EXPECT_EQ(worst["nan"], 64 * 36) << "worst first";
    const Json failure = case_of(report, "tweak height=2");
    EXPECT_EQ(failure["nan"], 64 * 36);
    EXPECT_EQ(failure["inf"], 0);
    EXPECT_NE(failure["note"].get<std::string>().find("2304 pixels of image"), std::string::npos);
    EXPECT_TRUE(failed(report).contains("all tweaks at their maximum"));
    EXPECT_FALSE(failed(report).contains("tweak height=0"));

    const Image picture = read_image(folder() / failure["picture"].get<std::string>());
    ASSERT_EQ(picture.size, glm::ivec2(64, 36));
    const std::byte magenta[] = {std::byte{255}, std::byte{0}, std::byte{255}};
    EXPECT_TRUE(std::equal(std::begin(magenta), std::end(magenta), picture.pixels.begin()));

    const Outcome outcome = again(failure);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const Image still = read_image(folder() / "glint-check/planted_nan-tweak-height-2.exr");
    ASSERT_EQ(still.type, ChannelType::f32);
    float first = 0.0f;
    std::memcpy(&first, still.pixels.data(), sizeof first);
    EXPECT_TRUE(std::isnan(first));
}

TEST_F(Check, NanIsBornOfWhatHasNoResult) {
    write("a.frag",
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    vec2 q = p - 0.5 * iResolution.xy;\n"
          "    c = vec4(atan(q.y, q.x) + log(length(q)) * q.x);\n}\n");
    const Json report =
        report_of(glint({"check", "a.frag", "--json", "--size", "9x9", "--case", "size 7x3"}), 6);
    EXPECT_EQ(report["cases"][0]["where"]["expression"], "log(length(q))") << report;
}

TEST_F(Check, NanOfABufferThatThePictureHidesIsFound) {
    write("scene.frag",
          "uniform float a; //@ 0.5 [0, 1]\n"
          "uniform sampler2D roots; //@ pass mainRoots size=8x8\n"
          "void mainRoots(out vec4 c, in vec2 p) { c = vec4(p.x < 1.0 ? sqrt(-a) : 1.0); }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(roots, ivec2(5), 0); }\n");
    const Json report = report_of(
        glint({"check", "scene.frag", "--json", "--random", "0", "--case", "tweak a=1"}), 6);
    ASSERT_EQ(report["cases"].size(), 1u);
    const Json& failure = report["cases"][0];
    EXPECT_EQ(failure["nan"], 8) << "one column of the buffer";
    EXPECT_NE(failure["reproduce"].get<std::string>().find("--pass roots"), std::string::npos);
    EXPECT_EQ(again(failure).code, 0);
    EXPECT_EQ(read_image(folder() / failure["picture"].get<std::string>()).size, glm::ivec2(8, 8));
}

// It has been drawn when the search begins, and is drawn again to be looked at.
TEST_F(Check, WhatIsBornInABufferOfNoStateIsToldThere) {
    write("scene.frag",
          "uniform sampler2D root; //@ pass mainRoot size=8x8\n"
          "void mainRoot(out vec4 c, in vec2 p) {\n"
          "    c = vec4(sqrt(3.0 - p.x)); }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(root, ivec2(p) % 8, 0); }\n");
    const auto report = report_of(glint({"check", "scene.frag", "--case", "search", "--json",
                                         "--size", "32x18", "--seconds", "5", "-o", "out"}),
                                  6);
    ASSERT_EQ(report["cases"].size(), 1u) << report;
    EXPECT_EQ(report["cases"][0]["verdict"], "fail") << report;
    EXPECT_EQ(report["cases"][0]["where"]["line"], 3) << report;
    EXPECT_EQ(report["cases"][0]["where"]["function"], "mainRoot") << report;
}

TEST_F(Check, LoopsOfABufferOfNoStateAreCounted) {
    write("scene.frag",
          "uniform sampler2D sum; //@ pass mainSum size=8x8\n"
          "void mainSum(out vec4 c, in vec2 p) {\n"
          "    float s = 0.0;\n"
          "    for (int i = 0; i < 70000; ++i) s = fract(s * 1.37 + 0.1);\n"
          "    c = vec4(s); }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(sum, ivec2(p) % 8, 0); }\n");
    const auto report = report_of(glint({"check", "scene.frag", "--case", "loop budget", "--json",
                                         "--size", "32x18", "-o", "out"}),
                                  6);
    ASSERT_EQ(report["cases"].size(), 1u) << report;
    EXPECT_EQ(report["cases"][0]["verdict"], "fail") << report;
}

TEST_F(Check, LoopsThatATweakMakesTooLongNameIt) {
    write(
        "scene.frag",
        "uniform float scale; //@ 1 [0, 2]\nuniform int steps; //@ 20 [1, 300]\n"
        "void mainImage(out vec4 c, in vec2 p) {\n    float s = 0.0;\n"
        "    for (int i = 0; i < steps; ++i) for (int k = 0; k < steps; ++k) s += sin(float(i));\n"
        "    c = vec4(fract(s * scale)); }\n");
    const auto report = report_of(glint({"check", "scene.frag", "--case", "loop budget", "--json",
                                         "--size", "8x4", "-o", "out"}),
                                  6);
    const std::string note = report["cases"][0]["note"];
    EXPECT_TRUE(note.ends_with("; at steps=300")) << note;
}

TEST_F(Check, AFloatClockFailsAfterADay) {
    const std::set<std::string> names = failed(check("planted_age", {}, 6));
    // Its wave swings 16 times a second.
    EXPECT_EQ(names, (std::set<std::string>{"age 1 day", "age 30 days", "age 1 year", "flashes"}));
}

TEST_F(Check, AFaintFloatClockBesideExactPhasesFailsToComeBack) {
    const Json report = check("planted_drift", {"--case", "same phase"}, 6);
    EXPECT_EQ(failed(report).size(), 3u);
    EXPECT_NE(report["cases"][0]["note"].get<std::string>().find("iTime beside iTick"),
              std::string::npos);
}

TEST_F(Check, WhatNeverMovesOrComesToRestIsNotBlamed) {
    write("still.frag", "void mainImage(out vec4 c, in vec2 p) { c = vec4(p, 0, 1) / 100.0; }\n");
    write("rest.frag",
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(min(iTime, 5.0) / 5.0); }\n");
    for (const char* name : {"still.frag", "rest.frag"}) {
        const Outcome outcome = glint({"check", name, "--case", "age"});
        EXPECT_EQ(outcome.code, 0) << outcome.out;
    }
}

TEST_F(Check, ASimulationThatDependsOnTheFrameRateIsFound) {
    const std::set<std::string> names = failed(check("planted_frame_rate", {}, 6));
    for (const char* name : {"frames of 1/240 s", "frames of 1/30 s", "frames of mixed lengths"}) {
        EXPECT_TRUE(names.contains(name)) << name;
    }
    EXPECT_FALSE(names.contains("frames of 1/60 s"));
    EXPECT_FALSE(names.contains("long run"));
}

TEST_F(Check, AnExplodingSpringIsFound) {
    const Json report = check("planted_spring", {"--inject", "0"}, 6);
    const std::set<std::string> names = failed(report);
    EXPECT_TRUE(names.contains("long run"));
    EXPECT_TRUE(names.contains("frames of 1 s"));
    EXPECT_NE(case_of(report, "long run")["note"].get<std::string>().find("grows"),
              std::string::npos);
}

// Its place swings, so that means of parts would hang on where in a swing each begins.
TEST_F(Check, AnUndampedSpringThatGainsALittleIsFound) {
    write("spring.frag",
          "uniform sampler2D spring; //@ pass mainSpring size=1x1 step=1/240\n"
          "void mainSpring(out vec4 c, in vec2 p) {\n"
          "    vec2 s = texelFetch(spring, ivec2(0), 0).xy;\n"
          "    if (iFrame == 0) s = vec2(1.0, 0.0);\n"
          "    c = vec4(s + vec2(s.y, -40.0 * s.x) * iTimeDelta, 0.0, 0.0);\n}\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(spring, ivec2(0), 0) * 0.1; }\n");
    const Json report =
        report_of(glint({"check", "spring.frag", "--json", "--case", "long run"}), 6);
    EXPECT_NE(case_of(report, "long run")["note"].get<std::string>().find("grows steadily"),
              std::string::npos)
        << report;
}

// Each step turns the sign of what the limit leaves, from three halves of the step in use on.
TEST_F(Check, AStepThatALimitHoldsIsNotCalledStable) {
    const auto told = [&](double rate) {
        write(
            "cold.frag",
            fmt::format(
                "uniform sampler2D cold; //@ pass mainCold size=2x2 step=1/60\n"
                "void mainCold(out vec4 c, in vec2 p) {{\n"
                "    float s = texelFetch(cold, ivec2(p), 0).x;\n"
                "    if (iFrame == 0) s = 0.9;\n"
                "    s = clamp(s - iTimeDelta * {:.1f} * (s - 0.4), 0.0, 1.0);\n"
                "    c = vec4(s, 0, 0, 1);\n"
                "}}\n"
                "void mainImage(out vec4 c, in vec2 p) {{ c = texelFetch(cold, ivec2(0), 0); }}\n",
                rate));
        const std::string note =
            case_of(report_of(glint({"check", "cold.frag", "--json", "--case", "step"})),
                    "step 1/60 s")["note"];
        return note.starts_with("stable up to ")
                   ? std::atof(note.c_str() + std::strlen("stable up to "))
               : note.starts_with("unstable by the step in use") ? 0.0
                                                                 : -1.0;
    };
    EXPECT_NEAR(told(80.0), 1.5, 0.1);
    EXPECT_EQ(told(150.0), 0.0);
}

TEST_F(Check, AStepThatDoesNotKnowHowLongItIsHasNoOrder) {
    write("count.frag",
          "uniform sampler2D count; //@ pass mainCount size=2x2 step=1/60\n"
          "void mainCount(out vec4 c, in vec2 p) {\n"
          "    c = vec4(0.5 + 0.9 * (texelFetch(count, ivec2(p), 0).x - 0.5), 0, 0, 1);\n"
          "}\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(count, ivec2(0), 0); }\n");
    const Json step = case_of(report_of(glint({"check", "count.frag", "--json", "--case", "step"})),
                              "step 1/60 s");
    EXPECT_TRUE(step["note"].get<std::string>().starts_with("it reads no iTimeDelta")) << step;
}

// The state with the step in use is none to compare others with.
TEST_F(Check, AStepThatExplodesIsNotCalledStable) {
    write("spring.frag",
          "uniform float k; //@ 30 [1, 40000]\n"
          "uniform sampler2D spring; //@ pass mainSpring size=1x1 step=1/60\n"
          "void mainSpring(out vec4 c, in vec2 p) {\n"
          "    vec2 s = texelFetch(spring, ivec2(0), 0).xy;\n"
          "    if (iFrame == 0 || !(abs(s.x) < 1e15)) s = vec2(1.0, 0.0);\n"
          "    s.y += (-k * s.x - 0.2 * s.y) * iTimeDelta;\n"
          "    s.x += s.y * iTimeDelta;\n"
          "    c = vec4(s, 0.0, 0.0);\n}\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(spring, ivec2(0), 0) * 0.1; }\n");
    const Json report = report_of(glint({"check", "spring.frag", "--json", "--case", "step"}), 0);
    EXPECT_NE(case_of(report, "step 1/60 s")["note"].get<std::string>().find(
                  "unstable by the step in use"),
              std::string::npos)
        << report;
}

TEST_F(Check, ALineOfAnotherColourAndTheSameMeanIsFound) {
    write("line.frag",
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    int y = int(p.y), rows = int(iResolution.y), half_of = rows / 2;\n"
          "    bool is_met = y < half_of || y >= rows - half_of;\n"
          "    c = is_met ? vec4(0.3, 0.3, 0.3, 1.0) : vec4(0.9, 0.0, 0.0, 1.0);\n}\n");
    const Json report =
        report_of(glint({"check", "line.frag", "--json", "--case", "odd sizes"}), 6);
    EXPECT_NE(case_of(report, "odd sizes")["note"].get<std::string>().find("a row stands out"),
              std::string::npos)
        << report;
}

TEST_F(Check, NanThatSpreadsSlowlyIsFound) {
    const Json report = check("planted_nan_spread", {}, 6);
    // Born after 20 s: only many frames show it. Spread by a blur: any texel shows it.
    EXPECT_TRUE(failed(report).contains("long run"));
    EXPECT_TRUE(failed(report).contains("NaN in smoke"));
    EXPECT_NE(case_of(report, "long run")["note"].get<std::string>().find("of smoke"),
              std::string::npos);
    EXPECT_EQ(check("planted_nan_spread", {"--case", "long run", "--frames", "1100"}, 0)["failed"],
              0);
    // What a still cannot do is done by the check itself.
    const Outcome outcome = again(case_of(report, "NaN in smoke"));
    EXPECT_EQ(outcome.code, 6);
    EXPECT_NE(outcome.out.find("fail    NaN in smoke"), std::string::npos) << outcome.out;
}

TEST_F(Check, ASampleThatIsNoNumberIsToldWithItsOperation) {
    write("scene.frag",
          "uniform float pitch; //@ 440 [0, 880]\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0); }\n"
          "vec2 mainSound(int samp, float time) {\n"
          "    float tone = sin(6.2831853 * fract(pitch * time));\n"
          "    return vec2(tone, tone * sqrt(1.0 - 0.1 * time));\n}\n");
    const Json report = report_of(glint({"check", "scene.frag", "--json", "--case", "sound"}), 6);
    const Json found = case_of(report, "sound");
    const auto note = found["note"].get<std::string>();
    // 10 s are 441,000 samples; 1 - 0.1 time is a rounding below 0 some samples later.
    EXPECT_TRUE(note.starts_with("NaN in the right channel at 10.000")) << note;
    EXPECT_NE(note.find("; born at scene.frag:5: sqrt"), std::string::npos) << note;
    EXPECT_EQ(found["where"]["line"], 5) << found;
    EXPECT_EQ(found["where"]["function"], "mainSound") << found;
    ASSERT_EQ(found["where"]["operands"].size(), 1u) << found;
    EXPECT_LT(found["where"]["operands"][0].get<double>(), 0.0);
}

TEST_F(Check, ASizeOfOneColumnIsTried) {
    EXPECT_EQ(failed(check("planted_bad_size", {}, 6)),
              (std::set<std::string>{"search", "size 1x1", "size 1x512"}));
}

// What flashes at the end of a range may be meant to.
TEST_F(Check, TheWorstJumpIsToldWithItsPlaceAndFailsNothing) {
    write("scene.frag",
          "uniform float speed; //@ 0 [0, 10]\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5 + 0.5 * sin(6.3 * speed * iTime)); "
          "}\n");
    const Json report = report_of(glint({"check", "scene.frag", "--json", "--case", "worst"}), 0);
    const std::string note = case_of(report, "worst")["note"];
    EXPECT_NE(note.find("a frame is off the next by"), std::string::npos) << note;
    EXPECT_NE(note.find("at speed="), std::string::npos) << note;
    EXPECT_NE(note.find("100 % of the picture flashes"), std::string::npos) << note;
}

TEST_F(Check, TheMouseIsReplayedFromAPreset) {
    write("scene.frag",
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(sqrt(iResolution.x - iMouse.x)); }\n");
    const Json report = report_of(glint({"check", "scene.frag", "--json", "--case", "mouse"}), 6);
    EXPECT_EQ(failed(report), std::set<std::string>{"mouse outside, high"});
    EXPECT_EQ(again(report["cases"][0]).code, 0);
    const Image still = read_image(folder() / "glint-check/scene-mouse-outside-high.exr");
    float first = 0.0f;
    std::memcpy(&first, still.pixels.data(), sizeof first);
    EXPECT_TRUE(std::isnan(first));
}

TEST_F(Check, AHangIsAFailureAndTheRestIsStillChecked) {
    const Json report = check("planted_hang", {"--hang", "1", "--case", "size"}, 6);
    EXPECT_EQ(failed(report), std::set<std::string>{"size 1920x1080"});
    EXPECT_NE(report["cases"][0]["note"].get<std::string>().find("hangs"), std::string::npos);
    EXPECT_EQ(report["cases"].size(), 5u);
}

TEST_F(Check, SeveralFilesAreOneReport) {
    write("presets/a.toml", "scene = \"../scene.frag\"\n");
    write("presets/b.toml", "scene = \"../scene.frag\"\n[tweaks]\nx = 2.0\n");
    write("scene.frag",
          "uniform float x; //@ 1 [1, 2]\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(1.0 / x); }\n");
    const Json report =
        report_of(glint({"check", "presets/a.toml", "presets/b.toml", "--json", "--random", "3"}));
    ASSERT_EQ(report["files"].size(), 2u);
    EXPECT_EQ(report["files"][1]["scene"], "presets/b.toml");
    // Sets of all tweaks are the same for both.
    const auto skipped = [&](const std::string& file) {
        return std::count_if(report["cases"].begin(), report["cases"].end(), [&](const Json& c) {
            return c["scene"] == file && c["verdict"] == "skip";
        });
    };
    EXPECT_EQ(skipped("presets/a.toml"), 0);
    EXPECT_EQ(skipped("presets/b.toml"), 7) << "it has no loops, and no loop budget";
}

TEST_F(Check, MistakesHaveTheSameCodesAsAStill) {
    write("wrong.frag", "void mainImage(out vec4 c, in vec2 p) { c = wrong; }\n");
    write("scene.frag", kGradient);
    EXPECT_EQ(glint({"check", "wrong.frag"}).code, 3);
    EXPECT_EQ(glint({"check", "gone.frag"}).code, 4);
    EXPECT_EQ(glint({"check", "scene.frag", "--size", "0x0"}).code, 2);
    EXPECT_EQ(glint({"check", "scene.frag", "--case", "no such"}).code, 2);
    EXPECT_EQ(glint({"check"}).code, 2);
    EXPECT_EQ(glint({"check", "scene.frag", "--device", "none such"}).code, 5);
    // A file that cannot be checked does not keep others from it.
    const Outcome outcome = glint({"check", "wrong.frag", "scene.frag"});
    EXPECT_EQ(outcome.code, 3);
    EXPECT_NE(outcome.out.find("scene.frag: 0 of"), std::string::npos) << outcome.out;
}

TEST_F(Check, LinesTellOfEachCaseAsItEnds) {
    const Outcome outcome =
        glint({"check", known_scene("planted_bad_size").string(), "--lines", "--case", "size"});
    EXPECT_EQ(outcome.code, 6) << outcome.err;
    std::istringstream lines(outcome.out);
    std::string line;
    long done = 0, of = -1, failed = 0;
    while (std::getline(lines, line)) {
        const Json json = Json::parse(line, nullptr, false);
        ASSERT_TRUE(json.is_object()) << line;
        EXPECT_EQ(json["done"], ++done);
        of = json["of"];
        failed += json["case"]["verdict"] == "fail";
        EXPECT_TRUE(json["case"]["case"].get<std::string>().starts_with("size"));
    }
    EXPECT_EQ(done, of);
    EXPECT_GT(failed, 0);
}

}  // namespace
}  // namespace glint::cli::check_test
