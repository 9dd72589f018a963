// The shown text as programs that are fed with its tweaks and numbers, at hand for the first move
// of a slider and for a save that changes numbers alone.
//
// A process of low priority compiles them and tries them, so that they cost nothing while nobody
// edits; it keeps them, and tries saves that they can draw. Here they are taken up one by one.
#pragma once

#include "window/live/program_loader.h"
#include "window/trial/trial.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace glint {

class Standby {
public:
    explicit Standby(const std::string& device);

    // Makes them ready for what is shown now, in the background, at this size in pixels and this
    // time in seconds; those before are of no use.
    void prepare(const Preset& shown, glm::ivec2 size, double time);
    // Hears the process, and goes on, a few milliseconds a call. To be called again and again, with
    // the context current that draws.
    void follow(ProgramShelf& shelf, Renderer& shown);
    // Nothing is held or made ready any more.
    void stop();

    // In the other process; here; done.
    bool is_preparing() const { return state_ == State::compiling; }
    bool is_loading() const { return state_ == State::loading; }
    bool is_ready() const { return state_ == State::ready; }
    // The other process cannot make them ready.
    bool is_refused() const { return state_ == State::refused; }

    // Whether they draw this text as well, by other numbers, and fit into memory.
    bool draws(const Preset& preset, const ProgramShelf& shelf) const;

    // The programs, to be drawn with the preset that they were prepared for, or one of the same
    // text; nothing where they are not here. Whoever draws them may give them back.
    std::optional<CompiledScene> take() { return std::exchange(scene_, std::nullopt); }
    void give_back(CompiledScene scene) { scene_ = std::move(scene); }
    // They are those of an older text, and are linked anew when it is time.
    void forget_scene() { scene_.reset(); }
    bool has_scene() const { return scene_.has_value(); }
    std::vector<GLuint> ids() const;

    const ProgramOptions& program_options() const { return options_; }
    // The process that has them.
    Trial& trial() { return trial_; }
    int descriptor() const { return trial_.descriptor(); }
    std::string work() const { return trial_.work(); }

private:
    void start();
    void refuse();
    void make_buffer(Renderer& shown);

    enum class State { none, compiling, loading, ready, refused };
    State state_ = State::none;
    ProgramOptions options_;
    Trial trial_;
    ProgramLoader loader_;
    std::optional<Preset> preset_;  // what they are prepared for
    glm::ivec2 size_{1};
    double time_ = 0.0;
    std::vector<PassTrial> passes_;  // that they draw
    std::optional<CompiledScene> scene_;
    bool has_buffers_ = false;  // those that it fills and the shown one does not
    bool fits_ = true;          // these have room in memory, as far as is known
};

}  // namespace glint
