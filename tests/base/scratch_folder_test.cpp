// What one process keeps there is not another one's to clear away while it runs.
#include "base/scratch_folder.h"

#include "test_folder.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <optional>

namespace glint::scratch_folder_test {
namespace {

namespace fs = std::filesystem;

void write_into(const fs::path& folder) {
    fs::create_directories(folder);
    std::ofstream(folder / "picture.png") << "pixels";
}

// In containers that share a home two processes may have one number.
TEST(ScratchFolders, OfTwoProcessesOfOneNumberAreTwo) {
    const TestFolder folder;
    std::optional<ScratchFolder> one(folder.path()), other(folder.path());
    EXPECT_NE(one->path(), other->path());
    write_into(one->path());
    write_into(other->path());
    other.reset();
    EXPECT_TRUE(fs::exists(one->path() / "picture.png"));
    one.reset();
    EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(ScratchFolders, OfAProcessThatRunsWhereItsNumberIsNotKnownStay) {
    const TestFolder folder;
    const ScratchFolder running(folder.path());
    write_into(running.path());
    // Such a name as it would have in a space of numbers of its own.
    const fs::path elsewhere = folder.path() / "999999999";
    fs::rename(running.path(), elsewhere);
    const ScratchFolder next(folder.path());
    EXPECT_TRUE(fs::exists(elsewhere / "picture.png"));
}

TEST(ScratchFolders, OfAProcessThatWasKilledGo) {
    const TestFolder folder;
    const pid_t process = ::fork();
    if (process == 0) {
        const ScratchFolder left(folder.path());
        write_into(left.path());
        ::_exit(1);
    }
    ::waitpid(process, nullptr, 0);
    const ScratchFolder next(folder.path());
    const bool is_left = std::ranges::any_of(
        fs::directory_iterator(folder.path()),
        [](const fs::directory_entry& entry) { return fs::exists(entry.path() / "picture.png"); });
    EXPECT_FALSE(is_left);
}

}  // namespace
}  // namespace glint::scratch_folder_test
