// How many pixels the picture has: a share of the full size that holds a frame rate while something
// moves, and more and more of it when nothing does.
#include "gl/context.h"
#include "window/live/playground_window.h"

#include <epoxy/gl.h>
#include <glm/common.hpp>

#include <algorithm>

namespace glint {
namespace {

glm::ivec2 share_of(glm::ivec2 size, double share) {
    return glm::max(glm::ivec2(glm::round(glm::dvec2(size) * share)), 1);
}

}  // namespace

glm::ivec2 PlaygroundWindow::full_size() const {
    return share_of(picture_area().size, static_cast<double>(settings_.resolution_scale));
}

// Before each frame. Where buffers would be cropped, a new choice begins the scene anew.
void PlaygroundWindow::choose_resolution() {
    if (playground_.is_open() && !playground_.has_picture() && !resolution_begun_)
        begin_resolution();
    if (settings_.hold_frame_rate != is_held_ && resolution_begun_) {
        is_held_ = settings_.hold_frame_rate;
        keep_resolution();
        if (playground_.keeps_size()) playground_.apply(TimeEdit::What::reset);
    }
    held_rate_.want(1000.0 / static_cast<double>(settings_.frame_rate));
    playground_.set_full_size(full_size());
    playground_.resize(share_of(full_size(), is_held_ ? held_rate_.share() : 1.0));
}

void PlaygroundWindow::begin_resolution() {
    resolution_begun_ = true;
    const std::optional<KeptResolution> kept = kept_resolutions_.find(place_);
    settings_.hold_frame_rate = is_held_ = !kept || !kept->full;
    settings_.refine = !kept || kept->refines;
    // One that is not mended later is not held to what an older text took.
    const bool is_last_known = kept && !playground_.keeps_size();
    held_rate_.begin({playground_.expected_ms(), beside_ms_}, is_last_known ? kept->share : 0.0,
                     1000.0 / static_cast<double>(settings_.frame_rate));
}

// Not the swap, which waits for the screen. A GPU is not waited for either: it takes next to no
// time for this.
void PlaygroundWindow::measure_beside(const Stopwatch& clock) {
    if (draws_in_software()) glFinish();
    const double ms = clock.ms();
    // A compiler that is at work until the first frame makes it seem more than it is.
    beside_ms_ = awaits_first_frame() && beside_ms_ > 0.0 ? std::min(beside_ms_, ms) : ms;
}

// After each frame of the scene, which the rest of the window took so long to show.
void PlaygroundWindow::hold_rate() {
    if (!is_held_ || playground_.keeps_size() || playground_.replayed() < 1.0) return;
    if (held_rate_.hear({playground_.frame_ms(), beside_ms_})) dirty_ = true;
}

void PlaygroundWindow::keep_resolution() const {
    if (!resolution_begun_) return;
    const KeptResolution now{
        .full = !is_held_, .refines = settings_.refine, .share = held_rate_.share()};
    const std::optional<KeptResolution> kept = kept_resolutions_.find(place_);
    if (now != kept.value_or(KeptResolution{.share = 1.0})) kept_resolutions_.keep(place_, now);
}

// Not where pixels are looked at, and not half of a wipe.
bool PlaygroundWindow::shows_refined() const {
    return settings_.refine && is_over_scene() && !settings_.passes && !settings_.wipe;
}

// Something rests that is not refined yet, and may be soon.
bool PlaygroundWindow::refining_is_due() const {
    return shows_refined() && playground_.stands() &&
           (refined_picture_ != playground_.picture_count() || refined_size_ != full_size());
}

// True when there is a better picture, or none any more.
bool PlaygroundWindow::follow_refining() {
    const bool is_still = playground_.stands() && settings_.refine;
    if (!is_still || resting_picture_ != playground_.picture_count() ||
        resting_size_ != full_size()) {
        resting_picture_ = playground_.picture_count();
        resting_size_ = full_size();
        since_rest_.restart();
        const bool was_refined = refined_ != nullptr;
        refiner_.stop();
        refined_.reset();
        refined_picture_ = 0;
        return was_refined;
    }
    if (refining_is_due() && since_rest_.ms() >= kRestBeforeRefining * 1000.0) {
        refined_picture_ = resting_picture_;
        refined_size_ = resting_size_;
        refiner_.start(playground_.refine_order());
    }
    const int before = refiner_.done();
    if (!refiner_.update()) return false;
    if (refiner_.take_picture()) refined_ = buffer_of(refiner_.picture());
    return refined_ != nullptr && before != refiner_.done();
}

bool PlaygroundWindow::show_refined(const BufferView& view) {
    if (!refined_ || !shows_refined()) return false;
    viewer_.show(*refined_, view, view_area());
    return true;
}

void PlaygroundWindow::tell_resolution(Facts& facts) const {
    facts.full_size = full_size();
    facts.full_ms = held_rate_.full_ms();
    facts.resolution_is_fixed = playground_.keeps_size();
    facts.refined = refiner_.done();
    facts.refined_of = refiner_.of();
}

}  // namespace glint
