// What a study renders: which knobs in which order, their values, and the references.
#include "../base/test_folder.h"
#include "measure/study/plan.h"
#include "measure/study/values.h"
#include "offline/common.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace glint::study_plan_test {
namespace {

using Values = std::vector<std::string>;

Values texts(const Knob& knob) {
    Values list;
    for (const KnobValue& value : knob.values) list.push_back(value.text);
    return list;
}

Values names(const StudyPlan& plan) {
    Values list;
    for (const Knob& knob : plan.knobs) list.push_back(knob.name);
    return list;
}

// A preset of a scene that has these tweaks, and what its compiled form would tell: all tweaks are
// read, nothing accumulates.
struct Planned {
    explicit Planned(const std::string& tweaks) : preset(read(tweaks)) {
        facts.read.assign(preset.scene.tweaks.size(), true);
        facts.drawn.assign(preset.scene.passes.size(), true);
        facts.read_with = [this](std::size_t, const TweakValue&) { return facts.read; };
        facts.accumulates = [](const std::vector<TweakValue>&) { return false; };
    }
    Planned(const Planned&) = delete;

    static Preset read(const std::string& tweaks) {
        const TestFolder folder;
        const ReadPreset read = read_preset(
            folder.write("a.frag", tweaks + "void mainImage(out vec4 c, in vec2 p) {}\n"));
        for (const Diagnostic& diagnostic : read.diagnostics)
            ADD_FAILURE() << to_string(diagnostic);
        return *read.preset;
    }

    StudyPlan plan(const StudyOptions& options = {}) const {
        return plan_study(preset, facts, options);
    }
    Knob only(const StudyOptions& options = {}) const {
        const StudyPlan found = plan(options);
        EXPECT_EQ(found.knobs.size(), 1u);
        return found.knobs.at(0);
    }

    Preset preset;
    SceneFacts facts;
};

TEST(StudyList, GoesOnByTheRatioBeforeTheDotsOrIsDoubled) {
    EXPECT_EQ(parse_list("1,2,5"), (Values{"1", "2", "5"}));
    EXPECT_EQ(parse_list("16,...,128"), (Values{"16", "32", "64", "128"}));
    EXPECT_EQ(parse_list("1,3,...,81"), (Values{"1", "3", "9", "27", "81"}));
    EXPECT_EQ(parse_list("8,\u2026,60"), (Values{"8", "16", "32", "60"}));
    EXPECT_EQ(parse_list("64,32,...,8"), (Values{"64", "32", "16", "8"})) << "downwards";
    for (const char* nowhere : {"...", "1,...", "0,...,1", "a,...,c", "4,4,...,8", "8,...,4",
                                "1,2,...,...,8", "1,1.0001,...,8"})
        EXPECT_THROW(parse_list(nowhere), UsageError) << nowhere;
    EXPECT_EQ(parse_list("off,traced"), (Values{"off", "traced"}));
}

// A budget of what the preset takes is filled by less than a whole step.
TEST(StudyValues, OfABudgetLieHalfwayToTheNextOfThePresetsOwn) {
    const Planned planned(
        "uniform int a; //@ 10 [1, 48] log quality\n"
        "uniform int b; //@ 1 [1, 4] quality\n"
        "uniform float c; //@ 1 [1, 16] log quality\n"
        "uniform int d; //@ 1 {off, on} quality\n"
        "uniform float e; //@ 0.4 [0, 1] step=0.2 quality\n");
    const StudyPlan plan = planned.plan({.ms_budget = "own"});
    ASSERT_EQ(plan.knobs.size(), 5u);
    const auto texts = [&](std::size_t knob) {
        Values list;
        for (const KnobValue& value : plan.knobs[knob].values) list.push_back(value.text);
        return list;
    };
    EXPECT_EQ(texts(0), (Values{"1", "2", "4", "8", "9", "10", "13", "16", "32", "48"}));
    EXPECT_EQ(texts(1), (Values{"1", "2", "3", "4"})) << "nothing lies between 1 and 2";
    EXPECT_EQ(texts(2), (Values{"1", "1.5", "2", "4", "8", "16"}));
    EXPECT_EQ(texts(3), (Values{"off", "on"}));
    EXPECT_EQ(texts(4), (Values{"0", "0.2", "0.4", "0.6", "0.8", "1"})) << "where a slider stands";
    EXPECT_EQ(planned.plan().knobs[0].values.size(), 8u) << "no budget, no half steps";
}

TEST(StudyValues, ARangeIsSpreadByItsKind) {
    const struct {
        const char* declaration;
        Values values;
    } kCases[] = {
        {"uniform int a; //@ 1 [1, 4] quality\n", {"1", "2", "3", "4"}},
        {"uniform int a; //@ 1 [1, 64] quality\n", {"1", "2", "4", "8", "16", "32", "64"}},
        {"uniform int a; //@ 1 [1, 48] quality\n", {"1", "2", "4", "8", "16", "32", "48"}},
        {"uniform int a; //@ 2 [2, 8] log quality\n", {"2", "4", "8"}},
        {"uniform int a; //@ 1 [1, 4096] quality\n", {"1", "4", "16", "64", "256", "1024", "4096"}},
        {"uniform float a; //@ 0 [0, 1] quality\n", {"0", "0.2", "0.4", "0.6", "0.8", "1"}},
        {"uniform float a; //@ 0.25 [0.25, 1] log quality\n", {"0.25", "0.5", "1"}},
        {"uniform float a; //@ 0 [0, 1] step=0.25 quality\n", {"0", "0.25", "0.5", "0.75", "1"}},
        {"uniform float a; //@ 0.1 [0.1, 1] step=0.1 log quality\n",
         {"0.1", "0.2", "0.4", "0.8", "1"}},
        {"uniform int a; //@ 1 [1, 31] step=2 quality\n", {"1", "3", "5", "9", "17", "31"}},
        {"uniform bool a; //@ on quality\n", {"off", "on"}},
        {"uniform int a; //@ 0 {off, march, traced} quality\n", {"off", "march", "traced"}},
    };
    for (const auto& [declaration, values] : kCases)
        EXPECT_EQ(texts(Planned(declaration).only()), values) << declaration;
}

TEST(StudyValues, ThePresetsOwnStandsAmongThemAndIsMarked) {
    Planned planned("uniform int a; //@ 5 [1, 64] log quality\n");
    const Knob knob = planned.only();
    EXPECT_EQ(texts(knob), (Values{"1", "2", "4", "5", "8", "16", "32", "64"}));
    for (const KnobValue& value : knob.values) EXPECT_EQ(value.is_between, value.text == "5");
    planned.preset.values[0][0] = 8.0;
    EXPECT_EQ(texts(planned.only()), (Values{"1", "2", "4", "8", "16", "32", "64"}));
    EXPECT_EQ(texts(planned.only({.vary = {"a=1,2"}})), (Values{"1", "2"})) << "as it was named";
}

// In another view it counts, be it this one's own.
TEST(StudyReference, KnowsWhatIsNamedBesideIt) {
    const Planned planned(
        "uniform int a; //@ 2 [1, 4] quality second=b=2\n"
        "uniform int b; //@ 3 [1, 4]\n");
    const Knob knob = planned.only({.reference = {"b=3"}});
    const std::vector<std::size_t> named = {1};
    EXPECT_EQ(knob.reference.named, named);
    EXPECT_TRUE(knob.values[0].named.empty());
    EXPECT_EQ(planned.only({.second = {"b=3", "a=9"}}).second->named, std::vector<std::size_t>());
    ASSERT_TRUE(planned.only().rival);
    EXPECT_EQ(planned.only().rival->value.named, named);
}

TEST(StudyValues, TurnOneKnobAndLeaveAllOthersAsThePresetHasThem) {
    Planned planned(
        "uniform int a; //@ 2 [1, 4] quality\n"
        "uniform int b; //@ 3 [1, 4] quality reference=9\n");
    planned.preset.settle = 7;
    const StudyPlan plan = planned.plan();
    ASSERT_EQ(names(plan), (Values{"a", "b"}));
    for (const KnobValue& value : plan.knobs[0].values) {
        EXPECT_EQ(value.setting.values[0][0], *value.work);
        EXPECT_EQ(value.setting.values[1][0], 3.0);
        EXPECT_EQ(value.setting.settle, 7);
    }
    const Setting& reference = plan.knobs[1].reference.setting;
    EXPECT_EQ(reference.values[0][0], 2.0);
    EXPECT_EQ(reference.values[1][0], 9.0);
}

TEST(StudyPlan, HasQualityTweaksInTheirOrderThenFramesThatSettle) {
    Planned planned(
        "uniform int b; //@ 1 [1, 4] quality\n"
        "uniform float taste; //@ 1 [1, 4]\n"
        "uniform int unread; //@ 1 [1, 4] quality\n"
        "uniform float endless; //@ 1 quality\n"
        "uniform bool a; //@ on quality\n");
    planned.facts.read[2] = false;
    planned.facts.accumulates = [](const std::vector<TweakValue>&) { return true; };
    const StudyPlan plan = planned.plan();
    EXPECT_EQ(names(plan), (Values{"b", "a", "settle"}));
    EXPECT_EQ(plan.left_out, (Values{"unread: nothing reads it",
                                     "endless: it has no range; name values with --vary"}));
    EXPECT_EQ(texts(plan.knobs[2]), (Values{"0", "1", "4", "16", "64"}));
    EXPECT_EQ(plan.knobs[2].reference.text, "256");
    EXPECT_EQ(plan.knobs[2].second->text, "513") << "twice the frames, the first one too";
}

TEST(StudyPlan, VariesWhatIsNamedInThatOrderAndNothingElse) {
    const Planned planned(
        "uniform int a; //@ 1 [1, 4] quality\n"
        "uniform float taste; //@ 1 [1, 4]\n");
    EXPECT_EQ(names(planned.plan({.vary = {"taste", "a=1,2"}})), (Values{"taste", "a"}));
}

TEST(StudyPlan, RefusesWhatTheSceneHasNot) {
    const Planned planned(
        "uniform int a; //@ 1 [1, 4] quality\n"
        "uniform vec2 two; //@ 1, 1 [0, 4]\n"
        "uniform float endless; //@ 1\n");
    for (const char* vary : {"none", "none=1", "endless", "two=1,2", "a=5", "a=many", "a=", "=1",
                             "settle", "settle=1,2"}) {
        EXPECT_THROW(planned.plan({.vary = {vary}}), UsageError) << vary;
    }
    EXPECT_THROW(planned.plan({.vary = {"a=1,2"}, .reference = {"a=many"}}), UsageError);
    EXPECT_THROW(planned.plan({.vary = {"a=1,2"}, .reference = {"a"}}), UsageError);
    EXPECT_THROW(planned.plan({.vary = {"a=1,2"}, .second = {"a=many"}}), UsageError);
}

TEST(StudyReference, IsTheOneThatIsNamedElseTheTweaksOwnElseTheLastValue) {
    const Planned own(
        "uniform int a; //@ 1 [1, 4] quality reference=64\n"
        "uniform int b; //@ 1 [0, 9]\n");
    EXPECT_EQ(own.only().reference.text, "64");
    EXPECT_EQ(own.only({.reference = {"a=32"}}).reference.text, "32");
    EXPECT_TRUE(own.only().notes.empty());
    const Planned none("uniform int a; //@ 1 [1, 4] quality\n");
    EXPECT_EQ(none.only().reference.text, "4");
    EXPECT_EQ(none.only().notes,
              (Values{"a declares no reference: its last value, 4, counts as the truth"}));
    EXPECT_TRUE(none.only({.time_only = true}).notes.empty()) << "no errors, no truth";
}

TEST(StudyReference, SaysWhetherMoreIsBetter) {
    const Knob steps = Planned("uniform int a; //@ 1 [1, 4] quality reference=64\n").only();
    EXPECT_TRUE(steps.more_is_better);
    EXPECT_EQ(steps.second->text, "128") << "twice the work";
    const Knob length =
        Planned("uniform float a; //@ 0.1 [0.1, 0.8] log quality reference=0.05\n").only();
    EXPECT_FALSE(length.more_is_better);
    EXPECT_EQ(length.second->text, "0.025") << "half the step";
    const Planned low("uniform int a; //@ 16 [1, 256] log quality\n");
    EXPECT_TRUE(low.only({.reference = {"a=64"}}).more_is_better) << "most octaves are below";
    const Planned declared("uniform int a; //@ 16 [1, 256] quality reference=256\n");
    EXPECT_TRUE(declared.only({.reference = {"a=64"}}).more_is_better) << "as the scene says";
    const Planned amid("uniform int a; //@ 64 [4, 64] quality reference=32\n");
    EXPECT_TRUE(amid.only().more_is_better) << "a number of steps";
    EXPECT_EQ(amid.only().second->text, "64");
    EXPECT_TRUE(amid.only().notes[0].starts_with("the reference, 32, lies among the values"));
    EXPECT_TRUE(amid.only({.reference = {"a=1024"}}).notes.empty());
    const Planned step("uniform float a; //@ 0.1 [0.01, 0.5] log quality reference=0.2\n");
    EXPECT_FALSE(step.only({.reference = {"a=0.001"}}).more_is_better) << "beyond the least";
    const Knob least = Planned("uniform int a; //@ 1 [1, 4] quality reference=0\n").only();
    EXPECT_FALSE(least.second) << "nothing is half of no step";
}

TEST(StudyReference, IsJudgedByWhatIsNamedElseByAnotherSeed) {
    Planned planned(
        "uniform int a; //@ 1 [1, 4] quality reference=64\n"
        "uniform int seed; //@ 3 [0, 9]\n");
    const KnobValue seed = *planned.only().second;
    EXPECT_EQ(seed.text, "64, another seed");
    EXPECT_EQ(seed.setting.values[0][0], 64.0);
    EXPECT_EQ(seed.setting.values[1][0], 4.0);
    EXPECT_EQ(planned.only({.second = {"a=99"}}).second->text, "99");
    EXPECT_FALSE(planned.only({.time_only = true}).second);
    planned.facts.read[1] = false;
    EXPECT_EQ(planned.only().second->text, "128") << "a seed that nothing reads changes nothing";
}

TEST(StudyReference, IsJudgedByAnotherTweakWhereThatIsNamed) {
    const Planned planned(
        "uniform int a; //@ 1 [1, 4] quality reference=64\n"
        "uniform int b; //@ 0 {slow, fast} quality reference=0\n");
    const StudyPlan plan = planned.plan({.second = {"b=fast"}});
    EXPECT_EQ(plan.knobs[0].second->text, "64 with b=fast");
    EXPECT_EQ(plan.knobs[0].second->setting.values[1][0], 1.0);
    EXPECT_EQ(plan.knobs[0].second_work.kind, SecondWork::Kind::another);
    EXPECT_EQ(plan.knobs[1].second->text, "fast") << "its own";
    const StudyPlan both = planned.plan({.second = {"a=32", "b=fast"}});
    EXPECT_EQ(both.knobs[0].second->text, "32");
    EXPECT_EQ(both.knobs[0].second_work.ratio, 0.5);
}

TEST(StudyReference, OfATweakThatIsNotStudiedIsPartOfTheTruth) {
    const Planned planned(
        "uniform int a; //@ 1 [1, 4] quality reference=64\n"
        "uniform int b; //@ 1 {slow, fast} quality reference=0\n"
        "uniform int c; //@ 0 {quick, exact}\n");
    const StudyPlan all = planned.plan({.reference = {"b=fast", "c=exact"}});
    EXPECT_EQ(all.knobs[0].reference.text, "64 with c=exact") << "b has a study of its own";
    EXPECT_EQ(all.knobs[0].reference.setting.values[2][0], 1.0);
    EXPECT_EQ(all.knobs[0].second->setting.values[2][0], 1.0) << "as what measures it";
    EXPECT_EQ(all.knobs[0].values[0].setting.values[2][0], 0.0) << "and not of a row";
    EXPECT_EQ(all.knobs[1].reference.text, "fast with c=exact");
    const StudyPlan one = planned.plan({.vary = {"a=1,2"}, .reference = {"b=slow"}});
    EXPECT_EQ(one.knobs[0].reference.text, "64 with b=slow");
    EXPECT_THROW(planned.plan({.reference = {"a=1", "a=2"}}), UsageError);
    EXPECT_THROW(planned.plan({.second = {"c=exact", "c=quick"}}), UsageError);
}

TEST(StudyReference, IsNotJudgedByWhatItHasItself) {
    const Planned planned(
        "uniform int a; //@ 1 [1, 4] quality reference=64\n"
        "uniform int b; //@ 0 {slow, fast}\n");
    const Knob knob = planned.only({.second = {"b=slow"}});
    EXPECT_EQ(knob.second->text, "128") << "else it would claim to be off by nothing";
    EXPECT_EQ(knob.notes,
              (Values{"--second says nothing of a: its reference, 64, has that already"}));
}

// What is chosen is to be used; who names a value wants it tried, and errors are told of all.
TEST(StudyPlan, ABudgetKeepsToWhatIsSafe) {
    const Planned planned(
        "uniform int way;   //@ 2 {loose, firm, exact} safe=[1, 2] quality reference=2\n"
        "uniform int steps; //@ 8 [1, 16] log safe=[4, 16] quality reference=64\n");
    const StudyPlan plan = planned.plan({.ms_budget = "own"});
    EXPECT_EQ(texts(plan.knobs[0]), (Values{"firm", "exact"}));
    EXPECT_EQ(texts(plan.knobs[1]), (Values{"4", "6", "8", "12", "16"}));
    EXPECT_EQ(planned.plan().knobs[0].values.size(), 3u);
    EXPECT_EQ(planned.plan({.vary = {"way=loose"}, .ms_budget = "own"}).knobs[0].values.size(), 2u);
}

// By what else would a budget be what the preset takes?
TEST(StudyPlan, OfABudgetHasThePresetsOwnValueWhateverIsNamed) {
    const Planned planned(
        "uniform int a; //@ 3 [1, 9] quality reference=64\n"
        "uniform int b; //@ 1 {slow, fast, none} quality reference=0\n");
    const StudyPlan plan = planned.plan({.vary = {"a=2,4", "b=slow,none"}, .ms_budget = "own"});
    EXPECT_EQ(texts(plan.knobs[0]), (Values{"2", "3", "4"}));
    EXPECT_EQ(texts(plan.knobs[1]), (Values{"slow", "none", "fast"}));
    EXPECT_THROW(planned.plan({.vary = {"settle=1,2"}, .ms_budget = "own"}), UsageError);
}

TEST(StudyReference, IsNotJudgedByItself) {
    const Planned planned(
        "uniform int k; //@ 8 [1, 256] quality reference=256\n"
        "uniform int method; //@ 0 {none, sum} quality reference=1\n"
        "uniform int other; //@ 8 [1, 128] quality reference=256 second=128\n");
    EXPECT_THROW(planned.plan({.second = {"k=256"}}), UsageError);
    EXPECT_THROW(planned.plan({.reference = {"k=64"}, .second = {"k=64"}}), UsageError);
    EXPECT_THROW(planned.plan({.second = {"method=sum"}}), UsageError);
    EXPECT_EQ(planned.plan({.second = {"k=255"}}).knobs[0].second->text, "255");
    const StudyPlan turned = planned.plan({.reference = {"other=128"}});
    EXPECT_EQ(turned.knobs[2].second->text, "256") << "what the scene names is the reference now";
}

TEST(StudyReference, OfAMethodHasTheRivalThatTheSceneNames) {
    const Planned planned(
        "uniform int a; //@ 1 {cheap, sums, photons} quality reference=2 second=sums,cells=64\n"
        "uniform int cells; //@ 8 [1, 64] quality reference=64 second=48\n");
    const StudyPlan plan = planned.plan();
    ASSERT_TRUE(plan.knobs[0].rival);
    EXPECT_EQ(plan.knobs[0].rival->value.text, "sums,cells=64");
    EXPECT_EQ(plan.knobs[0].rival->value.setting.values[0][0], 1.0);
    EXPECT_EQ(plan.knobs[0].rival->value.setting.values[1][0], 64.0);
    EXPECT_EQ(plan.knobs[0].rival->second->setting.values[1][0], 128.0) << "its own claim";
    EXPECT_FALSE(plan.knobs[1].rival) << "a number's own value measures its reference";
    EXPECT_EQ(plan.knobs[1].second->text, "48");
    EXPECT_EQ(plan.knobs[1].second_work.ratio, 0.75);
}

// Each method reads a quality of its own, and all of them the rays through a pixel.
TEST(StudyReference, OfAMethodIsJudgedByQualityThatIsItsAlone) {
    Planned planned(
        "uniform int method; //@ 0 {hard, soft} quality reference=1\n"
        "uniform int shadows; //@ 16 [1, 64] quality\n"
        "uniform int rays; //@ 4 [1, 64] quality\n"
        "uniform float blur; //@ 0.5 quality\n");
    planned.facts.read_with = [](std::size_t, const TweakValue& method) {
        return std::vector<bool>{true, method[0] == 1.0, true, true};
    };
    const KnobValue own = *planned.only({.vary = {"method"}}).second;
    EXPECT_EQ(own.text, "soft, its own quality doubled");
    EXPECT_EQ(own.setting.values[1][0], 32.0);
    EXPECT_EQ(own.setting.values[2][0], 4.0);
    planned.facts.read_with = [](std::size_t, const TweakValue&) {
        return std::vector<bool>{true, true, true, true};
    };
    const KnobValue all = *planned.only({.vary = {"method"}}).second;
    EXPECT_EQ(all.text, "soft, all other quality doubled");
    EXPECT_EQ(all.setting.values[1][0], 32.0);
    EXPECT_EQ(all.setting.values[2][0], 8.0);
    EXPECT_EQ(all.setting.values[3][0], 0.5) << "without a range it is left out";
}

TEST(StudyReference, OfAMethodThatAccumulatesHasSettled) {
    Planned planned("uniform int method; //@ 0 {exact, noisy} quality reference=1\n");
    planned.facts.accumulates = [](const std::vector<TweakValue>& values) {
        return values[0][0] == 1.0;
    };
    const Knob knob = planned.only();
    EXPECT_EQ(knob.reference.setting.settle, 256);
    EXPECT_EQ(knob.values[1].setting.settle, 0) << "its own row is one frame of it";
    EXPECT_EQ(knob.second->text, "noisy, twice the frames");
    EXPECT_EQ(knob.second->setting.settle, 513);
    EXPECT_EQ(knob.notes, (Values{"the reference, noisy, accumulates 256 more frames"}));
    const Knob fewer = planned.only({.reference = {"settle=63"}});
    EXPECT_EQ(fewer.reference.setting.settle, 63) << "as many as are named";
}

const std::string kWaves =
    "uniform sampler2D waves; //@ pass mainWaves size=64x32 format=rg32f\n"
    "uniform sampler2D foam; //@ pass mainFoam\n"
    "void mainWaves(out vec4 c, in vec2 p) {}\nvoid mainFoam(out vec4 c, in vec2 p) {}\n";

TEST(StudyFormats, AreAKnobWhoseTruthIsTheWidest) {
    const Planned planned(kWaves);
    const Knob knob = planned.only({.vary = {"waves.format=rg16f,r8"}});
    EXPECT_EQ(knob.name, "waves.format");
    EXPECT_EQ(texts(knob), (Values{"rg16f", "r8"}));
    EXPECT_EQ(knob.reference.text, "rgba32f");
    EXPECT_FALSE(knob.second);
    for (const KnobValue& value : knob.values) EXPECT_EQ(value.setting.format->pass, 0u);
    EXPECT_EQ(knob.values[0].setting.format->format, PixelFormat::rg16f);
    ASSERT_EQ(knob.notes.size(), 1u);
    EXPECT_EQ(knob.notes[0], "waves takes: rg16f 8.0 KiB, r8 2.0 KiB");
}

TEST(StudyFormats, UnnamedAreThoseOfTheBuffersOwnChannels) {
    const Planned planned(kWaves);
    EXPECT_EQ(texts(planned.only({.vary = {"waves.format"}})), (Values{"rg32f", "rg16f", "rg8"}));
    const Knob foam = planned.only({.vary = {"foam.format"},
                                    .reference = {"foam.format=rgba16f"},
                                    .second = {"foam.format=rgba32f"}});
    EXPECT_EQ(texts(foam), (Values{"rgba32f", "rgba16f", "rgba8"}));
    EXPECT_EQ(foam.reference.text, "rgba16f");
    ASSERT_TRUE(foam.second);
    EXPECT_EQ(foam.second->setting.format->format, PixelFormat::rgba32f);
}

TEST(StudyFormats, WhatCannotBeVariedIsToldWithWhatWasMeant) {
    Planned planned(kWaves);
    planned.facts.drawn[1] = false;
    const struct {
        const char *vary, *told;
    } kCases[] = {{"wafes.format", "did you mean 'waves'?"},
                  {"waves.format=rgba32f,rg16", "did you mean 'rg16f'?"},
                  {"waves.size=3", "waves.format=rgba32f,rgba16f"},
                  {"image.format=rgba8", "the picture is no buffer"},
                  {"foam.format=rgba8", "nothing reads this buffer"}};
    for (const auto& [vary, told] : kCases) {
        try {
            planned.plan({.vary = {vary}});
            ADD_FAILURE() << vary;
        } catch (const UsageError& error) {
            EXPECT_NE(std::string(error.what()).find(told), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace glint::study_plan_test
