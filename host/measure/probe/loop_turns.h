// How many turns the loops of a frame take. Those of llvmpipe share 65,535 a pixel, then end
// without a word, and what is drawn is not what the text says. Eight pixels share them, and a loop
// takes as many as the one of these that is in it the longest: together they may run out where none
// would alone.
#pragma once

#include "gl/context.h"
#include "measure/probe/probe.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace glint {

inline constexpr std::uint32_t kLoopBudget = 65535;  // LP_MAX_TGSI_LOOP_ITERATIONS (Mesa 22.3)

class LoopTurns {
public:
    // Compiles every pass once more; `compiled` is called after each. `preset` and `renderer` must
    // outlive this. Throws ProbeRefused.
    LoopTurns(const Preset& preset, Renderer& renderer, const ProgramOptions& options,
              const std::function<void()>& compiled = {});

    // Counts while `draw` draws this frame, all passes of it.
    void count(const Frame& frame, const std::function<void()>& draw);
    void forget() { most_ = 0; }
    // Of all frames that are not forgotten: the pixel with the most, and in which pass.
    std::uint32_t most() const { return most_; }
    const std::string& pass() const { return pass_; }
    // Whether that is all that there are, or so nearly that what the text adds to count is the
    // rest.
    bool is_cut() const { return most_ >= kLoopBudget - 535; }
    // Of the last frame, all passes together, for each pixel of the picture.
    double a_pixel() const { return turns_ / pixels_; }

private:
    const Preset& preset_;
    Renderer& renderer_;
    std::vector<Probe> probes_;  // by pass
    std::uint32_t most_ = 0;
    std::string pass_;
    double turns_ = 0.0, pixels_ = 1.0;
};

// Where no pixel takes more, its neighbours have not been seen to make it too many.
inline constexpr std::uint32_t kFewTurns = kLoopBudget / 4;

// Whether pixels of the picture, as the renderer has just drawn it in this frame, come out
// otherwise where their neighbours do nothing. One in 64 is tried, and none where the text may ask
// its neighbours or leave a pixel out, or cannot be compiled so.
bool differs_alone(const Preset& preset, Renderer& renderer, const ProgramOptions& options,
                   const Frame& frame);

// Whether the driver ends loops so.
bool ends_loops(const Context& context);

}  // namespace glint
