// A scene under check: drawn small, every value of every buffer looked at after every frame.
#pragma once

#include "gl/context.h"
#include "offline/common.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace glint {

constexpr float kLargestHalf = 65504.0f;  // of floats of 16 bits

// What has been seen since the last restore().
struct Observed {
    // The first frame that had any: how many pixels, and in which outputs, in drawing order.
    std::size_t nan = 0, infinite = 0;
    struct Found {
        std::string output;  // the sampler, or "image"
        std::size_t pixels;
    };
    std::vector<Found> found;
    // The picture, or the last buffer, that has any; RGBA.
    std::vector<float> values;
    glm::ivec2 size{0};            // of `values`
    float min = 0.0f, max = 0.0f;  // of all finite values so far
    bool any = false;              // there were some
    // The first buffer of 16-bit floats that held their largest, where some drivers end and others
    // go on to Inf.
    std::string at_largest_half{};
    bool is_finite() const { return nan == 0 && infinite == 0; }
};

// What `glint still` is told to draw the same frame.
struct StillPlace {
    double time = 0.0, fps = 60.0;  // s, Hz
};

struct SubjectOptions {
    // Of the floats in buffers, 2, or 4, where bytes are fine ones; 0: as the scene says.
    int float_bytes = 0;
    // Tweaks written in as constants, as a still draws them, and passes left out that they switch
    // off; the preset's values cannot be changed then.
    bool specialise = true;
    // What is unset and gets values that show; of outputs in the picture alone: a channel of a
    // buffer that nobody reads may hold anything.
    std::optional<Marked> marked{};
};

class CheckSubject {
public:
    // Compiles; throws Stop. `context` is current and outlives this.
    CheckSubject(const ViewOptions& view, const Preset& opened, Context& context,
                 const SubjectOptions& options = {});
    CheckSubject(const CheckSubject&) = delete;
    CheckSubject& operator=(const CheckSubject&) = delete;

    // Tweaks, size, events and buffers as they were at first; nothing observed.
    void restore();

    // Events may be changed, and without constants the values of tweaks; the size by resize().
    Preset preset;
    void resize(glm::ivec2 size);

    // Draws one frame, waits for it and looks at all that was drawn. False, and nothing is looked
    // at any more, once something was not finite.
    bool draw(const Frame& frame);

    // Draws a frame that nobody looks at.
    void draw_blindly(const Frame& frame);

    // Frames from `first` to `end`, each drawn, of a scene that is played at this rate from 0.
    bool play_frames(int first, int end, double fps);

    // A stateless scene draws the frame of this time; a simulation is played from 0 for so many
    // seconds, whatever time a still of it is of, with two of its steps at the least. Ends sooner
    // where `is_enough`, asked after each frame, says so.
    bool show(double time, double played, const std::function<bool()>& is_enough = nullptr);
    // The time of that frame, s.
    double shown_time(double time, double played) const;

    // Frame `index` of a playback that has reached `time`; the last frame took `delta`.
    Frame frame_at(double time, double delta, long index) const;

    bool stateful() const { return renderer_->graph().stateful; }
    // Whether anything is new from frame to frame without a person.
    bool moves() const;
    // Any pass, or this one.
    bool reads(Builtin builtin, std::optional<std::size_t> pass = {}) const;
    // Whether this pass can know how long a step, or a frame, is.
    bool knows_step(std::size_t pass) const;
    // Whether a frame finds in this buffer what an earlier one left, not only what itself drew.
    bool is_fed_back(std::size_t graph_index) const;
    // The largest finite magnitude in what is fed back.
    float largest_state() const;

    std::vector<float> picture() const;  // RGBA, rows bottom up
    // What is checked, and how; valid as long as this.
    Renderer& renderer() { return *renderer_; }
    const Renderer& renderer() const { return *renderer_; }
    Context& context() const { return context_; }
    const Observed& observed() const { return observed_; }
    const Preset& opened() const { return opened_; }
    const ViewOptions& view() const { return view_; }
    bool specialised() const { return specialised_; }
    // Whether a program of it that is instrumented throughout is a matter of seconds: compilers
    // take a minute for one of a long text.
    bool is_short() const { return scene().text.size() < 20'000; }
    const Scene& scene() const { return preset.scene; }

    // Set while a still can show the frame that was drawn last.
    std::optional<StillPlace> still;

    // Called after each frame, to tell that the driver still answers.
    std::function<void()> after_frame;

private:
    void look(std::size_t graph_index);

    ViewOptions view_;
    Preset opened_;
    bool specialised_, picture_alone_;
    Context& context_;
    std::vector<std::pair<Builtin, std::size_t>> builtins_;  // and the pass that reads it
    std::optional<Renderer> renderer_;
    std::vector<std::optional<std::size_t>> looked_at_;  // the version of each buffer
    Observed observed_;
};

}  // namespace glint
