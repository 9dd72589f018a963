// Time is a sum of two doubles: what one addition rounds away, the next gets back.
#include "scene/transport.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace glint {

namespace {

constexpr double kLongest = 0x1p36;  // s; up to here iTick is exact

double clamped_time(double seconds) {
    return std::clamp(seconds, 0.0, kLongest);
}

}  // namespace

Transport::Transport(double start) : time_(std::isfinite(start) ? clamped_time(start) : 0.0) {
    void_ = time_ != 0.0;
}

Instant Transport::advance(double wall_seconds) {
    wall_seconds = std::isfinite(wall_seconds) ? clamped_time(wall_seconds) : 0.0;
    if (resumes_) wall_seconds = 0.0;
    Instant now;
    now.jumped = void_;
    if (target_) {
        now.jumped = now.jumped || *target_ != time_;
        if (now.jumped) time_ = *target_, rest_ = 0.0;
    } else if (!begins_) {
        now.moved = move(wall_seconds);
        if (now.moved > 0.0 && wrap_in_loop()) now.jumped = true;
    }
    measure(wall_seconds);
    const bool flows = now.moved > 0.0 && !now.jumped && !resumes_;
    now.time = time_;
    now.time_delta = flows ? now.moved : kStep;
    now.frame_rate = fixed_step_ ? 1.0 / kStep : frame_rate_;
    now.frame = frame_;
    if (frame_ < std::numeric_limits<int>::max()) ++frame_;
    begins_ = resumes_ = void_ = false;
    target_.reset();
    return now;
}

// Moves time by what this frame is due, and says by how much.
double Transport::move(double wall_seconds) {
    if (steps_due_ > 0 || (playing_ && fixed_step_)) {
        // By so much the double nearest to 1/60 is too small: time after k steps is k / 60.0.
        constexpr double kRestOfStep = 0x1p-56 / 60.0;
        add(kStep);
        add(kRestOfStep);
        steps_due_ = std::max(steps_due_ - 1, 0);
        return kStep;
    }
    if (!playing_) return 0.0;
    const double seconds = wall_seconds * rate_;
    add(seconds);
    return seconds;
}

// Knuth's two-sum gives the rounding error of an addition exactly.
void Transport::add(double seconds) {
    const double sum = time_ + seconds;
    const double part = sum - time_;
    const double error = (time_ - (sum - part)) + (seconds - part);
    const double rest = rest_ + error;
    time_ = sum + rest;
    rest_ = rest - (time_ - sum);
}

bool Transport::wrap_in_loop() {
    if (!loop_ || time_ < loop_->end) return false;
    const double length = loop_->end - loop_->begin;
    time_ = loop_->begin + std::fmod((time_ - loop_->begin) + rest_, length);
    rest_ = 0.0;
    return true;
}

void Transport::measure(double wall_seconds) {
    constexpr double kWindow = 0.5;  // s
    if (!playing_ || begins_ || resumes_) return;
    measured_seconds_ += wall_seconds;
    ++measured_frames_;
    if (measured_seconds_ < kWindow) return;
    frame_rate_ = measured_frames_ / measured_seconds_;
    measured_seconds_ = 0.0;
    measured_frames_ = 0;
}

bool Transport::wants_frame() const {
    return playing_ || begins_ || void_ || steps_due_ > 0 || (target_ && *target_ != time_);
}

void Transport::play() {
    if (playing_) return;
    playing_ = resumes_ = true;
    steps_due_ = 0;
}

void Transport::pause() {
    playing_ = resumes_ = false;
}

void Transport::step() {
    pause();
    ++steps_due_;
}

void Transport::reset() {
    time_ = rest_ = 0.0;
    frame_ = steps_due_ = 0;
    begins_ = void_ = true;
    target_.reset();
}

void Transport::seek(double time) {
    if (std::isnan(time)) return;
    target_ = clamped_time(time);
    steps_due_ = 0;
}

double Transport::time() const {
    return target_.value_or(time_);
}

void Transport::set_rate(double rate) {
    if (!std::isnan(rate)) rate_ = std::clamp(rate, kSlowest, kFastest);
}

void Transport::set_fixed_step(bool fixed) {
    fixed_step_ = fixed;
}

void Transport::apply(const TimeEdit& edit) {
    using What = TimeEdit::What;
    switch (edit.what) {
        case What::play:
            return play();
        case What::pause:
            return pause();
        case What::step:
            return step();
        case What::reset:
            return reset();
        case What::seek:
            return seek(edit.number);
        case What::rate:
            return set_rate(edit.number);
        case What::fixed_step:
            return set_fixed_step(edit.on);
        case What::loop:
            return set_loop(edit.loop);
    }
}

void Transport::set_loop(std::optional<Loop> loop) {
    if (loop && (std::isnan(loop->begin) || std::isnan(loop->end))) return;
    loop_ = loop;
    if (!loop_) return;
    if (loop_->begin > loop_->end) std::swap(loop_->begin, loop_->end);
    loop_->begin = clamped_time(loop_->begin);
    loop_->end = std::max(clamped_time(loop_->end), loop_->begin + kStep);
}

}  // namespace glint
