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

}  // namespace
}  // namespace glint::study_over_test
