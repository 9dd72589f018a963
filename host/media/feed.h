// Samples that are made shortly before they are heard, in step with a time that a person plays,
// stops and moves. No device, no clock and no GL of its own.
#pragma once

#include "media/sound.h"

#include <map>
#include <optional>
#include <span>
#include <vector>

namespace glint {

constexpr long kFeedBlock = 8192;  // samples that are made at once; 0.19 s

// What is to be heard. Clocks are seconds of the steady clock.
struct PlayState {
    bool playing = false;
    double time = 0.0;  // s of the scene, at the clock `at`
    double rate = 1.0;  // scene seconds in a second
    double at = 0.0;
    float volume = 1.0f;
};

// All calls of one object are made one after the other.
class SoundFeed {
public:
    // From now on; the next samples follow it.
    void follow(const PlayState& state) { state_ = state; }

    // The block (kFeedBlock samples from its number times that on) that is to be made next, so that
    // the next second is there; none while it is.
    std::optional<long> wanted_block(double clock) const;
    // The one that is heard at this clock.
    long block_at(double clock) const;
    void add(long block, std::vector<float> pairs);

    // Another sound: what was made is void.
    void clear() { blocks_.clear(); }

    // The pairs of left and right that are heard from the clock `heard_at` on. What is not made yet
    // is silent. Starts, stops and jumps fade over one call, so that nothing clicks.
    void fill(std::span<float> pairs, double heard_at);

    // Nothing plays, and what did has faded.
    bool is_silent() const { return !state_.playing && !sounds_; }

private:
    double position(double clock) const;  // samples
    float value(double position, int channel) const;

    PlayState state_;
    std::map<long, std::vector<float>> blocks_;
    bool sounds_ = false;       // the last call ended loud
    double at_ = 0.0;           // samples; where the next call goes on
    float last_volume_ = 0.0f;  // at the end of the last call
};

}  // namespace glint
