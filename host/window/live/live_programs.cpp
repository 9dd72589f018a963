#include "window/live/live_programs.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace glint {

namespace {

// The other process has linked every pass and drawn one: what it linked lies where the driver keeps
// programs, and is taken up from there while it draws the others.
bool is_compiled(const Verdict& verdict) {
    return verdict.state == TrialState::running && !verdict.passes.empty() &&
           verdict.passes.front().first_ms > 0.0;
}

}  // namespace

LivePrograms::LivePrograms(const std::string& device, bool specialise)
    : trial_({.device = device}) {
    if (specialise) standby_.emplace(device);
}

ProgramOptions LivePrograms::options(Programs programs) const {
    if (programs != Programs::constants && standby_) return standby_->program_options();
    return {.specialise = programs == Programs::constants, .lean = true};
}

void LivePrograms::start_trial(Preset preset, Programs programs, bool is_text, glm::ivec2 size,
                               double time) {
    tried_ = std::move(preset);
    tried_is_text_ = is_text;
    tried_is_linking_ = false;
    tried_by_standby_ = programs != Programs::constants && standby_;
    loader_.stop();
    Trial& trial = tried_by_standby_ ? standby_->trial() : trial_;
    trial.start({.preset = *tried_,
                 .compile = {.program = options(programs)},
                 .size = size,
                 .time = time,
                 .images = {},
                 .is_text = is_text});
}

// Standby's programs are here already.
const Verdict& LivePrograms::follow_trial(bool is_awaited, Renderer* drawn) {
    static const Verdict running{.state = TrialState::running, .passes = {}, .diagnostics = {}};
    trial_.poll();
    const Verdict& verdict = (tried_by_standby_ ? standby_->trial() : trial_).poll();
    const bool has_passed = verdict.state == TrialState::passed;
    if (!is_awaited || tried_by_standby_ || (!has_passed && !is_compiled(verdict))) return verdict;
    if (!std::exchange(tried_is_linking_, true)) {
        const auto programs = standby_ ? Programs::constants : Programs::uniforms_for_good;
        loader_.start(*tried_, options(programs), verdict.passes);
    }
    if (has_passed) {
        double compile_ms = 0.0;
        for (const PassTrial& pass : verdict.passes) compile_ms += pass.first_ms;
        longest_compile_ms_ = std::max(longest_compile_ms_, compile_ms);
    }
    if (!loader_.is_loading()) return verdict;
    loader_.step(shelf_, tried_is_text_ ? nullptr : drawn);
    return running;
}

void LivePrograms::prepare(const Preset& shown, glm::ivec2 size, double time) {
    prepared_text_ = text_;
    standby_->prepare(shown, size, time);
}

void LivePrograms::follow_standby(Renderer& drawn) {
    if (!standby_) return;
    const bool was_ready = is_prepared();
    standby_->follow(shelf_, drawn);
    if (!was_ready) tidy(drawn);
}

std::optional<CompiledScene> LivePrograms::take_fed(const Preset& shown) {
    std::optional<CompiledScene> scene;
    if (standby_) scene = standby_->take();
    // Small texts are compiled here, and all where there is no other process.
    constexpr double kSmall = 60.0;  // ms
    const bool is_made_there = standby_ && !standby_->is_refused();
    if (scene || (is_made_there && longest_compile_ms_ >= kSmall)) return scene;
    return compile_scene(shown, {.program = {.specialise = false, .lean = true}}).scene;
}

void LivePrograms::note_drawn(Programs programs, bool is_text, Renderer* before, bool was_fed) {
    if (!is_text) {
        if (before && was_fed && is_prepared()) standby_->give_back(before->take_scene());
        return;
    }
    ++text_;
    if (!standby_) return;
    if (programs == Programs::constants) return standby_->stop();
    standby_->forget_scene();
    prepared_text_ = text_;
}

void LivePrograms::tidy(const Renderer& drawn) {
    if (!is_prepared()) return;
    std::vector<GLuint> ids = ids_of(drawn.scene());
    std::ranges::copy(standby_->ids(), std::back_inserter(ids));
    shelf_.keep_only(ids);
}

}  // namespace glint
