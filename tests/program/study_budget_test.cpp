// `glint study` with a budget, and over several views.
#include "report.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace glint::cli {
namespace {

using Json = nlohmann::json;

using StudyBudget = InAFolder;

std::string findings(const Json& study) {
    return study["findings"].dump();
}

// Two sums, one of which matters much and costs little, and the other way round.
const std::string kTwoDials =
    "uniform int cheap; //@ 4 [1, 16] log quality reference=64\n"
    "uniform int dear;  //@ 4 [1, 16] log quality reference=64\n"
    "uniform int method; //@ 0 {none, other} quality reference=0\n"
    "float sum(int n, float x) {\n"
    "    float s = 0.0;\n"
    "    for (int i = 0; i < n; ++i) s += exp(-x * float(i) / float(n));\n"
    "    return s / float(n);\n"
    "}\n"
    "void mainImage(out vec4 c, in vec2 p) {\n"
    "    vec2 uv = p / iResolution.xy;\n"
    "    float waste = 0.0;\n"
    "    for (int i = 0; i < 40 * dear; ++i) waste += exp(-uv.y * float(i));\n"
    "    c = vec4(vec3(0.4 * sum(cheap, uv.x) + 0.02 * sum(dear, uv.y) + 1e-12 * waste), 1);\n"
    "    if (method == 1) c.g += 0.2;\n"
    "}\n";

TEST_F(StudyBudget, ABudgetChoosesAndAPresetKeepsIt) {
    write("s.frag", kTwoDials);
    write("s.toml", "scene = \"s.frag\"\ntitle = \"mine\"\n");
    const Outcome outcome = glint({"study", "s.toml", "--size", "64x36", "--seconds", "1", "--ms",
                                   "own", "--json", "-o", "s.toml", "--name", "fast"});
    const Json json = report_of(outcome);
    EXPECT_EQ(json["knob"], "quality");
    const Json& best = json["best"];
    ASSERT_TRUE(best.is_object()) << json;
    EXPECT_EQ(best["tweaks"]["method"], "none");
    EXPECT_EQ(best["tweaks"]["cheap"], "16") << best << " costs next to nothing";
    const auto own = std::ranges::find_if(
        json["rows"], [](const Json& row) { return row["is_preset"].get<bool>(); });
    ASSERT_NE(own, json["rows"].end());
    EXPECT_LT(best["error"].get<double>(), 0.5 * (*own)["rmse"].get<double>());
    EXPECT_NE(json["rows"][best["row"].get<std::size_t>()]["verdict"], "slower");
    ASSERT_FALSE(json["frontier"].empty());
    EXPECT_TRUE(json["frontier"][0]["ms_high"].is_number());
    EXPECT_TRUE(json["frontier"][0]["tweaks"].contains("dear"));

    const std::string preset = bytes("s.toml");
    EXPECT_NE(preset.find("title = \"mine\""), std::string::npos) << preset;
    EXPECT_NE(preset.find("[quality.fast]\ncheap = 16\n"), std::string::npos) << preset;
    const Outcome used =
        glint({"still", "s.toml", "-o", "a.png", "--size", "64x36", "--quality", "fast"});
    EXPECT_EQ(used.code, 0) << used.err;
    std::vector<std::string> named = {"still", "s.toml", "-o", "b.png", "--size", "64x36"};
    for (const auto& [name, value] : best["tweaks"].items())
        named.insert(named.end(), {"--tweak", name + "=" + value.get<std::string>()});
    EXPECT_EQ(glint(named).code, 0);
    EXPECT_EQ(bytes("a.png"), bytes("b.png"));
    glint({"still", "s.toml", "-o", "c.png", "--size", "64x36"});
    EXPECT_NE(bytes("a.png"), bytes("c.png"));
    const Outcome wrong = glint({"still", "s.toml", "-o", "a.png", "--quality", "fats"});
    EXPECT_EQ(wrong.code, 2);
    EXPECT_NE(wrong.err.find("did you mean 'fast'?"), std::string::npos) << wrong.err;
    EXPECT_EQ(glint({"still", "s.toml", "-o", "a.jpg", "--size", "8x8", "--quality", "50"}).code,
              0);
}

TEST_F(StudyBudget, APresetKeepsWhatTheSettingStoodOnToo) {
    write("s.frag", kTwoDials);
    write("s.toml", "scene = \"s.frag\"\n[quality.tinted]\nmethod = \"other\"\n");
    const Outcome outcome = glint({"study", "s.toml", "--size", "16x9", "--seconds", "0.2", "--ms",
                                   "own", "--quality", "tinted", "--reference", "method=other",
                                   "--vary", "cheap", "-o", "s.toml", "--name", "fast"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const std::string preset = bytes("s.toml");
    const std::size_t fast = preset.find("[quality.fast]\n");
    ASSERT_NE(fast, std::string::npos) << preset;
    EXPECT_NE(preset.find("method = \"other\"", fast), std::string::npos) << preset;
}

TEST_F(StudyBudget, APresetThatCannotBeReadIsToldAndLeftOut) {
    write("s.frag", kTwoDials);
    write("s.toml", "scene = \"s.frag\"\n");
    write("broken.toml", "scene = \n");
    const Outcome outcome = glint({"study", "s.toml", "--size", "16x9", "--seconds", "0", "--over",
                                   "presets", "--vary", "cheap=4,8"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find("broken.toml is left out: "), std::string::npos) << outcome.err;
}

// What a person hardly sees may be left out, however much it is in numbers.
TEST_F(StudyBudget, MayBeWhatAPersonSees) {
    write("s.frag", kTwoDials);
    const auto by = [&](const std::string& option, const std::string& number) {
        return report_of(glint(
            {"study", "s.frag", "--size", "64x36", "--seconds", "1", option, number, "--json"}));
    };
    const Json json = by("--flip", "0.05");
    const Json& best = json["best"];
    ASSERT_TRUE(best.is_object()) << json;
    EXPECT_LE(best["flip"].get<double>(), 0.05);
    for (const Json& row : json["rows"]) {
        if (row["ms"].get<double>() < best["ms"].get<double>()) {
            EXPECT_GT(row["flip"].get<double>(), 0.05) << row["value"] << " is faster";
        }
    }
    ASSERT_FALSE(json["frontier"].empty());
    EXPECT_TRUE(json["frontier"][0]["flip"].is_number());
    EXPECT_EQ(by("--flip", "own")["best"]["tweaks"]["method"], "none");
    const Json strict = by("--flip", "1e-9");
    EXPECT_TRUE(strict["best"].is_null());
    EXPECT_NE(findings(strict).find("within 1e-09 FLIP; the least is "), std::string::npos)
        << findings(strict);
}

// One that falls like 1/n, and one that halves with each more: half of both at once shows mostly
// what the second lacks, of which the truth lacks next to nothing.
TEST_F(StudyBudget, TheTruthClaimsWhatItIsOff) {
    write("s.frag",
          "uniform int a; //@ 2 [1, 16] log quality reference=16\n"
          "uniform int b; //@ 2 [1, 8] quality reference=8\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = vec4(vec3(0.3 + 0.1 / float(a) + 0.2 * exp2(-float(b))), 1);\n"
          "}\n");
    const Json json = report_of(
        glint({"study", "s.frag", "--size", "8x8", "--seconds", "0", "--ms", "own", "--json"}));
    const auto linear = [](double c) { return std::pow((c + 0.055) / 1.055, 2.4); };
    const double off = linear(0.3 + 0.1 / 16 + 0.2 / 256) - linear(0.3);
    EXPECT_GT(json["own_error"].get<double>(), 0.9 * off);
    EXPECT_LT(json["own_error"].get<double>(), 1.5 * off);
    EXPECT_GT(json["reference_error"]["rmse"].get<double>(), 2.0 * off) << "half of both";
}

TEST_F(StudyBudget, AMenusNameOfTwoWordsIsChosenAndWritten) {
    std::string text = kTwoDials;
    text.replace(text.find("none"), 4, "none at all");
    text.replace(text.find("//@ 0 {"), 5, "//@ 1");
    write("s.frag", text);
    write("s.toml", "scene = \"s.frag\"\n");
    const Json json = report_of(glint({"study", "s.toml", "--size", "64x36", "--seconds", "1",
                                       "--rmse", "0.05", "--json", "-o", "s.toml"}));
    ASSERT_TRUE(json["best"].is_object()) << json;
    EXPECT_EQ(json["best"]["tweaks"]["method"], "0");
    EXPECT_NE(bytes("s.toml").find("method = \"none at all\"\n"), std::string::npos)
        << bytes("s.toml");
}

TEST_F(StudyBudget, ABudgetThatNothingMeetsIsTold) {
    write("s.frag", kTwoDials);
    const Json json = report_of(glint(
        {"study", "s.frag", "--size", "16x9", "--seconds", "0", "--ms", "0.000001", "--json"}));
    EXPECT_TRUE(json["best"].is_null());
    EXPECT_NE(findings(json).find("nothing that was tried is within"), std::string::npos);
    const Outcome unwritten = glint({"study", "s.frag", "--size", "16x9", "--seconds", "0", "--ms",
                                     "0.000001", "-o", "best.toml"});
    EXPECT_EQ(unwritten.code, 1);
    EXPECT_NE(unwritten.err.find("best.toml is not written: nothing that was tried"),
              std::string::npos)
        << unwritten.err;
    EXPECT_FALSE(fs::exists(folder() / "best.toml"));
    for (const char* wrong : {"much", "0", "-1", "nan", "inf", "1e999", ""}) {
        for (const char* option : {"--ms", "--rmse", "--flip"})
            EXPECT_EQ(glint({"study", "s.frag", option, wrong}).code, 2) << option << wrong;
    }
    EXPECT_EQ(glint({"study", "s.frag", "--ms", "1", "--rmse", "1"}).code, 2);
    EXPECT_EQ(glint({"study", "s.frag", "--flip", "1", "--rmse", "1"}).code, 2);
    EXPECT_EQ(glint({"study", "s.frag", "-o", "a.toml"}).code, 2);
}

// What cannot be kept is told before anything is sought.
TEST_F(StudyBudget, WhereItCannotBeKeptNothingIsSought) {
    write("s.frag", kTwoDials);
    write("other.frag", kGradient);
    write("other.toml", "scene = \"other.frag\"\n");
    write("broken.toml", "scene = [\n");
    const auto refused = [&](int code, std::vector<std::string> more) {
        std::vector<std::string> all = {"study", "s.frag", "--ms", "own", "--lines"};
        all.insert(all.end(), more.begin(), more.end());
        const Outcome outcome = glint(std::move(all));
        EXPECT_EQ(outcome.code, code) << outcome.err;
        EXPECT_EQ(outcome.out, "");
    };
    refused(2, {"-o", "no/where/s.toml"});
    refused(2, {"-o", "other.toml"});
    refused(4, {"-o", "broken.toml"});
    refused(2, {"-o", "s.toml", "--name", ""});
    refused(2, {"-o", "s.toml", "--name", "50"});
    refused(4, {"-o", "s.toml", "--name", "\xff"});
    write("dense.toml", "scene = \"s.frag\"\nquality = { best.a = 1 }\n");
    refused(4, {"-o", "dense.toml"});
    refused(2, {"--metric", "time"});
    EXPECT_EQ(bytes("broken.toml"), "scene = [\n");
}

// Steps that matter the more the brighter it is.
TEST_F(StudyBudget, TheNextBudgetFindsTheTruthDrawn) {
    write("two.frag", kTwoDials);
    const auto call = [&](const std::string& budget) {
        return report_of(glint({"study", "two.frag", "--size", "16x9", "--json", "--seconds", "0",
                                budget, "own", "-o", "report"}));
    };
    const auto truths = [&] {
        std::map<std::string, fs::file_time_type> files;
        for (const auto& entry : fs::directory_iterator(folder() / "report/data")) {
            const std::string name = entry.path().filename();
            const bool is_truth = name.find("-of-") != std::string::npos ||
                                  name.find("references") != std::string::npos;
            if (is_truth) files[name] = entry.last_write_time();
        }
        return files;
    };
    const Json first = call("--ms");
    const auto drawn = truths();
    EXPECT_GE(drawn.size(), 4u) << "all references, half of them, and half of each";
    const Json then = call("--rmse");
    EXPECT_EQ(truths(), drawn);
    EXPECT_EQ(then["own_error"], first["own_error"]);
}

TEST_F(StudyBudget, OverSeveralViewsTheWorstIsNamed) {
    write("s.frag",
          "uniform int n; //@ 1 [1, 4] quality reference=8\n"
          "uniform float light; //@ 0.1 [0, 1]\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = vec4(light * (0.5 + 0.1 / float(n)) + 0.01 * iTime);\n"
          "}\n");
    write("bright.toml", "scene = \"s.frag\"\n[tweaks]\nlight = 1.0\n");
    write("dim.toml", "scene = \"s.frag\"\n[tweaks]\nlight = 0.2\n");
    const std::vector<std::string> arguments = {"study",     "dim.toml", "--size", "8x8",
                                                "--seconds", "0",        "--json"};
    const auto with = [&](const std::string& over) {
        std::vector<std::string> all = arguments;
        all.insert(all.end(), {"--over", over});
        return glint(all);
    };
    const Json json = report_of(with("presets"));
    EXPECT_EQ(json["views"], Json({"bright", "dim"}));
    const Json alone = report_of(glint(arguments));
    for (std::size_t i = 0; i < json["rows"].size(); ++i) {
        const Json& row = json["rows"][i];
        EXPECT_EQ(row["worst"]["view"], "bright");
        const double bright = row["worst"]["rmse"], dim = alone["rows"][i]["rmse"];
        EXPECT_NEAR(row["rmse"].get<double>(), std::sqrt((bright * bright + dim * dim) / 2.0),
                    1e-6);
    }
    const Json times = report_of(with("time=0:10:5"));
    EXPECT_EQ(times["views"], Json({"time 0", "time 5", "time 10"}));
    EXPECT_EQ(times["rows"][0]["worst"]["view"], "time 10") << "brighter in linear light";
    EXPECT_EQ(with("time=5:0:1").code, 2);
    EXPECT_EQ(with("other").code, 2);
}

// A ratio of two numbers, which halving both leaves as it is.
TEST_F(StudyBudget, WhatBothReferencesShareIsNoErrorOfNone) {
    write("ratio.frag",
          "uniform int steps; //@ 8 [1, 32] log quality reference=32\n"
          "uniform int reach; //@ 8 [1, 32] log quality reference=32\n"
          "void mainImage(out vec4 c, in vec2 p) {\n"
          "    c = vec4(vec3(0.3 + 0.1 * float(reach) / float(steps)), 1);\n}\n");
    const Outcome outcome = glint(
        {"study", "ratio.frag", "--size", "16x9", "--seconds", "0.3", "--rmse", "0.001", "--json"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const Json study = Json::parse(outcome.out)["studies"][0];
    EXPECT_GT(study["own_error"].get<double>(), 0.01);
    EXPECT_NE(study["findings"].dump().find("the truth itself may be off"), std::string::npos)
        << study["findings"];
}

TEST_F(StudyBudget, TheBestOfAKnobMayLieInItsMiddle) {
    write("middle.frag",
          "uniform float mid; //@ 0.2 [0, 1] quality reference=0.53\n"
          "void mainImage(out vec4 c, in vec2 p) { c = vec4(vec3(0.3 + abs(mid - 0.53)), 1); }\n");
    const Outcome outcome = glint(
        {"study", "middle.frag", "--size", "16x9", "--seconds", "0.3", "--ms", "1000", "--json"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const Json best = Json::parse(outcome.out)["studies"][0]["best"];
    EXPECT_EQ(best["tweaks"]["mid"], "0.53") << best;
}

TEST_F(StudyBudget, SecondsMayBeAFractionOfOne) {
    const Outcome outcome = glint({"study", known_scene("quadrature").string(), "--size", "16x8",
                                   "--vary", "steps=1,2", "--seconds", "0.2"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
}

}  // namespace
}  // namespace glint::cli
