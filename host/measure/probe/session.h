// A scene that is opened to be probed: drawn to its frame, with a hand in at the moment when the
// pass is about to be drawn.
#pragma once

#include "gl/context.h"
#include "measure/probe/options.h"
#include "measure/probe/probe.h"
#include "offline/common.h"

#include <functional>
#include <memory>

namespace glint {

class ProbeSession {
public:
    // Throws as open_preset() and compile_or_stop() do.
    explicit ProbeSession(const ProbeOptions& options);
    // Of what has been read already.
    ProbeSession(Preset preset, const ProbeOptions& options);

    const Preset& preset() const { return preset_; }
    std::size_t pass() const { return pass_; }
    Renderer& renderer() { return *renderer_; }
    Context& context() { return *context_; }
    ProgramOptions program_options() const { return {.specialise = specialised_}; }
    // Of the pass.
    std::size_t index() const { return renderer_->graph_index(pass_); }
    const BufferShape& shape() const { return renderer_->buffer(index()).shape(); }
    // What a person asked for, or the middle. Throws UsageError.
    ProbePlace place(const ProbeOptions& options) const;

    // Plays to just before the frame, which is given back.
    const Frame& play_to(const ProbeOptions& options);
    // Plays to the frame and draws it; `ask` is called once, with what the pass reads as it is in
    // that frame. (Of several steps of a simulation in a frame, once for each; where it takes none,
    // in the last frame in which it does.) Throws ProbeRefused where there is none.
    using Ask = std::function<void(const Frame&)>;
    void at_frame(const ProbeOptions& options, const Ask& ask);
    // The same for one frame of many; the frames before must have been drawn. Not called of a
    // simulation that takes no step in it.
    void draw(const Frame& frame, const Ask& ask);

    // Filled but for what was found.
    Probing probing(const ProbePlace& place) const;
    const Frame& frame() const { return frame_; }
    void set_frame(const Frame& frame) { frame_ = frame; }  // that was drawn by other hands

    // The bytes of a line, as --line names it. Throws UsageError.
    Span line(const std::string& text) const;
    // Where `EXPR@LINE` is to be evaluated. Throws UsageError.
    ProbeExpression expression(const std::string& text) const;

private:
    double step() const;  // s; 0 of a pass that is drawn in every frame

    Preset preset_;
    std::string output_;  // of the pass, as it was asked for
    std::size_t pass_;
    bool specialised_;
    std::unique_ptr<Context> context_;
    std::optional<Renderer> renderer_;
    Frame frame_{};
    std::vector<std::string> notes_;
};

}  // namespace glint
