// Only what ends against its will leaves a mark for the next start.
#include "window/live/crash_mark.h"

#include "../../base/test_folder.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <stdexcept>

namespace glint::crash_mark_test {
namespace {

namespace fs = std::filesystem;

// Whether the next start finds the mark of a process that opened the scene and then did this.
bool is_marked_after(const std::function<void()>& end) {
    const TestFolder folder;
    const pid_t process = ::fork();
    if (process == 0) {
        try {
            CrashMark mark(folder.path());
            mark.set("a.frag");
            end();
        } catch (const std::runtime_error&) {
        }
        ::_exit(0);
    }
    ::waitpid(process, nullptr, 0);
    return CrashMark(folder.path()).take("a.frag");
}

TEST(CrashMarks, AreLeftByWhatEndsAgainstItsWill) {
    EXPECT_FALSE(is_marked_after([] {}));
    EXPECT_TRUE(is_marked_after([] { ::_exit(1); }));
    // As a lost GPU does.
    EXPECT_TRUE(is_marked_after([] { throw std::runtime_error("lost"); }));
}

TEST(CrashMarks, WaitForTheNextStartOfTheirOwnSceneWhoeverHasTheNumberOfTheProcess) {
    const TestFolder folder;
    const pid_t process = ::fork();
    if (process == 0) {
        CrashMark mark(folder.path());
        mark.set("/b.frag");
        mark.set("/a.frag");
        ::_exit(1);
    }
    ::waitpid(process, nullptr, 0);
    // Another process may have that number by now; this one stands for it.
    for (const auto& entry : fs::directory_iterator(folder.path()))
        fs::rename(entry.path(), folder.path() / std::to_string(::getpid()));
    CrashMark open(folder.path());
    EXPECT_FALSE(open.take("/b.frag"));
    open.set("/a.frag");
    EXPECT_TRUE(CrashMark(folder.path()).take("/a.frag")) << "that of the other run";
    EXPECT_FALSE(CrashMark(folder.path()).take("/a.frag")) << "this one still runs";
}

}  // namespace
}  // namespace glint::crash_mark_test
