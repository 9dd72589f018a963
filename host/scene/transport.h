// Time of a playground: play, pause, step, scrub, loop, rate. One call for each drawn frame.
#pragma once

#include <optional>

namespace glint {

// A stretch of time that plays again and again.
struct Loop {
    double begin = 0.0, end = 0.0;  // s
};

// What one drawn frame is told of time.
struct Instant {
    double time = 0.0;  // s, at least 0
    // s; how far time moved, but 1/60 on the first frame after a start, a reset, a resume or a
    // jump, and while time stands.
    double time_delta = 1.0 / 60;
    double frame_rate = 60.0;  // Hz; frames drawn by the wall clock, measured twice a second
    int frame = 0;             // since the start or the last reset
    // s; by how much playing moved time since the last frame: 30 s after the lid of a laptop was
    // open again. A jump is not counted.
    double moved = 0.0;
    // Time does not follow from the frame before: it went back, or a person moved it. What a scene
    // has simulated is then void, and is to be played again up to `time`. Buffers start at 0 when
    // `frame` is 0.
    bool jumped = false;
};

// What a person does to time in one go: panels wish for it, keys ask for it.
struct TimeEdit {
    enum class What { play, pause, step, reset, seek, rate, fixed_step, loop } what = What::play;
    double number = 0.0;       // seek: s from 0; rate: scene seconds for a wall second
    bool on = false;           // fixed_step
    std::optional<Loop> loop;  // loop: none ends it
};

// Plays from the start. Wall time, in double, is summed without loss: days later it has not
// drifted.
class Transport {
public:
    static constexpr double kStep = 1.0 / 60;  // s; of step() and of the fixed step
    static constexpr double kSlowest = 0.1, kFastest = 4.0;

    explicit Transport(double start = 0.0);

    // The instant of the frame that is about to be drawn, `wall_seconds` after the last. The first
    // frame after a start, a reset, a resume or a jump does not move time, unless the step is
    // fixed. A time that is negative or no number counts as 0.
    Instant advance(double wall_seconds);

    // Whether time asks for a frame. While it does not, and nothing else has changed, there is
    // nothing to draw.
    bool wants_frame() const;

    void play();
    void pause();
    void step();   // one frame of 1/60 s forward; pauses
    void reset();  // time and frame to 0; plays or stands as before
    // Jumps at the next frame. While a person holds the slider, seek at every frame: seeking to the
    // time that it is holds it there, and is no jump.
    void seek(double time);

    void set_rate(double rate);  // scene seconds for a wall second, clamped; time never jumps
    // Each frame moves time by exactly 1/60 s, whatever wall clock and rate are: frame k is that of
    // a sequence at 60 Hz.
    void set_fixed_step(bool fixed);
    // While it plays or steps, time that reaches the end goes on from the begin. A loop that is
    // shorter than a step becomes one step long; ends in the wrong order are swapped.
    void set_loop(std::optional<Loop> loop);

    // Does what a person asked for, as the methods above do.
    void apply(const TimeEdit& edit);

    bool playing() const { return playing_; }
    double time() const;  // of the last frame, or where a seek will put the next one
    double rate() const { return rate_; }
    bool fixed_step() const { return fixed_step_; }
    const std::optional<Loop>& loop() const { return loop_; }

private:
    double move(double wall_seconds);
    void add(double seconds);
    bool wrap_in_loop();
    void measure(double wall_seconds);

    double time_, rest_ = 0.0;  // s; the sum of both is the time, to twice the digits of a double
    bool playing_ = true, fixed_step_ = false;
    bool begins_ = true;    // the next frame is frame 0
    bool resumes_ = false;  // the next frame is the first after a pause
    bool void_;             // what has been simulated no longer holds
    int steps_due_ = 0;
    std::optional<double> target_;  // s; of a seek
    double rate_ = 1.0;
    std::optional<Loop> loop_;
    int frame_ = 0;
    double frame_rate_ = 60.0, measured_seconds_ = 0.0;
    int measured_frames_ = 0;
};

}  // namespace glint
