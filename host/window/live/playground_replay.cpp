// A scene that simulates, after a jump of time: it is played again, a slice at a time, from the
// nearest state that was kept.
#include "window/live/playground.h"

#include <algorithm>
#include <cmath>

namespace glint {
namespace {

// How long a replay may keep the window waiting in one frame.
constexpr double kReplaySlice = 30.0;  // ms

// From here on a playback counts its frames from elsewhere.
constexpr double kLongestKept = 1e6;  // s

}  // namespace

double Playground::replayed() const {
    if (replay_at_ < 0) return 1.0;
    return static_cast<double>(replay_at_ - replay_from_) /
           std::max(replay_until_ - replay_from_, 1);
}

bool Playground::simulates() const {
    return renderer_ && renderer_->graph().stateful;
}

void Playground::begin_replay(bool from_start) {
    renderer_->reset();
    // From here on the buffers follow from the preset alone, as those of a still do.
    is_replayable_ = true;
    replay_at_ = -1;
    if (!simulates() || (instant_.time <= 0.0 && !from_start)) return;
    const Playback playback{.end = instant_.time};
    const KeptStates::State* kept = from_start ? nullptr : kept_states_.nearest(playback);
    if (kept) renderer_->set_state(kept->passes);
    replay_at_ = replay_from_ = kept ? kept->frame : 0;
    replay_until_ = playback.last_frame();
}

// True when it has arrived: then `frame`, which is to be drawn, is the last frame of a still at its
// time, and those that follow count on from there.
bool Playground::replay_slice(Frame& frame) {
    const Stopwatch clock;
    const Playback playback{.end = frame.time, .mouse_size = still_size()};
    const int began = replay_at_;
    const auto measure = [&] {
        replayed_seconds_ += (replay_at_ - began) / playback.fps;
        replay_ms_ += clock.ms();
    };
    for (; replay_at_ < replay_until_; ++replay_at_) {
        if (clock.ms() > kReplaySlice) {
            measure();
            return false;
        }
        if (playback.end < kLongestKept && kept_states_.wants(replay_at_))
            kept_states_.keep({.frame = replay_at_,
                               .time = playback.frame(*preset_, replay_at_ - 1).time,
                               .passes = renderer_->state()});
        renderer_->advance(playback.frame(*preset_, replay_at_));
        context_.finish();
    }
    measure();
    keep_start_state();
    replay_at_ = -1;
    Frame last = playback.frame(*preset_, replay_until_);
    if (preset_->events.empty()) last.input = frame.input;  // of the same pixels
    last.date = frame.date;
    frame_offset_ += last.frame - instant_.frame;
    instant_.frame = last.frame;
    instant_.time_delta = last.time_delta;
    instant_.frame_rate = last.frame_rate;
    frame = last;
    return true;
}

double Playground::replay_rate() const {
    return replay_ms_ > 0.0 ? replayed_seconds_ / replay_ms_ * 1000.0 : 0.0;
}

// The state that stands after a live frame is that of a replay to its time only where it advances
// by steps alone, whose inputs are the same in every run: then frames may come as they like. Not
// where a person steered, time was dropped, or a text reads the date, which is today's.
void Playground::keep_live_state() {
    if (!is_replayable_ || !simulates() || instant_.time >= kLongestKept) return;
    const int frame = static_cast<int>(std::ceil(instant_.time * 60.0));
    if (!kept_states_.wants(frame)) return;
    const auto& passes = renderer_->graph().passes;
    const bool by_steps = std::ranges::none_of(passes, [](const GraphPass& pass) {
        return pass.feeds_state && pass.runs == Runs::every_frame;
    });
    const bool reads_date = preset_->scene.text.find("iDate") != std::string::npos;
    if (!by_steps || reads_date || !preset_->events.empty()) return;
    kept_states_.keep({.frame = frame, .time = instant_.time, .passes = renderer_->state()});
}

// So much time in one frame, and steps are left out.
void Playground::notice_dropped_steps() {
    double longest = 0.0;
    for (const Pass& pass : preset_->scene.passes)
        if (pass.step) longest = std::max(longest, pass.step.seconds());
    if (instant_.moved > kLongestCatchUp - 2.0 * longest) is_replayable_ = false;
}

// Buffers of a size of their own stand as they are, whatever the picture's, unless the mouse, whose
// place is told in the picture's pixels, has moved them. So does what reads nothing: each pixel of
// it is the same at every size.
bool Playground::states_depend_on_size() const {
    if (!renderer_) return true;
    const auto& passes = preset_->scene.passes;
    const auto& graph = renderer_->graph().passes;
    bool has_own_size = true;
    for (std::size_t i = 0; i < graph.size(); ++i) {
        const PassProgram& program = renderer_->scene().programs[i];
        const bool reads_nothing = program.builtins.empty() && program.samplers.empty();
        const bool is_sized = graph[i].pass < passes.size() && passes[graph[i].pass].size;
        has_own_size &= !graph[i].feeds_state || is_sized || (reads_nothing && !graph[i].carries);
    }
    return !has_own_size || (!preset_->events.empty() && renderer_->reads_mouse());
}

// Whether a simulation of this preset and these values stands where that of what is open does.
bool Playground::has_states_of(const Preset& preset, const std::vector<TweakValue>& values) const {
    const auto is_same_channel = [](const Sampler& a, const Sampler& b) {
        return same_input(a, b) && a.type == b.type && a.filter == b.filter && a.wrap == b.wrap &&
               a.pass == b.pass && a.noise_channels == b.noise_channels &&
               a.noise_size == b.noise_size && a.plays == b.plays;
    };
    return preset_ && preset.scene.text == preset_->scene.text &&
           preset.events == preset_->events && preset.date == preset_->date &&
           std::ranges::equal(preset.channels, preset_->channels, is_same_channel) &&
           values == tweaks.values();
}

void Playground::forget_states() {
    kept_states_.clear();
    is_replayable_ = false;
    replayed_seconds_ = replay_ms_ = 0.0;
}

}  // namespace glint
