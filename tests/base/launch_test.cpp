// Programs get what they are to get, nothing else, and end as they should.
#include "base/launch.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <utility>

namespace glint::launch_test {
namespace {

namespace fs = std::filesystem;

std::string read_all(int descriptor) {
    std::string text;
    std::array<char, 1024> chunk;
    for (ssize_t count; (count = ::read(descriptor, chunk.data(), chunk.size())) > 0;)
        text.append(chunk.data(), static_cast<std::size_t>(count));
    return text;
}

// What a program prints, and how it ended.
std::pair<std::string, int> printed(Launch wanted) {
    wanted.output = kPipe;
    const Launched launched = launch(wanted);
    const std::string text = read_all(launched.pipe);
    ::close(launched.pipe);
    return {text, wait_for(launched.process)};
}

std::pair<std::string, int> printed_by_shell(const std::string& script) {
    return printed({.words = {"sh", "-c", script}});
}

// The thread sanitizer makes a fork of vfork, whose child tells nothing through our memory and is
// not waited for until it runs.
#ifdef __SANITIZE_THREAD__
#define NEEDS_VFORK GTEST_SKIP() << "the thread sanitizer has no vfork"
#else
#define NEEDS_VFORK
#endif

int open_descriptors() {
    return static_cast<int>(
        std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator()));
}

TEST(Launch, AProgramThatIsMissingOrCannotRunIsKnownAtOnceAndLeavesNothing) {
    NEEDS_VFORK;
    const int before = open_descriptors();
    const auto why = [](const std::string& program) {
        return launch({.words = {program}, .output = kPipe}).error;
    };
    EXPECT_EQ(why("no-such-program"), ENOENT);
    EXPECT_EQ(why("/dev/null"), EACCES);
    EXPECT_EQ(open_descriptors(), before);
    EXPECT_EQ(ended(-1), 0) << "no process is left to be waited for";
    EXPECT_EQ(errno, ECHILD);
}

TEST(Launch, WordsArriveAsTheyAre) {
    const auto [text, code] =
        printed({.words = {"printf", "[%s]", "two words", "it's", "a \"quote\"", "", "$HOME *\n"}});
    EXPECT_EQ(text, "[two words][it's][a \"quote\"][][$HOME *\n]");
    EXPECT_EQ(code, 0);
}

TEST(Launch, ANameMayDifferFromTheProgram) {
    EXPECT_EQ(printed({.words = {"another", "-c", "echo $0"}, .program = "sh"}).first, "another\n");
}

TEST(Launch, TheExitCodeOrTheSignalIsTold) {
    EXPECT_EQ(printed_by_shell("exit 7").second, 7);
    EXPECT_EQ(printed_by_shell("kill -TERM $$").second, -SIGTERM);
}

TEST(Launch, WhatStillRunsHasNotEnded) {
    const Launched cat = launch({.words = {"cat"}, .input = kPipe});
    EXPECT_EQ(ended(cat.process), std::nullopt);
    ::close(cat.pipe);
    EXPECT_EQ(wait_for(cat.process), 0);
}

TEST(Launch, NothingOfOursIsInherited) {
    const int stray = ::open("/dev/zero", O_RDONLY);  // not close-on-exec
    const auto [text, code] = printed_by_shell("cd /proc/$$/fd; readlink *");
    ::close(stray);
    EXPECT_EQ(text.find("/dev/zero"), std::string::npos) << text;
    EXPECT_EQ(printed({.words = {"readlink", fmt::format("/proc/self/fd/{}", stray)}}).second, 1);
    EXPECT_TRUE(text.starts_with("/dev/null\npipe:") && text.ends_with("]\n/dev/null\n")) << text;
}

TEST(Launch, InputIsNothingOrOurs) {
    EXPECT_EQ(printed_by_shell("cat").first, "");
    EXPECT_EQ(printed({.words = {"readlink", "/proc/self/fd/0"}, .input = kOurs}).first,
              fs::read_symlink("/proc/self/fd/0").string() + "\n");
}

TEST(Launch, InputMayBeAPipeOfOurs) {
    const int out = ::memfd_create("out", MFD_CLOEXEC);
    const Launched cat = launch({.words = {"cat"}, .input = kPipe, .output = out});
    EXPECT_EQ(::write(cat.pipe, "hello", 5), 5);
    ::close(cat.pipe);
    EXPECT_EQ(wait_for(cat.process), 0);
    ::lseek(out, 0, SEEK_SET);
    EXPECT_EQ(read_all(out), "hello");
    ::close(out);
}

TEST(Launch, InputMayBeASocketOfOurs) {
    const Launched shell =
        launch({.words = {"sh", "-c", "read word; echo $word >&0"}, .input = kSocket});
    EXPECT_EQ(::write(shell.pipe, "hello\n", 6), 6);
    EXPECT_EQ(read_all(shell.pipe), "hello\n");
    ::close(shell.pipe);
    EXPECT_EQ(wait_for(shell.process), 0);
}

TEST(Launch, DescriptorsMayChangePlaces) {
    const int out = ::memfd_create("out", MFD_CLOEXEC);
    const int kept = ::dup(STDERR_FILENO);
    ::dup2(out, STDERR_FILENO);  // what is to be its output stands where its messages go
    const Launched shell = launch({.words = {"sh", "-c", "echo said; echo complained >&2"},
                                   .output = STDERR_FILENO,
                                   .messages = kNothing});
    ::dup2(kept, STDERR_FILENO);
    ::close(kept);
    EXPECT_EQ(wait_for(shell.process), 0);
    ::lseek(out, 0, SEEK_SET);
    EXPECT_EQ(read_all(out), "said\n");
    ::close(out);
}

TEST(Launch, GroupPriorityAndCoreFilesAreAsWanted) {
    NEEDS_VFORK;
    const auto group_of = [](Launch::Group group) {
        const Launched cat = launch({.words = {"cat"}, .input = kPipe, .group = group});
        const std::pair result{::getpgid(cat.process) == cat.process,
                               ::getsid(cat.process) == cat.process};
        ::close(cat.pipe);
        wait_for(cat.process);
        return result;
    };
    EXPECT_EQ(group_of(Launch::Group::ours), std::pair(false, false));
    EXPECT_EQ(group_of(Launch::Group::own), std::pair(true, false));
    EXPECT_EQ(group_of(Launch::Group::session), std::pair(true, true));
    EXPECT_EQ(printed({.words = {"nice"}, .niceness = 19}).first, "19\n");
    EXPECT_EQ(printed({.words = {"sh", "-c", "ulimit -c"}, .core_files = false}).first, "0\n");
}

// SIGUSR1 ignored, SIGUSR2 blocked, SIGHUP handled: the three states that there are.
TEST(Launch, SignalsAreOursOrTheDefault) {
    std::signal(SIGUSR1, SIG_IGN);
    std::signal(SIGHUP, [](int) {});
    sigset_t set, before;
    sigemptyset(&set);
    sigaddset(&set, SIGUSR2);
    pthread_sigmask(SIG_BLOCK, &set, &before);
    const auto survives = [](const char* signal, bool default_signals) {
        return printed({.words = {"sh", "-c", fmt::format("kill -{} $$", signal)},
                        .default_signals = default_signals})
                   .second == 0;
    };
    EXPECT_TRUE(survives("USR1", false));
    EXPECT_TRUE(survives("USR2", false));
    EXPECT_FALSE(survives("HUP", false));
    EXPECT_FALSE(survives("USR1", true));
    EXPECT_FALSE(survives("USR2", true));
    EXPECT_FALSE(survives("HUP", true));
    pthread_sigmask(SIG_SETMASK, nullptr, &set);
    EXPECT_TRUE(sigismember(&set, SIGUSR2) && !sigismember(&set, SIGTERM)) << "ours is as it was";
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
    std::signal(SIGUSR1, SIG_DFL);
    std::signal(SIGHUP, SIG_DFL);
}

// It speaks when it is told to, which is after the end of the process that has launched it.
std::string said_after_the_end_of_its_parent(bool ends_with_us) {
    int in[2], out[2];
    if (::pipe2(in, O_CLOEXEC) != 0 || ::pipe2(out, O_CLOEXEC) != 0) return "no pipe";
    const pid_t parent = ::fork();
    if (parent == 0) {
        launch({.words = {"sh", "-c", "read word; echo $word"},
                .input = in[0],
                .output = out[1],
                .ends_with_us = ends_with_us});
        ::raise(SIGKILL);
    }
    ::close(out[1]);
    EXPECT_EQ(wait_for(parent), -SIGKILL);
    EXPECT_EQ(::write(in[1], "outlives\n", 9), 9);
    const std::string text = read_all(out[0]);
    for (const int end : {in[0], in[1], out[0]}) ::close(end);
    return text;
}

TEST(Launch, EndsWithItsParentOrOutlivesIt) {
    EXPECT_EQ(said_after_the_end_of_its_parent(true), "");
    EXPECT_EQ(said_after_the_end_of_its_parent(false), "outlives\n");
}

TEST(Dying, TakesAlongWhatTheProcessHasStarted) {
    const Launched shell = launch({.words = {"sh", "-c", "sleep 1000 & echo begun; wait"},
                                   .output = kPipe,
                                   .group = Launch::Group::own});
    std::array<char, 6> begun{};
    EXPECT_EQ(::read(shell.pipe, begun.data(), begun.size()), 6);
    pid_t process = shell.process;
    {
        Dying dying;
        dying.end(process);
        EXPECT_EQ(process, 0);
        dying.end(process);  // none
    }
    EXPECT_EQ(read_all(shell.pipe), "") << "nobody holds its output open any more";
    ::close(shell.pipe);
    EXPECT_EQ(ended(shell.process), 0);
    EXPECT_EQ(errno, ECHILD) << "it was waited for";
}

}  // namespace
}  // namespace glint::launch_test
