// A picture that stands still becomes the one that `glint still --samples` would write, in a
// process of its own: neither its compiler nor its draws keep the window waiting.
#pragma once

#include "offline/common.h"
#include "window/trial/socket_process.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace glint {

// What a buffer of the scene holds already, for a process that need not draw it.
struct GivenBuffer {
    std::size_t pass = 0;              // of the scene
    bool feeds_state = false;          // as it is, whatever its text says by now
    std::size_t text_hash = 0;         // of the text that it was drawn with; 0: of no one text
    std::vector<std::size_t> reads{};  // passes
    glm::ivec2 size{0};
    int outputs = 1;
    std::size_t begin = 0;  // in shared memory, RGBA in floats, an output after the other
    bool is_known = false;  // given before, and the same since: not in memory any more
};

// What is to be drawn. Text, values and what the scene has simulated are sent as they stand here;
// only the files of its samplers are read there.
struct RefineOrder {
    Preset preset;  // whose size is the picture's
    bool specialise = true;
    int samples = 64;  // 0: what is given is only to be made ready, for the order that follows
    // The frame that stands.
    double time = 0.0, time_delta = 1.0 / 60, frame_rate = 60.0;
    int frame = 0;
    glm::vec4 date{0.0f};
    Input input{};
    glm::ivec2 mouse_size{0};  // as of a Frame
    std::vector<PassState> state{};
    std::vector<GivenBuffer> given{};  // to a sketch
};

// Which of `count` samples comes k-th, so that those so far lie all over the pixel.
int refining_sample(int k, int count);

class Refiner {
public:
    // `verb`: what the other process does; `output`: what stands there at its standard output.
    explicit Refiner(std::string device, std::filesystem::path program = "/proc/self/exe",
                     std::string verb = "refine", int output = kNothing);

    // Has a process at hand, unless one runs or cannot. Whether it is a new one.
    bool prepare();
    // Sends the one at hand what it needs to be ready: an order for no sample.
    void make_ready(const RefineOrder& order);

    // Instead of what may still run. Does not wait.
    void start(const RefineOrder& order);

    // Ends the process; what it has drawn goes. Costs nothing where there is none.
    void stop();

    // Hears the process; does not wait. True when a picture has arrived, or one more sample.
    bool update();

    // For ::poll(): readable when update() may know more; -1 when no process runs.
    int descriptor() const { return process_.descriptor(); }

    bool is_running() const { return process_.id() != 0; }
    pid_t process() const { return process_.id(); }  // 0 when there is none
    // Samples that have been drawn, and of how many; 0 of 0 before the start.
    int done() const { return done_; }
    int of() const { return of_; }
    // The mean so far, RGBA; empty until there is one.
    const Image& picture() const { return picture_; }
    // Whether it is another than when this was asked last.
    bool take_picture() { return std::exchange(is_new_picture_, false); }

private:
    bool take_arrived();

    std::string device_;
    std::filesystem::path program_;
    std::string verb_;
    int output_;
    bool is_refused_ = false;  // it ended before it was told anything
    SocketProcess process_;
    int done_ = 0, of_ = 0;
    bool is_new_picture_ = false;
    Image picture_;
};

// `glint refine`: the other process. Takes one order from standard input, which is a socket, and
// answers there. Throws UsageError when it is none.
void run_refine(const std::string& device);

// `glint sketch`: the same, once (window/trial/sketcher.h).
void run_sketch(const std::string& device);

}  // namespace glint
