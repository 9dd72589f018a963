#include "window/live/kept_states.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace glint {
namespace {

std::size_t bytes_of(const KeptStates::State& state) {
    std::size_t bytes = 0;
    for (const PassState& pass : state.passes) bytes += pass.bytes.size();
    return bytes;
}

}  // namespace

bool KeptStates::wants(int frame) const {
    if (is_too_large_ || frame < kLeastApart) return false;
    const auto after = std::ranges::lower_bound(states_, frame, {}, &State::frame);
    const bool is_near_after = after != states_.end() && after->frame - frame < kLeastApart;
    const bool is_near_before =
        after != states_.begin() && frame - std::prev(after)->frame < kLeastApart;
    // Far back they stand wider apart, and what was dropped there is not to come again.
    const bool is_behind = after != states_.end();
    return !is_near_after && !is_near_before && !(is_behind && bytes_ > budget_ / 2);
}

void KeptStates::keep(State state) {
    if (bytes_of(state) > budget_ / 4) {
        is_too_large_ = true;
        return;
    }
    bytes_ += bytes_of(state);
    states_.insert(std::ranges::upper_bound(states_, state.frame, {}, &State::frame),
                   std::move(state));
    thin_out();
    times_.clear();
    for (const State& kept : states_) times_.push_back(kept.time);
}

void KeptStates::thin_out() {
    while (bytes_ > budget_ && states_.size() > 1) {
        std::size_t least = 0;
        double least_cost = 1e300;
        for (std::size_t i = 0; i + 1 < states_.size(); ++i) {
            const int before = i == 0 ? 0 : states_[i - 1].frame;
            const double gap = states_[i + 1].frame - before;
            const double age = states_.back().frame - states_[i].frame;
            if (gap / age >= least_cost) continue;
            least = i;
            least_cost = gap / age;
        }
        bytes_ -= bytes_of(states_[least]);
        states_.erase(states_.begin() + static_cast<std::ptrdiff_t>(least));
    }
}

const KeptStates::State* KeptStates::nearest(const Playback& playback) const {
    const State* found = nullptr;
    for (const State& state : states_)
        if (state.frame <= playback.last_frame() && state.time <= playback.end) found = &state;
    return found;
}

void KeptStates::clear() {
    states_.clear();
    times_.clear();
    bytes_ = 0;
    is_too_large_ = false;
}

}  // namespace glint
