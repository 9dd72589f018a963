// The list of what was done, without the values themselves.
#include "scene/history.h"

#include <gtest/gtest.h>

#include <string>

namespace glint::history_test {
namespace {

void do_once(History& history, const std::string& name, double before, double after) {
    history.begin(TweakSet::a);
    history.note(name, {.value = {before}});
    history.entry().changes.back().after = {.value = {after}};
    history.commit();
}

TEST(History, GoesBackAndOnThroughWhatWasDone) {
    History history;
    EXPECT_EQ(history.undo(), nullptr);
    do_once(history, "waves", 1, 2);
    do_once(history, "wind", 3, 4);
    EXPECT_FALSE(history.can_redo());
    EXPECT_EQ(history.undo()->changes[0].name, "wind");
    EXPECT_EQ(history.undo()->changes[0].before.value[0], 1);
    EXPECT_EQ(history.undo(), nullptr);
    EXPECT_EQ(history.redo()->changes[0].after.value[0], 2);
    EXPECT_EQ(history.redo()->changes[0].name, "wind");
    EXPECT_EQ(history.redo(), nullptr);
}

TEST(History, OnlyTheFirstChangeOfATweakInAnEntryCounts) {
    History history;
    history.begin(TweakSet::b);
    for (const double before : {1, 2, 3}) history.note("waves", {.value = {before}});
    history.note("wind", {.value = {5}});
    history.commit();
    const HistoryEntry* entry = history.undo();
    ASSERT_NE(entry, nullptr);
    EXPECT_EQ(entry->set, TweakSet::b);
    ASSERT_EQ(entry->changes.size(), 2u);
    EXPECT_EQ(entry->changes[0].before.value[0], 1);
}

TEST(History, AnEntryThatIsOpenEmptyOrCancelledIsNotGoneBackTo) {
    History history;
    do_once(history, "waves", 1, 2);
    history.begin(TweakSet::a);
    EXPECT_EQ(history.undo(), nullptr) << "while one is open";
    history.commit();
    history.begin(TweakSet::a);
    history.note("wind", {.value = {3}});
    EXPECT_EQ(history.cancel().changes.size(), 1u);
    EXPECT_EQ(history.undo()->changes[0].name, "waves");
    EXPECT_FALSE(history.can_undo());
}

TEST(History, SomethingNewCutsOffWhatWasUndone) {
    History history;
    do_once(history, "waves", 1, 2);
    history.undo();
    do_once(history, "wind", 3, 4);
    EXPECT_FALSE(history.can_redo());
    EXPECT_EQ(history.undo()->changes[0].name, "wind");
    EXPECT_EQ(history.undo(), nullptr);
}

}  // namespace
}  // namespace glint::history_test
