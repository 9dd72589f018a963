// Another verb of this program in a process of its own, which the window hears line by line while
// it goes on drawing.
#pragma once

#include "base/launch.h"

#include <string>
#include <vector>

namespace glint {

// What the window was started with, and its verbs are to use as well.
struct VerbOptions {
    std::string device;
    bool specialise = true;
};

// It ends with this one, however this one ends, and yields the processor to it. To be used on one
// thread, which lives as long as the program.
class VerbProcess {
public:
    VerbProcess() = default;
    ~VerbProcess();
    VerbProcess(const VerbProcess&) = delete;
    VerbProcess& operator=(const VerbProcess&) = delete;

    // Runs `glint WORDS…`, instead of what may still run. Throws std::runtime_error when there is
    // no process to be had.
    void start(std::vector<std::string> words);

    // Ends it, and all that it has started.
    void end();

    // What has come on its stdout since the last call, as whole lines; does not wait.
    std::vector<std::string> lines();

    // Until it has ended and its last line was taken.
    bool runs() const { return process_ != 0; }

    // For ::poll(): readable when lines() has something to tell; -1 when nothing runs, and in the
    // last moments of a process, when lines() has to be asked now and then.
    int descriptor() const { return out_; }
    bool is_ending() const { return runs() && out_ < 0; }

    // Of the last one, once it has ended by itself: its exit code, or minus the signal that ended
    // it; and why, in its own words.
    int exit_code() const { return exit_code_; }
    std::string complaint() const;

private:
    void reap();

    pid_t process_ = 0;
    Dying dying_;
    int out_ = -1, messages_ = -1;  // its stdout, and what it wrote to stderr
    std::string heard_;             // no whole line yet
    int exit_code_ = 0;
};

}  // namespace glint
