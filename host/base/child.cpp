#include "base/child.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <stdexcept>
#include <string_view>
#include <thread>
#include <utility>

namespace glint {
namespace {

// The window is to stay quick; what is timed is told by the processor's clock where others are.
constexpr int kNiceness = 10;

// Becomes `glint WORDS…`. Between fork and exec only what is safe in a signal handler may be
// called: other threads may have held locks.
[[noreturn]] void become(char* const* words, pid_t parent, int out, int messages) {
    ::setpgid(0, 0);  // what it starts is ended with it
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (::getppid() != parent) ::_exit(1);
    ::setpriority(PRIO_PROCESS, 0, kNiceness);
    const rlimit none{.rlim_cur = 0, .rlim_max = 0};
    ::setrlimit(RLIMIT_CORE, &none);
    const int nothing = ::open("/dev/null", O_RDONLY);
    const bool ready = ::dup2(nothing, STDIN_FILENO) >= 0 && ::dup2(out, STDOUT_FILENO) >= 0 &&
                       ::dup2(messages, STDERR_FILENO) >= 0;
    ::close_range(STDERR_FILENO + 1, ~0U, 0);
    if (ready) ::execv("/proc/self/exe", words);
    ::_exit(127);
}

bool is_reaped(pid_t process) {
    return ::waitpid(process, nullptr, WNOHANG) != 0;  // an error: somebody else has done it
}

}  // namespace

VerbProcess::~VerbProcess() {
    end();
    if (messages_ >= 0) ::close(messages_);
    // A killed process is gone at once, unless it is stuck deep in a driver; that one is left.
    for (int i = 0; i < 1000 && !dying_.empty(); ++i) {
        reap();
        if (!dying_.empty()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
}

void VerbProcess::start(std::vector<std::string> words) {
    end();
    words.insert(words.begin(), "glint");
    std::vector<char*> pointers;
    for (std::string& word : words) pointers.push_back(word.data());
    pointers.push_back(nullptr);
    std::array<int, 2> ends{};
    if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("There is no pipe.");
    if (messages_ >= 0) ::close(messages_);
    messages_ = ::memfd_create("messages", MFD_CLOEXEC);
    const pid_t parent = ::getpid();
    process_ = ::fork();
    if (process_ == 0) become(pointers.data(), parent, ends[1], messages_);
    ::close(ends[1]);
    out_ = ends[0];
    ::fcntl(out_, F_SETFL, O_NONBLOCK);
    if (process_ > 0) return;
    process_ = 0;
    end();
    throw std::runtime_error("There is no process to be had.");
}

void VerbProcess::end() {
    if (out_ >= 0) ::close(std::exchange(out_, -1));
    heard_.clear();
    if (process_ == 0) return;
    ::kill(-process_, SIGKILL);
    ::kill(process_, SIGKILL);  // it may not have come to lead a group yet
    dying_.push_back(std::exchange(process_, 0));
    reap();
}

// Does not wait: drivers take their time to end.
void VerbProcess::reap() {
    std::erase_if(dying_, is_reaped);
    int status = 0;
    if (!is_ending() || ::waitpid(process_, &status, WNOHANG) == 0) return;
    process_ = 0;
    exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::vector<std::string> VerbProcess::lines() {
    std::vector<std::string> whole;
    std::array<char, 16 * 1024> chunk;
    while (out_ >= 0) {
        const ssize_t length = ::read(out_, chunk.data(), chunk.size());
        if (length < 0 && errno == EINTR) continue;
        if (length < 0 && errno == EAGAIN) break;
        if (length <= 0) {
            ::close(std::exchange(out_, -1));
            break;
        }
        heard_.append(chunk.data(), static_cast<std::size_t>(length));
    }
    std::size_t begin = 0;
    for (std::size_t at; (at = heard_.find('\n', begin)) != std::string::npos; begin = at + 1) {
        whole.push_back(heard_.substr(begin, at - begin));
    }
    heard_.erase(0, begin);
    reap();
    return whole;
}

// The first error, or else the last line.
std::string VerbProcess::complaint() const {
    std::array<char, 16 * 1024> text;
    const ssize_t length = messages_ < 0 ? 0 : ::pread(messages_, text.data(), text.size(), 0);
    std::string_view rest(text.data(), static_cast<std::size_t>(length > 0 ? length : 0));
    std::string_view last;
    while (!rest.empty()) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
        if (!line.empty()) last = line;
        if (line.find("error: ") != std::string_view::npos) break;
    }
    return std::string(last);
}

}  // namespace glint
