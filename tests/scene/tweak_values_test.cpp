// What a person does to values, two sets of them, random looks, and what a reload makes of them.
#include "scene/tweak_values.h"

#include "base/words.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <set>

namespace glint::tweak_values_test {
namespace {

Tweak slider(std::string name, double initial, double min, double max) {
    Tweak tweak;
    tweak.name = std::move(name);
    tweak.initial = {initial};
    tweak.min = min;
    tweak.max = max;
    return tweak;
}

Tweak menu(std::string name, double initial, std::vector<std::string> names) {
    Tweak tweak;
    tweak.name = std::move(name);
    tweak.type = TweakType::int1;
    tweak.initial = {initial};
    tweak.names = std::move(names);
    return tweak;
}

Tweak of_type(std::string name, TweakType type, TweakValue initial = {}) {
    Tweak tweak;
    tweak.name = std::move(name);
    tweak.type = type;
    tweak.initial = initial;
    return tweak;
}

Tweak colour(std::string name, const char* text) {
    Tweak tweak = of_type(std::move(name), TweakType::vec3);
    tweak.is_colour = true;
    tweak.initial = *parse_value(tweak, text);
    return tweak;
}

Tweak with_log(Tweak tweak) {
    tweak.log = true;
    return tweak;
}

Tweak with_step(Tweak tweak, double step) {
    tweak.step = step;
    return tweak;
}

std::vector<std::uint64_t> bits(const TweakValue& value) {
    std::vector<std::uint64_t> all;
    for (const double component : value) all.push_back(std::bit_cast<std::uint64_t>(component));
    return all;
}

using Tweaks = std::vector<Tweak>;

const Tweaks kSea = {slider("waves", 0.5, 0, 1), slider("wind", 3, 0, 20),
                     colour("tint", "#0b3a53"), menu("mirrors", 1, {"off", "traced"}),
                     of_type("fog", TweakType::bool1)};

TEST(Tidy, GivesTheShortestNumberThatTheShaderCannotTellApart) {
    const Tweak any = of_type("x", TweakType::float1);
    const Tweak third = slider("x", 0, 0, 1.0 / 3);
    struct Case {
        const Tweak& tweak;
        double value, tidied;
    };
    const Case cases[] = {
        {any, static_cast<double>(0.3f), 0.3},
        {any, 0.3, 0.3},
        {any, 1.0 / 3, 0.33333334},
        {any, 16777216.0, 16777216.0},
        {any, 1e300, static_cast<double>(std::numeric_limits<float>::max())},
        {any, 5e-324, 0.0},
        {third, 1.0 / 3, 1.0 / 3},
        {third, 0.9, 1.0 / 3},
    };
    for (const Case& c : cases) {
        const TweakValue tidied = tidy(c.tweak, {c.value});
        EXPECT_EQ(tidied[0], c.tidied) << c.value;
        EXPECT_EQ(tidy(c.tweak, tidied), tidied) << "twice is once";
    }
}

TEST(Tidy, AColourPickedInFloatsIsWrittenAsAColour) {
    const Tweak tint = colour("tint", "#0b3a53");
    for (int byte = 0; byte < 256; ++byte) {
        const double picked = static_cast<float>(byte) / 255.0f;
        const TweakValue tidied = tidy(tint, {picked, 0.5, 1.0});
        EXPECT_EQ(tidied[0], byte / 255.0);
        EXPECT_EQ(tidied[1], 0.5);
    }
}

TEST(Rebase, AValueFollowsItsNameThroughAReload) {
    struct Case {
        const char* what;
        Tweak before, after;
        double value, expected;
    };
    const Case cases[] = {
        {"nothing changed", slider("a", 0.5, 0, 1), slider("a", 0.5, 0, 1), 0.7, 0.7},
        {"a narrower range clamps", slider("a", 0.5, 0, 1), slider("a", 0.5, 0, 0.6), 0.7, 0.6},
        {"a wider range does not", slider("a", 0.5, 0, 1), slider("a", 0.5, -9, 9), 0.7, 0.7},
        {"a new default moves it there", slider("a", 0.5, 0, 1), slider("a", 0.2, 0, 1), 0.5, 0.2},
        {"but not from elsewhere", slider("a", 0.5, 0, 1), slider("a", 0.2, 0, 1), 0.7, 0.7},
        {"the default as a float is it too", slider("a", 2.0 / 3, 0, 1), slider("a", 0.2, 0, 1),
         0.6666667, 0.2},
        {"another type resets", slider("a", 0.5, 0, 1), of_type("a", TweakType::int1, {4}), 0.7, 4},
        {"an option keeps its name", menu("a", 0, {"off", "traced"}),
         menu("a", 0, {"off", "screen", "traced"}), 1, 2},
        {"an option that is gone resets", menu("a", 0, {"off", "traced"}),
         menu("a", 0, {"off", "screen"}), 1, 0},
        {"a menu made of a number clamps", of_type("a", TweakType::int1),
         menu("a", 0, {"off", "on"}), 7, 1},
    };
    for (const Case& c : cases) {
        EXPECT_EQ(rebased(c.before, {c.value}, c.after)[0], c.expected) << c.what;
        TweakValues tweaks(std::span(&c.before, 1), std::vector<TweakValue>{{c.value}});
        tweaks.rebase(std::span(&c.after, 1));
        EXPECT_EQ(tweaks.value(0)[0], c.expected) << c.what;
    }
}

TEST(Rebase, ATweakThatAppearsHasWhatThePresetSaysOfIt) {
    TweakValues tweaks(Tweaks{kSea[0]});
    std::vector<TweakValue> written = TweakValues(kSea).values();
    written[1] = {9};
    tweaks.rebase(kSea, written);
    EXPECT_EQ(tweaks.values(TweakSet::a)[1][0], 9.0);
    EXPECT_EQ(tweaks.values(TweakSet::b)[1][0], 9.0);
    Tweaks of_another_type = kSea;
    of_another_type[1] = of_type("wind", TweakType::int1, {4});
    written[1] = {2};
    tweaks.rebase(of_another_type, written);
    EXPECT_EQ(tweaks.value(1)[0], 2.0);
}

TEST(Rebase, AnUntouchedTweakThatComesBackHasWhatTheFileSaysByThen) {
    std::vector<TweakValue> written = TweakValues(kSea).values();
    written[1] = {9};
    TweakValues tweaks(kSea, written);
    tweaks.rebase(Tweaks{kSea[0]});
    EXPECT_TRUE(tweaks.waiting().empty());
    written[1] = {2};
    tweaks.rebase(kSea, written);
    EXPECT_EQ(tweaks.value(1)[0], 2.0);
}

TEST(Rebase, ATweakThatComesBackHasItsValueAndLockAgain) {
    TweakValues tweaks(kSea);
    tweaks.set(1, {7});
    tweaks.lock(1, true);
    const Tweaks without = {kSea[0]};
    tweaks.rebase(without);
    EXPECT_EQ(tweaks.values().size(), 1u);
    tweaks.rebase(without);
    tweaks.rebase(kSea);
    EXPECT_EQ(tweaks.value(1)[0], 7.0);
    EXPECT_TRUE(tweaks.locked(1));
}

TEST(Rebase, BothSetsAreCarriedOver) {
    TweakValues tweaks(kSea);
    tweaks.set(0, {0.75});
    tweaks.show(TweakSet::b);
    tweaks.set(1, {7});
    Tweaks after = kSea;
    after[0].initial = {0.25};
    std::swap(after[0], after[1]);
    tweaks.rebase(after);
    EXPECT_EQ(tweaks.values(TweakSet::a)[1][0], 0.75);
    EXPECT_EQ(tweaks.values(TweakSet::b)[1][0], 0.25);
    EXPECT_EQ(tweaks.values(TweakSet::a)[0][0], 3.0);
    EXPECT_EQ(tweaks.values(TweakSet::b)[0][0], 7.0);
}

TEST(TweakValues, StartsWithThePresetsValuesOrTheDefaults) {
    EXPECT_EQ(TweakValues(kSea).values()[1][0], 3.0);
    std::vector<TweakValue> values = TweakValues(kSea).values();
    values[1] = {1.0 / 3};
    EXPECT_EQ(TweakValues(kSea, values).values(), values);
    EXPECT_TRUE(TweakValues(kSea, values).changed(1));
    EXPECT_FALSE(TweakValues(kSea, values).can_undo());
}

TEST(TweakValues, UndoIsExactToTheBit) {
    const double starts[] = {0.0, -0.0, 0.1, 1.0 / 3, 5e-324, 19.999999999999996};
    for (const double start : starts) {
        const std::vector<TweakValue> values = {{0.5}, {start}, kSea[2].initial, {1}, {0}};
        TweakValues tweaks(kSea, values);
        tweaks.set(1, {12.3});
        ASSERT_TRUE(tweaks.undo());
        EXPECT_EQ(bits(tweaks.value(1)), bits({start}));
        ASSERT_TRUE(tweaks.redo());
        EXPECT_EQ(tweaks.value(1)[0], 12.3);
    }
}

TEST(TweakValues, ADragIsOneEntry) {
    TweakValues tweaks(kSea);
    tweaks.set(1, {1});
    tweaks.begin();
    for (int k = 0; k < 100; ++k) tweaks.set(0, {k / 100.0});
    EXPECT_FALSE(tweaks.undo()) << "not while the mouse is down";
    EXPECT_FALSE(tweaks.can_undo());
    tweaks.commit();
    EXPECT_EQ(tweaks.value(0)[0], 0.99);
    ASSERT_TRUE(tweaks.undo());
    EXPECT_EQ(tweaks.value(0)[0], 0.5);
    EXPECT_EQ(tweaks.value(1)[0], 1.0);
    ASSERT_TRUE(tweaks.undo());
    EXPECT_EQ(tweaks.value(1)[0], 3.0);
    EXPECT_FALSE(tweaks.undo());
}

TEST(TweakValues, WhatChangesNothingIsNoEntry) {
    TweakValues tweaks(kSea);
    tweaks.begin();
    tweaks.commit();
    tweaks.set(0, {0.5});
    tweaks.reset_all();
    tweaks.begin();
    tweaks.set(0, {0.9});
    tweaks.set(0, {0.5});
    tweaks.commit();
    tweaks.commit();
    EXPECT_FALSE(tweaks.can_undo());
}

TEST(TweakValues, ACancelledDragLeavesNothingBehind) {
    TweakValues tweaks(kSea);
    tweaks.begin();
    tweaks.set(0, {0.9});
    tweaks.set(1, {9});
    tweaks.cancel();
    EXPECT_FALSE(tweaks.any_changed());
    EXPECT_FALSE(tweaks.can_undo());
}

TEST(TweakValues, ANewChangeCutsTheRedo) {
    TweakValues tweaks(kSea);
    tweaks.set(0, {0.1});
    tweaks.set(0, {0.2});
    tweaks.undo();
    tweaks.set(1, {5});
    EXPECT_FALSE(tweaks.can_redo());
    tweaks.undo();
    EXPECT_EQ(tweaks.value(0)[0], 0.1);
}

TEST(TweakValues, KeepsTheLastThousandEntries) {
    TweakValues tweaks(kSea);
    for (int k = 1; k <= 1500; ++k) tweaks.set(1, {k / 100.0});
    int undone = 0;
    while (tweaks.undo()) ++undone;
    EXPECT_EQ(undone, 1000);
    EXPECT_EQ(tweaks.value(1)[0], 5.0);
}

TEST(TweakValues, ResetsOneOrAllAsOneEntry) {
    TweakValues tweaks(kSea);
    tweaks.set(0, {0.9});
    tweaks.set(1, {9});
    EXPECT_TRUE(tweaks.changed(0));
    tweaks.reset(0);
    EXPECT_FALSE(tweaks.changed(0));
    EXPECT_TRUE(tweaks.any_changed());
    tweaks.undo();
    tweaks.reset_all();
    EXPECT_FALSE(tweaks.any_changed());
    tweaks.undo();
    EXPECT_EQ(tweaks.value(0)[0], 0.9);
    EXPECT_EQ(tweaks.value(1)[0], 9.0);
}

TEST(TweakValues, SettingClampsToTheRange) {
    TweakValues tweaks(kSea);
    tweaks.set(1, {99});
    EXPECT_EQ(tweaks.value(1)[0], 20.0);
    tweaks.set(3, {0.4});
    EXPECT_EQ(tweaks.value(3)[0], 0.0);
    tweaks.set(1, {std::nan("")});
    EXPECT_EQ(tweaks.value(1)[0], 3.0);
}

TEST(TweakValues, UndoReachesOverReloads) {
    TweakValues tweaks(kSea);
    tweaks.set(0, {0.9});
    tweaks.set(1, {9});
    const Tweaks after = {slider("new", 1, 0, 2), slider("waves", 0.5, 0, 0.6)};
    tweaks.rebase(after);
    EXPECT_EQ(tweaks.value(1)[0], 0.6);
    ASSERT_TRUE(tweaks.undo()) << "passes over wind, which is gone";
    EXPECT_EQ(tweaks.value(1)[0], 0.5);
    EXPECT_FALSE(tweaks.undo());
    tweaks.rebase(kSea);
    EXPECT_EQ(tweaks.value(1)[0], 3.0) << "was undone while it was away";
    ASSERT_TRUE(tweaks.redo());
    EXPECT_EQ(tweaks.value(0)[0], 0.9) << "the value itself, now that the range allows it";
    ASSERT_TRUE(tweaks.redo());
    EXPECT_EQ(tweaks.value(1)[0], 9.0);
}

TEST(TweakValues, UndoPassesOverAnotherType) {
    TweakValues tweaks(kSea);
    tweaks.set(1, {9});
    Tweaks after = kSea;
    after[1] = of_type("wind", TweakType::vec2, {1, 2});
    tweaks.rebase(after);
    EXPECT_FALSE(tweaks.undo());
    EXPECT_EQ(tweaks.value(1), (TweakValue{1, 2}));
}

TEST(TweakValues, UndoOfAMenuFollowsTheOption) {
    TweakValues tweaks(kSea);
    tweaks.set(3, {0});
    Tweaks after = kSea;
    after[3] = menu("mirrors", 0, {"screen", "off", "traced"});
    tweaks.rebase(after);
    EXPECT_EQ(tweaks.value(3)[0], 1.0);
    ASSERT_TRUE(tweaks.undo());
    EXPECT_EQ(tweaks.value(3)[0], 2.0);
}

TEST(TweakValues, AReloadDuringADragKeepsTheEntryWhole) {
    TweakValues tweaks(kSea);
    tweaks.begin();
    tweaks.set(0, {0.7});
    Tweaks after = kSea;
    after[1].initial = {8};
    tweaks.rebase(after);
    tweaks.set(0, {0.8});
    tweaks.commit();
    ASSERT_TRUE(tweaks.undo());
    EXPECT_EQ(tweaks.value(0)[0], 0.5);
    EXPECT_EQ(tweaks.value(1)[0], 8.0);
    EXPECT_FALSE(tweaks.undo());
}

TEST(TweakValues, TwoSetsAreKeptApartAndUndoShowsTheOneItChanges) {
    using Set = TweakSet;
    TweakValues tweaks(kSea);
    tweaks.set(0, {0.1});
    tweaks.show(Set::b);
    EXPECT_EQ(tweaks.value(0)[0], 0.5);
    tweaks.set(0, {0.9});
    tweaks.show(Set::a);
    EXPECT_EQ(tweaks.value(0)[0], 0.1);
    ASSERT_TRUE(tweaks.undo());
    EXPECT_EQ(tweaks.shown(), Set::b);
    EXPECT_EQ(tweaks.value(0)[0], 0.5);
    ASSERT_TRUE(tweaks.undo());
    EXPECT_EQ(tweaks.shown(), Set::a);
    tweaks.redo();
    tweaks.redo();
    EXPECT_EQ(tweaks.values(Set::a)[0][0], 0.1);
    EXPECT_EQ(tweaks.values(Set::b)[0][0], 0.9);
}

TEST(TweakValues, CopyingToTheOtherSetCanBeUndone) {
    using Set = TweakSet;
    TweakValues tweaks(kSea);
    tweaks.set(0, {0.1});
    tweaks.copy_to_other();
    EXPECT_EQ(tweaks.shown(), Set::a);
    EXPECT_EQ(tweaks.values(Set::b), tweaks.values(Set::a));
    tweaks.undo();
    EXPECT_EQ(tweaks.values(Set::b)[0][0], 0.5);
    EXPECT_EQ(tweaks.values(Set::a)[0][0], 0.1);
}

TEST(TweakValues, ResetGoesToWhatTheFileSaysThenToTheDefault) {
    const Tweaks two = {kSea[0], kSea[1]};
    TweakValues tweaks(two, std::vector<TweakValue>{{0.25}, {7.0}});
    tweaks.set(0, {0.9});
    tweaks.reset(0);
    EXPECT_EQ(tweaks.value(0)[0], 0.25);
    EXPECT_TRUE(tweaks.is_as_written(0));
    tweaks.reset(0);
    EXPECT_EQ(tweaks.value(0)[0], 0.5);
    EXPECT_FALSE(tweaks.is_as_written(0));
    tweaks.reset_all();
    EXPECT_EQ(tweaks.value(0)[0], 0.25) << "one stood elsewhere: all go to the file first";
    EXPECT_EQ(tweaks.value(1)[0], 7.0);
    tweaks.reset_all();
    EXPECT_FALSE(tweaks.any_changed());
    tweaks.undo();
    EXPECT_EQ(tweaks.value(1)[0], 7.0);
    tweaks.reset_to_default(1);
    EXPECT_EQ(tweaks.value(1)[0], 3.0);
    tweaks.set_written(std::vector<TweakValue>{{0.75}, {3.0}});
    tweaks.reset(0);
    EXPECT_EQ(tweaks.value(0)[0], 0.75) << "a save moves where reset goes";
}

TEST(TweakValues, ARandomLookLeavesTheCameraAndWhatSaysSo) {
    Tweak eye = slider("eye", 0.5, 0, 1), shy = slider("shy", 0.5, 0, 1);
    eye.group = "Camera";
    shy.no_random = true;
    Tweak costly = slider("costly", 0.5, 0, 1), plain = slider("plain", 0.5, 0, 1);
    costly.quality = true;
    const Tweaks all = {eye, shy, costly, plain};
    TweakValues tweaks(all);
    tweaks.randomise(42);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(tweaks.value(i)[0], 0.5) << all[i].name;
    EXPECT_NE(tweaks.value(3)[0], 0.5);
}

TEST(TweakValues, LocksAreKnownByNameAndOutliveAReload) {
    TweakValues tweaks(kSea);
    const std::vector<std::string> names = {kSea[1].name, "gone"};
    tweaks.set_locks(names);
    EXPECT_EQ(tweaks.locks(), std::vector<std::string>{kSea[1].name});
    tweaks.rebase(kSea);
    EXPECT_TRUE(tweaks.locked(1));
    tweaks.set_locks({});
    EXPECT_TRUE(tweaks.locks().empty());
}

TEST(TweakValues, RandomiseLeavesWhatIsLockedAndIsOneEntry) {
    TweakValues tweaks(kSea), again(kSea);
    for (TweakValues* one : {&tweaks, &again}) {
        one->lock(1, true);
        one->randomise(42);
    }
    EXPECT_EQ(tweaks.values(), again.values()) << "the same seed, the same look";
    EXPECT_EQ(tweaks.value(1)[0], 3.0);
    EXPECT_NE(tweaks.value(0)[0], 0.5);
    again.randomise(43);
    EXPECT_NE(tweaks.values(), again.values());
    ASSERT_TRUE(tweaks.undo());
    EXPECT_FALSE(tweaks.any_changed());
    EXPECT_FALSE(tweaks.can_undo());
}

TEST(TweakValues, AWishIsDoneAndSaysWhetherItHasChangedAnything) {
    using enum TweakEdit::What;
    struct Case {
        const char* what;
        TweakEdit edit;
        bool changes;
        double then;  // waves, in the shown set
    };
    const Case cases[] = {
        {"undo of nothing", {.what = undo}, false, 0.5},
        {"the value that it has", {.what = set, .index = 0, .value = {0.5}}, false, 0.5},
        {"another one", {.what = set, .index = 0, .value = {0.75}}, true, 0.75},
        {"undo", {.what = undo}, true, 0.5},
        {"redo", {.what = redo}, true, 0.75},
        {"the other set", {.what = show, .shown = TweakSet::b}, true, 0.5},
        {"which is shown", {.what = show, .shown = TweakSet::b}, false, 0.5},
        {"and made the same", {.what = show, .shown = TweakSet::a}, true, 0.75},
        {"by a copy", {.what = copy_to_other}, true, 0.75},
        {"a lock", {.what = lock, .index = 0}, false, 0.75},
        {"keeps it", {.what = randomise, .seed = 42}, true, 0.75},
        {"until unlocked", {.what = unlock, .index = 0}, false, 0.75},
        {"the default", {.what = reset, .index = 0}, true, 0.5},
        {"of all", {.what = reset_all}, true, 0.5},
        {"the beginning of a drag", {.what = begin}, false, 0.5},
        {"its middle", {.what = set, .index = 0, .value = {0.1}}, true, 0.1},
        {"and more", {.what = set, .index = 0, .value = {0.2}}, true, 0.2},
        {"its end", {.what = commit}, false, 0.2},
        {"is one entry", {.what = undo}, true, 0.5},
    };
    TweakValues tweaks(kSea);
    for (const Case& c : cases) {
        EXPECT_EQ(tweaks.apply(c.edit), c.changes) << c.what;
        EXPECT_EQ(tweaks.value(0)[0], c.then) << c.what;
    }
    EXPECT_FALSE(tweaks.locked(0));
}

TEST(RandomValue, IsEvenOverWhatTheTweakCanBe) {
    struct Case {
        const char* what;
        Tweak tweak;
        double lowest, highest, median, tolerance;
    };
    Tweak count = slider("n", 1, 1, 6);
    count.type = TweakType::int1;
    const Case cases[] = {
        {"linear", slider("a", 0, -2, 6), -2, 6, 2, 0.4},
        {"log", with_log(slider("a", 1, 0.01, 100)), 0.01, 100, 1, 0.4},
        {"stepped", with_step(slider("a", 0, 0, 1), 0.25), 0, 1, 0.5, 0},
        {"whole", count, 1, 6, 3, 1},
        {"menu", menu("a", 0, {"x", "y", "z"}), 0, 2, 1, 0},
    };
    for (const Case& c : cases) {
        std::vector<double> values;
        for (std::uint32_t seed = 0; seed < 2001; ++seed) {
            const TweakValue value = random_value(c.tweak, c.tweak.initial, seed);
            EXPECT_EQ(value, clamp_to_range(c.tweak, value)) << c.what;
            EXPECT_EQ(value[1], 0.0) << c.what;
            values.push_back(value[0]);
        }
        std::sort(values.begin(), values.end());
        const double span = c.highest - c.lowest;
        EXPECT_NEAR(values.front(), c.lowest, 0.01 * span) << c.what;
        EXPECT_NEAR(values.back(), c.highest, 0.01 * span) << c.what;
        EXPECT_NEAR(values[1000], c.median, c.tolerance) << c.what;
    }
}

TEST(RandomValue, StepsBoolsAndColoursAreWhatAPersonWouldSet) {
    const Tweak stepped = with_step(slider("a", 0, 0, 1), 0.1);
    std::set<std::string> texts;
    std::set<double> switches;
    for (std::uint32_t seed = 0; seed < 500; ++seed) {
        texts.insert(format_number(random_value(stepped, {}, seed)[0]));
        switches.insert(random_value(kSea[4], {}, seed)[0]);
        const Tweak& tint = kSea[2];
        EXPECT_EQ(format_value(tint, random_value(tint, tint.initial, seed)).size(), 7u);
    }
    EXPECT_EQ(texts.size(), 11u);
    EXPECT_TRUE(texts.contains("0.3"));
    EXPECT_EQ(switches, (std::set<double>{0, 1}));
}

TEST(RandomValue, QualityAndWhatHasNoRangeStay) {
    Tweak quality = slider("steps", 64, 8, 1024);
    quality.quality = true;
    EXPECT_EQ(random_value(quality, {64}, 1)[0], 64.0);
    EXPECT_EQ(random_value(of_type("a", TweakType::float1), {5}, 1)[0], 5.0);
}

TEST(RandomValue, DependsOnTheNameAndNotOnTheOtherTweaks) {
    const Tweak a = slider("a", 0, 0, 1), b = slider("b", 0, 0, 1);
    EXPECT_NE(random_value(a, {}, 7)[0], random_value(b, {}, 7)[0]);
    TweakValues alone(Tweaks{a}), both(Tweaks{b, a});
    alone.randomise(7);
    both.randomise(7);
    EXPECT_EQ(alone.value(0), both.value(1));
}

}  // namespace
}  // namespace glint::tweak_values_test
