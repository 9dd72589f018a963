// A process that was given no processor is told from one that hangs.
#include "base/process_time.h"

#include "../crowd.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <thread>

namespace glint::process_time_test {
namespace {

using namespace std::chrono_literals;

TEST(HadItsTime, IsWhatAMachineWithoutOtherWorkWouldHaveGiven) {
    struct Case {
        const char* what;
        double wall;
        ProcessTime since;
        bool over;
    };
    // With a limit of 2 s and 4 processors.
    const Case cases[] = {
        {"it has just begun", 0.1, {.used = 0.1, .waited = 0.0}, false},
        {"the limit itself is no excess", 2.0, {.used = 2.0, .waited = 0.0}, false},
        {"a hang that computes", 2.1, {.used = 2.1, .waited = 0.0}, true},
        {"on all processors", 2.1, {.used = 8.4, .waited = 0.0}, true},
        {"on all processors, half as long", 1.1, {.used = 4.4, .waited = 0.0}, false},
        {"a hang that sleeps", 2.1, {.used = 0.0, .waited = 0.0}, true},
        {"it was given no processor", 2.1, {.used = 0.0, .waited = 2.1}, false},
        {"or hardly one", 10.0, {.used = 1.0, .waited = 9.0}, false},
        {"but half of one for long enough", 4.1, {.used = 2.05, .waited = 2.05}, true},
        {"many threads waited at once", 5.0, {.used = 3.0, .waited = 20.0}, false},
        {"and have used as much as ever they may", 9.0, {.used = 8.1, .waited = 40.0}, true},
        {"nobody waits for ever", 30.1, {.used = 0.0, .waited = 30.1}, true},
        {"where the kernel does not count, time goes by the wall", 2.1, {}, true},
    };
    for (const Case& c : cases) EXPECT_EQ(had_its_time(2.0, c.wall, c.since, 4), c.over) << c.what;
}

TEST(ProcessTime, CountsWhatWasUsedAndWhatWasWaitedFor) {
    const Crowd crowd(4);
    const pid_t first = crowd.processes.front();
    const auto end = std::chrono::steady_clock::now() + 20s;
    ProcessTime time;
    while (time.used < 0.1 && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(5ms);
        time = time_of(first);
    }
    EXPECT_GE(time.used, 0.1);
    EXPECT_GT(time.waited, time.used) << "three others had the processor as often";
}

TEST(ProcessTime, OneThatSleepsWaitsForNobody) {
    const pid_t process = fork();
    if (process == 0) {
        pause();
        _exit(0);
    }
    std::this_thread::sleep_for(50ms);  // it sleeps by now, whenever it began
    const ProcessTime before = time_of(process);
    std::this_thread::sleep_for(100ms);
    const ProcessTime after = time_of(process);
    kill(process, SIGKILL);
    waitpid(process, nullptr, 0);
    EXPECT_LT(after.used + after.waited - before.used - before.waited, 0.1);
    EXPECT_EQ(time_of(process).used, 0.0) << "it is gone";
}

}  // namespace
}  // namespace glint::process_time_test
