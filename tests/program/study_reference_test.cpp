// What `glint study` says of its reference, and of a second one.
#include "report.h"

#include <fmt/format.h>

#include <cmath>
#include <initializer_list>
#include <utility>

namespace glint::cli::study_reference_test {
namespace {

using Json = nlohmann::json;
using StudyReference = InAFolder;

std::string findings(const Json& study) {
    return study["findings"].dump();
}

TEST_F(StudyReference, TwoReferencesThatDifferByMoreThanBothClaimAreTold) {
    const auto scene = [](const char* other) {
        return std::string(
                   "uniform int method; //@ 0 {none, sum, other} quality reference=1 second=other\n"
                   "uniform int steps; //@ 16 [1, 64] log quality\n"
                   "void mainImage(out vec4 c, in vec2 p) {\n"
                   "    float x = p.x / iResolution.x, sum = 0.0;\n"
                   "    for (int i = 0; i < steps; ++i)\n"
                   "        sum += exp(-x * (float(i) + (method == 1 ? 0.5 : 0.0)) / "
                   "float(steps));\n"
                   "    c = vec4(vec3(method == 0 ? 0.5 : 0.5 * sum / float(steps)), 1);\n") +
               other + "}\n";
    };
    const std::vector<std::string> arguments = {"study", "s.frag", "--size", "32x18", "--seconds",
                                                "0",     "--json", "--vary", "method"};
    write("s.frag", scene(""));
    const Json agrees = report_of(glint(arguments));
    EXPECT_EQ(agrees["rival"]["value"], "other");
    EXPECT_EQ(agrees["rival"]["disagrees"], false) << agrees["rival"];
    EXPECT_GT(agrees["rival"]["own_error"].get<double>(), 1e-3) << "half a step";
    EXPECT_EQ(agrees["findings"], Json::array());
    write("s.frag", scene("    if (method == 2) c.rgb *= 0.9;\n"));
    const Json differs = report_of(glint(arguments));
    EXPECT_EQ(differs["rival"]["disagrees"], true);
    EXPECT_NE(findings(differs).find("more than both claim"), std::string::npos);
}

// The other's error is that of order 1/2, all of which it must claim.
TEST_F(StudyReference, AnotherWayClaimsWhatItsOwnOrderLeaves) {
    write("s.frag",
          "uniform int method; //@ 0 {sum, other} quality reference=0 second=other\n"
          "uniform int steps; //@ 16 [1, 64] log quality\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    float sum = 0.5 + 0.2 / float(steps * steps);\n"
          "    c = vec4(vec3(method == 0 ? sum : 0.5 + 0.2 / sqrt(float(steps))), 1);\n"
          "}\n");
    for (const std::vector<std::string>& how : std::initializer_list<std::vector<std::string>>{
             {"--vary", "method"}, {"--rmse", "0.01"}}) {
        std::vector<std::string> arguments = {"study",  "s.frag",    "--size", "16x8",
                                              "--json", "--seconds", "0.5"};
        arguments.insert(arguments.end(), how.begin(), how.end());
        const Json told = report_of(glint(arguments))["rival"];
        const double steps = how[0] == "--vary" ? 16.0 : 64.0;
        const double error = 0.2 / std::sqrt(steps);  // and in linear light a little less
        EXPECT_NEAR(told["own_error"], error, 0.15 * error) << how[0];
        EXPECT_EQ(told["disagrees"], false) << how[0] << told;
    }
}

// The seed is that of a film's grain, which the midpoint rule knows nothing of.
TEST_F(StudyReference, ASeedOfTheGrainSaysNothingOfTheSteps) {
    write("s.frag",
          "uniform int steps; //@ 8 [1, 64] log quality reference=256\n"
          "uniform float seed; //@ 0 [0, 100]\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    float b = 1.0 + p.x / iResolution.x, sum = 0.0;\n"
          "    for (int i = 0; i < steps; ++i) sum += exp(b * (float(i) + 0.5) / float(steps));\n"
          "    float grain = fract(p.x * 0.37 + p.y * 0.71 + seed * 0.23);\n"
          "    c = vec4(vec3(0.1 * sum / float(steps) + 0.1 * grain), 1);\n"
          "}\n");
    const Json told =
        report_of(glint({"study", "s.frag", "--size", "32x18", "--seconds", "0", "--json"}));
    EXPECT_EQ(told["second_reference"], "512");
    EXPECT_LT(told["own_error"].get<double>(), 1e-5);
    EXPECT_NEAR(told["order"].get<double>(), 2.0, 0.3);
    EXPECT_NE(told["notes"].dump().find("the seed moves something else than steps"),
              std::string::npos)
        << told["notes"];
}

// llvmpipe ends all loops of a pixel after 65,535 turns, which 256 by 256 are a little more than.
TEST_F(StudyReference, WhatTheDriverDidNotDrawToItsEndIsNoTruth) {
    const auto told = [&](const char* range, std::vector<std::string> more = {}) {
        write("s.frag", std::string("uniform int n; //@ 8 ") + range +
                            "\n"
                            "void mainImage(out vec4 c, in vec2 p) {\n"
                            "    float sum = 0.0, of = float(n * n);\n"
                            "    for (int i = 0; i < n; ++i)\n"
                            "        for (int j = 0; j < n; ++j)\n"
                            "            sum += sin(0.1 * p.x + float(i * j + i) / of) / of;\n"
                            "    c = vec4(vec3(0.5 + 0.4 * sum), 1);\n"
                            "}\n");
        std::vector<std::string> arguments = {"study",  "s.frag",    "--size", "16x8",
                                              "--json", "--seconds", "0"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return report_of(glint(arguments));
    };
    const Json far = told("[1, 64] quality reference=400");
    EXPECT_EQ(far["reference_cut"], "image");
    EXPECT_TRUE(far["own_error"].is_null()) << far;
    ASSERT_EQ(far["findings"].size(), 1u) << findings(far);
    EXPECT_NE(findings(far).find("the reference, 400, is cut short, for loops of image"),
              std::string::npos);
    for (const Json& row : far["rows"]) EXPECT_FALSE(row.contains("failed")) << row;

    const Json second = told("[1, 64] quality reference=160", {"--second", "n=400"});
    EXPECT_EQ(second["reference_cut"], "");
    EXPECT_TRUE(second["own_error"].is_null()) << second;
    EXPECT_NE(findings(second).find("the second reference, 400, is cut short, for loops of image"),
              std::string::npos);

    const Json row = told("[1, 400] quality", {"--vary", "n=8,64,300", "--reference", "n=128"});
    EXPECT_TRUE(row["rows"][2]["failed"].is_string()) << row;
    EXPECT_FALSE(row["rows"][1].contains("failed"));

    const Json sound = told("[1, 64] quality reference=100");
    EXPECT_EQ(sound["reference_cut"], "");
    EXPECT_EQ(sound["findings"], Json::array());
}

// Columns by turns take 60,000 turns in one of two loops; eight pixels together take both.
TEST_F(StudyReference, TurnsThatNeighboursTakeCountToo) {
    const auto cut_at = [&](const char* loops) {
        write("s.frag", std::string("uniform int n; //@ 8 [1, 64] quality reference=300\n"
                                    "void mainImage(out vec4 c, in vec2 p) {\n"
                                    "    float sum = 0.0;\n"
                                    "    bool odd = (int(p.x) & 1) == 1;\n"
                                    "    for (int i = 0; i < 200; ++i) {\n") +
                            loops +
                            "    }\n"
                            "    c = vec4(vec3(sum / 60000.0), 1);\n"
                            "}\n");
        return report_of(glint({"study", "s.frag", "--size", "16x8", "--json", "--seconds", "0",
                                "--second", "n=200"}))["reference_cut"];
    };
    EXPECT_EQ(cut_at("for (int j = 0; j < (odd ? n : 0); ++j) sum += 1.0;\n"
                     "for (int j = 0; j < (odd ? 0 : n); ++j) sum += 1.0;\n"),
              "image");
    EXPECT_EQ(cut_at("for (int j = 0; j < n; ++j) sum += 1.0;\n"), "");
}

TEST_F(StudyReference, ABudgetIsContentWithAPartOfReferencesThatAreCut) {
    write("s.frag",
          "uniform int n; //@ 8 [1, 64] log quality reference=400\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    float sum = 0.0;\n"
          "    for (int i = 0; i < n * n; ++i)\n"
          "        sum += sin(3.0 * (float(i) + p.x / 16.0) / float(n * n)) / float(n * n);\n"
          "    c = vec4(vec3(sum), 1);\n"
          "}\n");
    const Json json = report_of(
        glint({"study", "s.frag", "--size", "16x8", "--ms", "50", "--json", "--seconds", "0.5"}));
    EXPECT_EQ(json["reference"], "0.5 of each reference");
    EXPECT_EQ(json["reference_cut"], "");
    EXPECT_FALSE(json["best"].is_null()) << json["findings"];
    EXPECT_NE(json["notes"].dump().find("with all references it is cut short"), std::string::npos);
}

TEST_F(StudyReference, WhatTheDriverDidNotDrawToItsEndIsStillToldWhereAStudyGoesOn) {
    write("s.frag",
          "uniform int n; //@ 8 [1, 64] quality reference=400\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    float sum = 0.0;\n"
          "    for (int i = 0; i < n * n; ++i) sum += 1.0 / float(n * n);\n"
          "    c = vec4(vec3(0.5 * sum), 1);\n"
          "}\n");
    const std::vector<std::string> arguments = {"study", "s.frag", "--size",    "16x8", "-o",
                                                "out",   "--json", "--seconds", "0"};
    EXPECT_EQ(report_of(glint(arguments))["reference_cut"], "image");
    EXPECT_EQ(report_of(glint(arguments))["reference_cut"], "image");
}

// Beyond 1000 steps it is a square root of what is negative, and with `half` only on the left.
TEST_F(StudyReference, AReferenceThatIsNotFiniteIsToldAndBlamesNoRow) {
    const auto told = [&](const char* half, std::vector<std::string> more = {}) {
        write("s.frag", std::string("uniform int n; //@ 8 [1, 256] quality reference=4096\n"
                                    "void mainImage(out vec4 c, in vec2 p) {\n"
                                    "    vec2 q = p / iResolution.xy;\n"
                                    "    float s = sqrt(float(1000 - (") +
                            half +
                            " ? n : 1)));\n"
                            "    c = vec4(vec3(0.02 * s / float(n)) + 0.1 * q.x, 1);\n"
                            "}\n");
        std::vector<std::string> arguments = {"study",  "s.frag",    "--size", "16x8",
                                              "--json", "--seconds", "0"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return report_of(glint(arguments));
    };
    for (const auto& [half, pixels] : {std::pair{"true", 128}, std::pair{"q.x < 0.5", 64}}) {
        const Json json = told(half);
        EXPECT_EQ(json["reference_not_finite"], pixels);
        EXPECT_TRUE(json["own_error"].is_null() && json["reference_error"].is_null()) << json;
        EXPECT_EQ(json["converges"], false);
        ASSERT_EQ(json["findings"].size(), 1u) << findings(json);
        EXPECT_NE(findings(json).find(fmt::format("is not finite in {} pixels", pixels)),
                  std::string::npos);
        for (const Json& row : json["rows"]) {
            EXPECT_FALSE(row.contains("failed") || row["pareto"].get<bool>()) << row;
            EXPECT_EQ(row["rmse"].is_null(), pixels == 128) << "what can be compared is";
        }
    }
    const Json budget = told("true", {"--ms", "5"});
    EXPECT_TRUE(budget["best"].is_null());
    EXPECT_NE(findings(budget).find("is not finite in 128 pixels"), std::string::npos);
    EXPECT_EQ(findings(budget).find("nothing that was tried"), std::string::npos);
}

TEST_F(StudyReference, AReferenceIsNotMeasuredByItself) {
    const Outcome outcome = glint(
        {"study", known_scene("quadrature").string(), "--second", "steps=4096", "--seconds", "0"});
    EXPECT_EQ(outcome.code, 2);
    EXPECT_NE(outcome.err.find("--second steps=4096: that is the reference itself"),
              std::string::npos)
        << outcome.err;
}

// The mean of so many hashed numbers.
TEST_F(StudyReference, TwoSeedsShareTheirDifferenceWhoeverNamesTheSecond) {
    write("s.frag",
          "uniform int samples; //@ 4 [1, 16] log quality reference=128\n"
          "uniform float seed; //@ 0 [0, 9]\n"
          "uniform float unused; //@ 0 [0, 9]\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    float sum = unused * 1e-9;\n"
          "    for (int i = 0; i < samples; ++i)\n"
          "        sum += fract(sin(dot(vec3(p, float(i) + 900.0 * seed), vec3(12.99, 78.2, 3.7))) "
          "* 43758.5);\n"
          "    c = vec4(vec3(sum / float(samples)), 1);\n"
          "}\n");
    const auto own_error = [&](std::vector<std::string> more) {
        std::vector<std::string> arguments = {"study",  "s.frag",    "--size",
                                              "16x9",   "--seconds", "0",
                                              "--json", "--vary",    "samples=1,4"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return report_of(glint(arguments))["own_error"].get<double>();
    };
    const double shared = own_error({});
    EXPECT_GT(shared, 0.0);
    EXPECT_EQ(own_error({"--second", "seed=1"}), shared);
}

TEST_F(StudyReference, WithoutASecondTheOwnErrorIsNotKnown) {
    write("s.frag",
          "uniform float f; //@ 0.5 [0, 1] quality reference=0\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(vec3(f), 1); }\n");
    const Json json = report_of(
        glint({"study", "s.frag", "--size", "8x8", "--seconds", "0", "--json", "--vary", "f"}));
    EXPECT_TRUE(json["reference_error"].is_null());
    EXPECT_TRUE(json["own_error"].is_null());
}

// Half a step is more work.
TEST_F(StudyReference, AllOtherQualityDoesMoreWorkWhicheverWayItsSliderGoes) {
    write("s.frag",
          "uniform float stride; //@ 0.1 [0.01, 1] log quality reference=0.01\n"
          "uniform bool fine; //@ off quality reference=on\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = vec4(vec3(0.5 + stride * 0.1 * sin(p.x) + (fine ? 0.0 : 0.01)), 1);\n"
          "}\n");
    const std::vector<std::string> arguments = {"study", "s.frag", "--size", "16x9", "--seconds",
                                                "0",     "--json", "--vary", "fine"};
    const Json own = report_of(glint(arguments));
    std::vector<std::string> named = arguments;
    named.insert(named.end(), {"--second", "stride=0.05"});
    EXPECT_EQ(own["reference_error"]["rmse"], report_of(glint(named))["reference_error"]["rmse"]);
}

}  // namespace
}  // namespace glint::cli::study_reference_test
