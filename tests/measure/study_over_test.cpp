// A study over several views of one scene, as far as no frame need be drawn.
#include "../base/test_folder.h"
#include "measure/study/over.h"
#include "measure/study/result.h"
#include "offline/common.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace glint::study_over_test {
namespace {

// Of one row in each view: so far off, with files of their own.
std::vector<Study> studies_of(const std::vector<double>& errors) {
    std::vector<Study> studies;
    for (const double error : errors) {
        const std::string name = std::to_string(studies.size());
        StudyRow row{.value = "8", .error = Difference{.rmse = error}};
        row.picture = "picture " + name;
        row.map = "map " + name;
        row.flip_map = "flip " + name;
        studies.emplace_back().rows.push_back(row);
    }
    return studies;
}

std::vector<View> views_of(std::size_t count) {
    std::vector<View> views;
    for (std::size_t i = 0; i < count; ++i) views.push_back({"view " + std::to_string(i), {}});
    return views;
}

TEST(StudyOver, ShowsAllPicturesOfTheWorstView) {
    const StudyRow row = over_all(views_of(3), studies_of({0.1, 0.3, 0.2})).rows[0];
    ASSERT_TRUE(row.worst);
    EXPECT_EQ(row.worst->view, "view 1");
    EXPECT_EQ(row.picture, "picture 1");
    EXPECT_EQ(row.map, "map 1");
    EXPECT_EQ(row.flip_map, "flip 1");
}

// A scene's preset, another that has another look, and a knob whose every picture has the first's.
struct Turned {
    Turned() {
        const TestFolder folder;
        base = *read_preset(folder.write("a.frag",
                                         "uniform int n; //@ 4 [1, 64] quality\n"
                                         "uniform float bright; //@ 0.1 [0, 1]\n"
                                         "void mainImage(out vec4 c, in vec2 p) {}\n"))
                    .preset;
        view = {"b", base};
        view.preset.values[1][0] = 0.7;
        const KnobValue own{.setting = {.values = base.values}};
        knob = {.name = "n", .values = {own}, .reference = own, .second = own, .more = own};
        knob.rival = Rival{.value = own, .second = own, .more = own, .less = own};
    }
    Preset base;
    View view;
    Knob knob;
};

TEST(StudyOver, EveryPictureHasTheLookOfTheView) {
    const Turned turned;
    const Knob knob = knob_in(turned.view, turned.base, turned.knob);
    const Rival& rival = *knob.rival;
    for (const KnobValue& value : {knob.values[0], knob.reference, *knob.second, *knob.more,
                                   rival.value, *rival.second, *rival.more, *rival.less})
        EXPECT_EQ(value.setting.values[1][0], 0.7);
}

// A preset that lies at the base's own value of what --reference names, and one that does not.
TEST(StudyOver, WhatIsNamedCountsInEachViewBeItTheFilesOwn) {
    Turned turned;
    turned.knob.reference.named = {1};
    const Knob knob = knob_in(turned.view, turned.base, turned.knob);
    EXPECT_EQ(knob.reference.setting.values[1][0], 0.1);
    EXPECT_EQ(knob.values[0].setting.values[1][0], 0.7);
}

TEST(StudyOver, TheWorstViewIsANumberWhereThereIsOne) {
    const double none = std::nan("");
    for (const auto& [errors, worst] :
         std::vector<std::pair<std::vector<double>, std::string>>{{{none, 0.1, 0.3}, "view 2"},
                                                                  {{0.1, 0.3, none}, "view 1"},
                                                                  {{0.3, none, 0.1}, "view 0"},
                                                                  {{none, none}, "view 0"}}) {
        std::vector<Study> studies = studies_of(errors);
        for (Study& study : studies)
            if (std::isnan(study.rows[0].error->rmse)) study.rows[0].failed = "diverged";
        const StudyRow row = over_all(views_of(errors.size()), studies).rows[0];
        EXPECT_EQ(row.worst->view, worst);
        const auto first = std::ranges::find_if(errors, [](double e) { return std::isnan(e); });
        EXPECT_EQ(row.failed, fmt::format("view {}: diverged", first - errors.begin()));
    }
}

TEST(StudyOver, NamesTheViewWhoseReferenceIsNoTruth) {
    std::vector<Study> studies = studies_of({0.1, 0.3, 0.2});
    for (Study& study : studies) study.reference = "64";
    studies[1].reference_not_finite = 7;
    Study all = over_all(views_of(3), studies);
    judge(all, {}, true);
    ASSERT_FALSE(all.findings.empty());
    EXPECT_TRUE(all.findings[0].starts_with("the reference, 64 in view 1, is not finite in 7 "))
        << all.findings[0];
}

std::vector<std::string> times(const std::string& range) {
    std::vector<std::string> names;
    for (const View& view : views_over({}, {.over = "time=" + range})) names.push_back(view.name);
    return names;
}

TEST(StudyOver, TimesAreAsShortAsAPersonWritesThem) {
    EXPECT_EQ(times("0:0.3:0.1"),
              (std::vector<std::string>{"time 0", "time 0.1", "time 0.2", "time 0.3"}));
    EXPECT_EQ(times("5:5:1"), (std::vector<std::string>{"time 5"}));
    EXPECT_EQ(times("0:99:1").size(), 100u);
    EXPECT_EQ(times("0:9.9:0.1").size(), 100u);
    for (const char* wrong :
         {"0:100:1", "0:10:0.1", "0:1:1e-300", "1:0:1", "0:1:0", "0:1", "a:b:c"})
        EXPECT_THROW(times(wrong), UsageError) << wrong;
}

}  // namespace
}  // namespace glint::study_over_test
