// Runs the real glint as a user does, and gives it a folder of its own.
#pragma once

#include "../base/test_folder.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sched.h>
#include <sys/mount.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace glint::cli {

namespace fs = std::filesystem;

struct Command {
    std::vector<std::string> arguments;
    fs::path folder{};                                               // where it runs
    std::vector<std::pair<std::string, std::string>> environment{};  // added to ours
    std::optional<rlim_t> largest_file{};  // bytes; a write beyond fails as on a full disk
    std::string out_to{};                  // a file for stdout; empty: captured
    std::string err_to{};                  // and for stderr, such as a terminal
    std::chrono::seconds limit{120};       // for what hangs; killed then
};

struct Outcome {
    int code = -1;   // exit code, or -1 when a signal ended it
    int signal = 0;  // 0: it ended by itself
    bool timed_out = false;
    std::string out, err;
};

// A program that runs; it is killed and waited for when this goes away.
class Process {
public:
    explicit Process(const Command& command) : deadline_(Clock::now() + command.limit) {
        if (::pipe2(out_.data(), O_CLOEXEC) != 0 || ::pipe2(err_.data(), O_CLOEXEC) != 0) {
            throw std::runtime_error("no pipe");
        }
        std::vector<std::string> words = {GLINT_BINARY};
        words.insert(words.end(), command.arguments.begin(), command.arguments.end());
        std::vector<char*> pointers;
        for (std::string& word : words) pointers.push_back(word.data());
        pointers.push_back(nullptr);
        pid_ = ::fork();
        if (pid_ < 0) throw std::runtime_error("no process");
        if (pid_ == 0) become(command, pointers.data());
        ::close(std::exchange(out_[1], -1));
        ::close(std::exchange(err_[1], -1));
    }
    ~Process() {
        if (pid_ > 0) {
            ::kill(pid_, SIGKILL);
            ::waitpid(pid_, nullptr, 0);
        }
        for (const int end : {out_[0], err_[0]}) ::close(end);
    }
    Process(const Process&) = delete;
    Process& operator=(const Process&) = delete;

    pid_t id() const { return pid_; }
    void signal(int number) const { ::kill(pid_, number); }

    // Not ended yet, and not a zombie.
    bool runs() const {
        siginfo_t info{};
        ::waitid(P_PID, static_cast<id_t>(pid_), &info, WEXITED | WNOHANG | WNOWAIT);
        return info.si_pid == 0;
    }

    Outcome wait() {
        Outcome outcome;
        std::array<pollfd, 2> ends = {pollfd{out_[0], POLLIN, 0}, pollfd{err_[0], POLLIN, 0}};
        while (ends[0].fd >= 0 || ends[1].fd >= 0) {
            const auto left =
                std::chrono::duration_cast<std::chrono::milliseconds>(deadline_ - Clock::now());
            if (left.count() <= 0 && !outcome.timed_out) {
                outcome.timed_out = true;
                signal(SIGKILL);
            }
            ::poll(ends.data(), ends.size(), static_cast<int>(std::max<long>(left.count(), 10)));
            read_from(ends[0], outcome.out);
            read_from(ends[1], outcome.err);
        }
        int status = 0;
        ::waitpid(std::exchange(pid_, -1), &status, 0);
        if (WIFEXITED(status)) outcome.code = WEXITSTATUS(status);
        if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
        return outcome;
    }

private:
    using Clock = std::chrono::steady_clock;

    [[noreturn]] void become(const Command& command, char* const* words) const {
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // a test that is killed leaves nothing behind
        for (const int signal : {SIGINT, SIGHUP})
            ::signal(signal, SIG_DFL);  // nohup, or a shell's &
        for (const auto& [name, value] : command.environment) {
            ::setenv(name.c_str(), value.c_str(), 1);
        }
        if (command.largest_file) {
            const rlimit limit{*command.largest_file, *command.largest_file};
            ::setrlimit(RLIMIT_FSIZE, &limit);
            ::signal(SIGXFSZ, SIG_IGN);
        }
        const int out = command.out_to.empty() ? out_[1] : ::open(command.out_to.c_str(), O_WRONLY);
        const int err =
            command.err_to.empty() ? err_[1] : ::open(command.err_to.c_str(), O_WRONLY | O_NOCTTY);
        const int in = ::open("/dev/null", O_RDONLY);
        const bool ready = (command.folder.empty() || ::chdir(command.folder.c_str()) == 0) &&
                           ::dup2(in, 0) == 0 && ::dup2(out, 1) == 1 && ::dup2(err, 2) == 2;
        if (ready) ::execv(words[0], words);
        ::_exit(127);
    }

    static void read_from(pollfd& end, std::string& text) {
        if (end.fd < 0 || end.revents == 0) return;
        std::array<char, 4096> chunk;
        const ssize_t count = ::read(end.fd, chunk.data(), chunk.size());
        if (count > 0) text.append(chunk.data(), static_cast<std::size_t>(count));
        if (count == 0) end.fd = -1;
    }

    Clock::time_point deadline_;
    std::array<int, 2> out_{-1, -1}, err_{-1, -1};
    pid_t pid_ = -1;
};

inline Outcome run(const Command& command) {
    Outcome outcome = Process(command).wait();
    EXPECT_FALSE(outcome.timed_out) << outcome.err;
    EXPECT_EQ(outcome.signal, 0) << outcome.err;
    return outcome;
}

inline std::string bytes_of(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

// A file system of its own that is soon full ("64k"); only this process and its children see it.
inline bool mount_small_disk(const fs::path& where, const std::string& size) {
    return ::unshare(CLONE_NEWNS) == 0 &&
           ::mount(nullptr, "/", nullptr, MS_REC | MS_PRIVATE, nullptr) == 0 &&
           ::mount("tmpfs", where.c_str(), "tmpfs", 0, ("size=" + size).c_str()) == 0;
}
inline bool grow_small_disk(const fs::path& where, const std::string& size) {
    return ::mount("tmpfs", where.c_str(), "tmpfs", MS_REMOUNT, ("size=" + size).c_str()) == 0;
}
inline void unmount(const fs::path& where) {
    ::umount(where.c_str());
}

// The smallest scene that shows something: red is x, green is y.
inline constexpr std::string_view kGradient =
    "void mainImage(out vec4 c, in vec2 p) { c = vec4(p / iResolution.xy, 0.25, 1.0); }\n";

// Every test has a folder of its own, empty at the start and gone afterwards. glint runs in it.
class InAFolder : public testing::Test {
protected:
    const fs::path& folder() const { return folder_.path(); }

    void write(const fs::path& name, std::string_view text) const { folder_.write(name, text); }

    std::string bytes(const fs::path& name) const { return bytes_of(folder() / name); }

    // All names in the folder, hidden ones too.
    std::set<std::string> names() const {
        std::set<std::string> list;
        for (const auto& entry : fs::directory_iterator(folder())) {
            list.insert(entry.path().filename().string());
        }
        return list;
    }

    Command command(std::vector<std::string> arguments) const {
        return {.arguments = std::move(arguments), .folder = folder()};
    }

    Outcome glint(std::vector<std::string> arguments) const {
        return run(command(std::move(arguments)));
    }

    // `glint still`, small, which must succeed without a word on stderr.
    void still(std::vector<std::string> arguments) const {
        arguments.insert(arguments.begin(), "still");
        if (std::find(arguments.begin(), arguments.end(), "--size") == arguments.end()) {
            arguments.insert(arguments.end(), {"--size", "64x36"});
        }
        const Outcome outcome = glint(std::move(arguments));
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
    }

private:
    TestFolder folder_;
};

}  // namespace glint::cli
