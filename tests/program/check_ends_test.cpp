// Faults that wait at an end: of the tick, of a tweak's range, of the picture under the mouse.
#include "report.h"

#include <map>
#include <utility>

namespace glint::cli::check_ends_test {
namespace {

using Json = nlohmann::json;

class CheckEnds : public InAFolder {
protected:
    // The verdict of a case on this scene, which fails or not.
    std::string note_of(const std::string& scene, const std::string& name, int code) {
        write("s.frag", scene);
        const Json report =
            report_of(glint({"check", "s.frag", "--size", "16x9", "--json", "--case", name}), code);
        for (const Json& one : report["cases"])
            if (one["case"] == name) return one["note"];
        return "none";
    }
};

TEST_F(CheckEnds, ATickThatIsUsedSoThatItJumpsWhereItWraps) {
    const auto scene = [](const std::string& phase) {
        return "void mainImage(out vec4 c, in vec2 p) {\n    c = vec4(vec3(0.5 + 0.4 * "
               "sin(6.2831853 "
               "* fract(" +
               phase + "))), 1);\n}\n";
    };
    EXPECT_EQ(note_of(scene("float(iTick & 0xFFFFFu) / 1048576.0"), "tick wraps", 0), "");
    EXPECT_NE(note_of(scene("float(iTick % 218453u) / 218453.0"), "tick wraps", 6).find("65536 s"),
              std::string::npos);
    EXPECT_NE(note_of(scene("float(int(iTick) / 66) / 50000.0"), "tick wraps", 6).find("32768 s"),
              std::string::npos);
}

// What jumps at the end of each of its periods, as slides do, jumps at those of the tick as well.
TEST_F(CheckEnds, ATickWhoseOwnPeriodEndsWithACutIsUsedWell) {
    const char* slides =
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    uint slide = (iTick >> 19) & 3u;\n"
        "    c = vec4(vec3(slide == 0u ? 0.9 : 0.2 * float(slide)), 1);\n}\n";
    EXPECT_EQ(note_of(slides, "tick wraps", 0), "");
}

TEST_F(CheckEnds, SlidesByChanceAreUsedWell) {
    for (const char* bits : {"15", "17", "18", "20"})
        EXPECT_EQ(note_of(std::string("float grey(uint n) { n = (n ^ 61u) * 0x9E3779B9u; return "
                                      "float((n ^ (n >> 15)) & 255u) / 255.0; }\n"
                                      "void mainImage(out vec4 c, in vec2 p) {\n"
                                      "    c = vec4(vec3(grey(iTick >> ") +
                              bits + ")), 1);\n}\n",
                          "tick wraps", 0),
                  "")
            << bits;
}

// Its own cut comes at each period, of which the tick's wrap is one.
TEST_F(CheckEnds, APeriodOfTheTickThatIsNoPowerOfTwoEndsWithItsOwnCut) {
    const std::string phase = "float(uint(int(0.21 * 65536.0)) * iTick) / 4294967296.0";
    EXPECT_EQ(note_of("void mainImage(out vec4 c, in vec2 p) {\n    c = vec4(step(p.x / "
                      "iResolution.x, " +
                          phase + "));\n}\n",
                      "tick wraps", 0),
              "");
}

// The middle row and column are half of one side and half of the other.
TEST_F(CheckEnds, HardEdgesThroughTheMiddleAreNoLineThatStandsOut) {
    EXPECT_EQ(note_of("void mainImage(out vec4 c, in vec2 p) {\n"
                      "    vec2 q = p - 0.5 * iResolution.xy;\n"
                      "    c = vec4(q.x * q.y > 0.0 ? 0.8 : 0.2);\n}\n",
                      "odd sizes", 0)
                  .find("stands out"),
              std::string::npos);
}

// At rest in the second and in the minute that are looked at first.
TEST_F(CheckEnds, AMotionThatBeginsLateOrPausesHasAnAge) {
    for (const char* angle : {"1.9 * max(iTime - 3.0, 0.0)", "max(mod(iTime, 6.0) - 2.5, 0.0)"}) {
        const std::string scene =
            std::string(
                "void mainImage(out vec4 c, in vec2 p) {\n    c = vec4(0.5 + 0.5 * sin(0.7 "
                "* p.x + ") +
            angle + "));\n}\n";
        EXPECT_NE(note_of(scene, "age 30 days", 6).find("when young"), std::string::npos) << angle;
        EXPECT_NE(note_of(scene, "age 1 hour", 0), "none") << angle;
    }
}

// A texel is 0 after NaN until the sweep comes round again, in four seconds.
TEST_F(CheckEnds, WhatTheNextSweepWritesAnewHasHealed) {
    const auto scene = [](const char* healed) {
        return std::string(
                   "uniform sampler2D s; //@ pass mainS size=8x8\n"
                   "void mainS(out vec4 c, in vec2 p) {\n"
                   "    float was = texelFetch(s, ivec2(p), 0).x;\n"
                   "    if (!(was >= 0.0)) was = ") +
               healed +
               ";\n    if (was < 2.0 && abs(fract(0.25 * iTime) * 8.0 - p.x) < 0.5) was = 1.0;\n"
               "    c = vec4(was * (was > 2.0 ? 1.0 : exp(-iTimeDelta)));\n}\n"
               "void mainImage(out vec4 c, in vec2 p) {\n"
               "    c = texture(s, p / iResolution.xy);\n}\n";
    };
    EXPECT_NE(note_of(scene("0.0"), "healed s", 0), "none");
    EXPECT_NE(note_of(scene("9.0"), "healed s", 6).find("wrong state"), std::string::npos);
}

// A tile of the picture is two pixels wide and one high here.
TEST_F(CheckEnds, EdgesThatMoveSlowlyAreNoFlashes) {
    for (const char* along : {"x", "y"})
        EXPECT_NE(note_of(std::string("void mainImage(out vec4 c, in vec2 p) {\n    c = vec4(vec3("
                                      "step(0.5, fract(p.") +
                              along + " / 2.7 - iTime))), 1);\n}\n",
                          "flashes", 0)
                      .find("0 % of the picture flashes"),
                  std::string::npos)
            << along;
}

TEST_F(CheckEnds, WhatIsAssertedDoesNotHoldWithAnotherValue) {
    const std::string scene =
        "uniform float r; //@ 1 [0, 2]\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    //@ assert r > 0.0 \"a radius\"\n"
        "    c = vec4(vec3(r * 0.3), 1);\n}\n";
    EXPECT_EQ(note_of(scene, "asserted values", 0), "");
    const std::string found = note_of(scene, "asserted at the ranges' ends", 6);
    EXPECT_NE(found.find("s.frag:3:5: assert r > 0.0"), std::string::npos) << found;
    EXPECT_TRUE(found.ends_with("; at r=0")) << found;
}

TEST_F(CheckEnds, AnEdgeThatTheMouseIsDraggedTo) {
    const std::string found = note_of(
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    c = vec4(vec3(iMouse.z > 0.0 && iMouse.z != iMouse.x ? 1.0 / iMouse.x : 0.5), 1);\n"
        "}\n",
        "mouse bottom left", 6);
    EXPECT_NE(found.find("Inf"), std::string::npos) << found;
}

// A person may wait, and press a key in between.
TEST_F(CheckEnds, WhatGoesWrongInASimulationSecondsLater) {
    const auto scene = [](const std::string& step, const std::string& body) {
        return "uniform sampler2D s; //@ pass mainS size=1" + step +
               "\nvoid mainS(out vec4 c, in vec2 p) {\n    float n = texelFetch(s, ivec2(0), "
               "0).x;\n"
               "    " +
               body +
               "\n}\nvoid mainImage(out vec4 c, in vec2 p) {\n"
               "    c = vec4(vec3(texelFetch(s, ivec2(0), 0).y), 1);\n}\n";
    };
    const std::string late =
        note_of(scene("", "c = vec4(min(n + 1.0 / 256.0, 1.0), max(sqrt(0.75 - n), 0.2), 0, 1);"),
                "search", 6);
    EXPECT_NE(late.find("s.frag:4: in mainS: sqrt(0.75 - n) is undefined"), std::string::npos)
        << late;
    EXPECT_NE(late.find("; after "), std::string::npos) << late;
    const std::string slow = note_of(
        scene(" step=1/10", "c = vec4(0.5, iFrame == 0 ? 0.4 : max(sqrt(n - 0.75), 0.2), 0, 1);"),
        "search", 6);
    EXPECT_NE(slow.find("sqrt(n - 0.75) is undefined"), std::string::npos) << slow;
    note_of(scene("", "c = vec4(min(n + 1.0 / 256.0, 1.0), sqrt(1.0 - 0.5 * n), 0, 1);"), "search",
            0);
}

TEST_F(CheckEnds, ThatTwoTweaksAreEqual) {
    const std::string found = note_of(
        "uniform float a; //@ 0.3 [0.1, 0.77]\nuniform float b; //@ 0.51 [0.1, 0.9]\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    c = vec4(vec3(clamp((a - b) / (b * b - a * a), 0.0, 1.0)), 1);\n}\n",
        "search", 6);
    EXPECT_NE(found.find("s.frag:4: in mainImage"), std::string::npos) << found;
}

TEST_F(CheckEnds, WhatEachFrameAddsWhileAKeyIsHeld) {
    const auto scene = [](const std::string& added) {
        return "uniform sampler2D s; //@ pass mainS\nuniform sampler2D keys; //@ keyboard\n"
               "void mainS(out vec4 c, in vec2 p) {\n"
               "    float b = texelFetch(s, ivec2(p), 0).x * exp(-1.5 * iTimeDelta);\n"
               "    if (texelFetch(keys, ivec2(32, 0), 0).x > 0.5) b += " +
               added +
               ";\n    c = vec4(b);\n}\nvoid mainImage(out vec4 c, in vec2 p) {\n"
               "    float v = texelFetch(s, ivec2(p), 0).x; c = vec4(vec3(v / (1.0 + v)), 1);\n}\n";
    };
    const std::string found = note_of(scene("0.1"), "frame rates", 6);
    EXPECT_NE(found.find("something is added in every frame"), std::string::npos) << found;
    EXPECT_TRUE(found.ends_with("; at key space")) << found;
    note_of(scene("6.0 * iTimeDelta"), "frame rates", 0);
}

// With what flashes up now and then, and with what the mouse has painted once it is let go.
TEST_F(CheckEnds, WhatEachFrameFadesByAShare) {
    const auto scene = [](const std::string& share, const std::string& hit) {
        return "uniform sampler2D s; //@ pass mainS\n"
               "void mainS(out vec4 c, in vec2 p) {\n"
               "    float hit = " +
               hit + ";\n    c = vec4(max(texelFetch(s, ivec2(p), 0).x * " + share +
               ", hit));\n}\nvoid mainImage(out vec4 c, in vec2 p) {\n"
               "    c = vec4(vec3(0.8 * texelFetch(s, ivec2(p), 0).x), 1);\n}\n";
    };
    const std::pair<const char*, const char*> cases[] = {
        {"step(0.9, fract(iTime * 2.0))", "after 0.7 s"},
        {"step(0.5, fract(iTime))", "after 1.2 s"},
        {"iMouse.z > 0.0 ? smoothstep(9.0, 3.0, length(p - iMouse.xy)) : 0.0",
         "let go at 0.2 s; at mouse"}};
    for (const auto& [hit, words] : cases) {
        const std::string found = note_of(scene("0.95", hit), "frame rates", 6);
        EXPECT_NE(found.find("fades by a share in every frame"), std::string::npos) << found;
        EXPECT_NE(found.find(words), std::string::npos) << found;
        note_of(scene("exp(-3.0 * iTimeDelta)", hit), "frame rates", 0);
    }
}

// A clock that each frame adds to reaches as far in thirty minutes as it is to.
TEST_F(CheckEnds, WhatCountsSecondsIsNoExplosion) {
    const auto scene = [](const std::string& next) {
        return "uniform sampler2D s; //@ pass mainS size=4x4\n"
               "void mainS(out vec4 c, in vec2 p) {\n"
               "    float x = texelFetch(s, ivec2(p), 0).x;\n    c = vec4(" +
               next +
               ");\n}\nvoid mainImage(out vec4 c, in vec2 p) {\n"
               "    c = vec4(vec3(texelFetch(s, ivec2(0), 0).x * 1e-7), 1);\n}\n";
    };
    note_of(scene("x + 100.0 * iTimeDelta"), "frames of 30 s", 0);
    const std::string found = note_of(
        scene("iFrame == 0 ? 1.0 : clamp(x * (1.0 + iTimeDelta), 0.0, 1e9)"), "frames of 30 s", 6);
    EXPECT_NE(found.find("the state explodes"), std::string::npos) << found;
}

// What is told to draw it again does.
TEST_F(CheckEnds, TheFrameThatFailedIsTheOneThatIsTold) {
    const auto again = [&](const std::string& value, const std::string& name) {
        write("s.frag", "void mainImage(out vec4 c, in vec2 p) { c = vec4(" + value + "); }\n");
        return report_of(glint({"check", "s.frag", "--size", "16x9", "--json", "--case", name}),
                         6)["cases"][0]["reproduce"]
            .get<std::string>();
    };
    EXPECT_NE(again("sqrt(100.0 - iTime)", "age 1 hour").find("--time 3600 "), std::string::npos);
    EXPECT_NE(again("log(iTime)", "worst").find("--time 0 "), std::string::npos);
}

TEST_F(CheckEnds, OfASoundTheSampleIsTold) {
    const std::string found = note_of(
        "vec2 mainSound(int samp, float time) {\n"
        "    float n[4] = float[4](220.0, 247.0, 262.0, 294.0);\n"
        "    return vec2(0.1 * sin(6.2831 * n[int(time * 2.0)] * time));\n}\n"
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5); }\n",
        "sound", 6);
    EXPECT_NE(found.find("index 4 out of range; at 2.000 s"), std::string::npos) << found;
}

TEST_F(CheckEnds, OfASoundTheStartIsHeardInAnyTimeAndWhatIsNoNumberIsCounted) {
    write("s.frag",
          "vec2 mainSound(int samp, float time) { return vec2(sqrt(-time), 0.0); }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(0.5); }\n");
    const Json found = report_of(
        glint({"check", "s.frag", "--seconds", "3", "--size", "8x8", "--json", "--case", "sound"}),
        6)["cases"][0];
    EXPECT_EQ(found["nan"], 8191) << found;
    EXPECT_EQ(found["inf"], 0) << found;
}

// The preset's own values explode, and those of the case do not.
TEST_F(CheckEnds, WhatThePresetDoesIsNotTheCases) {
    write("s.frag",
          "uniform float gain; //@ 1.5 [0.5, 2] \"factor a frame\"\n"
          "uniform sampler2D s; //@ pass mainS size=16\n"
          "void mainS(out vec4 c, in vec2 p) {\n"
          "    c = vec4(texelFetch(s, ivec2(p), 0).r * gain + 0.1);\n}\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = vec4(vec3(texelFetch(s, ivec2(mod(p, 16.0)), 0).r), 1.0);\n}\n");
    const Outcome low = glint({"check", "s.frag", "--case", "gain=0.5 for long", "--size", "8x8"});
    EXPECT_EQ(low.code, 0) << low.out;
    EXPECT_EQ(glint({"check", "s.frag", "--case", "gain=2 for long", "--size", "8x8"}).code, 6);
}

TEST_F(CheckEnds, AFailureOfAQualityIsDrawnAgainWithIt) {
    write("s.frag",
          "uniform int n; //@ 1 [1, 4] quality reference=4\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(n == 3 ? sqrt(-p.x) : 0.5); }\n");
    write("s.toml", "scene = \"s.frag\"\n[quality.low]\nn = 3\n");
    const Json found =
        report_of(glint({"check", "s.toml", "--quality", "low", "--json", "--case", "size 7x3"}),
                  6)["cases"][0];
    EXPECT_NE(found["reproduce"].get<std::string>().find(" --quality low "), std::string::npos)
        << found;
}

TEST_F(CheckEnds, ADivisionByZeroThatBecomesNanLaterIsNamedItself) {
    const std::string found = note_of(
        "uniform float b; //@ 0.5 [0, 1]\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    float x = p.x / b;\n    c = vec4(fract(x));\n}\n",
        "search", 6);
    EXPECT_NE(found.find("s.frag:3: p.x / b: division by zero"), std::string::npos) << found;
}

// Shift does nothing alone.
TEST_F(CheckEnds, KeysThatAreHeldTogether) {
    const auto scene = [](const std::string& value) {
        return "uniform sampler2D keys; //@ keyboard\n"
               "float down(int k) { return texelFetch(keys, ivec2(k, 0), 0).x; }\n"
               "void mainImage(out vec4 c, in vec2 p) {\n"
               "    float z = 0.6 * (down(87) - down(83)) * (1.0 + down(16));\n    c = vec4(" +
               value + ");\n}\n";
    };
    const std::string found = note_of(scene("acos(z)"), "search", 6);
    EXPECT_NE(found.find(", key shift; born at s.frag:5: acos(z)"), std::string::npos) << found;
    note_of(scene("acos(clamp(z, -1.0, 1.0))"), "search", 0);
}

TEST_F(CheckEnds, WhatAssertionsSayOfKeysWhereNoTweakIs) {
    const std::string found = note_of(
        "uniform sampler2D keys; //@ keyboard\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    float t = 0.5 - texelFetch(keys, ivec2(65, 0), 0).x;\n"
        "    //@ assert t >= 0.0\n    c = vec4(t);\n}\n",
        "asserted at the ranges' ends", 6);
    EXPECT_NE(found.find("key a"), std::string::npos) << found;
}

TEST_F(CheckEnds, WhatEachFrameMovesUntilItMeetsALimit) {
    const auto scene = [](const std::string& moved) {
        return "uniform sampler2D s; //@ pass mainS size=1\nuniform sampler2D keys; //@ keyboard\n"
               "void mainS(out vec4 c, in vec2 p) {\n"
               "    float x = iFrame == 0 ? 0.5 : texelFetch(s, ivec2(0), 0).x;\n"
               "    c = vec4(clamp(x + texelFetch(keys, ivec2(39, 0), 0).x * " +
               moved +
               ", 0.0, 1.0));\n}\nvoid mainImage(out vec4 c, in vec2 p) {\n"
               "    float x = texelFetch(s, ivec2(0), 0).x;\n"
               "    c = vec4(vec3(smoothstep(0.2, 0.1, length(p / iResolution.xy - vec2(x, "
               "0.5)))), "
               "1);\n}\n";
    };
    const std::string found = note_of(scene("0.01"), "frame rates", 6);
    EXPECT_TRUE(found.ends_with("; at key right")) << found;
    note_of(scene("0.6 * iTimeDelta"), "frame rates", 0);
}

TEST_F(CheckEnds, FlashesAtTheEndOfARangeOnceAKeyWasPressed) {
    const std::string found = note_of(
        "uniform float rate; //@ 1 [0.3, 6]\nuniform sampler2D keys; //@ keyboard\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    float on = step(0.5, fract(rate * iTime));\n"
        "    c = vec4(vec3(on * (0.05 + 0.9 * texelFetch(keys, ivec2(76, 2), 0).x)), 1);\n}\n",
        "flashes", 6);
    EXPECT_NE(found.find("; at rate=6, key "), std::string::npos) << found;
}

TEST_F(CheckEnds, WhatEndsByItselfHasNotAged) {
    const std::string image =
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    float v = 0.5 + 0.5 * sin(6.2831853 * (float(iTick & 0xFFFFFu) / 1048576.0 + p.x / "
        "iResolution.x));\n    c = vec4(vec3(v * smoothstep(0.0, 3.0, iTime)), 1);\n}\n";
    EXPECT_EQ(note_of(image, "same phase after 1 year", 0).find("it reads"), std::string::npos);
    note_of(
        "uniform sampler2D s; //@ pass mainS size=1 step=1/60\n"
        "void mainS(out vec4 c, in vec2 p) {\n"
        "    c = vec4(mix(texelFetch(s, ivec2(0), 0).x, 0.5, 0.02));\n}\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    float battery = sqrt(max(1.0 - iTime / 150.0, 0.0));\n"
        "    c = vec4(vec3(texelFetch(s, ivec2(0), 0).x + 0.5 * battery * p.x / "
        "iResolution.x), 1);\n}\n",
        "age 1 day", 0);
}

// One frame of it at lacunarity=1 takes most of a second, and flashes are looked for in dozens.
TEST_F(CheckEnds, AnEndlessLoopIsToldInTimeThoughOtherCasesOfSuchFramesAreLeftOut) {
    write(
        "s.frag",
        "uniform float lacunarity; //@ 2 [1, 3]\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    float s = 0.1 * sin(6.2831853 * fract(float(iTick & 0xFFFFFu) / 1048576.0));\n"
        "    for (float k = 1.0; k < 64.0; k *= lacunarity)\n"
        "        s += sin(p.x * k + 1.7 * sin(p.y * k)) * cos(p.y * k + sin(0.7 * p.x * k)) / k;\n"
        "    c = vec4(vec3(0.5 + 0.5 * sin(s)), 1);\n}\n");
    const Json report =
        report_of(glint({"check", "s.frag", "--size", "48x32", "--json", "--seconds", "6"}), 6);
    std::map<std::string, std::pair<std::string, std::string>> told;
    for (const Json& one : report["cases"]) told[one["case"]] = {one["verdict"], one["note"]};
    EXPECT_EQ(told["loop budget"].first, "fail");
    EXPECT_TRUE(told["loop budget"].second.ends_with("; at lacunarity=1")) << report;
    EXPECT_NE(told["flashes"].first, "fail");
    // What is allowed, and the frame that was drawn then: a second or two. All of them take
    // minutes.
    EXPECT_LT(report["files"][0]["seconds"], 60.0);
}

TEST_F(CheckEnds, WhatIsWrongAtAnEndWhateverTheAgeNamesIt) {
    const std::string found = note_of(
        "uniform float density; //@ 0.3 [0, 2]\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    float d = 1.0 + p.x, air = (1.0 - exp(-density * d)) / density;\n"
        "    c = vec4(vec3(air * (0.8 + 0.1 * sin(6.2831853 * fract(float(iTick & 0xFFFFFu) / "
        "131072.0)))), 1);\n}\n",
        "age 1 year", 6);
    EXPECT_NE(found.find("at the ends of ranges; at density=0"), std::string::npos) << found;
}

}  // namespace
}  // namespace glint::cli::check_ends_test
