// From the start, or the opening of another file, until its first frame: a picture that stands for
// it, and words on what is waited for.
#include "window/live/playground_window.h"

namespace glint {
namespace {

// Of a kept picture; larger ones are made smaller.
constexpr int kLongestSide = 1920;  // pixels
// Of the sides: a picture that was held below this does not replace a better one.
constexpr double kCoarse = 0.3;
// How old the picture may be that a window leaves which is killed.
constexpr double kKeepPicturePeriod = 60.0;  // s
// A picture that is read sooner is there before the ground could be seen.
constexpr double kShortWait = 0.03;  // s

}  // namespace

bool PlaygroundWindow::awaits_first_frame() const {
    return !file_.empty() && !values_known_ &&
           (playground_.is_loading() || playground_.has_unseen_text());
}

void PlaygroundWindow::begin_start() {
    since_open_.restart();
    start_picture_.read(kept_pictures_.find(place_));
    start_picture_.wait(kShortWait);
    start_picture_.update();
}

bool PlaygroundWindow::follow_start() {
    if (values_known_ && !playground_.has_unseen_text()) start_picture_.clear();
    if (values_known_ && since_picture_kept_.ms() > kKeepPicturePeriod * 1000.0) keep_picture();
    return start_picture_.update();
}

// In place of the scene that was open before, too, unless that is all there will be.
bool PlaygroundWindow::shows_start_picture() const {
    return awaits_first_frame() && start_picture_.shown();
}

// What is on the screen, for the next time that this file is opened.
void PlaygroundWindow::keep_picture() {
    if (!values_known_ || !playground_.has_picture()) return;
    since_picture_kept_.restart();
    keep_resolution();
    const std::size_t root = playground_.renderer()->graph().passes.size() - 1;
    const Buffer& drawn = playground_.renderer()->buffer(root);
    const bool is_coarse = !refined_ && drawn.shape().size.x < kCoarse * full_size().x;
    if (is_coarse && !kept_pictures_.find(place_).empty()) return;
    kept_pictures_.keep(place_, picture_of(refined_ ? *refined_ : drawn, kLongestSide));
}

void PlaygroundWindow::tell_start(Facts& facts) const {
    const bool waits = awaits_first_frame();
    facts.waits_for = waits ? playground_.waits_for() : "";
    facts.waited = since_open_.ms() / 1000.0;
    facts.shows_picture = playground_.has_picture() || shows_start_picture();
    if (!shows_start_picture()) return;
    const StartPicture::Shown& shown = *start_picture_.shown();
    const ScreenArea area =
        Viewer::area_of(shown.size, {}, {.origin = {0, 0}, .size = window_.size()});
    facts.start_picture = {.texture = shown.texture.id(),
                           .share = shown.share,
                           .origin = area.origin,
                           .size = area.size};
}

}  // namespace glint
