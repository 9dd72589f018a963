// A candidate is compiled and drawn small in another process first, so that a shader that never
// ends or takes the GPU down cannot take the window with it.
#pragma once

#include "base/process_time.h"
#include "offline/common.h"
#include "window/trial/socket_process.h"

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace glint {

struct TrialAnswer;

// What an image sampler will read; its pixels do not matter here, its form does.
struct TrialImage {
    std::size_t sampler = 0;  // as in sampler_at
    glm::ivec2 size{1};       // pixels
    int channels = 4;
    bool floats = false;
};

// What is about to be drawn. Text, declarations and values are sent as they stand here; the other
// process opens no file.
struct Candidate {
    const Preset& preset;
    CompileOptions compile;
    glm::ivec2 size{1280, 720};  // pixels of the picture, for the estimate
    PixelFormat picture_format = PixelFormat::rgba8;
    double time = 0.0;  // s
    std::vector<TrialImage> images;
    // Nobody has judged the text yet: all of it has to compile, what no pass calls and its sound
    // too.
    bool is_text = true;
};

enum class TrialState {
    idle,         // nothing was started
    running,      // no answer yet
    passed,       // drawn; `expected_ms` may still be too much for a window
    rejected,     // does not compile, or the driver refused it: see the diagnostics
    too_slow,     // no frame within the limit, though it had the time
    crashed,      // the driver ended the process
    lost,         // the GPU was reset
    unavailable,  // there is no second context to try it in; go on without
};

struct PassTrial {
    std::string name;
    double compile_ms = 0.0;
    // Small draws: the first, with what the driver compiles only then, and the second; 0 when
    // nothing had changed for this pass. Processor time where software draws.
    double first_ms = 0.0, second_ms = 0.0;
    double expected_ms = 0.0;  // a draw at its full size, roughly; 0 for less than can be told
};

struct Verdict {
    TrialState state = TrialState::idle;
    std::vector<PassTrial> passes;  // in drawing order, as far as it came
    double expected_ms = 0.0;       // a frame at full size: the sum over the passes
    double total_ms = 0.0;          // from start() to the answer
    // Errors and warnings of the compiler, or why it did not pass: which pass, why, and the place
    // of the loop that is likely to blame.
    Diagnostics diagnostics;
};

struct TrialOptions {
    std::string device;                               // as for make_egl_context
    std::filesystem::path program{"/proc/self/exe"};  // run as `program trial DEVICE`
    // What the other process has, as far as the machine lets it run (base/process_time.h).
    double draw_seconds = 2.0;      // for one small draw
    double compile_seconds = 20.0;  // for a compile; it holds nobody up
    double slow_ms = 1000.0;        // a warning names the likely loop from this expected frame on
    int niceness = 0;               // of the other process
    bool at_once = true;            // else by get_ready(), or the first candidate
};

// Keeps a process at hand; a new one is started in the background when one had to be killed. To be
// used on one thread, which lives as long as the process that is to be protected: the other one
// ends with it.
class Trial {
public:
    explicit Trial(TrialOptions options = {});
    ~Trial();
    Trial(const Trial&) = delete;
    Trial& operator=(const Trial&) = delete;

    // Starts the process, unless there is one; does not wait.
    void get_ready();

    // Does not wait. One that is still running gives way; its answer is never seen.
    void start(const Candidate& candidate);

    // What is known now; does not wait. After an answer it gives the same one until the next start.
    const Verdict& poll();

    // For ::poll(): readable when poll() may know more, also while no trial runs; -1 when there is
    // no process. It changes with the process.
    int descriptor() const { return process_.descriptor(); }

    // The renderer of the other process once it is ready, "" before; for telling whether it is the
    // window's.
    const std::string& renderer() const { return renderer_; }

    // The process that tries; 0 when there is none.
    pid_t process() const { return process_.id(); }

    // What the process does with the newest candidate, in words such as "compiling image".
    std::string work() const;

    // Whether there is no answer yet to the newest candidate.
    bool is_running() const { return verdict_.state == TrialState::running; }

private:
    using Clock = std::chrono::steady_clock;

    void spawn();
    void replace_process();
    void receive();
    void hear(TrialAnswer answer);
    void note_time();
    void fail(TrialState state, const std::string& why);
    void hear_end_of_process();
    bool is_at_work() const;  // the process, as far as it has told
    bool is_too_slow() const;
    double limit_seconds() const;

    TrialOptions options_;
    SocketProcess process_;
    int failed_starts_ = 0;               // in a row, of processes that were not ready yet
    int failed_launches_ = 0;             // in a row, of those that the system did not make
    std::string unavailable_;             // why there can be no process
    std::string renderer_;                // "": not ready yet
    std::string order_;                   // the newest candidate, as sent
    std::uint64_t number_ = 0;            // of the newest candidate
    std::unique_ptr<TrialAnswer> heard_;  // the last words, whichever candidate they are about
    Clock::time_point started_, heard_at_;
    std::optional<Clock::time_point> silent_since_;  // its socket is closed, and it not yet gone
    ProcessTime heard_time_;                         // of the process, then
    Verdict verdict_;
};

// `glint trial`: the other process. Takes candidates from standard input, which is a socket, and
// answers there until it is closed. Throws UsageError when it is none.
void run_trial(const std::string& device);

}  // namespace glint
