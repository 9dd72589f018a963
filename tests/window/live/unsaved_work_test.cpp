// What is not saved outlives its window, belongs to one window at a time, and goes when it is
// decided on.
#include "window/live/unsaved_work.h"

#include "../../base/test_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

namespace glint::unsaved_work_test {
namespace {

namespace fs = std::filesystem;

class Unsaved : public ::testing::Test {
protected:
    // What a window finds that starts now.
    std::optional<std::string> found(const fs::path& file) const {
        return text_of(UnsavedWork(folder / "state").find(file));
    }
    static std::optional<std::string> text_of(const std::optional<UnsavedLook>& look) {
        return look ? std::optional(look->text) : std::nullopt;
    }
    bool is_empty() const {
        return !fs::exists(folder / "state") || fs::is_empty(folder / "state");
    }

    TestFolder made;
    const fs::path folder = made.path();
};

TEST_F(Unsaved, IsFoundByTheNextWindowOfTheSameFileUntilItIsDiscarded) {
    { UnsavedWork(folder / "state").keep("a.toml", {"one", {}}, 0); }
    EXPECT_EQ(found("b.toml"), std::nullopt);
    EXPECT_EQ(found("a.toml"), "one");
    EXPECT_EQ(found(fs::absolute("./x/../a.toml")), "one") << "undecided, under another name";
    UnsavedWork next(folder / "state");
    EXPECT_EQ(text_of(next.find("a.toml")), "one");
    next.discard_found();
    EXPECT_EQ(next.find("a.toml"), std::nullopt);
    EXPECT_TRUE(is_empty());
}

TEST_F(Unsaved, IsKeptWithWhatItsFileSaidThen) {
    { UnsavedWork(folder / "state").keep("a.toml", {"two", "one"}, 0); }
    EXPECT_EQ(UnsavedWork(folder / "state").find("a.toml"), (UnsavedLook{"two", "one"}));
}

// A window that found it again and again would do nothing else.
TEST_F(Unsaved, ThatCannotBeRemovedIsDecidedOnOnce) {
    { UnsavedWork(folder / "state").keep("a.toml", {"one", {}}, 0); }
    UnsavedWork next(folder / "state");
    ASSERT_EQ(text_of(next.find("a.toml")), "one");
    const fs::path where = next.found_folder(), copy = folder / "copy";
    fs::copy(where, copy);
    next.discard_found();
    fs::rename(copy, where);  // as where it may not be removed
    EXPECT_EQ(next.find("a.toml"), std::nullopt);
    EXPECT_EQ(found("a.toml"), "one") << "another window may";
}

TEST_F(Unsaved, ThatAWindowPassesIsLeftForTheNext) {
    { UnsavedWork(folder / "state").keep("a.toml", {"one", {}}, 0); }
    UnsavedWork next(folder / "state");
    ASSERT_EQ(text_of(next.find("a.toml")), "one");
    next.pass_found();
    EXPECT_EQ(next.find("a.toml"), std::nullopt);
    EXPECT_EQ(found("a.toml"), "one");
}

TEST_F(Unsaved, IsNotOfferedWhileItsWindowIsOpen) {
    UnsavedWork open(folder / "state");
    open.keep("a.toml", {"one", {}}, 0);
    EXPECT_EQ(found("a.toml"), std::nullopt);
    UnsavedWork second(folder / "state");
    second.keep("a.toml", {"two", {}}, 0);
    second.forget();
    open.keep("a.toml", {"three", {}}, 0);
    open = UnsavedWork(folder / "state");
    EXPECT_EQ(found("a.toml"), "three");
}

TEST_F(Unsaved, TwoWindowsOfOneFileKeepBoth) {
    {
        UnsavedWork a(folder / "state"), b(folder / "state");
        a.keep("a.toml", {"one", {}}, 0);
        b.keep("a.toml", {"two", {}}, 0);
    }
    UnsavedWork next(folder / "state");
    std::vector<std::string> all;
    while (const auto look = next.find("a.toml")) {
        all.push_back(look->text);
        next.discard_found();
    }
    std::sort(all.begin(), all.end());
    EXPECT_EQ(all, (std::vector<std::string>{"one", "two"}));
}

TEST_F(Unsaved, IsOfferedToOneWindowOnly) {
    { UnsavedWork(folder / "state").keep("a.toml", {"one", {}}, 0); }
    UnsavedWork first(folder / "state");
    EXPECT_EQ(text_of(first.find("a.toml")), "one");
    EXPECT_EQ(found("a.toml"), std::nullopt);
}

TEST_F(Unsaved, IsGoneOnceItIsSavedAndMayComeAgain) {
    UnsavedWork work(folder / "state");
    work.keep("a.toml", {"one", {}}, 0);
    work.forget();
    EXPECT_TRUE(is_empty());
    work.keep("a.toml", {"two", {}}, 0);
    fs::remove_all(folder / "state");  // somebody clears up
    work.keep("a.toml", {"three", {}}, 0);
    work = UnsavedWork(folder / "state");
    EXPECT_EQ(found("a.toml"), "three");
}

TEST_F(Unsaved, WhereNothingCanBeWrittenIsSaid) {
    UnsavedWork work("/dev/null/state");
    EXPECT_THROW(work.keep("a.toml", {"one", {}}, 0), std::runtime_error);
    EXPECT_EQ(work.find("a.toml"), std::nullopt);
}

}  // namespace
}  // namespace glint::unsaved_work_test
