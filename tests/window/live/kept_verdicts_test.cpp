// What passed its trial here before is known at the next start.
#include "window/live/kept_verdicts.h"

#include "../../base/test_folder.h"

#include <gtest/gtest.h>

namespace glint::kept_verdicts_test {
namespace {

namespace fs = std::filesystem;

class KeptVerdict : public ::testing::Test {
protected:
    KeptVerdict() {
        preset_.scene.text = "void mainImage(out vec4 c, in vec2 p) { c = vec4(1); }";
        preset_.time = 9.0;
    }
    // A run of the same text; what it knew.
    std::optional<Verdict> run(const Verdict& said, const char* driver = "any", int width = 320) {
        KeptVerdicts verdicts(folder_.path() / "trials", driver);
        const Candidate candidate{.preset = preset_,
                                  .compile = {},
                                  .size = {width, 180},
                                  .time = static_cast<double>(++runs_),
                                  .images = {}};
        std::optional<Verdict> known = verdicts.take(candidate);
        verdicts.keep(said);
        return known;
    }
    TestFolder folder_;
    Preset preset_;
    int runs_ = 0;
    const Verdict passed_{.state = TrialState::passed,
                          .passes = {{.name = "image", .first_ms = 400.0}},
                          .expected_ms = 30.0,
                          .total_ms = 900.0,
                          .diagnostics = {}};
};

TEST_F(KeptVerdict, IsThatOfTheSameTextDriverAndSizeAtAnyTime) {
    EXPECT_FALSE(run(passed_));
    const std::optional<Verdict> known = run(passed_);
    ASSERT_TRUE(known);
    EXPECT_EQ(known->state, TrialState::passed);
    EXPECT_EQ(known->expected_ms, 30.0);
    ASSERT_EQ(known->passes.size(), 1u);
    EXPECT_EQ(known->passes[0].name, "image");
    EXPECT_EQ(known->total_ms, 0.0) << "nobody waited this time";
    EXPECT_FALSE(run(passed_, "another"));
    EXPECT_FALSE(run(passed_, "any", 640));
    preset_.scene.text += " ";
    EXPECT_FALSE(run(passed_));
}

TEST_F(KeptVerdict, IsGoneWhereARunDidNotComeToKeepIt) {
    run(passed_);
    EXPECT_TRUE(run({}));
    EXPECT_FALSE(run(passed_));
}

TEST_F(KeptVerdict, OfWhatDidNotPassThereIsNone) {
    for (const TrialState state : {TrialState::running, TrialState::rejected, TrialState::too_slow,
                                   TrialState::unavailable}) {
        run({.state = state, .passes = {}, .diagnostics = {}});
        EXPECT_FALSE(run({}));
    }
}

TEST_F(KeptVerdict, ADamagedFileIsNone) {
    run(passed_);
    for (const auto& entry : fs::directory_iterator(folder_.path() / "trials"))
        fs::resize_file(entry.path(), 9);
    EXPECT_FALSE(run(passed_));
    EXPECT_TRUE(run(passed_)) << "it has been written anew";
}

}  // namespace
}  // namespace glint::kept_verdicts_test
