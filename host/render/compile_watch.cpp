#include "render/compile_watch.h"

#include "base/memory.h"
#include "gl/context.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <mutex>
#include <optional>

namespace glint {
namespace {

using namespace std::chrono_literals;

// A driver that takes memory as fast as it can takes some tens of megabytes meanwhile.
constexpr auto kBetweenLooks = 20ms;

double seconds_on(clockid_t clock) {
    timespec now{};
    clock_gettime(clock, &now);
    return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

// Takes none itself: it is asked for where there may be none.
std::size_t resident_bytes() {
    std::array<char, 128> text{};
    const int file = ::open("/proc/self/statm", O_RDONLY | O_CLOEXEC);
    if (file < 0) return 0;
    const ssize_t length = ::read(file, text.data(), text.size() - 1);
    ::close(file);
    if (length <= 0) return 0;
    char* end = nullptr;
    std::strtoull(text.data(), &end, 10);  // the whole; what is resident comes second
    return std::strtoull(end, nullptr, 10) * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
}

// Processor time, so that a busy machine changes nothing. Where the processor draws, too, threads
// of its own do so beside the one that compiles; drivers of GPUs compile in threads of their own.
clockid_t compiling_clock() {
    clockid_t clock = CLOCK_PROCESS_CPUTIME_ID;
    if (draws_in_software()) pthread_getcpuclockid(pthread_self(), &clock);
    return clock;
}

std::optional<double> wanted_by(const char* variable) {
    const char* text = std::getenv(variable);
    const double number = text ? std::strtod(text, nullptr) : 0.0;
    return number > 0.0 && number < 1e6 ? std::optional(number) : std::nullopt;
}

// What a handler of signals can know of a thread.
struct Trapped {
    std::atomic<pid_t> thread = 0;
    std::atomic<int> signal = 0;
    alignas(16) std::array<std::byte, 64 * 1024> stack;  // a compiler overflows its own
};
std::array<Trapped, kMostTraps> trapped;

// The handlers are those of the process: the first trap sets them, the last one puts back what was.
constexpr std::array kSignals = {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL};
std::array<struct sigaction, kSignals.size()> handlers_before;
std::mutex traps_mutex;
int traps = 0;

void default_action(int signal) {
    ::signal(signal, SIG_DFL);
    ::raise(signal);  // heard when the handler returns
}

// The other thread says what there is to say, and ends the process; or it is stuck as well.
void hear_crash(int signal) {
    for (Trapped& one : trapped) {
        if (one.thread != ::gettid()) continue;
        one.signal = signal;
        ::sleep(5);
    }
    default_action(signal);
}

void set_handlers() {
    struct sigaction action {};
    action.sa_handler = hear_crash;
    action.sa_flags = SA_ONSTACK;
    for (std::size_t i = 0; i < kSignals.size(); ++i)
        ::sigaction(kSignals[i], &action, &handlers_before[i]);
}

}  // namespace

CrashTrap::CrashTrap() {
    const std::lock_guard lock(traps_mutex);
    if (traps++ == 0) set_handlers();
    for (place_ = 0; place_ < kMostTraps && trapped[place_].thread != 0;) ++place_;
    if (place_ == kMostTraps) return;
    trapped[place_].signal = 0;
    trapped[place_].thread = ::gettid();
    stack_t stack{};
    stack.ss_sp = trapped[place_].stack.data();
    stack.ss_size = trapped[place_].stack.size();
    ::sigaltstack(&stack, &stack_before_);
}

CrashTrap::~CrashTrap() {
    const std::lock_guard lock(traps_mutex);
    if (--traps == 0)
        for (std::size_t i = 0; i < kSignals.size(); ++i)
            ::sigaction(kSignals[i], &handlers_before[i], nullptr);
    if (place_ == kMostTraps) return;
    ::sigaltstack(&stack_before_, nullptr);
    trapped[place_].thread = 0;
}

int CrashTrap::crashed() const {
    return place_ == kMostTraps ? 0 : trapped[place_].signal.load();
}

CompileLimits compile_limits() {
    CompileLimits limits;
    if (const auto seconds = wanted_by("GLINT_COMPILE_SECONDS")) limits.seconds = *seconds;
    if (const auto gib = wanted_by("GLINT_COMPILE_GIB"))
        limits.bytes = static_cast<std::size_t>(*gib * (1 << 30));
    limits.bytes = std::min(limits.bytes, available_memory() / 4 * 3);
    return limits;
}

CompileWatch::CompileWatch(const GiveUp& give_up, const Preset& preset, std::size_t pass,
                           std::size_t more_bytes) {
    const clockid_t clock = compiling_clock();
    const double start = seconds_on(clock);
    const std::size_t resident = resident_bytes();
    const CompileLimits limits = compile_limits();  // where what it throws is caught
    thread_ = std::jthread([=, this, &give_up, &preset](const std::stop_token& stop) {
        std::mutex own;
        std::unique_lock lock(own);
        std::condition_variable_any none;
        while (!none.wait_for(lock, stop, kBetweenLooks, [&] { return stop.stop_requested(); })) {
            if (const int signal = trap_.crashed())
                give_up(preset, pass, fmt::format("crashed ({})", ::strsignal(signal)));
            if (seconds_on(clock) - start > limits.seconds)
                give_up(preset, pass,
                        fmt::format("took more than {:g} s to compile", limits.seconds));
            if (resident_bytes() > resident + limits.bytes + more_bytes)
                give_up(preset, pass,
                        fmt::format("took more than {:.1f} GiB of memory to compile",
                                    static_cast<double>(limits.bytes) / (1 << 30)));
        }
    });
}

}  // namespace glint
