// Passes that threads of their own, each with a context of its own, let the driver compile.
#pragma once

#include "gl/context_beside.h"

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace glint {

// Each of so many passes is compiled once: by the threads from the last one down, for the picture's
// takes longest, or by the thread that made this, at the draws that it comes to meanwhile. To be
// made and destroyed on the thread whose context is current.
class CompileAhead {
public:
    using Compile = std::function<void(std::size_t pass)>;
    // Hears, on one of the threads at a time, of the pass that has been compiled for the longest
    // whenever that is another one: a driver that never comes back is in that one. May be empty.
    using WorksOn = std::function<void(std::size_t pass)>;

    // One thread a processor, but for the calling one. `compile` is called on any of them.
    CompileAhead(std::size_t passes, Compile compile, WorksOn works_on);
    ~CompileAhead();  // waits for what they are at
    CompileAhead(const CompileAhead&) = delete;
    CompileAhead& operator=(const CompileAhead&) = delete;

    // False where no context could be had; nothing is compiled then.
    bool is_there() const { return !threads_.empty(); }

    // The calling thread is about to draw it: nobody else begins with it, and who is at it is
    // waited for. While it draws the last one, the picture, nothing else is begun: what is left
    // then is for later frames, and this one would wait for it.
    void take(std::size_t pass);

    // Compiles on this thread, too, until all is done. The processor's milliseconds of each; 0
    // where it was taken.
    std::vector<double> finish();

private:
    enum class State { waiting, begun, done };

    void work(ContextBeside& context);
    void compile(std::size_t pass);
    bool begin(std::size_t pass);
    void end(std::size_t pass, double ms);
    void tell() const;

    const Compile compile_;
    const WorksOn works_on_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::vector<State> states_;
    std::vector<double> ms_;
    bool rests_ = false;
    std::vector<std::size_t> begun_;  // and not done, the oldest first
    std::deque<ContextBeside> contexts_;
    std::vector<std::jthread> threads_;  // the last member: they use all others
};

}  // namespace glint
