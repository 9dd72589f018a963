// Values of the scene on the screen, from a process that stands by: instrumented texts are compiled
// there, so that neither a compiler nor a loop without end keeps the window waiting.
//
// The order tells all; what that process has at hand already (a text, its programs, buffers) it
// keeps. What it answers is of measure/rows/probe.h.
#pragma once

#include "glsl/raw_text.h"
#include "window/trial/refiner.h"
#include "window/trial/shared_memory.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace glint {

enum class ProbeMap : std::uint8_t { none, value, cost };

struct ProbeOrder {
    std::uint64_t number = 0;   // of the order
    std::uint64_t subject = 0;  // another one: another text, value, size or pass
    std::uint64_t instant = 0;  // another one: another frame, other buffers
    RefineOrder scene;
    std::size_t pass = 0;
    std::optional<glm::ivec2> pixel{};  // of the pass's buffer, y up
    // Of the pixel, as it stands in that buffer; where there is one to compare with.
    std::optional<glm::vec4> colour{};
    Span lines{};  // bytes of the text whose values are wanted
    // The value in every pixel, or what every pixel costs.
    ProbeMap map = ProbeMap::none;
    int line = 0, column = 0;  // of the value's row, with its file and its name
    std::string file{}, name{}, kind{};
};

struct ProbeAnswer {
    std::uint64_t number = 0;
    std::string found{};  // a Probing as JSON; its first `watched` values are those of the watches
    int watched = 0;
    // Whether all lines are compiled that were asked for: each order has some of them compiled.
    bool is_whole = true;
    std::vector<std::uint8_t> ran{};  // by line of the text: a LineState; where it is whole
    std::string problem{};            // why there is nothing; "" where there is
    double compile_ms = 0.0;          // 0 where all was at hand
    // Four floats a pixel, of which so many count, rows bottom up; and whether it was reached.
    ProbeMap map = ProbeMap::none;
    glm::ivec2 size{0};
    int components = 0;
    std::vector<std::byte> values{};
    std::vector<std::byte> reached{};
};

// What a line did at the pixel.
enum class LineState : std::uint8_t { unknown, ran, did_not_run };

class Prober {
public:
    explicit Prober(std::string device, std::filesystem::path program = "/proc/self/exe")
        : device_(std::move(device)), program_(std::move(program)) {}

    // Has a process at hand, unless one runs.
    void prepare();
    // One order at a time, and that memory belongs to it until it is answered. Does not wait.
    void ask(const ProbeOrder& order);
    // Ends the process. Costs nothing where there is none.
    void stop();

    // Hears the process; does not wait. The answer, when one has come. Where the process died, or
    // takes too long, an answer that says so.
    std::optional<ProbeAnswer> update();

    // For what the order gives.
    SharedMemory& memory() { return memory_; }
    bool is_asking() const { return asked_ != 0; }
    // Milliseconds since the order that is not answered yet.
    double waited_ms() const { return is_asking() ? since_asked_.ms() : 0.0; }
    pid_t process() const { return process_.id(); }           // 0 when there is none
    int descriptor() const { return process_.descriptor(); }  // for ::poll()

private:
    ProbeAnswer given_up(std::string problem);

    std::string device_;
    std::filesystem::path program_;
    SharedMemory memory_;
    SocketProcess process_;
    std::uint64_t asked_ = 0;
    bool has_answered_ = false;
    bool is_refused_ = false;  // it ended unasked, and never answered: it cannot start here
    Stopwatch since_asked_;
};

}  // namespace glint
