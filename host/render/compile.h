// A scene as linked programs: only those passes that the wanted one needs, and what each must do.
#pragma once

#include "render/compile_watch.h"
#include "render/graph.h"
#include "render/program.h"

#include <functional>

namespace glint {

struct CompileOptions {
    std::size_t root = kImagePass;  // the pass that is wanted; others only where it needs them
    ProgramOptions program{};
    // Where the driver compiles on the processor: passes that fill buffers are linked on another
    // one while the root is. Times of single passes mean nothing then.
    bool side_by_side = false;
    // What the texts name counts as read, though the driver leaves out what its value does not hang
    // on: for who looks into variables.
    bool as_written = false;
};

// `programs` stand in the order of `graph.passes`. To be drawn with the preset that it was compiled
// from, or, when not specialised, with other values of its tweaks.
struct CompiledScene {
    std::vector<PassProgram> programs;
    PassGraph graph;
    double compile_ms = 0.0;  // of processors: reading and linking; the rest is in the first draw
    std::size_t root = 0;  // where the wanted pass stands; later ones are those that it reads back
    GiveUp give_up;        // ends what is still compiling at the first draw; empty: nothing does
};

struct CompileResult {
    std::optional<CompiledScene> scene;  // empty when there are errors
    Diagnostics diagnostics;             // each once, however many passes share the text
};

// Links the root, asks it which buffers it reads, links their passes, and so on. `before_pass`
// hears of each pass before it is compiled, `give_up` (where there is one) of the pass that the
// driver would never finish.
CompileResult compile_scene(const Preset& preset, const CompileOptions& options,
                            const std::function<void(std::size_t pass)>& before_pass = nullptr,
                            const GiveUp& give_up = nullptr, ProgramShelf* shelf = nullptr);

// Those of its programs.
std::vector<GLuint> ids_of(const CompiledScene& scene);

}  // namespace glint
