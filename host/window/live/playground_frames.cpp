// An open scene, frame by frame: whether one is due, what it is drawn with, and drawing it.
#include "window/live/playground.h"

#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <limits>

namespace glint {
namespace {

constexpr double kLongAgo = -std::numeric_limits<double>::infinity();  // s

Date local_now() {
    std::timespec now{};
    std::timespec_get(&now, TIME_UTC);
    std::tm local{};
    localtime_r(&now.tv_sec, &local);
    return {.year = local.tm_year + 1900,
            .month = local.tm_mon + 1,
            .day = local.tm_mday,
            .seconds = local.tm_hour * 3600.0 + local.tm_min * 60.0 + local.tm_sec +
                       static_cast<double>(now.tv_nsec) * 1e-9};
}

}  // namespace

bool Playground::wants_frame() const {
    if (!renderer_) return false;
    const bool settles = !transport_.playing() && extra_frames_ < preset_->settle;
    const bool time_moves = transport_.playing() ? follows_time() : transport_.wants_frame();
    return touched_ || replay_at_ >= 0 || settles || time_moves || renderer_->has_maps_left();
}

bool Playground::follows_time() const {
    const auto& passes = renderer_->graph().passes;
    return !preset_->events.empty() ||
           std::any_of(passes.begin(), passes.end(),
                       [](const GraphPass& pass) { return pass.runs != Runs::on_change; });
}

void Playground::mouse(glm::dvec2 fraction, bool down) {
    input_.mouse(fraction, down);
    recent_.mouse(fraction, down);
    recorder.mouse(fraction, down);
    heard(renderer_ && renderer_->reads_mouse());
}

void Playground::key(int code, bool down) {
    input_.key(code, down);
    recent_.key(code, down);
    recorder.key(code, down);
    heard(renderer_ && renderer_->reads_keyboard());
}

void Playground::heard(bool is_read) {
    touched_ |= is_read;
    is_replayable_ &= !is_read;
}

void Playground::measure_passes(bool on) {
    if (on == measuring_) return;
    measuring_ = on;
    pass_times_.clear();
    if (!renderer_) return;
    renderer_->set_picture_format(picture_format());
    renderer_->draw_root(frame_again());
}

Frame Playground::next_frame(double wall_seconds) {
    const double before = instant_.time;
    // A simulation drops no time, so that its states are those of a still, and what is recorded is
    // replayed by exports, which drop none: a frame that is too slow holds time up. Below the
    // limit, for the part of a step that was left over.
    if (recorder.recording() || simulates()) {
        wall_seconds = std::min(wall_seconds, 0.8 * kLongestCatchUp / transport_.rate());
    }
    instant_ = transport_.advance(wall_seconds);
    if (instant_.frame == 0) frame_offset_ = 0;
    const bool stands = instant_.frame > 0 && instant_.time == before && !instant_.jumped;
    extra_frames_ = stands ? extra_frames_ + 1 : 0;
    instant_.frame += frame_offset_;
    Frame frame;
    frame.time = instant_.time;
    frame.time_delta = instant_.time_delta;
    frame.frame_rate = instant_.frame_rate;
    frame.frame = instant_.frame;
    frame.date = shadertoy_date(local_now(), 0.0);
    follow_events(before, frame.time);
    being_drawn_ = input_;
    frame.input = input_.next_frame(still_size());
    frame.mouse_size = still_size();
    frame.longest_catch_up = kLongestCatchUp;
    recorder.frame(frame.time);
    recent_.frame(frame.time);
    recent_.forget_before(frame.time - 4.0 * kLongestCatchUp);
    frame.events = recent_.events();
    return frame;
}

// Where time does not go on from the frame before, what is held or toggled by then is new to no
// step of a simulation.
void Playground::follow_events(double before, double time) {
    if (recent_.recording() && !instant_.jumped) return replay_events(before, time);
    if (time > 0.0 && !recorder.recording() && !preset_->events.empty())
        return take_events_up_to(time);
    recent_.go_on_from(kLongAgo, input_);
    if (time == 0.0) replay_events(kLongAgo, time);
}

// After a jump the preset's events have brought the input to where they do in a still.
void Playground::take_events_up_to(double time) {
    const Playback playback{.end = time};
    const double before = (playback.last_frame() - 1) / playback.fps;
    input_ = input_after(preset_->events, before, time);
    recent_.go_on_from(kLongAgo, {});
    for (const Event& event : events_between(preset_->events, kLongAgo, time))
        recent_.replayed(event);
}

// The preset's events go on while time does, also when a person has taken over.
void Playground::replay_events(double from, double to) {
    for (const Event& event : events_between(preset_->events, from, to)) {
        input_.apply(event);
        recent_.replayed(event);
        recorder.replayed(event);
    }
}

std::string Playground::waits_for() const {
    if (reloader_.is_trying()) return programs_.work();
    if (replay_at_ >= 0)
        return fmt::format("playing up to {:g} s, {:.0f} % done", instant_.time, 100 * replayed());
    return has_unseen_text() ? "drawing the first frame" : "";
}

bool Playground::draw(double wall_seconds) {
    if (!renderer_) return false;
    // Panels move over a picture that stands; no frame of the scene goes by then.
    if (!transport_.playing() && !wants_frame()) return false;
    const Stopwatch clock;
    // While a replay is under way, time stands.
    Frame frame = next_frame(replay_at_ < 0 ? wall_seconds : 0.0);
    const bool plays_again = opening_ == Opening::plays_again;
    if (plays_again) opening_ = Opening::done;
    if (instant_.jumped || plays_again) {
        begin_replay(plays_again);
        take_start_state();
    }
    if (replay_at_ >= 0 && !replay_slice(frame)) return false;
    notice_dropped_steps();

    touched_ = false;
    if (measuring_) {
        pass_times_.resize(renderer_->graph().passes.size());
        for (PassTime& pass : pass_times_) pass.drawn = false;
        renderer_->after_pass = [this, watch = Stopwatch()](std::size_t pass) mutable {
            context_.finish();
            pass_times_[pass] = {.ms = watch.restart(), .drawn = true};
        };
    }
    renderer_->set_map_seconds(map_seconds());
    const bool drawn = renderer_->draw(frame);
    begins_move_ = false;
    has_picture_ |= drawn;
    if (drawn) ++pictures_;
    renderer_->after_pass = nullptr;
    context_.finish();
    drawn_inputs_ = being_drawn_;
    drawn_input_ = frame.input;
    drawn_mouse_size_ = frame.mouse_size;
    drawn_date_ = frame.date;
    if (drawn) frame_ms_ = clock.ms();
    if (drawn) forget_slowness();
    reloader_.drawn(clock.ms());
    keep_live_state();
    return drawn;
}

// A new text is shown once it is right as a whole, unless it differs by a number, which is like a
// tweak. While one moves, the picture is to follow it, and at the first move soon; once it rests,
// the maps are to be whole soon.
double Playground::map_seconds() const {
    constexpr double kAtFirst = 0.005, kWhileMoving = 0.02, kMoves = 0.15, kAtRest = 0.1;  // s
    const bool is_other_text = reloader_.has_unseen() && reloader_.programs() != Programs::uniforms;
    if (!has_picture_ || is_other_text || replay_at_ >= 0) return 0.0;
    if (since_tweak_.ms() > 1e3 * kMoves) return kAtRest;
    return begins_move_ ? kAtFirst : kWhileMoving;
}

// The trial warned of a frame of the full size; several in a row, at the size that is held, tell
// better.
void Playground::forget_slowness() {
    constexpr int kTold = 3;  // the first has maps to draw, and a program to warm up
    quick_frames_ = frame_ms_ < kSlowMs ? quick_frames_ + 1 : 0;
    if (quick_frames_ == kTold) reloader_.forget_slowness();
}

// The inputs of the frame that was drawn last.
Frame Playground::frame_again() const {
    Frame frame;
    frame.time = instant_.time;
    frame.time_delta = instant_.time_delta;
    frame.frame_rate = instant_.frame_rate;
    frame.frame = instant_.frame;
    frame.date = drawn_date_;
    frame.input = drawn_input_;
    frame.mouse_size = drawn_mouse_size_;
    return frame;
}

}  // namespace glint
