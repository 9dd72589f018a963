// Values of the scene at the pixel under the mouse, for the source panel.
#include "window/live/inspect.h"
#include "window/live/playground_window.h"

#include <glm/common.hpp>

namespace glint {
namespace {

std::size_t pass_of(const Playground& playground, const std::vector<GraphPass>& passes,
                    const std::string& name) {
    const Scene& scene = playground.preset()->scene;
    for (const GraphPass& pass : passes)
        if (pass_name(scene, pass.pass) == name) return pass.pass;
    return kImagePass;
}

}  // namespace

bool PlaygroundWindow::probes() const {
    return settings_.source && settings_.visible && playground_.has_picture() &&
           playground_.replayed() >= 1.0;
}

const std::vector<std::string>& PlaygroundWindow::watch() const {
    static const std::vector<std::string> kNobody;
    return watch_ ? *watch_ : written() ? written()->watch : kNobody;
}

// The place that is asked about: that which is pinned, or that under the mouse.
std::optional<glm::dvec2> PlaygroundWindow::probed_place() const {
    if (settings_.probe.pinned) return settings_.probe.pinned;
    if (panels_.takes_mouse_at(mouse_)) return last_probed_;
    const glm::dvec2 at = Viewer::fraction_at(middle_of_pixel(mouse_), playground_.size(),
                                              buffer_view(), view_area());
    const bool is_inside = at.x >= 0.0 && at.y >= 0.0 && at.x < 1.0 && at.y < 1.0;
    return is_inside ? std::optional(at) : std::nullopt;
}

bool PlaygroundWindow::follow_probe() {
    if (!probes()) {
        last_probed_.reset();
        if (settings_.source || probe_.descriptor() >= 0) probe_.stop();
        return false;
    }
    const auto& passes = playground_.renderer()->graph().passes;
    ProbeQuestion question{.pass = pass_of(playground_, passes, settings_.probe.pass),
                           .lines = seen_lines_,
                           .value = settings_.probe.value,
                           .cost = settings_.probe.cost,
                           .watch = watch()};
    last_probed_ = probed_place();
    const Renderer& renderer = *playground_.renderer();
    const glm::ivec2 size = renderer.buffer(renderer.graph_index(question.pass)).shape().size;
    if (last_probed_)
        question.pixel =
            glm::clamp(glm::ivec2(*last_probed_ * glm::dvec2(size)), glm::ivec2(0), size - 1);
    probed_pixel_ = question.pixel;
    probed_size_ = size;
    return probe_.follow(playground_, question);
}

// A click on the picture: that pixel, wherever the mouse goes. True where it was that.
bool PlaygroundWindow::pin_probe(glm::dvec2 position) {
    if (!probes() || panels_.takes_mouse_at(position)) return false;
    const glm::dvec2 at = Viewer::fraction_at(middle_of_pixel(position), playground_.size(),
                                              buffer_view(), view_area());
    if (at.x < 0.0 || at.y < 0.0 || at.x >= 1.0 || at.y >= 1.0) return false;
    settings_.probe.pinned = at;
    return true;
}

void PlaygroundWindow::tell_probe(Facts& facts) const {
    ProbeFact& fact = facts.probe;
    if (!settings_.source || !playground_.is_open()) return;
    probe_.tell(fact);
    fact.pixel = probed_pixel_;
    fact.size = probed_size_;
    fact.watch = watch();
    if (last_probed_ && settings_.probe.pass.empty() && full_size() != playground_.size())
        fact.full_pixel = glm::ivec2(*last_probed_ * glm::dvec2(full_size()));
    for (const PassFact& pass : passes_) fact.passes.push_back(pass.name);
    if (!settings_.probe.pinned || !settings_.probe.pass.empty()) return;
    // The middle of its pixel, where the picture fills its area.
    const ScreenArea area = view_area();
    if (settings_.view.zoom > 0.0) return;
    const glm::dvec2 size(playground_.size());
    const glm::dvec2 middle = (glm::floor(*settings_.probe.pinned * size) + 0.5) / size;
    fact.mark = glm::dvec2(area.origin) + middle * glm::dvec2(area.size);
}

void PlaygroundWindow::grant_probe(const Wishes& wishes) {
    if (wishes.lines) seen_lines_ = *wishes.lines;
    if (wishes.watch) watch_ = *wishes.watch;
    dirty_ |= wishes.watch.has_value();
}

// A value in every pixel, or what every pixel costs.
bool PlaygroundWindow::show_value(const BufferView& view) {
    if (!probes() || (!settings_.probe.value && !settings_.probe.cost)) return false;
    const Buffer* picture = probe_.picture(settings_.probe.look);
    if (!picture) return false;
    BufferView plain = view;
    plain.channel = ViewChannel::rgb;
    plain.exposure = 0.0f;
    plain.tone_curve = false;
    viewer_.show(*picture, plain, view_area());
    return true;
}

}  // namespace glint
