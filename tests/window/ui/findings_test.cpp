// Studies and checks under a mouse: a point applies its value, a failure tells how to see it again.
#include "screen.h"
#include "window/ui/diagram.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace glint::findings_test {
namespace {

ImVec2 at(const ImRect& rect, float x, float y = 0.5f) {
    return {rect.Min.x + x * rect.GetWidth(), rect.Min.y + y * rect.GetHeight()};
}

Tweak steps() {
    Tweak tweak;
    tweak.name = "steps";
    tweak.type = TweakType::int1;
    tweak.initial = {8};
    tweak.min = 1;
    tweak.max = 64;
    tweak.quality = true;
    return tweak;
}

// Twice the time for half the error.
Study halving() {
    Study study{.knob = "steps", .reference = "4096", .reference_error = Difference{.rmse = 1e-5}};
    double ms = 1.0, rmse = 0.08;
    for (const char* value : {"4", "8", "16", "32", "64"}) {
        study.rows.push_back({.value = value,
                              .error = Difference{.rmse = rmse},
                              .ms = {ms, 0.9 * ms, 1.2 * ms},
                              .pareto = true});
        ms *= 2.0;
        rmse *= 0.5;
    }
    return study;
}

class StudyPanel : public testing::Test {
protected:
    StudyPanel() {
        studies_ = {halving()};
        screen_.facts.studies = studies_;
        screen_.settings.study = true;
        for (int i = 0; i < 4; ++i) screen_.frame();
    }

    ImRect diagram() {
        const ImGuiWindow* body = screen_.window("Study/body");
        if (!body) return {};
        return screen_.find(ImHashStr("diagram", 0, body->ID), "Study").value_or(ImRect());
    }

    // The rows become joint settings, of which the preset's own has eight steps.
    void join_rows() {
        Study& study = studies_[0];
        study.knob = "quality";
        study.is_joint = true;
        for (StudyRow& row : study.rows) {
            row.is_preset = row.value == "8";
            row.value = "steps=" + row.value;
            row.pareto = false;
        }
    }

    ImRect slider() {
        screen_.frame();
        const ImGuiWindow* body = screen_.window("Study/body");
        if (!body) return {};
        return screen_.find(ImHashStr("##along", 0, body->ID), "Study").value_or(ImRect());
    }

    // Every place of the diagram that has a tooltip, clicked; the values that the tweak took.
    std::vector<double> click_all_points() {
        const ImRect rect = diagram();
        std::vector<double> values;
        for (float x = rect.Min.x; x < rect.Max.x; x += 8) {
            for (float y = rect.Min.y; y < rect.Max.y; y += 8) {
                screen_.move({x, y});
                if (!screen_.window("##Tooltip")) continue;
                screen_.click({x, y});
                const double value = screen_.tweaks.value(0)[0];
                if (values.empty() || values.back() != value) values.push_back(value);
            }
        }
        return values;
    }

    std::vector<Study> studies_;
    Screen screen_{{steps()}};
};

TEST_F(StudyPanel, AClickOnAPointAppliesItsValueAndUndoReturns) {
    EXPECT_EQ(click_all_points(), (std::vector<double>{4, 8, 16, 32, 64}));
    EXPECT_TRUE(screen_.changed);
    for (const double value : {32, 16, 8, 4, 8}) {
        EXPECT_TRUE(screen_.tweaks.undo());
        EXPECT_EQ(screen_.tweaks.value(0)[0], value);
    }
    EXPECT_FALSE(screen_.tweaks.can_undo());
}

TEST_F(StudyPanel, ALineOfTheTableDoesTheSame) {
    const ImGuiWindow* body = screen_.window("Study/body");
    ASSERT_TRUE(body);
    const ImRect rect = diagram();
    std::vector<double> values;
    for (float y = rect.Max.y + 40; y < body->Rect().Max.y; y += 10) {
        screen_.click({rect.Min.x + 100, y});
        const double value = screen_.tweaks.value(0)[0];
        if (value != 8 && (values.empty() || values.back() != value)) values.push_back(value);
    }
    EXPECT_EQ(values, (std::vector<double>{4, 16, 32, 64}));
}

TEST_F(StudyPanel, ARowWithoutAPictureHasNoPoint) {
    studies_[0].rows[1].failed = "it does not compile";
    studies_[0].rows[2].error.reset();
    screen_.tweaks.set(0, {4});
    EXPECT_EQ(click_all_points(), (std::vector<double>{4, 32, 64}));
}

TEST_F(StudyPanel, RunsTheKnobThatIsChosenAndCancels) {
    const ImGuiWindow* panel = screen_.window("Study");
    ASSERT_TRUE(panel);
    const auto run = screen_.find(ImHashStr("Run", 0, panel->ID), "Study");
    ASSERT_TRUE(run);
    screen_.click(at(*run, 0.5f));
    EXPECT_EQ(screen_.wishes.study, "");
    const auto menu = screen_.find(ImHashStr("##knob", 0, panel->ID), "Study");
    ASSERT_TRUE(menu);
    screen_.click(at(*menu, 0.5f));
    screen_.frame();
    const ImGuiWindow* list = screen_.window("##Combo");
    ASSERT_TRUE(list);
    screen_.click(at(list->Rect(), 0.5f, 0.75f));
    screen_.click(at(*run, 0.5f));
    EXPECT_EQ(screen_.wishes.study, "steps");
    screen_.facts.study_work = {.running = true, .done = 2, .of = 9};
    screen_.frame();
    const auto cancel = screen_.find(ImHashStr("Cancel", 0, panel->ID), "Study");
    ASSERT_TRUE(cancel);
    screen_.click(at(*cancel, 0.5f));
    EXPECT_TRUE(screen_.wishes.cancel_study);
}

// Joint settings, of which the clock tells none from another: the slider goes along the medians.
TEST_F(StudyPanel, OneDragTurnsAllTweaksAndIsOneStepOfUndo) {
    join_rows();
    studies_[0].rows[3].error->rmse = 0.5;  // slower and worse: no stop
    const ImRect along = slider();
    ASSERT_GT(along.GetWidth(), 0.0f);
    screen_.drag(at(along, 0.4f), at(along, 0.98f));
    EXPECT_EQ(screen_.tweaks.value(0)[0], 64);
    screen_.drag(at(along, 0.98f), at(along, 0.65f));
    EXPECT_EQ(screen_.tweaks.value(0)[0], 16) << "32 is slower than 16 and has more error";
    EXPECT_TRUE(screen_.tweaks.undo());
    EXPECT_EQ(screen_.tweaks.value(0)[0], 64);
    EXPECT_TRUE(screen_.tweaks.undo());
    EXPECT_EQ(screen_.tweaks.value(0)[0], 8);
    EXPECT_FALSE(screen_.tweaks.can_undo());
}

// The preset's own setting is no stop where another has less error in less time.
TEST_F(StudyPanel, AClickOnTheStopWhereTheHandleStandsSetsIt) {
    join_rows();
    for (StudyRow& row : studies_[0].rows)
        if (row.is_preset) row.error->rmse = 1.0;
    const ImRect along = slider();
    ASSERT_GT(along.GetWidth(), 0.0f);
    for (float x = 0.02f; x < 1.0f && screen_.tweaks.value(0)[0] == 8; x += 0.02f) {
        screen_.click(at(along, x));
        if (screen_.tweaks.value(0)[0] != 4) screen_.tweaks.undo();
        if (screen_.tweaks.value(0)[0] == 4) return;
    }
    FAIL() << "the stop before 8, on which the handle stands, was never set";
}

TEST_F(StudyPanel, ComparesThePictureOfTheRowThatWasClicked) {
    const ImGuiWindow* body = screen_.window("Study/body");
    ASSERT_TRUE(body);
    const auto wipe = screen_.find(ImHashStr("Wipe", 0, body->ID), "Study");
    ASSERT_TRUE(wipe);
    screen_.click(at(*wipe, 0.5f));
    EXPECT_EQ(screen_.settings.shown, Shown::wipe);
    EXPECT_EQ(screen_.settings.shown_row, 1u) << "the row at which the tweak stands";
    EXPECT_TRUE(screen_.window("wipe")) << "the handle";
    click_all_points();
    EXPECT_EQ(screen_.settings.shown_row, 4u);
}

TEST(Diagram, TicksAreRoundAndFew) {
    EXPECT_EQ(round_ticks(0.9, 12.0), (std::vector<double>{1, 2, 5, 10}));
    EXPECT_EQ(round_ticks(1e-6, 2e-1).size(), 6u);
    EXPECT_GE(round_ticks(10.0, 14.0).size(), 2u);
    EXPECT_TRUE(round_ticks(std::numeric_limits<double>::quiet_NaN(), 1.0).empty());
}

class CheckPanel : public testing::Test {
protected:
    CheckPanel() {
        cases_ = {{.name = "size 7x3",
                   .verdict = CaseVerdict::fail,
                   .note = "NaN in 3 pixels of image",
                   .reproduce = "glint still scene.frag --size 7x3",
                   .picture = "size.png"},
                  {.name = "age 1 s", .note = "moves"}};
        screen_.facts.cases = cases_;
        screen_.settings.check = true;
        for (int i = 0; i < 4; ++i) screen_.frame();
    }

    std::optional<ImRect> item(std::size_t index, const char* name) {
        const ImGuiWindow* body = screen_.window("Check/body");
        if (!body) return std::nullopt;
        const ImGuiID id = ImHashStr(cases_[index].name.c_str(), 0, body->ID);
        return screen_.find(ImHashStr(name, 0, id), "Check");
    }

    std::vector<CaseResult> cases_;
    Screen screen_{{steps()}};
};

TEST_F(CheckPanel, AClickOnAFailureShowsItsFrameAndItsCommandToCopy) {
    const auto line = item(0, "case");
    ASSERT_TRUE(line);
    screen_.click(at(*line, 0.5f));
    EXPECT_EQ(screen_.settings.shown, Shown::failure);
    EXPECT_EQ(screen_.settings.shown_case, "size 7x3");
    for (int i = 0; i < 4; ++i) screen_.frame();
    const auto copy = item(0, "Copy the command");
    ASSERT_TRUE(copy);
    screen_.click(at(*copy, 0.5f));
    EXPECT_STREQ(ImGui::GetClipboardText(), "glint still scene.frag --size 7x3");
    screen_.click(at(*line, 0.5f));
    EXPECT_EQ(screen_.settings.shown, Shown::scene) << "a second click puts it away";
}

TEST_F(CheckPanel, ACaseThatPassedLeavesTheSceneInTheView) {
    const auto line = item(1, "case");
    ASSERT_TRUE(line);
    screen_.click(at(*line, 0.5f));
    EXPECT_EQ(screen_.settings.shown, Shown::scene);
}

TEST_F(CheckPanel, RunsAndCancels) {
    const ImGuiWindow* panel = screen_.window("Check");
    ASSERT_TRUE(panel);
    const auto run = screen_.find(ImHashStr("Run", 0, panel->ID), "Check");
    ASSERT_TRUE(run);
    screen_.click(at(*run, 0.5f));
    EXPECT_TRUE(screen_.wishes.check);
    screen_.facts.check_work = {.running = true};
    screen_.frame();
    const auto cancel = screen_.find(ImHashStr("Cancel", 0, panel->ID), "Check");
    ASSERT_TRUE(cancel);
    screen_.click(at(*cancel, 0.5f));
    EXPECT_TRUE(screen_.wishes.cancel_check);
}

// What a study or a check of a broken scene may bring, in windows of any size.
TEST(Findings, StandWithExtremeNumbersAndTexts) {
    constexpr double kMost = std::numeric_limits<double>::max();
    constexpr double kLeast = std::numeric_limits<double>::denorm_min();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::vector<Study> studies(3);
    const auto error = [](double rmse, double psnr = 0.0) {
        return Difference{.rmse = rmse, .psnr = psnr};
    };
    studies[0].rows = {
        {.value = "\xff%s##", .error = error(kLeast, kInfinity), .ms = {kMost, 0, 0}},
        {.value = "", .error = error(kMost), .ms = {kLeast, 0, kInfinity}},
        {.value = std::string(3000, 'x'), .error = error(0.0), .ms = {1, 0, 0}}};
    studies[1] = {.knob = std::string(500, 'k'),
                  .reference_error = error(kInfinity),
                  .findings = {std::string(5000, 'f')}};
    studies[2].rows = {{.value = "1", .error = error(1.0), .ms = {5, 0, 0}, .pareto = true}};
    const std::vector<CaseResult> cases{{.name = std::string(4000, 'n')},
                                        {.name = "\xfe %d",
                                         .verdict = CaseVerdict::fail,
                                         .note = std::string(9000, 'w'),
                                         .reproduce = std::string(9000, 'r')}};
    for (const ImVec2 size : {ImVec2{40, 30}, {300, 2000}, {1280, 720}}) {
        for (std::size_t shown = 0; shown < 4; ++shown) {
            Screen screen({steps()}, size);
            screen.facts.studies = studies;
            screen.facts.cases = cases;
            screen.facts.study_work = {.running = true, .done = 5, .of = 3};
            screen.facts.check_work = {.problem = std::string(3000, 'p'), .stale = true};
            screen.settings.study = screen.settings.check = true;
            screen.settings.shown_study = shown;
            screen.settings.shown_row = shown;
            screen.settings.shown_case = cases[1].name;
            screen.settings.shown = static_cast<Shown>(shown);
            for (int i = 0; i < 8; ++i) {
                screen.interface.is_behind();
                screen.frame();
            }
            EXPECT_FALSE(screen.interface.is_behind()) << size.x << "x" << size.y;
        }
    }
}

}  // namespace
}  // namespace glint::findings_test
