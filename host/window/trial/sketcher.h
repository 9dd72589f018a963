// What a saved text will look like, before the driver has made fast programs of it: another
// process, whose driver does not optimise, draws it once.
//
// Only drivers that draw in software have such a mode. Buffers that the edit leaves as they are
// lie in memory that both processes see, so that neither their passes are compiled there nor their
// simulations played.
#pragma once

#include "window/trial/refiner.h"
#include "window/trial/shared_memory.h"

#include <cstddef>
#include <filesystem>
#include <string>

namespace glint {

// Of the text that fills a buffer, as both processes reckon it.
std::size_t sketch_hash(const std::string& pass_text);
// The programs that a sketch is drawn with.
inline constexpr ProgramOptions kSketched{.specialise = true, .lean = true};

class Sketcher {
public:
    explicit Sketcher(const std::string& device,
                      const std::filesystem::path& program = "/proc/self/exe");

    // Has a process at hand: its driver takes longer to start than a small text to be drawn.
    void prepare() { process_.prepare(); }

    // For what the order gives.
    SharedMemory& memory() { return memory_; }

    // One picture, instead of what may still run. Does not wait.
    void start(const RefineOrder& order) { process_.start(order); }
    void stop() { process_.stop(); }

    // Hears the process; does not wait. True when the picture is there.
    bool update() { return process_.update() && process_.take_picture(); }
    const Image& picture() const { return process_.picture(); }

    // For ::poll(): readable when update() may know more; -1 when no process runs.
    int descriptor() const { return process_.descriptor(); }
    pid_t process() const { return process_.process(); }  // 0 when there is none
    // Whether it was given something to draw, and has not drawn it yet.
    bool is_drawing() const { return process_.of() > process_.done(); }

private:
    SharedMemory memory_;
    Refiner process_;
};

}  // namespace glint
