// Bounds what a driver may take to compile one pass: no driver can be stopped in the midst, and
// some texts would have it unroll, inline or expand for hours, or until the system kills whom it
// likes. Others, nested too deep, make it crash.
#pragma once

#include <csignal>
#include <cstddef>
#include <functional>
#include <string>
#include <thread>

namespace glint {

struct Preset;

// Hears, on a thread of its own and while the driver still works, which pass is given up and why:
// "took more than 60 s to compile". Must not return: it ends the process.
using GiveUp = std::function<void(const Preset& preset, std::size_t pass, const std::string& why)>;

struct CompileLimits {
    // Processor time of one pass. The largest scenes here take 4 s, all their passes together.
    double seconds = 60.0;
    // Growth of this process's memory. Those scenes take 0.2 GiB.
    std::size_t bytes = std::size_t{2} << 30;
};

// The usual limits, with less memory where less is free. GLINT_COMPILE_SECONDS and
// GLINT_COMPILE_GIB in the environment are for machines that need others.
CompileLimits compile_limits();

// While it lasts, a crash of the thread that made it waits to be told of by another one. Of so many
// threads at a time; those of more crash untold.
inline constexpr unsigned kMostTraps = 4;
class CrashTrap {
public:
    CrashTrap();
    ~CrashTrap();
    CrashTrap(const CrashTrap&) = delete;
    CrashTrap& operator=(const CrashTrap&) = delete;

    // The signal; 0: none.
    int crashed() const;

private:
    unsigned place_ = kMostTraps;  // among the threads that are trapped
    stack_t stack_before_{};
};

// Watches what the thread that makes it lets a driver do, until it goes.
class CompileWatch {
public:
    // `give_up` and `preset` must outlive it. `more_bytes` may come on top of the limit: pixels.
    CompileWatch(const GiveUp& give_up, const Preset& preset, std::size_t pass,
                 std::size_t more_bytes = 0);

private:
    CrashTrap trap_;
    std::jthread thread_;
};

}  // namespace glint
