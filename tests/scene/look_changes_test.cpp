// A file that is edited while its window has unsaved changes.
#include "scene/look_changes.h"

#include <gtest/gtest.h>

namespace glint::look_changes_test {
namespace {

// Two tweaks, and what a file says of them.
Preset file_with(double red, double green) {
    Preset preset;
    for (const char* name : {"red", "green"}) {
        Tweak& tweak = preset.scene.tweaks.emplace_back();
        tweak.name = name;
        tweak.min = 0.0;
        tweak.max = 1.0;
    }
    preset.values = {{red}, {green}};
    return preset;
}

TEST(LookChanges, OfAFileAreOneEntryOfTheUndoList) {
    const Preset before = file_with(0.1, 0.9), now = file_with(0.7, 0.2);
    TweakValues tweaks(before.scene.tweaks, before.values);
    tweaks.set(0, {0.4});
    EXPECT_EQ(lay_changes_over(before, now, tweaks), std::vector<std::string>{"red"});
    EXPECT_EQ(tweaks.values(), now.values);
    tweaks.undo();
    EXPECT_EQ(tweaks.values(), file_with(0.4, 0.9).values);
}

TEST(LookChanges, ReachTheHiddenSetWhereNobodyHasChangedIt) {
    const Preset before = file_with(0.1, 0.9), now = file_with(0.7, 0.2);
    TweakValues tweaks(before.scene.tweaks, before.values);
    tweaks.show(TweakSet::b);
    tweaks.set(1, {0.4});
    tweaks.show(TweakSet::a);
    EXPECT_TRUE(lay_changes_over(before, now, tweaks).empty());
    EXPECT_EQ(tweaks.values(TweakSet::b), file_with(0.7, 0.4).values);
    EXPECT_EQ(tweaks.shown(), TweakSet::a);
}

TEST(LookChanges, ThatAFileDoesNotHaveMoveNothing) {
    const Preset file = file_with(0.1, 0.9);
    TweakValues tweaks(file.scene.tweaks, file.values);
    tweaks.set(0, {0.4});
    EXPECT_TRUE(lay_changes_over(file, file, tweaks).empty());
    EXPECT_EQ(tweaks.values(), file_with(0.4, 0.9).values);
    EXPECT_EQ(tweaks.values(TweakSet::b), file.values);
}

}  // namespace
}  // namespace glint::look_changes_test
