#include "base/launch.h"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <thread>
#include <utility>

namespace glint {
namespace {

// All that is needed between vfork and exec. There memory is shared with us, and other threads may
// hold locks: only what is safe in a signal handler may be called.
struct Plan {
    const Launch& wanted;
    const char* program;
    char* const* words;
    std::array<int, 3> streams;
    pid_t parent;
    sigset_t mask;           // ours, before all was blocked
    volatile int error = 0;  // told back through the shared memory
};

// First above the three, so that none is overwritten before it is in its place.
bool place(std::array<int, 3> streams) {
    const int nothing = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    for (int& stream : streams) {
        if (stream == kOurs) continue;
        stream = ::fcntl(stream == kNothing ? nothing : stream, F_DUPFD_CLOEXEC, STDERR_FILENO + 1);
        if (stream < 0) return false;
    }
    for (int i = 0; i < 3; ++i) {
        const int stream = streams[static_cast<std::size_t>(i)];
        if (stream != kOurs && ::dup2(stream, i) < 0) return false;
    }
    ::closefrom(STDERR_FILENO + 1);
    return true;
}

// Our handlers must not run in the other process, so they go before anything is let through.
void set_signals(bool default_signals, sigset_t mask) {
    for (int signal = 1; signal < NSIG; ++signal) {
        struct sigaction action {};
        ::sigaction(signal, nullptr, &action);
        if (action.sa_handler == SIG_IGN && !default_signals) continue;
        action = {};
        action.sa_handler = SIG_DFL;
        ::sigaction(signal, &action, nullptr);
    }
    if (default_signals) ::sigemptyset(&mask);
    ::sigprocmask(SIG_SETMASK, &mask, nullptr);
}

[[noreturn]] void become(Plan& plan) {
    const Launch& wanted = plan.wanted;
    if (wanted.group == Launch::Group::own) ::setpgid(0, 0);
    if (wanted.group == Launch::Group::session) ::setsid();
    if (wanted.ends_with_us) end_with(plan.parent);
    if (wanted.niceness != 0) ::setpriority(PRIO_PROCESS, 0, wanted.niceness);
    const rlimit none{.rlim_cur = 0, .rlim_max = 0};
    if (!wanted.core_files) ::setrlimit(RLIMIT_CORE, &none);
    const rlimit time{wanted.most_seconds, wanted.most_seconds + 1};
    const rlimit room{wanted.most_bytes, wanted.most_bytes};
    if (wanted.most_seconds > 0) ::setrlimit(RLIMIT_CPU, &time);
    if (wanted.most_bytes > 0) ::setrlimit(RLIMIT_AS, &room);
    if (place(plan.streams)) {
        set_signals(wanted.default_signals, plan.mask);
        ::execvp(plan.program, plan.words);
    }
    plan.error = errno;
    ::_exit(127);
}

// vfork: a fork would copy the page tables of a window with gigabytes, and could not tell why there
// is no program. A function of its own, since both processes return to its frame.
[[gnu::noinline]] pid_t start(Plan& plan) {
    const pid_t process = ::vfork();
    if (process == 0) become(plan);
    return process;
}

int code_of(int status) {
    return WIFSIGNALED(status) ? -WTERMSIG(status) : WEXITSTATUS(status);
}

// Fills in what stands for a new pipe or socket; `theirs` and `ours` are its ends.
bool make_pipe(std::array<int, 3>& streams, int& theirs, int& ours) {
    const auto wanted =
        std::ranges::find_if(streams, [](int s) { return s == kPipe || s == kSocket; });
    if (wanted == streams.end()) return true;
    std::array<int, 2> ends{};
    const int result = *wanted == kPipe
                           ? ::pipe2(ends.data(), O_CLOEXEC)
                           : ::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data());
    if (result != 0) return false;
    if (wanted != streams.begin()) std::swap(ends[0], ends[1]);  // the first is read from
    *wanted = theirs = ends[0];
    ours = ends[1];
    return true;
}

}  // namespace

Launched launch(const Launch& wanted) {
    std::vector<char*> words;
    for (const std::string& word : wanted.words) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    const std::string& program = wanted.program.empty() ? wanted.words.front() : wanted.program;
    Plan plan{.wanted = wanted,
              .program = program.c_str(),
              .words = words.data(),
              .streams = {wanted.input, wanted.output, wanted.messages},
              .parent = ::getpid(),
              .mask = {}};
    int ours = -1, theirs = -1;
    if (!make_pipe(plan.streams, theirs, ours)) return {.error = errno};
    sigset_t all;
    ::sigfillset(&all);
    ::pthread_sigmask(SIG_SETMASK, &all, &plan.mask);
    const pid_t process = start(plan);
    const int error = process < 0 ? errno : plan.error;
    ::pthread_sigmask(SIG_SETMASK, &plan.mask, nullptr);
    if (theirs >= 0) ::close(theirs);
    if (error == 0) return {.process = process, .pipe = ours};
    if (ours >= 0) ::close(ours);
    if (process > 0) wait_for(process);
    return {.error = error};
}

void end_with(pid_t parent) {
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(1);  // it was gone before
}

std::string read_to_end(int pipe) {
    std::string text;
    std::array<char, 4096> chunk;
    for (;;) {
        const ssize_t count = ::read(pipe, chunk.data(), chunk.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) break;
        text.append(chunk.data(), static_cast<std::size_t>(count));
    }
    ::close(pipe);
    return text;
}

int wait_for(pid_t process) {
    int status = 0;
    while (::waitpid(process, &status, 0) < 0 && errno == EINTR) continue;
    return code_of(status);
}

std::optional<int> ended(pid_t process) {
    int status = 0;
    if (::waitpid(process, &status, WNOHANG) == 0) return std::nullopt;
    return code_of(status);
}

Dying::~Dying() {
    for (int i = 0; i < 1000 && !empty(); ++i) {
        reap();
        if (!empty()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

void Dying::end(pid_t& process) {
    if (process == 0) return;
    ::kill(-process, SIGKILL);
    processes_.push_back(std::exchange(process, 0));
    reap();
}

void Dying::reap() {
    std::erase_if(processes_, [](pid_t process) { return ended(process).has_value(); });
}

}  // namespace glint
