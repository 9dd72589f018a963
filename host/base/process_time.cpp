#include "base/process_time.h"

#include <time.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>

namespace glint {
namespace {

constexpr double kNanosecond = 1e-9;
constexpr double kMostPatience = 15.0;  // times the limit

double ms_on(clockid_t clock) {
    timespec time{};
    ::clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) * 1e3 + static_cast<double>(time.tv_nsec) * 1e-6;
}

}  // namespace

double own_processor_ms() {
    return ms_on(CLOCK_PROCESS_CPUTIME_ID);
}

double own_thread_ms() {
    return ms_on(CLOCK_THREAD_CPUTIME_ID);
}

// "schedstat" of each thread: ns on a processor, ns in the queue for one, and how many times.
ProcessTime time_of(pid_t process) {
    ProcessTime time;
    std::error_code gone;
    const std::string threads = "/proc/" + std::to_string(process) + "/task";
    for (auto thread = std::filesystem::directory_iterator(threads, gone);
         !gone && thread != std::filesystem::directory_iterator(); thread.increment(gone)) {
        double used_ns = 0.0, waited_ns = 0.0;
        std::ifstream(thread->path() / "schedstat") >> used_ns >> waited_ns;
        time.used += used_ns * kNanosecond;
        time.waited += waited_ns * kNanosecond;
    }
    return time;
}

bool had_its_time(double limit, double wall, const ProcessTime& since, unsigned processors) {
    if (wall <= limit) return false;
    return wall - since.waited > limit || since.used > limit * std::max(processors, 1u) ||
           wall > limit * kMostPatience;
}

}  // namespace glint
