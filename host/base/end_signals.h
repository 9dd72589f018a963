// Ctrl+C in the terminal, `kill`, and the terminal's end: the program is asked to end, and does so
// in order.
#pragma once

namespace glint {

// From now on SIGINT, SIGTERM and SIGHUP wait to be noticed, each once: a second of a kind ends the
// program at once, for one that hangs. What was ignored (nohup) stays so. One at a time.
class EndSignals {
public:
    EndSignals();
    ~EndSignals();
    EndSignals(const EndSignals&) = delete;
    EndSignals& operator=(const EndSignals&) = delete;

    int descriptor() const;  // readable once one has come
    int arrived() const;     // its number, or 0

private:
    int pipe_[2];
};

// Ends the process as the signal would have: a shell sees 128 + number.
[[noreturn]] void end_by(int signal);

}  // namespace glint
