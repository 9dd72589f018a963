#include "window/live/live_programs.h"

#include "base/process_time.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace glint {

namespace {

const Verdict kRunning{.state = TrialState::running, .passes = {}, .diagnostics = {}};

// The other process has linked every pass and drawn one: what it linked lies where the driver keeps
// programs, and is taken up from there while it draws the others.
bool is_linked(const Verdict& verdict) {
    return verdict.state == TrialState::running && !verdict.passes.empty() &&
           verdict.passes.front().first_ms > 0.0;
}

double compile_ms_of(const Verdict& verdict) {
    double sum = 0.0;
    for (const PassTrial& pass : verdict.passes) sum += pass.first_ms;
    return sum;
}

}  // namespace

LivePrograms::LivePrograms(Trial& trial, const std::string& device, bool specialise,
                           KeptVerdicts verdicts)
    : trial_(trial), verdicts_(std::move(verdicts)) {
    if (specialise) standby_.emplace(device);
}

ProgramOptions LivePrograms::options(Programs programs) const {
    if (programs != Programs::constants && standby_) return standby_->program_options();
    return {.specialise = programs == Programs::constants, .lean = true};
}

Candidate LivePrograms::candidate() const {
    return {.preset = *tried_,
            .compile = {.program = options(tried_programs_),
                        // Nobody works with its picture yet.
                        .side_by_side = tried_is_text_ && longest_compile_ms_ == 0.0},
            .size = tried_size_,
            .time = tried_time_,
            .images = {},
            .is_text = tried_is_text_};
}

void LivePrograms::start_trial(Preset preset, Programs programs, bool is_text, glm::ivec2 size,
                               double time) {
    tried_ = std::move(preset);
    tried_programs_ = programs;
    tried_size_ = size;
    tried_time_ = time;
    tried_is_text_ = is_text;
    tried_is_linking_ = false;
    tried_by_standby_ = programs != Programs::constants && standby_;
    loader_.stop();
    known_.reset();
    if (is_text && !tried_by_standby_) known_ = verdicts_.take(candidate());
    if (!known_) return (tried_by_standby_ ? standby_->trial() : trial_).start(candidate());
    longest_compile_ms_ = std::max(longest_compile_ms_, compile_ms_of(*known_));
    loader_.start(*tried_, options(programs), known_->passes);
}

// Its programs lie where the driver keeps them. Where it has to compile one after all, the rest is
// left to the other process.
const Verdict& LivePrograms::follow_known() {
    if (!loader_.is_loading()) return *known_;
    constexpr double kFromCache = 60.0;  // ms of a processor, by far
    const double began_ms = own_thread_ms();
    loader_.step(shelf_, nullptr);
    if (own_thread_ms() - began_ms > kFromCache) {
        known_.reset();
        loader_.stop();
        trial_.start(candidate());
        return kRunning;
    }
    // Once it is done nothing else calls again soon.
    return loader_.is_loading() ? kRunning : *known_;
}

void LivePrograms::keep_verdict() {
    if (!tried_is_text_ || tried_by_standby_) return;
    verdicts_.keep(known_ ? *known_ : trial_.poll());
}

std::string LivePrograms::work() const {
    if (known_) return "loading programs";
    return tried_by_standby_ ? standby_->work() : trial_.work();
}

// Standby's programs are here already.
const Verdict& LivePrograms::follow_trial(bool is_awaited, Renderer* drawn) {
    if (known_) return follow_known();
    const Verdict& verdict = (tried_by_standby_ ? standby_->trial() : trial_).poll();
    const bool has_passed = verdict.state == TrialState::passed;
    // Programs for a picture that stands are warmed up by drawing, which would compile here what
    // the other process has not drawn yet.
    const bool may_link = has_passed || (tried_is_text_ && is_linked(verdict));
    if (!is_awaited || tried_by_standby_ || !may_link) return verdict;
    if (!std::exchange(tried_is_linking_, true)) {
        const auto programs = standby_ ? Programs::constants : Programs::uniforms_for_good;
        loader_.start(*tried_, options(programs), verdict.passes);
    }
    if (has_passed) longest_compile_ms_ = std::max(longest_compile_ms_, compile_ms_of(verdict));
    if (!loader_.is_loading()) return verdict;
    loader_.step(shelf_, tried_is_text_ ? nullptr : drawn);
    return loader_.is_loading() ? kRunning : verdict;
}

void LivePrograms::prepare(const Preset& shown, glm::ivec2 size, double time) {
    prepared_text_ = text_;
    standby_->prepare(shown, size, time);
}

void LivePrograms::follow_standby(Renderer& drawn) {
    if (!standby_) return;
    const bool were_awaited = awaits_fed();
    standby_->follow(shelf_, drawn);
    if (were_awaited) tidy(drawn);
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
    if (awaits_fed()) return;
    std::vector<GLuint> ids = ids_of(drawn.scene());
    if (standby_) std::ranges::copy(standby_->ids(), std::back_inserter(ids));
    shelf_.keep_only(ids);
}

}  // namespace glint
