// What becomes of a saved text, state by state, without a window, GL or another process.
#include "window/live/reloader.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace glint::reloader_test {
namespace {

using enum ReloadState;
using enum ReloadEvent;

using Tried = std::pair<std::string, Programs>;

std::string words(const Diagnostics& diagnostics) {
    std::string all;
    for (const Diagnostic& diagnostic : diagnostics) all += diagnostic.text + ";";
    return all;
}

// The world that a reloader asks: a file with a text, a trial whose answer the test gives, and a
// screen. A preset's title stands for its text.
class Reloading : public testing::Test {
protected:
    static ReloadSteps steps_of(Reloading& world) {
        return {
            .read = [&world](const std::filesystem::path& file) { return world.read(file); },
            .watch = [&world](const ReadPreset&) { ++world.watched; },
            .has_uniforms = [&world](const Preset& preset) { return world.has_uniforms(preset); },
            .start_trial =
                [&world](const Preset& preset, Programs programs, bool) {
                    world.tried.emplace_back(preset.title, programs);
                    world.verdict = {.state = TrialState::running, .passes = {}, .diagnostics = {}};
                },
            .trial = [&world]() -> const Verdict& {
                ++world.asked;
                return world.verdict;
            },
            .put_in_place = [&world](const Preset& preset, Programs programs,
                                     bool) { return world.put(preset, programs); }};
    }

    // A title like that of the screen, but for what stands behind a colon, is fed.
    bool has_uniforms(const Preset& preset) const {
        const auto fixed = [](const std::string& title) {
            return title.substr(0, title.find(':'));
        };
        return is_prepared && fixed(preset.title) == fixed(screen);
    }

    ReadPreset read(const std::filesystem::path& file) {
        ReadPreset result;
        result.files = {file, "part.glsl"};
        if (text.empty()) {
            result.diagnostics = {{.place = {.file = file.string()}, .text = "is not there"}};
        } else {
            result.preset.emplace().title = text;
        }
        return result;
    }

    Diagnostics put(const Preset& preset, Programs programs) {
        states_while_placing.push_back(reloader.state());
        if (!refused_here.empty()) return {{.place = {}, .text = refused_here}};
        screen = preset.title;
        screens_programs = programs;
        return {};
    }

    void save(const std::string& now) {
        text = now;
        reloader.saved("scene.frag");
    }
    bool answer(TrialState state, double expected_ms = 1.0, const std::string& why = "") {
        verdict = {.state = state,
                   .passes = {},
                   .expected_ms = expected_ms,
                   .total_ms = 7.0,
                   .diagnostics = {}};
        if (!why.empty()) verdict.diagnostics = {{.place = {}, .text = why}};
        return reloader.follow();
    }
    // The window opens on this, and has drawn it.
    void open_and_draw(const std::string& first) {
        text = first;
        reloader.open("scene.frag");
        ASSERT_TRUE(answer(TrialState::passed));
        reloader.drawn(2.0);
        ASSERT_EQ(screen, first);
        ASSERT_EQ(reloader.report_count(), 1u);
    }
    // A slider is moved; the window draws with uniforms.
    void move() {
        reloader.tweaks_moved();
        reloader.uses_uniforms();
        screens_programs = Programs::uniforms;
    }
    void rest() {
        Preset drawn;
        drawn.title = screen;
        reloader.tweaks_rest(drawn);
    }
    const ReloadReport& last() const { return reloader.reports().back(); }

    bool is_prepared = false;
    std::string text = "first", refused_here;
    int watched = 0, asked = 0;
    std::vector<Tried> tried;
    Verdict verdict;
    std::string screen;
    Programs screens_programs = Programs::uniforms;
    std::vector<ReloadState> states_while_placing;
    Reloader reloader{steps_of(*this)};
};

TEST(ReloadStates, GoWhereTheTableSays) {
    struct Case {
        ReloadState state;
        ReloadEvent event;
        ReloadState then;
    };
    const Case cases[] = {
        {idle, read, trying_text},
        {idle, unreadable, idle},
        {idle, rested, trying_constants},
        {trying_text, read, trying_text},
        {trying_text, unreadable, idle},
        {trying_text, moved, trying_text},
        {trying_text, passed, placing_text},
        {trying_text, refused, idle},
        {placing_text, placed, idle},
        {placing_text, refused, idle},
        {trying_constants, read, trying_text},
        {trying_constants, unreadable, idle},
        {trying_constants, moved, idle},
        {trying_constants, passed, placing_constants},
        {trying_constants, refused, idle},
        {placing_constants, placed, idle},
        {placing_constants, refused, idle},
    };
    for (const Case& c : cases)
        EXPECT_EQ(next(c.state, c.event), c.then)
            << name_of(c.state) << " " << static_cast<int>(c.event);
}

// Compiling here holds the thread that hears of saves; constants wait for a text.
TEST(ReloadStates, NothingComesBetweenWhileItIsPutInPlace) {
    for (const ReloadState placing : {placing_text, placing_constants})
        for (const ReloadEvent event : {read, unreadable, passed, moved, rested})
            EXPECT_EQ(next(placing, event), std::nullopt) << name_of(placing);
    EXPECT_EQ(next(trying_text, rested), std::nullopt);
    EXPECT_EQ(next(idle, passed), std::nullopt);
    EXPECT_EQ(next(idle, placed), std::nullopt);
}

TEST_F(Reloading, AGoodSaveIsTriedPlacedAndToldOfWithItsFirstFrame) {
    open_and_draw("first");
    save("second");
    EXPECT_EQ(reloader.state(), trying_text);
    EXPECT_EQ(tried.back(), Tried("second", Programs::constants)) << "compiled sooner";
    EXPECT_FALSE(reloader.follow()) << "no answer yet";
    EXPECT_EQ(screen, "first");
    EXPECT_TRUE(answer(TrialState::passed));
    EXPECT_EQ(states_while_placing.back(), placing_text);
    EXPECT_EQ(reloader.state(), idle);
    EXPECT_EQ(screen, "second");
    EXPECT_EQ(reloader.as_written()->title, "second");
    EXPECT_TRUE(reloader.has_unseen());
    EXPECT_EQ(reloader.report_count(), 1u) << "nobody has seen it yet";
    reloader.drawn(3.0);
    EXPECT_EQ(reloader.report_count(), 2u);
    EXPECT_TRUE(last().shown);
    EXPECT_EQ(last().trial_ms, 7.0);
    EXPECT_EQ(last().first_frame_ms, 3.0);
    reloader.drawn(3.0);
    EXPECT_EQ(reloader.report_count(), 2u) << "the next frame is no news";
}

TEST_F(Reloading, ASaveDuringATrialTakesItsPlace) {
    open_and_draw("first");
    save("second");
    save("third");
    EXPECT_EQ(reloader.state(), trying_text);
    EXPECT_EQ(tried.back().first, "third");
    EXPECT_TRUE(answer(TrialState::passed));
    reloader.drawn(1.0);
    EXPECT_EQ(screen, "third");
    EXPECT_EQ(states_while_placing.size(), 2u) << "the second never came to the screen";
    EXPECT_EQ(reloader.report_count(), 2u) << "nor to a report";
}

TEST_F(Reloading, TwoSavesWithinAMillisecondAreTwoReadingsAndTheLastOneIsShown) {
    open_and_draw("first");
    for (int i = 0; i < 2; ++i) save("twice " + std::to_string(i));
    EXPECT_EQ(tried.size(), 3u);
    EXPECT_TRUE(answer(TrialState::passed));
    EXPECT_EQ(screen, "twice 1");
}

// The thread is in the driver then; the watcher tells afterwards.
TEST_F(Reloading, ASaveDuringACompileIsReadAfterIt) {
    open_and_draw("first");
    save("second");
    text = "third";  // saved while the second is compiled
    EXPECT_TRUE(answer(TrialState::passed));
    EXPECT_EQ(screen, "second");
    reloader.saved("scene.frag");
    EXPECT_EQ(reloader.state(), trying_text);
    reloader.drawn(1.0);
    EXPECT_TRUE(last().shown) << "the second: the third is still tried";
    EXPECT_EQ(last().trial_ms, 7.0) << "and not a report of the third, which had no trial yet";
    EXPECT_TRUE(answer(TrialState::passed));
    reloader.drawn(1.0);
    EXPECT_EQ(screen, "third");
    EXPECT_EQ(reloader.report_count(), 3u);
}

TEST_F(Reloading, AFailureKeepsThePictureAndAGoodSaveFollows) {
    open_and_draw("first");
    save("broken");
    EXPECT_FALSE(answer(TrialState::rejected, 0.0, "expected ';'"));
    EXPECT_EQ(reloader.state(), idle);
    EXPECT_EQ(screen, "first");
    EXPECT_TRUE(reloader.shows_older_text());
    EXPECT_FALSE(last().shown);
    EXPECT_TRUE(last().text.starts_with("scene.frag: not shown, 1 error; read ")) << last().text;
    EXPECT_EQ(words(reloader.diagnostics()), "expected ';';");
    EXPECT_EQ(reloader.as_written()->title, "first");

    save("mended");
    EXPECT_TRUE(reloader.shows_older_text()) << "until it is judged";
    EXPECT_TRUE(answer(TrialState::passed));
    EXPECT_FALSE(reloader.shows_older_text());
    EXPECT_EQ(screen, "mended");
    EXPECT_TRUE(reloader.diagnostics().empty());
}

TEST_F(Reloading, EveryWayOfNotPassingIsARefusal) {
    open_and_draw("first");
    for (const TrialState state : {TrialState::rejected, TrialState::too_slow, TrialState::crashed,
                                   TrialState::lost, TrialState::idle}) {
        save("bad");
        EXPECT_FALSE(answer(state, 0.0, "why"));
        EXPECT_EQ(reloader.state(), idle);
        EXPECT_TRUE(reloader.shows_older_text());
        EXPECT_EQ(screen, "first");
    }
    EXPECT_EQ(reloader.report_count(), 6u);
}

TEST_F(Reloading, ATrialThatHangsIsRefusedAndHeardOnAfterwards) {
    open_and_draw("first");
    save("endless");
    for (int i = 0; i < 10; ++i) EXPECT_FALSE(reloader.follow());
    EXPECT_EQ(reloader.state(), trying_text);
    EXPECT_FALSE(answer(TrialState::too_slow, 0.0, "no frame within 2 s"));
    EXPECT_EQ(words(reloader.diagnostics()), "no frame within 2 s;");
    const int before = asked;
    EXPECT_FALSE(reloader.follow());
    EXPECT_EQ(asked, before + 1) << "a new process says that it is ready: it wants to be heard";
    EXPECT_EQ(reloader.report_count(), 2u);
}

TEST_F(Reloading, AHopelesslySlowSceneIsRefusedThoughItPassed) {
    open_and_draw("first");
    save("slow");
    EXPECT_FALSE(answer(TrialState::passed, 12'000.0));
    EXPECT_EQ(words(reloader.diagnostics()),
              "a frame would take about 12 s; make it cheaper, or lower the resolution;");
    EXPECT_EQ(screen, "first");
}

TEST_F(Reloading, AWarningOfSlownessGoesOnceFramesAreQuickAndOthersStay) {
    open_and_draw("first");
    save("slow");
    EXPECT_TRUE(answer(TrialState::passed, 1'300.0, "about 1.3 s a frame"));
    reloader.tell({.place = {}, .text = "another"});
    EXPECT_EQ(words(reloader.diagnostics()), "about 1.3 s a frame;another;");
    reloader.forget_slowness();
    EXPECT_EQ(words(reloader.diagnostics()), "another;");
    save("quick");
    EXPECT_TRUE(answer(TrialState::passed, 20.0, "a warning of the compiler"));
    reloader.forget_slowness();
    EXPECT_EQ(words(reloader.diagnostics()), "a warning of the compiler;");
}

TEST_F(Reloading, WithoutASecondProcessItGoesOnWithAWarning) {
    open_and_draw("first");
    save("second");
    EXPECT_TRUE(answer(TrialState::unavailable, 0.0, "no second context"));
    EXPECT_EQ(screen, "second");
    EXPECT_EQ(words(reloader.diagnostics()), "no second context;");
}

TEST_F(Reloading, WhatPassesThereAndFailsHereIsRefused) {
    open_and_draw("first");
    save("second");
    refused_here = "no memory";
    EXPECT_FALSE(answer(TrialState::passed));
    EXPECT_EQ(reloader.state(), idle);
    EXPECT_TRUE(reloader.shows_older_text());
    EXPECT_EQ(words(reloader.diagnostics()), "no memory;");
    EXPECT_FALSE(last().shown);
}

TEST_F(Reloading, APresetSavedWhileItsSceneIsTriedIsReadWithIt) {
    open_and_draw("first");
    save("scene edited");
    text = "scene edited, look edited";
    reloader.saved("look.toml");
    EXPECT_EQ(tried.back().first, "scene edited, look edited");
    EXPECT_TRUE(answer(TrialState::passed));
    reloader.drawn(1.0);
    EXPECT_EQ(last().file, "look.toml");
    EXPECT_EQ(reloader.report_count(), 2u);
}

TEST_F(Reloading, AFileThatVanishesIsRefusedAndMayReturn) {
    open_and_draw("first");
    save("");
    EXPECT_EQ(reloader.state(), idle);
    EXPECT_EQ(tried.size(), 1u) << "there is nothing to try";
    EXPECT_TRUE(reloader.shows_older_text());
    EXPECT_TRUE(reloader.is_read_from("part.glsl")) << "followed, to see it return";
    EXPECT_EQ(watched, 2);
    save("back");
    EXPECT_TRUE(answer(TrialState::passed));
    EXPECT_EQ(screen, "back");
}

TEST_F(Reloading, ACandidateThatIsAbandonedIsNeverShownButHeard) {
    open_and_draw("first");
    save("second");
    save("");  // its file goes while it is tried
    EXPECT_EQ(reloader.state(), idle);
    const int before = asked;
    EXPECT_FALSE(answer(TrialState::passed)) << "the answer to what nobody waits for";
    EXPECT_GT(asked, before);
    EXPECT_EQ(screen, "first");
    EXPECT_EQ(reloader.report_count(), 2u);
}

TEST_F(Reloading, WhatIsNotThereAtTheStartComesLater) {
    text = "";
    reloader.open("scene.frag");
    EXPECT_EQ(reloader.state(), idle);
    EXPECT_EQ(reloader.as_written(), nullptr);
    save("there");
    EXPECT_TRUE(answer(TrialState::passed));
    EXPECT_EQ(reloader.as_written()->title, "there");
}

TEST_F(Reloading, AnotherFileTakesThePlaceOfOneThatIsTried) {
    open_and_draw("first");
    save("second");
    text = "other";
    reloader.open("other.frag");
    EXPECT_EQ(reloader.as_written(), nullptr) << "it has not been shown yet";
    EXPECT_EQ(screen, "first");
    EXPECT_TRUE(answer(TrialState::passed));
    EXPECT_EQ(screen, "other");
    reloader.drawn(1.0);
    EXPECT_EQ(last().file, "other.frag");
}

TEST_F(Reloading, RestingTweaksBecomeConstantsWithoutAReport) {
    open_and_draw("first");
    EXPECT_FALSE(reloader.wants_constants()) << "a text begins with them";
    move();
    EXPECT_TRUE(reloader.wants_constants());
    rest();
    EXPECT_EQ(reloader.state(), trying_constants);
    EXPECT_EQ(tried.back(), Tried("first", Programs::constants));
    EXPECT_FALSE(answer(TrialState::passed)) << "no new text";
    EXPECT_EQ(states_while_placing.back(), placing_constants);
    EXPECT_EQ(screens_programs, Programs::constants);
    EXPECT_EQ(reloader.programs(), Programs::constants);
    EXPECT_FALSE(reloader.wants_constants());
    EXPECT_FALSE(reloader.has_unseen());
    EXPECT_EQ(reloader.report_count(), 1u);
}

TEST_F(Reloading, ATweakThatMovesAbandonsConstantsAndTheyAreTriedAgain) {
    open_and_draw("first");
    move();
    rest();
    reloader.tweaks_moved();
    EXPECT_EQ(reloader.state(), idle);
    EXPECT_FALSE(answer(TrialState::passed));
    EXPECT_EQ(screens_programs, Programs::uniforms) << "those were other values";
    rest();
    EXPECT_EQ(reloader.state(), trying_constants);
}

TEST_F(Reloading, ATweakThatMovesLeavesATextOnTrial) {
    open_and_draw("first");
    save("second");
    reloader.tweaks_moved();
    EXPECT_EQ(reloader.state(), trying_text);
    rest();
    EXPECT_EQ(reloader.state(), trying_text) << "constants wait for the text";
    EXPECT_EQ(tried.back(), Tried("second", Programs::constants));
}

TEST_F(Reloading, ConstantsThatAreRefusedAreLeftUntilATweakMoves) {
    for (const bool here : {false, true}) {
        open_and_draw("first");
        move();
        if (here) refused_here = "not compiled";
        rest();
        answer(here ? TrialState::passed : TrialState::too_slow, 0.0, "not for anybody's eyes");
        EXPECT_EQ(reloader.programs(), Programs::uniforms_for_good);
        EXPECT_FALSE(reloader.shows_older_text());
        EXPECT_TRUE(reloader.diagnostics().empty()) << words(reloader.diagnostics());
        rest();
        EXPECT_EQ(reloader.state(), idle);
        reloader.tweaks_moved();
        EXPECT_TRUE(reloader.wants_constants());
        refused_here.clear();
        reloader = Reloader(steps_of(*this));
    }
}

TEST_F(Reloading, ASaveTakesThePlaceOfConstantsOnTrial) {
    open_and_draw("first");
    move();
    rest();
    save("second");
    EXPECT_EQ(reloader.state(), trying_text);
    EXPECT_TRUE(answer(TrialState::passed));
    EXPECT_EQ(reloader.programs(), Programs::constants);
    EXPECT_EQ(screen, "second");
}

TEST_F(Reloading, ATextThatProgramsAtHandCanDrawIsTriedWithTheseAndBecomesConstantsLater) {
    open_and_draw("first: 1");
    is_prepared = true;
    save("first: 2");
    EXPECT_EQ(tried.back(), Tried("first: 2", Programs::uniforms));
    EXPECT_TRUE(answer(TrialState::passed));
    EXPECT_EQ(screen, "first: 2");
    EXPECT_EQ(screens_programs, Programs::uniforms);
    EXPECT_TRUE(reloader.wants_constants());
    rest();
    EXPECT_EQ(tried.back(), Tried("first: 2", Programs::constants));
    answer(TrialState::passed);
    EXPECT_EQ(reloader.programs(), Programs::constants);
}

TEST_F(Reloading, ATextThatProgramsAtHandCannotDrawIsTriedAsConstants) {
    open_and_draw("first: 1");
    is_prepared = true;
    save("second: 1");
    EXPECT_EQ(tried.back(), Tried("second: 1", Programs::constants));
}

TEST_F(Reloading, WhatProgramsAtHandDrawMayBeRefusedLikeAnyText) {
    open_and_draw("first: 1");
    is_prepared = true;
    save("first: endless");
    EXPECT_FALSE(answer(TrialState::too_slow, 0.0, "no frame within 2 s"));
    EXPECT_EQ(screen, "first: 1");
    EXPECT_TRUE(reloader.shows_older_text());
}

TEST_F(Reloading, WhoWantsNoConstantsIsAskedForNone) {
    reloader = Reloader(steps_of(*this), {.constants = false});
    open_and_draw("first");
    rest();
    reloader.tweaks_moved();
    rest();
    EXPECT_EQ(reloader.state(), idle);
    EXPECT_EQ(reloader.programs(), Programs::uniforms_for_good);
}

TEST_F(Reloading, AnInputBeforeTheFirstFrameIsPartOfTheTextsReport) {
    text = "first";
    reloader.open("scene.frag");
    answer(TrialState::passed);
    reloader.input_arrived({.file = "paint.png", .read_ms = 1.0, .text = {}});
    reloader.drawn(1.0);
    EXPECT_EQ(reloader.report_count(), 1u);
    EXPECT_EQ(last().file, "scene.frag");
    reloader.input_arrived({.file = "paint.png", .read_ms = 1.0, .text = {}});
    EXPECT_TRUE(reloader.has_unseen());
    reloader.drawn(1.0);
    EXPECT_EQ(last().file, "paint.png") << "later it has its own";
}

TEST_F(Reloading, AnInputThatComesDuringATrialLeavesTheTextsReportAlone) {
    open_and_draw("first");
    save("second");
    reloader.input_arrived({.file = "paint.png", .read_ms = 1.0, .text = {}});
    reloader.drawn(1.0);
    EXPECT_EQ(last().file, "paint.png");
    EXPECT_TRUE(answer(TrialState::passed));
    reloader.drawn(1.0);
    EXPECT_EQ(last().file, "scene.frag");
}

TEST_F(Reloading, AnInputThatCannotBeReadIsToldOnceItIsMissedAndForgottenOnceItIsThere) {
    open_and_draw("first");
    const Diagnostic missing{
        .place = {.file = "scene.frag", .line = 3}, .text = "cannot be read", .missing_file = true};
    reloader.input_failed({.file = "paint.png", .text = {}}, missing);
    EXPECT_EQ(last().file, "paint.png");
    EXPECT_FALSE(last().shown);
    EXPECT_FALSE(reloader.shows_older_text()) << "the text is right";
    EXPECT_EQ(words(reloader.diagnostics()), "cannot be read;");
    reloader.forget_missing_file("another");
    EXPECT_EQ(reloader.diagnostics().size(), 1u);
    reloader.forget_missing_file("cannot be read");
    EXPECT_TRUE(reloader.diagnostics().empty());
}

TEST_F(Reloading, OnlyTheLastHundredReportsAreKept) {
    open_and_draw("first");
    for (int i = 0; i < 150; ++i) save("");
    EXPECT_EQ(reloader.reports().size(), 100u);
    EXPECT_EQ(reloader.report_count(), 151u);
}

}  // namespace
}  // namespace glint::reloader_test
