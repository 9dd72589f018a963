// A machine that is busy on purpose: children who compute for ever, all on one processor.
#pragma once

#include <sched.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

namespace glint {

class Crowd {
public:
    explicit Crowd(int count) {
        for (int i = 0; i < count; ++i) {
            const pid_t process = fork();
            if (process == 0) {
                ::prctl(PR_SET_PDEATHSIG, SIGKILL);
                ::setsid();  // kernels may share a processor out by session
                bring(0);
                for (std::atomic<unsigned> work = 0;; ++work) {
                }
            }
            processes.push_back(process);
        }
    }
    ~Crowd() {
        for (const pid_t process : processes) {
            kill(process, SIGKILL);
            waitpid(process, nullptr, 0);
        }
    }
    Crowd(const Crowd&) = delete;
    Crowd& operator=(const Crowd&) = delete;

    // This process, with all its threads, has to share that processor from now on; 0: the caller.
    static void bring(pid_t process) {
        const std::string name = process == 0 ? "self" : std::to_string(process);
        std::error_code gone;
        for (const auto& thread :
             std::filesystem::directory_iterator("/proc/" + name + "/task", gone)) {
            cpu_set_t one = first_processor();
            sched_setaffinity(std::stoi(thread.path().filename().string()), sizeof one, &one);
        }
    }

    std::vector<pid_t> processes;

private:
    static cpu_set_t first_processor() {
        cpu_set_t all, one;
        sched_getaffinity(0, sizeof all, &all);
        CPU_ZERO(&one);
        for (int cpu = 0; cpu < CPU_SETSIZE && CPU_COUNT(&one) == 0; ++cpu)
            if (CPU_ISSET(cpu, &all)) CPU_SET(cpu, &one);
        return one;
    }
};

}  // namespace glint
