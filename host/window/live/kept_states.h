// States of a simulation in memory: a jump of time is played again from the nearest one, not from
// the start.
#pragma once

#include "offline/common.h"

#include <cstddef>
#include <vector>

namespace glint {

class KeptStates {
public:
    static constexpr std::size_t kBudget = std::size_t{256} << 20;  // bytes, of all together
    static constexpr int kLeastApart = 30;                          // frames of 1/60 s

    explicit KeptStates(std::size_t budget = kBudget) : budget_(budget) {}

    // What stands before frame `frame` of a Playback at 60 Hz, whatever its end.
    struct State {
        int frame = 0;
        double time = 0.0;  // s; of what was simulated last
        std::vector<PassState> passes;
    };

    // Whether one before this frame is of use: none stands near.
    bool wants(int frame) const;

    // Keeps it. Where all together are over the budget, those go that leave the least gap for their
    // age: the newest stand half a second apart, and the older the wider. One that is more than a
    // quarter of the budget is not kept, nor any after it until clear().
    void keep(State state);

    // The last one from which this playback can be reached; null: from the start. Valid until the
    // next keep() or clear().
    const State* nearest(const Playback& playback) const;

    // They are of another text, of other tweaks, inputs, or of another size.
    void clear();

    // Where they stand, s, ascending.
    const std::vector<double>& times() const { return times_; }

private:
    void thin_out();

    std::size_t budget_, bytes_ = 0;
    std::vector<State> states_;  // by frame
    std::vector<double> times_;  // of each
    bool is_too_large_ = false;
};

}  // namespace glint
