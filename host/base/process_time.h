// What a process has been given of the processors, as the kernel's scheduler counts it.
#pragma once

#include <sys/types.h>

namespace glint {

// Seconds, summed over the threads that a process has now.
struct ProcessTime {
    double used = 0.0;    // on a processor
    double waited = 0.0;  // ready to run, while others ran
};

// Milliseconds that the processors have spent on this process, in all threads, gone ones too.
double own_processor_ms();
// Those on the calling thread.
double own_thread_ms();

// 0 of a process that is gone, and where the kernel does not count.
ProcessTime time_of(pid_t process);

// Whether a process that has something to do within `limit` seconds has had the chance. `wall`:
// seconds since it began; `since`: its time in them; `processors`: of this machine. True
//   - when it ran, or slept by its own will (for a GPU, say), for so long;
//   - when it has used what a machine without other work could have given it in that time;
//   - and, however little it was given, after 15 times as long.
// So on a machine without other work this is `wall > limit`.
bool had_its_time(double limit, double wall, const ProcessTime& since, unsigned processors);

}  // namespace glint
