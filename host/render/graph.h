// What must run: which passes the picture needs, which buffers are read back, and how often each
// pass has anything new to draw. Plain data; no GL.
#pragma once

#include "scene/scene.h"

#include <cstddef>
#include <string>
#include <vector>

namespace glint {

// How often a pass runs.
enum class Runs { every_frame, on_change, every_step };

// "every frame", "on change" or "every step", as `info` prints it.
const char* to_string(Runs runs);

// What one linked pass reads.
struct PassReads {
    std::size_t pass = 0;              // kImagePass for the picture
    std::vector<std::size_t> buffers;  // passes whose buffers it reads, each once
    bool changes_by_itself = false;  // reads time, frame, tick, date or a sound: new in every frame
};

// One pass that must run, in drawing order.
struct GraphPass {
    std::size_t pass = 0;
    std::vector<std::size_t> reads;
    bool feedback = false;  // reads its own previous frame, so its buffer is double
    bool previous = false;  // some buffer that it reads was drawn in the previous frame
    bool carries = false;  // its content is read in a later frame, or the next step goes on from it
    bool feeds_state = false;  // a later frame depends on it: a simulation must draw it every time
    Runs runs = Runs::on_change;
};

struct PassGraph {
    std::vector<GraphPass> passes;
    bool stateful = false;  // the picture at a time depends on the frames before it
};

// `reads` holds the passes that the root needs, directly or through others, and the root. Passes
// run in the order of their declarations. Reading a buffer that has run in this frame gives this
// frame; reading oneself or a later one gives the previous frame.
PassGraph build_graph(const std::vector<Pass>& passes, std::vector<PassReads> reads);

// Whether a buffer as large as the picture, or a share of it, carries something into a later frame:
// another size of the picture would crop it.
bool keeps_picture_size(const Scene& scene, const PassGraph& graph);

// Whether a pass is drawn anew at every sub-pixel position of an averaged picture: the picture, and
// buffers of its own pixels that no later frame depends on. All others stay as they are.
bool is_jittered(const Scene& scene, const GraphPass& pass);

}  // namespace glint
