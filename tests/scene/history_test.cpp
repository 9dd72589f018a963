// Undo, defaults, random looks, two sets, and what a reload makes of values.
#include "scene/history.h"

#include "base/words.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <set>

namespace glint {
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
        History history(std::span(&c.before, 1), std::vector<TweakValue>{{c.value}});
        history.rebase(std::span(&c.after, 1));
        EXPECT_EQ(history.value(0)[0], c.expected) << c.what;
    }
}

TEST(Rebase, ATweakThatComesBackHasItsValueAndLockAgain) {
    History history(kSea);
    history.set(1, {7});
    history.lock(1, true);
    const Tweaks without = {kSea[0]};
    history.rebase(without);
    EXPECT_EQ(history.values().size(), 1u);
    history.rebase(without);
    history.rebase(kSea);
    EXPECT_EQ(history.value(1)[0], 7.0);
    EXPECT_TRUE(history.locked(1));
}

TEST(Rebase, BothSetsAreCarriedOver) {
    History history(kSea);
    history.set(0, {0.75});
    history.show(History::Set::b);
    history.set(1, {7});
    Tweaks after = kSea;
    after[0].initial = {0.25};
    std::swap(after[0], after[1]);
    history.rebase(after);
    EXPECT_EQ(history.values(History::Set::a)[1][0], 0.75);
    EXPECT_EQ(history.values(History::Set::b)[1][0], 0.25);
    EXPECT_EQ(history.values(History::Set::a)[0][0], 3.0);
    EXPECT_EQ(history.values(History::Set::b)[0][0], 7.0);
}

TEST(History, StartsWithThePresetsValuesOrTheDefaults) {
    EXPECT_EQ(History(kSea).values()[1][0], 3.0);
    std::vector<TweakValue> values = History(kSea).values();
    values[1] = {1.0 / 3};
    EXPECT_EQ(History(kSea, values).values(), values);
    EXPECT_TRUE(History(kSea, values).changed(1));
    EXPECT_FALSE(History(kSea, values).can_undo());
}

TEST(History, UndoIsExactToTheBit) {
    const double starts[] = {0.0, -0.0, 0.1, 1.0 / 3, 5e-324, 19.999999999999996};
    for (const double start : starts) {
        const std::vector<TweakValue> values = {{0.5}, {start}, kSea[2].initial, {1}, {0}};
        History history(kSea, values);
        history.set(1, {12.3});
        ASSERT_TRUE(history.undo());
        EXPECT_EQ(bits(history.value(1)), bits({start}));
        ASSERT_TRUE(history.redo());
        EXPECT_EQ(history.value(1)[0], 12.3);
    }
}

TEST(History, ADragIsOneEntry) {
    History history(kSea);
    history.set(1, {1});
    history.begin();
    for (int k = 0; k < 100; ++k) history.set(0, {k / 100.0});
    EXPECT_FALSE(history.undo()) << "not while the mouse is down";
    EXPECT_FALSE(history.can_undo());
    history.commit();
    EXPECT_EQ(history.value(0)[0], 0.99);
    ASSERT_TRUE(history.undo());
    EXPECT_EQ(history.value(0)[0], 0.5);
    EXPECT_EQ(history.value(1)[0], 1.0);
    ASSERT_TRUE(history.undo());
    EXPECT_EQ(history.value(1)[0], 3.0);
    EXPECT_FALSE(history.undo());
}

TEST(History, WhatChangesNothingIsNoEntry) {
    History history(kSea);
    history.begin();
    history.commit();
    history.set(0, {0.5});
    history.reset_all();
    history.begin();
    history.set(0, {0.9});
    history.set(0, {0.5});
    history.commit();
    history.commit();
    EXPECT_FALSE(history.can_undo());
}

TEST(History, ACancelledDragLeavesNothingBehind) {
    History history(kSea);
    history.begin();
    history.set(0, {0.9});
    history.set(1, {9});
    history.cancel();
    EXPECT_FALSE(history.any_changed());
    EXPECT_FALSE(history.can_undo());
}

TEST(History, ANewChangeCutsTheRedo) {
    History history(kSea);
    history.set(0, {0.1});
    history.set(0, {0.2});
    history.undo();
    history.set(1, {5});
    EXPECT_FALSE(history.can_redo());
    history.undo();
    EXPECT_EQ(history.value(0)[0], 0.1);
}

TEST(History, KeepsTheLastThousandEntries) {
    History history(kSea);
    for (int k = 1; k <= 1500; ++k) history.set(1, {k / 100.0});
    int undone = 0;
    while (history.undo()) ++undone;
    EXPECT_EQ(undone, 1000);
    EXPECT_EQ(history.value(1)[0], 5.0);
}

TEST(History, ResetsOneOrAllAsOneEntry) {
    History history(kSea);
    history.set(0, {0.9});
    history.set(1, {9});
    EXPECT_TRUE(history.changed(0));
    history.reset(0);
    EXPECT_FALSE(history.changed(0));
    EXPECT_TRUE(history.any_changed());
    history.undo();
    history.reset_all();
    EXPECT_FALSE(history.any_changed());
    history.undo();
    EXPECT_EQ(history.value(0)[0], 0.9);
    EXPECT_EQ(history.value(1)[0], 9.0);
}

TEST(History, SettingClampsToTheRange) {
    History history(kSea);
    history.set(1, {99});
    EXPECT_EQ(history.value(1)[0], 20.0);
    history.set(3, {0.4});
    EXPECT_EQ(history.value(3)[0], 0.0);
    history.set(1, {std::nan("")});
    EXPECT_EQ(history.value(1)[0], 3.0);
}

TEST(History, UndoReachesOverReloads) {
    History history(kSea);
    history.set(0, {0.9});
    history.set(1, {9});
    const Tweaks after = {slider("new", 1, 0, 2), slider("waves", 0.5, 0, 0.6)};
    history.rebase(after);
    EXPECT_EQ(history.value(1)[0], 0.6);
    ASSERT_TRUE(history.undo()) << "passes over wind, which is gone";
    EXPECT_EQ(history.value(1)[0], 0.5);
    EXPECT_FALSE(history.undo());
    history.rebase(kSea);
    EXPECT_EQ(history.value(1)[0], 3.0) << "was undone while it was away";
    ASSERT_TRUE(history.redo());
    EXPECT_EQ(history.value(0)[0], 0.9) << "the value itself, now that the range allows it";
    ASSERT_TRUE(history.redo());
    EXPECT_EQ(history.value(1)[0], 9.0);
}

TEST(History, UndoPassesOverAnotherType) {
    History history(kSea);
    history.set(1, {9});
    Tweaks after = kSea;
    after[1] = of_type("wind", TweakType::vec2, {1, 2});
    history.rebase(after);
    EXPECT_FALSE(history.undo());
    EXPECT_EQ(history.value(1), (TweakValue{1, 2}));
}

TEST(History, UndoOfAMenuFollowsTheOption) {
    History history(kSea);
    history.set(3, {0});
    Tweaks after = kSea;
    after[3] = menu("mirrors", 0, {"screen", "off", "traced"});
    history.rebase(after);
    EXPECT_EQ(history.value(3)[0], 1.0);
    ASSERT_TRUE(history.undo());
    EXPECT_EQ(history.value(3)[0], 2.0);
}

TEST(History, AReloadDuringADragKeepsTheEntryWhole) {
    History history(kSea);
    history.begin();
    history.set(0, {0.7});
    Tweaks after = kSea;
    after[1].initial = {8};
    history.rebase(after);
    history.set(0, {0.8});
    history.commit();
    ASSERT_TRUE(history.undo());
    EXPECT_EQ(history.value(0)[0], 0.5);
    EXPECT_EQ(history.value(1)[0], 8.0);
    EXPECT_FALSE(history.undo());
}

TEST(History, TwoSetsAreKeptApartAndUndoShowsTheOneItChanges) {
    using Set = History::Set;
    History history(kSea);
    history.set(0, {0.1});
    history.show(Set::b);
    EXPECT_EQ(history.value(0)[0], 0.5);
    history.set(0, {0.9});
    history.show(Set::a);
    EXPECT_EQ(history.value(0)[0], 0.1);
    ASSERT_TRUE(history.undo());
    EXPECT_EQ(history.shown(), Set::b);
    EXPECT_EQ(history.value(0)[0], 0.5);
    ASSERT_TRUE(history.undo());
    EXPECT_EQ(history.shown(), Set::a);
    history.redo();
    history.redo();
    EXPECT_EQ(history.values(Set::a)[0][0], 0.1);
    EXPECT_EQ(history.values(Set::b)[0][0], 0.9);
}

TEST(History, CopyingToTheOtherSetCanBeUndone) {
    using Set = History::Set;
    History history(kSea);
    history.set(0, {0.1});
    history.copy_to_other();
    EXPECT_EQ(history.shown(), Set::a);
    EXPECT_EQ(history.values(Set::b), history.values(Set::a));
    history.undo();
    EXPECT_EQ(history.values(Set::b)[0][0], 0.5);
    EXPECT_EQ(history.values(Set::a)[0][0], 0.1);
}

TEST(History, RandomiseLeavesWhatIsLockedAndIsOneEntry) {
    History history(kSea), again(kSea);
    for (History* one : {&history, &again}) {
        one->lock(1, true);
        one->randomise(42);
    }
    EXPECT_EQ(history.values(), again.values()) << "the same seed, the same look";
    EXPECT_EQ(history.value(1)[0], 3.0);
    EXPECT_NE(history.value(0)[0], 0.5);
    again.randomise(43);
    EXPECT_NE(history.values(), again.values());
    ASSERT_TRUE(history.undo());
    EXPECT_FALSE(history.any_changed());
    EXPECT_FALSE(history.can_undo());
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
    History alone(Tweaks{a}), both(Tweaks{b, a});
    alone.randomise(7);
    both.randomise(7);
    EXPECT_EQ(alone.value(0), both.value(1));
}

}  // namespace
}  // namespace glint
