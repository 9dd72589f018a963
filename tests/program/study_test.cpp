// `glint study` on scenes whose error is known, and on planted faults.
#include "report.h"

#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <sstream>
#include <thread>
#include <utility>

namespace glint::cli::study_test {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;

class Study : public InAFolder {
protected:
    Json study(const std::string& name, std::vector<std::string> more = {}) const {
        std::vector<std::string> arguments = {
            "study", known_scene(name).string(), "--size", "64x36", "--json", "--seconds", "0"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = glint(std::move(arguments));
        EXPECT_EQ(outcome.err, "");
        return report_of(outcome);
    }

    static std::string findings(const Json& study) { return study["findings"].dump(); }
};

TEST_F(Study, WhereThereIsNothingToStudyItSaysWhatToDo) {
    write("s.frag", "uniform float glow; //@ 1 [0, 2]\nuniform bool wide; //@ on\n" +
                        std::string("void mainImage(out vec4 c, in vec2 p) { c = vec4(glow); }\n"));
    const Outcome outcome = glint({"study", "s.frag", "--size", "8x8"});
    EXPECT_EQ(outcome.code, 0);
    EXPECT_NE(outcome.err.find("one of glow, wide: glint study s.frag --vary glow"),
              std::string::npos)
        << outcome.err;
    write("plain.frag", kGradient);
    EXPECT_NE(glint({"study", "plain.frag"}).err.find("has no tweaks"), std::string::npos);
}

// Values that double from 1 to 64. Near 1 the error is not of its order yet, and the curve that
// decodes sRGB bends it a little: so 0.2.
TEST_F(Study, TheMidpointRuleIsOfOrderTwo) {
    const Json json = study("quadrature");
    EXPECT_NEAR(json["order"].get<double>(), 2.0, 0.2);
    EXPECT_EQ(json["findings"], Json::array());
}

TEST_F(Study, TheLeftRuleIsOfOrderOne) {
    const Json json = study("quadrature", {"--tweak", "rule=left"});
    EXPECT_NEAR(json["order"].get<double>(), 1.0, 0.2);
}

TEST_F(Study, AMeanOfNoiseIsOfOrderOneHalf) {
    // Against a reference of 256 frames those of 16 and 64 are told apart badly: so 0.15.
    const Json json = study("accumulate");
    EXPECT_EQ(json["knob"], "settle");
    EXPECT_EQ(json["second_reference"], "256, another seed");
    EXPECT_NEAR(json["order"].get<double>(), 0.5, 0.15);
    EXPECT_GT(json["reference_error"]["rmse"].get<double>(), 0.0);
    EXPECT_TRUE(json["rows"].back()["near_reference"]);
}

// A ramp of 1/3 has no end in binary: each format cuts it at its own digits.
TEST_F(Study, AFormatCostsTheDigitsThatItLacks) {
    write("ramp.frag",
          "uniform sampler2D ramp; //@ pass mainRamp filter=nearest\n"
          "void mainRamp(out vec4 c, in vec2 p) { c = vec4(p.x / 333.0); }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(ramp, ivec2(p), 0); }\n");
    const Outcome outcome = glint({"study", "ramp.frag", "--size", "64x4", "--seconds", "0",
                                   "--json", "--vary", "ramp.format=rgba32f,rgba16f,rgba8,r32f"});
    EXPECT_EQ(outcome.err, "");
    const Json json = report_of(outcome);
    EXPECT_EQ(json["knob"], "ramp.format");
    EXPECT_EQ(json["reference"], "rgba32f");
    ASSERT_EQ(json["rows"].size(), 4u);
    std::vector<double> most;
    for (const Json& row : json["rows"]) most.push_back(row["max"].get<double>());
    EXPECT_EQ(most[0], 0.0);
    EXPECT_TRUE(json["rows"][0]["is_reference"] && json["rows"][0]["is_preset"]);
    EXPECT_GT(most[1], 0.0);
    EXPECT_LT(most[1], most[2]);
    EXPECT_GT(most[3], 0.01) << "green and blue are gone, 0.03 of them in linear light";
}

TEST_F(Study, HasTheDocumentedKeys) {
    const Json json = study("quadrature");
    EXPECT_EQ(json["knob"], "steps");
    EXPECT_EQ(json["reference"], "4096");
    EXPECT_EQ(json["second_reference"], "8192");
    EXPECT_EQ(json["size"], Json({64, 36}));
    EXPECT_FALSE(json["renderer"].get<std::string>().empty());
    EXPECT_FALSE(json["machine"].get<std::string>().empty());
    EXPECT_FALSE(json["clock"].get<std::string>().empty());
    ASSERT_EQ(json["rows"].size(), 7u);
    double before = 1.0, flip_before = 1.0;
    bool any_pareto = false;
    for (const Json& row : json["rows"]) {
        EXPECT_GT(row["ms_min"].get<double>(), 0.0);
        EXPECT_LE(row["ms_min"], row["ms"]);
        EXPECT_LE(row["ms"], row["ms_max"]);
        EXPECT_LT(row["rmse"].get<double>(), before);
        EXPECT_LE(row["rmse"], row["max"]);
        EXPECT_GT(row["flip"].get<double>(), 0.0);
        EXPECT_LT(row["flip"].get<double>(), flip_before);
        flip_before = row["flip"];
        EXPECT_GE(row["relative_mse"].get<double>(), 0.0);
        EXPECT_TRUE(row.contains("psnr") && row.contains("share_off"));
        before = row["rmse"];
        any_pareto |= row["pareto"].get<bool>();
    }
    // The nearest row is on the frontier whatever the clock says.
    EXPECT_TRUE(json["rows"].back()["pareto"]);
    EXPECT_TRUE(any_pareto);
    EXPECT_EQ(json["studies"].size(), 1u);
}

TEST_F(Study, MethodsAreComparedInOneTable) {
    const Json json = study("quadrature", {"--vary", "rule=left,midpoint", "--tweak", "steps=16",
                                           "--reference", "rule=midpoint"});
    ASSERT_EQ(json["rows"].size(), 2u);
    EXPECT_EQ(json["rows"][0]["value"], "left");
    EXPECT_GT(json["rows"][0]["rmse"].get<double>(), 0.0);
    EXPECT_EQ(json["rows"][1]["is_reference"], true);
    EXPECT_EQ(json["rows"][1]["rmse"], 0.0);
    EXPECT_TRUE(json["order"].is_null());
    // What judges the reference has twice the steps, which the midpoint rule hardly needs.
    EXPECT_LT(json["reference_error"]["rmse"].get<double>(),
              json["rows"][0]["rmse"].get<double>() / 10.0);
}

TEST_F(Study, AMethodThatAccumulatesCountsAsTheTruthOnlyAfterItHas) {
    write("scene.frag",
          "uniform int method; //@ 0 {exact, wrong, noisy} quality reference=2\n"
          "uniform sampler2D sums; //@ pass mainSums\n"
          "void mainSums(out vec4 c, in vec2 p) {\n"
          "    uint h = uint(p.x) * 7919u + uint(p.y) * 104729u + uint(iFrame) * 15485863u;\n"
          "    h ^= h >> 16u; h *= 0x7feb352du; h ^= h >> 15u; h *= 0x846ca68bu; h ^= h >> 16u;\n"
          "    c = texelFetch(sums, ivec2(p), 0) + vec4(float(h >> 8u) / 16777216.0, 0, 0, 1);\n"
          "}\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = vec4(method == 0 ? 0.5 : 0.6);\n"
          "    if (method == 2) { vec4 s = texelFetch(sums, ivec2(p), 0); c = vec4(s.x / s.a); }\n"
          "}\n");
    const Json json = report_of(glint({"study", "scene.frag", "--size", "64x36", "--json"}));
    EXPECT_EQ(json["studies"].size(), 1u) << "what is drawn accumulates nothing: no settle";
    EXPECT_EQ(json["second_reference"], "noisy, twice the frames");
    EXPECT_NE(json["notes"].dump().find("accumulates 256 more frames"), std::string::npos);
    // The mean of 257 uniform numbers is off by 0.29 / sqrt(257) = 0.018 before the display curve
    // is undone, which changes little at a half.
    EXPECT_LT(json["rows"][0]["rmse"].get<double>(), 0.03);
    EXPECT_GT(json["rows"][1]["rmse"].get<double>(), 0.06);
    EXPECT_GT(json["rows"][2]["rmse"].get<double>(), 0.15) << "one frame of it";
}

// Twice the grain would change both pictures alike: it is no doubt of the reference.
TEST_F(Study, AMethodsReferenceIsJudgedByQualityThatIsItsAlone) {
    write("scene.frag",
          "uniform int shadows; //@ 0 {hard, soft} quality reference=1\n"
          "uniform int rays; //@ 16 [1, 64] quality\n"
          "uniform int grain; //@ 1 [1, 4] quality\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    float light = shadows == 1 ? 0.5 + 0.01 / float(rays) : 0.6;\n"
          "    c = vec4(vec3(light / float(grain)), 1);\n"
          "}\n");
    const Json json =
        report_of(glint({"study", "scene.frag", "--size", "8x8", "--vary", "shadows", "--json"}));
    EXPECT_EQ(json["second_reference"], "soft, its own quality doubled");
    EXPECT_LT(json["reference_error"]["rmse"].get<double>(), 0.001);
    EXPECT_FALSE(json["rows"][0]["near_reference"]);
}

TEST_F(Study, AFileThatCannotBeStudiedCostsTheOthersNoReport) {
    const Outcome outcome = glint({"study", "gone.frag", known_scene("quadrature").string(),
                                   "--size", "64x36", "-o", "report", "--vary", "steps=1,2"});
    EXPECT_EQ(outcome.code, 4) << outcome.err;
    EXPECT_NE(outcome.err.find("gone.frag: error:"), std::string::npos) << outcome.err;
    EXPECT_NE(bytes("report/index.html").find("quadrature.frag"), std::string::npos);
    const std::string report = bytes("report/study.json");
    EXPECT_EQ(Json::parse(report)["studies"].size(), 1u);
    EXPECT_EQ(glint({"study", "gone.frag", "-o", "report"}).code, 4);
    EXPECT_EQ(bytes("report/study.json"), report) << "there is no newer one";
}

TEST_F(Study, AFolderThatCannotBeMadeIsNamed) {
    write("file", "");
    const std::string scene = known_scene("quadrature").string();
    Outcome outcome = glint({"study", scene, "-o", "file"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err, "error: -o file: this is a file; name a folder.\n");
    outcome = glint({"study", scene, "-o", "file/below"});
    EXPECT_EQ(outcome.code, 1);
    EXPECT_EQ(outcome.err, "error: Cannot write file/below/data: Not a directory.\n");
}

TEST_F(Study, ABadMethodIsFound) {
    const Json json = study("planted_bad_method");
    EXPECT_LT(json["order"].get<double>(), -0.5);
    EXPECT_NE(findings(json).find("grows with the work"), std::string::npos) << findings(json);
    EXPECT_EQ(json["converges"], false);
}

TEST_F(Study, AWrongReferenceIsFound) {
    const Json json = study("planted_wrong_reference");
    EXPECT_NE(findings(json).find("the reference is wrong"), std::string::npos) << findings(json);
}

// Of a step so small that the difference is rounding, though its own error is as large as that
// says.
TEST_F(Study, AReferenceOfRoundingIsWrong) {
    write("s.frag",
          "uniform float e; //@ 0.01 [1e-4, 0.3] log quality reference=1e-7\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    vec2 x = 3.0 * p / iResolution.xy + 1.0;\n"
          "    c = vec4(0.5 + 0.2 * (sin(x.x + e) - sin(x.x - e)) * cos(x.y) / e);\n}\n");
    const Json json =
        report_of(glint({"study", "s.frag", "--size", "64x36", "--json", "--seconds", "0"}));
    EXPECT_NE(findings(json).find("the reference is wrong"), std::string::npos) << findings(json);
}

TEST_F(Study, WorkThatTheTextDoesNotUseHasNoStar) {
    write("s.frag",
          "uniform int n; //@ 16 [1, 256] log quality reference=1024\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    float s = 0.0, h = 1.0 / float(min(n, 16));\n"
          "    for (int i = 0; i < min(n, 16); i++) s += h * sqrt(float(i) * h);\n"
          "    c = vec4(s);\n}\n");
    const Json json = report_of(glint({"study", "s.frag", "--size", "16x9", "--json", "--seconds",
                                       "0", "--vary", "n=8,16,64,256"}));
    EXPECT_NE(json["notes"].dump().find("3 rows draw the reference's very picture"),
              std::string::npos)
        << json["notes"];
    int stars = 0;
    for (const Json& row : json["rows"])
        stars += row["pareto"] == true && row["value"] != "8" ? 1 : 0;
    EXPECT_EQ(stars, 1);
}

// By each rule: what its order is, within what the first values and the display's curve bend.
constexpr struct {
    const char* rule;
    double order, within, bias;
} kRules[] = {
    {"left", 1.0, 0.2, 0.02},
    {"midpoint", 2.0, 0.2, 0.02},
    {"simpson", 4.0, 0.5, 0.02},
    {"samples", 0.5, 0.1, 0.1},
};

TEST_F(Study, PlantedIntegratorsHaveTheirOrders) {
    for (const auto& [rule, order, within, bias] : kRules) {
        const Json json = study("planted_integrators", {"--tweak", std::string("rule=") + rule});
        EXPECT_NEAR(json["order"].get<double>(), order, within) << rule;
        EXPECT_EQ(json["findings"], Json::array()) << rule;
        EXPECT_EQ(json["converges"], true) << rule;
    }
}

TEST_F(Study, AReferenceThatIsBiasedIsFoundWhateverTheOrder) {
    for (const auto& [rule, order, within, bias] : kRules) {
        const Json json = study("planted_integrators", {"--tweak", std::string("rule=") + rule,
                                                        "--tweak", "bias=" + std::to_string(bias)});
        EXPECT_NE(findings(json).find("the reference is wrong"), std::string::npos)
            << rule << findings(json);
    }
}

TEST_F(Study, WhatGoesNowhereDoesNotConvergeAndHasNoStar) {
    const std::vector<std::string> restless = {"--tweak", "rule=restless"};
    const Json json = study("planted_integrators", restless);
    EXPECT_EQ(json["converges"], false);
    EXPECT_NE(findings(json).find("it does not converge"), std::string::npos) << findings(json);
    for (const Json& row : json["rows"]) EXPECT_FALSE(row["pareto"]);
    const Outcome table = glint({"study", known_scene("planted_integrators").string(), "--size",
                                 "32x18", "--seconds", "0", "--tweak", "rule=restless"});
    EXPECT_NE(table.out.find("\n  !"), std::string::npos) << table.out;
    EXPECT_EQ(table.out.find("\n*"), std::string::npos) << table.out;
}

// The error of 64 samples: as the 128 tell that contain them, and as it is.
TEST_F(Study, AReferenceThatSharesItsSamplesIsJudgedAsIfItDidNot) {
    const Json told = study("planted_integrators", {"--tweak", "rule=samples", "--vary",
                                                    "steps=1,...,32", "--reference", "steps=64"});
    EXPECT_EQ(told["second_reference"], "128");
    const Json truth =
        study("planted_integrators", {"--vary", "rule=samples", "--tweak", "steps=64",
                                      "--reference", "rule=simpson", "--second", "steps=32"});
    const double is = truth["rows"][0]["rmse"];
    // Of 2304 pixels: a deviation is known to a few hundredths. Not corrected, it would be 0.71.
    EXPECT_NEAR(told["own_error"].get<double>() / is, 1.0, 0.1);
}

// u' = cos(t) - u by Euler's method, which knows no chance; by Kutta's, which soon is as near as
// floats are; and a number that goes nowhere. The seed is another method's.
TEST_F(Study, ASeedThatAMethodDoesNotReadSaysNothingOfItsError) {
    write(
        "s.frag",
        "uniform int method; //@ 0 {euler, kutta, restless, noise}\n"
        "uniform int n; //@ 8 [2, 256] log quality reference=1024\n"
        "uniform int seed; //@ 0 [0, 9]\n"
        "float random(vec2 p, int i) { return fract(sin(dot(p, vec2(12.9, 78.2)) + float(i)) * "
        "43758.5); }\n"
        "void mainImage(out vec4 c, in vec2 p) {\n"
        "    float u = 0.3 + 0.1 * p.x / iResolution.x, h = 2.0 / float(n), sum = 0.0;\n"
        "    for (int i = 0; i < n; ++i) {\n"
        "        float t = float(i) * h, a = cos(t) - u, b = cos(t + h / 2.0) - u - h / 2.0 * a;\n"
        "        float d = cos(t + h / 2.0) - u - h / 2.0 * b, e = cos(t + h) - u - h * d;\n"
        "        u += method == 0 ? h * a : h / 6.0 * (a + 2.0 * b + 2.0 * d + e);\n"
        "    }\n"
        "    if (method == 2) u = random(p, n);\n"
        "    if (method == 3) u += random(p, n + seed) / float(n);\n"
        "    c = vec4(vec3(u), 1);\n"
        "}\n");
    const auto of = [&](const std::string& method) {
        return report_of(glint({"study", "s.frag", "--size", "32x18", "--json", "--seconds", "0",
                                "--tweak", "method=" + method}));
    };
    const Json euler = of("euler"), restless = of("restless");
    EXPECT_EQ(euler["second_reference"], "2048");
    // By its order the 256 steps are four times as far off as the truth's 1024, and a third of that
    // is what they differ by.
    EXPECT_NEAR(euler["own_error"].get<double>() / euler["rows"].back()["rmse"].get<double>(),
                1.0 / 3, 0.05);
    EXPECT_EQ(restless["converges"], false) << findings(restless);
    EXPECT_EQ(of("kutta")["findings"], Json::array()) << "which floats round, and nobody sees";
    EXPECT_EQ(of("noise")["second_reference"], "1024, another seed");
}

TEST_F(Study, ASecondReferenceMayTurnAnotherTweak) {
    const Json json =
        study("planted_integrators", {"--vary", "steps=1,...,64", "--second", "rule=left"});
    EXPECT_EQ(json["second_reference"], "1024 with rule=left");
    // The left rule is off by half a step times the integrand's fall, and the display's curve.
    EXPECT_GT(json["own_error"].get<double>(), 1e-5);
    bool any = false;
    for (const Json& row : json["rows"]) {
        any |= row["pareto"].get<bool>();
        if (row["rmse"] < json["own_error"]) {
            EXPECT_FALSE(row["pareto"]) << row;
        }
    }
    EXPECT_TRUE(any);
}

TEST_F(Study, ADivergedPointIsListed) {
    const Json json = study("planted_diverged");
    ASSERT_EQ(json["rows"].size(), 5u);
    const Json& diverged = json["rows"][0];
    EXPECT_EQ(diverged["value"], "0");
    EXPECT_EQ(diverged["failed"], "diverged: 2304 pixels are not finite");
    EXPECT_TRUE(diverged["rmse"].is_null());
    EXPECT_FALSE(diverged["pareto"]);
    EXPECT_NE(findings(json).find("0: diverged"), std::string::npos);
    const Outcome table =
        glint({"study", known_scene("planted_diverged").string(), "--size", "64x36"});
    EXPECT_NE(table.out.find("diverged: 2304 pixels"), std::string::npos) << table.out;
}

TEST_F(Study, CostOverSizeNeedsNoReference) {
    // Large enough that the steps, not the frame, are what is timed.
    const Json json = study("quadrature", {"--metric", "time", "--vary", "steps=8,\u2026,64"});
    ASSERT_EQ(json["rows"].size(), 4u);
    EXPECT_EQ(json["rows"][1]["value"], "16");
    EXPECT_EQ(json["metric"], "time");
    EXPECT_TRUE(json["rows"][0]["rmse"].is_null());
    EXPECT_FALSE(json["cost_exponent"].is_null());
}

TEST_F(Study, ABufferIsComparedAsItIs) {
    write("scene.frag",
          "uniform int n; //@ 1 [1, 4] quality reference=8\n"
          "uniform sampler2D light; //@ pass mainLight size=4x4\n"
          "void mainLight(out vec4 c, in vec2 p) { c = vec4(100.0 + 1.0 / float(n)); }\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(light, ivec2(0), 0); }\n");
    const Json json =
        report_of(glint({"study", "scene.frag", "--pass", "light", "--vary", "n=1,2", "--json"}));
    EXPECT_EQ(json["size"], Json({4, 4}));
    EXPECT_NEAR(json["rows"][0]["rmse"].get<double>(), 1.0 - 1.0 / 8.0, 1e-4);
    EXPECT_NEAR(json["rows"][1]["rmse"].get<double>(), 0.5 - 1.0 / 8.0, 1e-4);
}

// 240 steps of a sum, that is its rate over four; and a number which the sum knows nothing of, so
// that its pictures go on from where the others have come.
TEST_F(Study, WhatDoesNotActOnASimulationFindsItAsItIs) {
    write("s.frag",
          "uniform float rate; //@ 1 [0, 4] quality reference=4\n"
          "uniform int shades; //@ 4 [1, 64] quality reference=64\n"
          "uniform sampler2D total; //@ pass mainTotal size=1x1 step=1/240\n"
          "uniform sampler2D seen;  //@ pass mainSeen size=8x8\n"
          "void mainTotal(out vec4 c, in vec2 p) {\n"
          "    c = texelFetch(total, ivec2(0), 0) + vec4(rate / 960.0);\n"
          "}\n"
          "void mainSeen(out vec4 c, in vec2 p) {\n"
          "    c = texelFetch(total, ivec2(0), 0) + vec4(1.0 / float(shades));\n"
          "}\n"
          "void mainImage(out vec4 c, in vec2 p) { c = texelFetch(seen, ivec2(0), 0); }\n");
    write("s.toml", "scene = \"s.frag\"\ntime = 1.0\n");
    const Json json = report_of(
        glint({"study", "s.toml", "--size", "8x8", "--json", "--pass", "seen", "--seconds", "0",
               "--vary", "rate=1,2", "--vary", "shades=1,2", "--vary", "rate=0,1"}));
    const auto rmse = [&](int study, int row) {
        return json["studies"][study]["rows"][row]["rmse"].get<double>();
    };
    EXPECT_NEAR(rmse(0, 0), 0.75, 1e-4);
    EXPECT_NEAR(rmse(0, 1), 0.5, 1e-4);
    EXPECT_NEAR(rmse(1, 0), 1.0 - 1.0 / 64, 1e-6);
    EXPECT_NEAR(rmse(1, 1), 0.5 - 1.0 / 64, 1e-6);
    EXPECT_NEAR(rmse(2, 0), 1.0, 1e-4);
    EXPECT_NEAR(rmse(2, 1), 0.75, 1e-4);
}

TEST_F(Study, LinesTellOfEachPictureAsItIsDrawn) {
    const Outcome outcome = glint({"study", known_scene("quadrature").string(), "--size", "64x36",
                                   "--frames", "15", "--lines"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    std::istringstream lines(outcome.out);
    std::string line;
    std::size_t done = 0, rows = 0;
    while (std::getline(lines, line)) {
        const Json json = Json::parse(line, nullptr, false);
        ASSERT_TRUE(json.is_object()) << line;
        const std::size_t before = std::exchange(done, json["done"].get<std::size_t>());
        EXPECT_TRUE(done == before + 1 || (before == 9 && done == 9)) << line;
        EXPECT_EQ(json["of"], 10) << "seven rows, two references, and the rows' times";
        EXPECT_EQ(json["study"]["knob"], "steps");
        EXPECT_GE(json["study"]["rows"].size(), rows);
        rows = json["study"]["rows"].size();
    }
    EXPECT_EQ(done, 10u);
    EXPECT_EQ(rows, 7u);
    EXPECT_EQ(glint({"study", known_scene("quadrature").string(), "--lines", "--json"}).code, 2);
}

TEST_F(Study, AKnobThatIsOnlyNamedHasItsOwnValuesAndThePresets) {
    write(
        "scene.frag",
        "uniform int n; //@ 1 [1, 32] quality reference=4096\n"
        "uniform int m; //@ 1 [1, 4] quality\n"
        "void mainImage(out vec4 c, in vec2 p) { c = vec4(vec3(0.2 + 0.5 / float(n * m)), 1); }\n");
    // 31 and 32 are more alike than the reference is far: no reason to doubt the reference.
    write("look.toml", "scene = \"scene.frag\"\n[tweaks]\nn = 31\n");
    const Json json =
        report_of(glint({"study", "look.toml", "--size", "8x8", "--vary", "n", "--json"}));
    ASSERT_EQ(json["studies"].size(), 1u);
    std::string values;
    for (const Json& row : json["rows"]) {
        values += row["value"].get<std::string>() + " ";
        EXPECT_EQ(row["is_preset"], row["value"] == "31");
    }
    EXPECT_EQ(values, "1 2 4 8 16 31 32 ");
    EXPECT_EQ(json["findings"], Json::array());
}

TEST_F(Study, SeveralScenesAreOneReportThatOpensOffline) {
    const Outcome outcome = glint({"study", known_scene("quadrature").string(),
                                   known_scene("planted_diverged").string(), "--each", "--size",
                                   "64x36", "-o", "report"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::string page = bytes("report/index.html");
    EXPECT_NE(page.find("quadrature.frag"), std::string::npos);
    EXPECT_NE(page.find("href=\"#s1\""), std::string::npos) << "an index";
    EXPECT_NE(page.find("diverged"), std::string::npos);
    // Nothing comes from elsewhere; the namespaces of the diagrams are names, no addresses.
    for (const char* tag : {"src=\"http", "href=\"http", "url(http", "<script", "@import"}) {
        EXPECT_EQ(page.find(tag), std::string::npos) << tag;
    }
    // Every picture that it shows is there.
    std::size_t shown = 0;
    for (std::size_t at = page.find("src=\""); at != std::string::npos;
         at = page.find("src=\"", at + 1)) {
        const std::size_t end = page.find('"', at + 5);
        EXPECT_TRUE(fs::exists(folder() / "report" / page.substr(at + 5, end - at - 5)));
        ++shown;
    }
    EXPECT_EQ(shown, 22u + 13u) << "a reference, and pictures and two maps of 7 and of 4 others";
    const std::string csv = bytes("report/study.csv");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 7 + 5);
    EXPECT_EQ(Json::parse(bytes("report/study.json"))["studies"].size(), 2u);
    if (std::system("gnuplot --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no gnuplot";
    EXPECT_NE(page.find("<svg"), std::string::npos);
}

TEST_F(Study, AfterAKillItGoesOnFromWhatIsDone) {
    const std::vector<std::string> arguments = {"study",  known_scene("quadrature").string(),
                                                "--size", "256x256",
                                                "-o",     "report",
                                                "--json", "--frames",
                                                "60"};
    const auto rows_done = [&] {
        std::map<std::string, fs::file_time_type> rows;
        std::error_code none;
        for (const auto& entry : fs::directory_iterator(folder() / "report/data", none)) {
            if (entry.path().extension() == ".json") {
                rows[entry.path().filename()] = entry.last_write_time();
            }
        }
        return rows;
    };
    Process process(command(arguments));
    while (process.runs() && rows_done().size() < 2) std::this_thread::sleep_for(1ms);
    process.signal(SIGKILL);
    EXPECT_EQ(process.wait().signal, SIGKILL);
    const auto done = rows_done();
    ASSERT_GE(done.size(), 2u);
    ASSERT_LT(done.size(), 7u) << "it was faster than the test";

    const Json json = report_of(glint(arguments));
    ASSERT_EQ(json["rows"].size(), 7u);
    for (std::size_t i = 0; i < 7; ++i) {
        EXPECT_EQ(json["rows"][i]["resumed"], i < done.size()) << i;
    }
    const auto all = rows_done();
    EXPECT_EQ(all.size(), 8u) << "and the times of all";
    for (const auto& [name, time] : done) EXPECT_EQ(all.at(name), time) << name;
    EXPECT_NEAR(json["order"].get<double>(), 2.0, 0.2);

    // Other pictures are not taken for these.
    std::vector<std::string> other = arguments;
    other.insert(other.end(), {"--tweak", "rule=left"});
    const Json left = Json::parse(glint(other).out);
    for (const Json& row : left["rows"]) EXPECT_EQ(row["resumed"], false);
}

TEST_F(Study, WhatIsDamagedIsMadeAnewAndTheRestStays) {
    write("s.frag",
          "uniform float a; //@ 0.5 [0, 1]\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(a * p.x / iResolution.x); }\n");
    const std::vector<std::string> arguments = {"study",       "s.frag",    "--size", "16x9",
                                                "--vary",      "a=0.2,0.4", "-o",     "report",
                                                "--reference", "a=1",       "--json"};
    const Outcome first = glint(arguments);
    ASSERT_EQ(first.code, 0) << first.err;
    const Json rows = Json::parse(first.out)["rows"];
    std::vector<fs::path> files;
    for (const char* kind : {"data", "pictures"})
        for (const auto& entry : fs::directory_iterator(folder() / "report" / kind))
            files.push_back(entry.path());
    ASSERT_GE(files.size(), 10u);  // two of each reference, five of each row

    const std::function<void(const fs::path&)> damages[] = {
        [](const fs::path& file) { fs::resize_file(file, 0); },
        [](const fs::path& file) { fs::resize_file(file, fs::file_size(file) * 2 / 3); },
        [](const fs::path& file) {
            fs::remove(file);
            ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
        },
        [this](const fs::path& file) {  // whole, and something else
            fs::copy_file(folder() / "s.frag", file, fs::copy_options::overwrite_existing);
        },
    };
    for (const auto& damage : damages) {
        for (const fs::path& file : files) damage(file);
        const Outcome again = glint(arguments);
        EXPECT_EQ(again.code, 0) << again.err;
        EXPECT_NE(again.err.find("it is damaged, and is made anew"), std::string::npos);
        const Json anew = Json::parse(again.out, nullptr, false)["rows"];
        ASSERT_EQ(anew.size(), rows.size()) << again.out;
        for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(anew[i]["rmse"], rows[i]["rmse"]);
    }
    // One alone costs no other.
    for (const fs::path& file : files) fs::last_write_time(file, fs::file_time_type());
    const auto exr = std::ranges::find_if(
        files, [](const fs::path& file) { return file.extension() == ".exr"; });
    fs::resize_file(*exr, 100);
    EXPECT_EQ(glint(arguments).code, 0);
    EXPECT_LE(std::ranges::count_if(files,
                                    [](const fs::path& file) {
                                        return fs::last_write_time(file) != fs::file_time_type();
                                    }),
              5);
    EXPECT_EQ(glint(arguments).err, "");
}

TEST_F(Study, MistakesHaveTheSameCodesAsAStill) {
    write("wrong.frag", "void mainImage(out vec4 c, in vec2 p) { c = wrong; }\n");
    const std::string quadrature = known_scene("quadrature").string();
    EXPECT_EQ(glint({"study", "wrong.frag"}).code, 3);
    EXPECT_EQ(glint({"study", "gone.frag"}).code, 4);
    EXPECT_EQ(glint({"study", quadrature, "--vary", "none=1,2"}).code, 2);
    EXPECT_EQ(glint({"study", quadrature, "--vary", "none"}).code, 2);
    EXPECT_EQ(glint({"study", quadrature, "--vary", "settle"}).code, 2);
    EXPECT_EQ(glint({"study", quadrature, "--vary", "steps=1,many"}).code, 2);
    EXPECT_EQ(glint({"study", quadrature, "--vary", "steps=1,65"}).code, 2);
    EXPECT_EQ(glint({"study", quadrature, "--vary", "settle=1,2"}).code, 2);
    EXPECT_EQ(glint({"study", quadrature, "--frames", "3"}).code, 2);
    EXPECT_EQ(glint({"study", quadrature, "--device", "none such"}).code, 5);
}

}  // namespace
}  // namespace glint::cli::study_test
