#include "window/live/standby.h"

#include <algorithm>
#include <ranges>
#include <stdexcept>

namespace glint {
namespace {

constexpr ProgramOptions kFed{.specialise = false, .lean = true, .feed = true};

}  // namespace

// Frames with uniforms are slower than those that a person is warned of.
Standby::Standby(const std::string& device)
    : options_(kFed),
      trial_({.device = device, .slow_ms = 4000.0, .niceness = 19, .at_once = false}) {}

void Standby::prepare(const Preset& shown, glm::ivec2 size, double time) {
    preset_ = shown;
    size_ = size;
    time_ = time;
    scene_.reset();
    options_ = kFed;
    start();
}

void Standby::start() {
    state_ = State::compiling;
    trial_.start({.preset = *preset_,
                  .compile = {.program = options_},
                  .size = size_,
                  .time = time_,
                  .images = {}});
}

void Standby::refuse() {
    stop();
    state_ = State::refused;
}

void Standby::stop() {
    state_ = State::none;
    scene_.reset();
    loader_.stop();
}

void Standby::follow(ProgramShelf& shelf, Renderer& shown) {
    const Verdict& verdict = trial_.poll();
    if (state_ == State::compiling && verdict.state != TrialState::running) {
        if (verdict.state == TrialState::passed) {
            state_ = State::loading;
            passes_ = verdict.passes;
            loader_.start(*preset_, options_, passes_);
        } else if (options_.feed && verdict.state != TrialState::unavailable) {
            options_.feed = false;  // more numbers than a program may be fed with
            start();
        } else {
            refuse();
        }
    }
    if (state_ == State::ready && scene_ && !has_buffers_) return make_buffer(shown);
    if (state_ != State::loading) return;
    if (loader_.is_loading()) return loader_.step(shelf, &shown);
    CompileResult compiled =
        compile_scene(*preset_, {.program = options_}, nullptr, nullptr, &shelf);
    if (!compiled.scene) return refuse();
    scene_ = std::move(*compiled.scene);
    state_ = State::ready;
    has_buffers_ = false;
    fits_ = true;
}

void Standby::make_buffer(Renderer& shown) {
    try {
        has_buffers_ = !shown.make_ahead(*scene_);
    } catch (const std::runtime_error&) {
        has_buffers_ = true;  // whoever draws them is told
        fits_ = false;
    }
}

bool Standby::draws(const Preset& preset, const ProgramShelf& shelf) const {
    // Most edits are of the picture, which is drawn last.
    return is_ready() && fits_ &&
           std::ranges::all_of(std::views::reverse(passes_), [&](const PassTrial& tried) {
               const auto pass = pass_named(preset.scene, tried.name);
               return pass && shelf.find(pass_text(preset, *pass, options_).text) != 0;
           });
}

std::vector<GLuint> Standby::ids() const {
    return scene_ ? ids_of(*scene_) : std::vector<GLuint>();
}

}  // namespace glint
