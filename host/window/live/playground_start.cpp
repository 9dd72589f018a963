// A simulation that was opened is played up to its start, or stands there since an earlier run.
#include "window/live/playground.h"

#include <stdexcept>

namespace glint {
namespace {

// Fewer are played as soon as a file is read.
constexpr int kWorthKeeping = 30;  // frames

// A first frame that took no longer is as soon drawn as read.
constexpr double kLongFrame = 150.0;  // ms

}  // namespace

void Playground::find_start_state() {
    replays_start_ = renderer_->graph().stateful && preset_->time > 0.0;
    if (!replays_start_) return;
    Preset start = *preset_;
    start.values = start_values_ = tweaks.values();
    start_states_.read(start, context_.renderer());
}

// Without its inputs it would be another one.
bool Playground::stands_for_start() const {
    return replays_start_ && !awaits_inputs() && instant_.time == preset_->time &&
           tweaks.values() == start_values_;
}

void Playground::take_start_state() {
    if (replay_at_ < 0 || !stands_for_start()) return;
    const std::optional<Snapshot> kept = start_states_.take();
    if (!kept || kept->frame != replay_until_) return;
    try {
        renderer_->set_state(kept->passes);
        replay_at_ = replay_from_ = kept->frame;
        replays_start_ = false;
    } catch (const std::runtime_error&) {
        // Its buffers have other sizes today.
    }
}

void Playground::keep_start_state() {
    if (!stands_for_start() || replay_until_ < kWorthKeeping) return;
    replays_start_ = false;
    start_states_.keep({.frame = replay_until_,
                        .time = instant_.time,
                        .renderer = context_.renderer(),
                        .provenance = {},
                        .passes = renderer_->state()});
}

void Playground::keep_maps() {
    if (!kept_maps_.wants() || !has_picture_) return;
    if (!reports().empty() && reports().back().first_frame_ms > kLongFrame)
        kept_maps_.keep(*renderer_);
    kept_maps_.forget();
}

}  // namespace glint
