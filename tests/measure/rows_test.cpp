// Rows of study and check on their way to JSON and back.
#include "measure/rows/case.h"
#include "measure/rows/study.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <limits>

namespace glint::rows_test {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// As the window gets it: a line of text.
Json through_text(const Json& json) {
    return Json::parse(json.dump());
}

// Every member is another than the default, and no number ends in decimals.
Study study() {
    return {.scene = "a.toml",
            .knob = "steps",
            .reference = "4096",
            .second = "8192",
            .reference_error = Difference{.rmse = 1e-5 / 3, .max = 0.1, .psnr = kInfinity},
            .own_error = 1e-5 / 7,
            .rival = RivalReference{.value = "march=steps",
                                    .difference = {.rmse = 0.1 / 9},
                                    .own_error = 0.1 / 11,
                                    .disagrees = true},
            .converges = false,
            .renderer = "llvmpipe",
            .machine = "two threads",
            .size = {64, 36},
            .pass = "light",
            .time_only = true,
            .clock = Clock::processor,
            .rows = {{.value = "4",
                      .wall = {.median = 1.0 / 3},
                      .gpu = {.median = 2.0 / 3},
                      .processor = {.median = 4.0 / 3},
                      .all_passes_ms = 0.7,
                      .error = Difference{.rmse = 0.1 / 3,
                                          .max = 0.3,
                                          .relative_mse = 0.01 / 7,
                                          .psnr = 28.1 / 3,
                                          .share_off = 1.0 / 7,
                                          .flip = 0.1 / 7},
                      .is_preset = true,
                      .is_reference = true,
                      .resumed = true,
                      .picture = "pictures/a.png",
                      .map = "pictures/a-map.png",
                      .flip_map = "pictures/a-flip.png",
                      .ms = {4.0 / 3, 1.1, 1.9, 1.0 / 7, 5.0 / 3},
                      .verdict = TimeVerdict::slower,
                      .nearer = true,
                      .pareto = true,
                      .near_reference = true},
                     {.value = "8", .failed = "diverged: 3 pixels are not finite"}},
            .order = 5.0 / 3,
            .cost_exponent = 1.0 / 7,
            .findings = {"it changes nothing"},
            .notes = {"left out: b"},
            .reference_picture = "pictures/r.png"};
}

TEST(StudyRows, ComeBackFromJsonAsTheyWere) {
    const Study found = study_from_json(through_text(to_json(study())));
    EXPECT_EQ(to_json(found).dump(), to_json(study()).dump());
    EXPECT_EQ(found.clock, Clock::processor);
    EXPECT_EQ(found.size, glm::ivec2(64, 36));
    ASSERT_EQ(found.rows.size(), 2u);
    EXPECT_EQ(found.rows[0].ms.max, 1.9);
    EXPECT_EQ(found.rows[0].ms.high, 5.0 / 3);
    EXPECT_EQ(found.rows[0].verdict, TimeVerdict::slower);
    EXPECT_FALSE(found.rows[1].verdict);
    ASSERT_TRUE(found.rows[0].error);
    EXPECT_EQ(found.rows[0].error->relative_mse, 0.01 / 7);
    EXPECT_EQ(found.rows[0].error->flip, 0.1 / 7);
    EXPECT_EQ(found.rows[1].failed, "diverged: 3 pixels are not finite");
}

TEST(StudyRows, WithoutOptionalFactsComeBackWithoutThem) {
    const Study found = study_from_json(through_text(to_json(Study{.rows = {StudyRow()}})));
    EXPECT_FALSE(found.reference_error || found.order || found.cost_exponent);
    EXPECT_FALSE(found.rows.at(0).error);
    EXPECT_EQ(found.reference_rmse(), 0.0);
}

TEST(StudyRows, EqualPicturesHaveAnInfinitePsnrOnBothSides) {
    const Json json = through_text(to_json(Difference{.psnr = kInfinity}));
    EXPECT_TRUE(json.at("psnr").is_null());
    EXPECT_EQ(difference_from_json(json).psnr, kInfinity);
}

// It may have been compared, but nothing follows from the pixels that are left.
TEST(StudyRows, OneThatFailedTellsOfNoError) {
    const Study study{.rows = {{.error = Difference{.rmse = 0.5}, .failed = "diverged"}}};
    EXPECT_TRUE(to_json(study).at("rows").at(0).at("rmse").is_null());
    EXPECT_FALSE(study_from_json(to_json(study)).rows.at(0).error);
}

TEST(StudyRows, WhatIsNoStudyIsRefused) {
    EXPECT_THROW(study_from_json(Json::object()), nlohmann::json::exception);
    Json json = to_json(study());
    json["rows"][0]["value"] = 3;
    EXPECT_THROW(study_from_json(json), nlohmann::json::exception);
}

TEST(CaseRows, ComeBackFromJsonAsTheyWere) {
    for (const CaseVerdict verdict :
         {CaseVerdict::fail, CaseVerdict::report, CaseVerdict::pass, CaseVerdict::skip}) {
        const CaseResult result{.name = "size 7x3",
                                .verdict = verdict,
                                .nan = 3,
                                .infinite = 4,
                                .min = -0.1f,
                                .max = 1e30f,
                                .note = "NaN",
                                .reproduce = "glint still",
                                .picture = "a.png"};
        const CaseResult found = case_from_json(through_text(to_json(result)));
        EXPECT_EQ(to_json(found).dump(), to_json(result).dump());
        EXPECT_EQ(found.verdict, verdict);
        EXPECT_EQ(found.min, -0.1f);
    }
    EXPECT_THROW(case_from_json(Json::object()), nlohmann::json::exception);
}

TEST(CaseRows, FailuresStandAboveAndThoseWithMorePixelsFirst) {
    const CaseResult worst{.name = "a", .verdict = CaseVerdict::fail, .nan = 1, .infinite = 5};
    const CaseResult bad{.name = "b", .verdict = CaseVerdict::fail, .nan = 5};
    const CaseResult fine{.name = "c", .nan = 100};
    EXPECT_TRUE(is_worse(worst, bad));
    EXPECT_TRUE(is_worse(bad, fine));
    EXPECT_FALSE(is_worse(fine, worst));
    EXPECT_FALSE(is_worse(bad, bad));
}

}  // namespace
}  // namespace glint::rows_test
