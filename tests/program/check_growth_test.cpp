// What `glint check` says of states that grow, and of those that only come to rest.
#include "report.h"

#include <fmt/format.h>

namespace glint::cli::check_growth_test {
namespace {

using Json = nlohmann::json;

class CheckGrowth : public InAFolder {
protected:
    // Of a simulation in steps: `text` makes the next `x` of the last.
    void simulate(const std::string& text, const std::string& declared = "",
                  const std::string& step = "1/60") const {
        write("s.frag", declared + "uniform sampler2D s; //@ pass mainS size=8x8 step=" + step +
                            "\n"
                            "void mainS(out vec4 c, in vec2 p) {\n"
                            "    vec4 x = texelFetch(s, ivec2(p), 0);\n"
                            "    float h = iTimeDelta;\n    " +
                            text +
                            "\n    c = x;\n}\n"
                            "void mainImage(out vec4 c, in vec2 p) {\n"
                            "    c = vec4(vec3(0.4 + 0.01 * texelFetch(s, ivec2(0), 0).x), 1);\n"
                            "}\n");
    }
    std::string verdict(const std::string& name, int code) {
        const Json report = report_of(glint({"check", "s.frag", "--json", "--case", name}), code);
        for (const Json& one : report["cases"])
            if (one["case"] == name)
                return one["verdict"].get<std::string>() + ": " + one["note"].get<std::string>();
        return "none";
    }
};

// A spring that swings and an average lose little by one rounding; each frame's adds up in the
// spring alone, and chaos makes as much of one as of all.
TEST_F(CheckGrowth, WhatSumsLoseIn16BitsIsFound) {
    const auto said = [&](const std::string& text) {
        simulate(text, "", "1/240 format=rgba16f");
        return verdict("buffers of rgba32f", text.find("h * x.y") != text.npos ? 6 : 0);
    };
    const std::string spring = said(
        "if (iFrame == 0) x = vec4(50, 0, 0, 1);\n"
        "x.y += h * (-9.0 * x.x - 0.5 * x.y);\nx.x += h * x.y;");
    EXPECT_NE(spring.find("s rounds in each frame what it adds to; ask for format=rgba32f"),
              std::string::npos)
        << spring;
    EXPECT_TRUE(said("x = mix(x, vec4(sin(iTime)), 0.05);").starts_with("pass"));
    EXPECT_TRUE(said("if (iFrame == 0) x = vec4(0.3 + 0.02 * p.x);\n"
                     "x = 3.9 * x * (1.0 - x);")
                    .starts_with("pass"));
}

// (1 - 4/60)^32 beside (1 - 4/120)^64.
TEST_F(CheckGrowth, WhatAStepCostsInAccuracyIsTold) {
    simulate("if (iFrame == 0) x = vec4(1);\n    x -= 4.0 * h * x;");
    EXPECT_NE(verdict("step 1/60 s", 0)
                  .find("order 1.01: after 0.53 s half the step changes 3.7 % of the state"),
              std::string::npos);
}

// Explicit Euler, by (1 + (h w)^2)^(1/2) a step; five to sixteen swings in the run, all in phase.
TEST_F(CheckGrowth, OfFewSwingsIsFound) {
    for (const double w : {1.0, 2.0, 3.0}) {
        simulate(
            fmt::format("if (iFrame == 0) x = vec4(1, 0, 0, 1);\n"
                        "x.xy += h * vec2(x.y, {:.1f} * x.x);",
                        -w * w));
        EXPECT_TRUE(verdict("long run", 6).starts_with("fail: s.x grows steadily")) << w;
        simulate(
            fmt::format("if (iFrame == 0) x = vec4(1, 0, 0, 1);\n"
                        "x.y -= h * {:.1f} * x.x; x.x += h * x.y;",
                        w * w));
        EXPECT_TRUE(verdict("long run", 0).starts_with("pass")) << w;
    }
}

// Predator and prey by explicit Euler: swings become larger, faster and faster, and longer.
TEST_F(CheckGrowth, ThatSpeedsUpIsFound) {
    const std::string start = "if (iFrame == 0) x = vec4(1, 0.5, 0, 0);\n";
    simulate(start + "x.xy += 2.0 * h * vec2(x.x * (1.0 - x.y), x.y * (x.x - 1.0));");
    EXPECT_TRUE(verdict("long run", 6).starts_with("fail: s.x grows steadily"));
    simulate(start + "x.x *= exp(2.0 * h * (1.0 - x.y)); x.y *= exp(2.0 * h * (x.x - 1.0));");
    EXPECT_TRUE(verdict("long run", 0).starts_with("pass"));
}

TEST_F(CheckGrowth, InOnePlaceIsFound) {
    simulate(
        "if (iFrame == 0) x = vec4(p.x < 1.0 && p.y < 1.0 ? 0.01 : 1.0, 0, 0, 1);\n"
        "if (p.x < 1.0 && p.y < 1.0) x.y = 2.0 + (x.y - 2.0) * 1.0005 + (iFrame == 0 ? 2.1 : "
        "0.0);");
    EXPECT_TRUE(verdict("long run", 6).starts_with("fail: ")) << "a texel of 64";
}

// The exact flow of y' = y (1 - y / k): no step is too long for it.
TEST_F(CheckGrowth, ThatComesToRestIsNone) {
    simulate(
        "if (iFrame == 0) x = vec4(0.1);\n"
        "x = vec4(k / (1.0 + (k / x.x - 1.0) * exp(-h)));",
        "uniform float k; //@ 1 [0.5, 50]\n");
    EXPECT_TRUE(verdict("k=50 for long", 0).starts_with("pass"));
}

// From 120 on each step goes farther back than it came, and a limit holds both ends.
TEST_F(CheckGrowth, ThatALimitHoldsIsFoundWithSmallerSteps) {
    const char* tweak = "uniform float k; //@ 20 [1, 200]\n";
    simulate(
        "if (iFrame == 0) x = vec4(0.9);\n"
        "x = clamp(x - h * k * (x - 0.4), 0.0, 1.0);",
        "uniform float k; //@ 20 [1, 400]\n");
    EXPECT_NE(verdict("k=400 for long", 6).find("though a limit hides it"), std::string::npos)
        << "half of such a step is still too long";
    EXPECT_NE(verdict("step 1/60 s", 0).find("unstable by the step in use"), std::string::npos);
    simulate(
        "if (iFrame == 0) x = vec4(0.9);\n"
        "x = clamp(x - h * k * (x - 0.4), 0.0, 1.0);",
        tweak);
    EXPECT_NE(verdict("k=200 for long", 6).find("though a limit hides it"), std::string::npos);
    simulate(
        "if (iFrame == 0) x = vec4(0.9);\n"
        "x = clamp(0.4 + (x - 0.4) * exp(-h * k), 0.0, 1.0);",
        tweak);
    EXPECT_TRUE(verdict("k=200 for long", 0).starts_with("pass"));
    simulate("x = vec4(1.0 - x.x, k, 0, 1);", tweak);
    EXPECT_TRUE(verdict("k=200 for long", 0).starts_with("pass")) << "turns are what it is for";
}

TEST_F(CheckGrowth, ThatALimitHoldsIsFoundInStepsLongerThanAFrameAndRoundWhatMoves) {
    const char* tweak = "uniform float k; //@ 5 [1, 150]\n";
    const std::string start = "if (iFrame == 0) x = vec4(0.1);\n";
    for (const char* step : {"1/30", "1/20"}) {
        simulate(start + "x = clamp(x - h * k * (x - 0.5), 0.0, 1.0);", tweak, step);
        EXPECT_NE(verdict("k=150 for long", 6).find("though a limit hides it"), std::string::npos)
            << step;
        simulate(start + "x = clamp(0.5 + (x - 0.5) * exp(-h * k), 0.0, 1.0);", tweak, step);
        EXPECT_TRUE(verdict("k=150 for long", 0).starts_with("pass")) << step;
    }
    const std::string target = "float m = 0.5 + 0.3 * sin(iTime);\n";
    simulate(start + target + "x = clamp(x - h * k * (x - m), 0.0, 1.0);", tweak);
    EXPECT_NE(verdict("k=150 for long", 6).find("though a limit hides it"), std::string::npos);
    simulate(start + target + "x = clamp(m + (x - m) * exp(-h * k), 0.0, 1.0);", tweak);
    EXPECT_TRUE(verdict("k=150 for long", 0).starts_with("pass"));
}

// Explicit diffusion is stable up to a quarter, waves up to a half (von Neumann's condition);
// beyond, neighbours overshoot each other. Cells, clocks and filters that do so by their rules are
// no scheme.
TEST_F(CheckGrowth, ThatALimitHoldsIsFoundThoughTheTextKnowsNoLengths) {
    const auto said = [&](const std::string& rule, int code) {
        write("s.frag",
              "uniform float tint; //@ 0.5 [0, 1]\n"
              "uniform sampler2D s; //@ pass mainS size=32x32 filter=nearest\n"
              "float at(ivec2 i) { return texelFetch(s, i & 31, 0).x; }\n"
              "void mainS(out vec4 c, in vec2 p) {\n"
              "    ivec2 i = ivec2(p);\n    vec4 u = texelFetch(s, i, 0);\n"
              "    float n = at(i + ivec2(1, 0)) + at(i - ivec2(1, 0))\n"
              "            + at(i + ivec2(0, 1)) + at(i - ivec2(0, 1));\n"
              "    float all = n + at(i + 1) + at(i - 1) + at(i + ivec2(1, -1))\n"
              "              + at(i + ivec2(-1, 1));\n"
              "    float chance = fract(float((i.x * 73 + i.y * 151) % 509) * 0.618);\n"
              "    if (iFrame == 0) { c = vec4(chance < 0.4, 0, 0, 1); return; }\n    " +
                  rule +
                  "\n    c = vec4(u.xy, 0, 1);\n}\n"
                  "void mainImage(out vec4 c, in vec2 p) {\n"
                  "    c = vec4(tint * texelFetch(s, ivec2(p) & 31, 0).xxx, 1);\n}\n");
        return verdict("long run", code);
    };
    for (const std::string rule :
         {"u.x = clamp(u.x + 0.3 * (n - 4.0 * u.x), 0.0, 1.0);",
          "u.y = clamp(u.y + 0.6 * (n - 4.0 * u.x), -1.0, 1.0); u.x = clamp(u.x + u.y, 0.0, 1.0);",
          "u.y += 0.6 * (n - 4.0 * u.x); u.xy = tanh(vec2(u.x + u.y, u.y));"})
        EXPECT_NE(said(rule, 6).find("though a limit hides it"), std::string::npos) << rule;
    for (const std::string rule :
         {"u.x = clamp(u.x + 0.24 * (n - 4.0 * u.x), 0.0, 1.0);",
          "u.y = clamp(u.y + 0.4 * (n - 4.0 * u.x), -1.0, 1.0); u.x = clamp(u.x + u.y, 0.0, 1.0);",
          "u.x = float(all == 3.0 || (all == 2.0 && u.x == 1.0));",
          "u.x = float((i.x + i.y + iFrame) & 1);", "u.x = 1.0 - u.x;",
          "u.x = clamp(1.0 - 0.25 * n, 0.0, 1.0);", "u.x = n > 2.5 ? 0.0 : n < 1.5 ? 1.0 : u.x;",
          "u.x = clamp(u.x + 0.6 * (u.x - all / 8.0), 0.0, 1.0);"})
        EXPECT_TRUE(said(rule, 0).starts_with("pass")) << rule << "\n" << said(rule, 0);
}

TEST_F(CheckGrowth, WhatIsMendedWithWhereItGoesIsHealed) {
    simulate(
        "if (!(x.x >= 0.0 && x.x <= 4.0)) x = vec4(0.6); if (iFrame == 0) x = vec4(0);\n"
        "x = vec4(0.6 + (x.x - 0.6) * exp(-0.5 * h));");
    EXPECT_TRUE(verdict("healed s", 0).starts_with("pass"));
    simulate(
        "if (!(x.x >= 0.0 && x.x <= 4.0)) x = vec4(3.0); if (iFrame == 0) x = vec4(0);\n"
        "if (x.x != 3.0) x = vec4(0.6 + (x.x - 0.6) * exp(-0.5 * h));");
    EXPECT_TRUE(verdict("healed s", 6).starts_with("fail")) << "3 is where it never goes";
}

// Without a preset a scene has the time 0, at which no step has been made.
TEST_F(CheckGrowth, OfASceneWithoutAPresetItsSimulationIsPlayed) {
    simulate("x = vec4(1.0 / (k - 5.0));", "uniform float k; //@ 1 [0, 5]\n");
    EXPECT_TRUE(verdict("tweak k=5", 6).starts_with("fail"));
}

}  // namespace
}  // namespace glint::cli::check_growth_test
