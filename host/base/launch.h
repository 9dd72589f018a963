// One way to start a program: what it gets of ours, and how it ends with us.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <optional>
#include <string>
#include <vector>

namespace glint {

// What stands at one of a program's first three descriptors, besides a descriptor of ours.
constexpr int kNothing = -1;  // /dev/null
constexpr int kOurs = -2;     // what stands there here
constexpr int kPipe = -3;     // a new pipe, whose other end we get; for one of the three at most
constexpr int kSocket = -4;   // the same with a stream socket, which goes both ways

struct Launch {
    std::vector<std::string> words;  // its name, then what it is told
    std::string program{};  // the file, where that is not its name; PATH finds it if no / is in it
    int input = kNothing, output = kNothing, messages = kNothing;
    enum class Group { ours, own, session } group = Group::ours;  // a session has no terminal
    // Killed when the thread that launches it ends, however that comes about.
    bool ends_with_us = true;
    bool default_signals = false;  // none ignored, none blocked; false: as here
    bool core_files = true;
    int niceness = 0;  // 0: ours
    // Seconds of a processor and bytes of memory, beyond which it is ended; 0: as many as it takes.
    rlim_t most_seconds = 0, most_bytes = 0;
};

struct Launched {
    pid_t process = 0;  // the caller waits for it in the end
    int pipe = -1;      // our end; the caller closes it
    int error = 0;      // why nothing was started, as errno has it
};

// Starts a program, which gets no other descriptor of ours than these three. May be called while
// other threads run.
Launched launch(const Launch& wanted);

// For a process that is there by fork alone: ends it with the thread that has forked it.
void end_with(pid_t parent);

// All that comes through a pipe, until nobody has its other end any more; closes ours.
std::string read_to_end(int pipe);

// How a process ended: its exit code, or minus the signal that ended it. wait_for() waits for
// that; ended() does not, and knows nothing before. Of what somebody else has waited for, 0.
int wait_for(pid_t process);
std::optional<int> ended(pid_t process);

// Leaders of groups that were killed and are not gone yet. Nobody waits for them: deep in a driver
// they take their time.
class Dying {
public:
    Dying() = default;
    ~Dying();  // waits up to a second; one that is stuck is left
    Dying(const Dying&) = delete;
    Dying& operator=(const Dying&) = delete;

    // Kills a process, if there is one, with all that it has started, and makes it 0.
    void end(pid_t& process);
    void reap();
    bool empty() const { return processes_.empty(); }

private:
    std::vector<pid_t> processes_;
};

}  // namespace glint
