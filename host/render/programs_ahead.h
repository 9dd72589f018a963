// Programs that a thread of its own links while another one links the picture's.
#pragma once

#include "gl/context_beside.h"
#include "render/compile_watch.h"
#include "render/program.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace glint {

// Links the passes whose buffers the picture reads, as far as the words of texts tell; what
// constants switch off only the driver knows. To be made and destroyed on the thread whose context
// is current.
class ProgramsAhead {
public:
    struct Linked {
        PassText source;
        Program program;
    };

    // All but `options` outlive it; `give_up` may be empty.
    ProgramsAhead(const Preset& preset, const ProgramOptions& options, const GiveUp& give_up);
    ~ProgramsAhead();  // waits for the one that it is at
    ProgramsAhead(const ProgramsAhead&) = delete;
    ProgramsAhead& operator=(const ProgramsAhead&) = delete;

    // Where it is at that one, links others meanwhile, from the last one down, and waits when none
    // is left. Nothing where it has not come to it, and then never will, or where there is
    // something to say of it.
    std::optional<Linked> take(std::size_t pass);

private:
    enum class State { waiting, begun, done };
    struct Pass {
        State state = State::waiting;
        std::optional<Linked> linked;
    };

    bool ends_before(std::chrono::milliseconds patience);
    void work(std::chrono::milliseconds patience);
    std::optional<std::size_t> begin_next();
    void want(const std::vector<std::size_t>& passes);
    void link(std::size_t pass);  // on any thread that has begun it

    const Preset& preset_;
    const ProgramOptions options_;
    const GiveUp& give_up_;
    ContextBeside context_;
    std::mutex mutex_;
    std::condition_variable changed_;
    bool ends_ = false;
    std::vector<Pass> passes_;
    std::vector<std::size_t> wanted_;  // in the order in which they are met
    std::thread thread_;
};

}  // namespace glint
