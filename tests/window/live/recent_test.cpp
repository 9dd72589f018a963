// The files that were open last.
#include "window/live/recent.h"

#include "../../base/test_folder.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace glint::recent_test {
namespace {

namespace fs = std::filesystem;

class RecentFiles : public testing::Test {
protected:
    fs::path file(const std::string& name) const {
        made_.write(name, "x");
        return folder_ / name;
    }

    TestFolder made_;
    fs::path folder_ = fs::canonical(made_.path());
};

TEST_F(RecentFiles, TheNewestIsFirstAndEachIsThereOnce) {
    const Recent recent(folder_ / "state/recent");
    EXPECT_TRUE(recent.files().empty());
    const fs::path a = file("a.frag"), b = file("b.frag");
    recent.add(a);
    recent.add(b);
    recent.add(folder_ / "." / "a.frag");
    EXPECT_EQ(Recent(folder_ / "state/recent").files(), (std::vector{a, b}));
}

TEST_F(RecentFiles, WhatIsGoneIsLeftOutAndOldOnesAreForgotten) {
    const Recent recent(folder_ / "recent");
    for (int i = 0; i < 30; ++i) recent.add(file(std::to_string(i) + ".frag"));
    EXPECT_EQ(recent.files().size(), 12u);
    fs::remove(folder_ / "29.frag");
    EXPECT_EQ(recent.files().front(), folder_ / "28.frag");
}

TEST_F(RecentFiles, AListThatIsBrokenOrCannotBeWrittenIsNoTrouble) {
    fs::create_directory(folder_ / "recent");
    const Recent recent(folder_ / "recent");
    recent.add(file("a.frag"));
    EXPECT_TRUE(recent.files().empty());
    std::ofstream(folder_ / "odd") << std::string(1 << 18, '\n') << '\0';
    EXPECT_TRUE(Recent(folder_ / "odd").files().empty());
}

}  // namespace
}  // namespace glint::recent_test
