// What a saved text will look like, before the driver has made fast programs of it: another
// process, whose driver does not optimise, draws it once.
//
// Only drivers that draw in software have such a mode. Buffers that the edit leaves as they are
// lie in memory that both processes see, so that neither their passes are compiled there nor their
// simulations played. Maps, which stay as they are for long, are given before anybody edits.
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
// Of the text that would fill a pass's buffer as it was drawn: with constants, whose text it is, or
// by programs that were fed with `drawn`'s values (null), for which constants stand as well.
std::size_t filling_hash(const Preset& drawn, std::size_t pass, const std::string* constants);
// Those of a later order that were given before and are the same since are known.
void note_known(std::vector<GivenBuffer>& later, const std::vector<GivenBuffer>& before);

class Sketcher {
public:
    explicit Sketcher(const std::string& device,
                      const std::filesystem::path& program = "/proc/self/exe");

    // Has a process at hand: its driver takes longer to start than a small text to be drawn.
    // Whether it is a new one, which knows nothing yet.
    bool prepare() { return process_.prepare(); }
    // To the process at hand: what the order gives, for the one that follows.
    void make_ready(const RefineOrder& order) { process_.make_ready(order); }

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
