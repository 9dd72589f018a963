// Studies and checks of the open scene, run beside the window, and their pictures in its view.
#include "window/live/playground_window.h"

#include <algorithm>
#include <stdexcept>

namespace glint {

bool PlaygroundWindow::follow_findings() {
    const bool study = study_.update(), check = check_.update();
    return study || check;
}

void PlaygroundWindow::grant_findings(const Wishes& wishes) {
    if (wishes.cancel_study) study_.cancel();
    if (wishes.cancel_check) check_.cancel();
    if (wishes.study)
        begin_finding(studied_,
                      [&] { study_.start(playground_.preset_as_shown(), *wishes.study); });
    if (wishes.check) begin_finding(checked_, [&] { check_.start(playground_.current_preset()); });
    dirty_ |= wishes.cancel_study || wishes.cancel_check || wishes.study || wishes.check;
}

void PlaygroundWindow::begin_finding(Subject& subject, const std::function<void()>& start) {
    if (!playground_.is_open()) return;
    pictures_.clear();
    try {
        start();
        subject = {.values = playground_.tweaks.values()};
    } catch (const std::runtime_error& error) {
        notice(error.what());
    }
}

// The text on the screen is another: what was found about the one before is told as that.
void PlaygroundWindow::stop_findings() {
    study_.cancel();
    check_.cancel();
    studied_.is_other_text = checked_.is_other_text = true;
}

void PlaygroundWindow::tell_findings(Facts& facts) const {
    facts.study_work = study_.work();
    facts.check_work = check_.work();
    facts.studies = study_.studies();
    facts.cases = check_.cases();
    if (!facts.scene) return;
    // The knob of a study is turned by its own panel.
    const bool any_study = settings_.shown_study < facts.studies.size();
    const Study none, &seen = any_study ? facts.studies[settings_.shown_study] : none;
    const auto differs = [&](const Subject& subject, const Study& turned) {
        const std::vector<TweakValue> now = playground_.tweaks.values();
        bool other = subject.is_other_text || now.size() != subject.values.size();
        for (std::size_t i = 0; !other && i < now.size(); ++i) {
            const Tweak& tweak = facts.scene->tweaks[i];
            const bool is_turned = turned.is_joint ? tweak.quality : tweak.name == turned.knob;
            other = now[i] != subject.values[i] && !is_turned;
        }
        return other;
    };
    facts.study_work.stale = any_study && differs(studied_, seen);
    facts.check_work.stale = !facts.cases.empty() && differs(checked_, none);
}

glm::ivec2 PlaygroundWindow::viewed_size() const {
    return settings_.shown == Shown::scene ? playground_.size() : finding_size_;
}

// Puts a picture of a study or a check into the view. False where the scene itself is to be seen.
bool PlaygroundWindow::show_finding() {
    const bool is_open = settings_.shown == Shown::failure ? settings_.check : settings_.study;
    if (!is_open) settings_.shown = Shown::scene;
    if (settings_.shown != shown_before_) {  // a picture of another size, perhaps
        settings_.view.zoom = 0.0;
        settings_.view.centre = glm::dvec2(0.5);
    }
    const bool found = settings_.shown == Shown::failure ? show_failure()
                       : settings_.shown != Shown::scene ? show_comparison()
                                                         : false;
    if (!found) settings_.shown = Shown::scene;
    shown_before_ = settings_.shown;
    return found;
}

// Pixel by pixel: the one that is no number is to be seen.
bool PlaygroundWindow::show_failure() {
    const Buffer* picture = pictures_.find(check_.picture(settings_.shown_case));
    if (!picture) return false;
    finding_size_ = picture->shape().size;
    const glm::dvec2 ratio = glm::dvec2(window_.size()) / glm::dvec2(finding_size_);
    const double zoom = settings_.view.zoom;
    viewer_.show(
        *picture,
        {.centre = settings_.view.centre, .zoom = zoom > 0.0 ? zoom : std::min(ratio.x, ratio.y)},
        {.origin = {0, 0}, .size = window_.size()});
    return true;
}

bool PlaygroundWindow::show_comparison() {
    if (!settings_.shown_row) return false;
    const LiveStudy::Pictures files = study_.pictures(settings_.shown_study, *settings_.shown_row);
    const bool map = settings_.shown == Shown::map;
    const Buffer* picture = pictures_.find(map ? files.map : files.row);
    const Buffer* reference = map ? picture : pictures_.find(files.reference);
    if (!picture || !reference) return false;
    finding_size_ = picture->shape().size;
    const BufferView view{.centre = settings_.view.centre, .zoom = settings_.view.zoom};
    if (map) {
        viewer_.show(*picture, view, {.origin = {0, 0}, .size = window_.size()});
    } else {
        show_wipe(*picture, *reference, view);
    }
    return true;
}

}  // namespace glint
