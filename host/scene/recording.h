// Recording mouse and keys in the live window as a preset's events, and playing them there.
#pragma once

#include "scene/frame.h"

#include <glm/vec2.hpp>

#include <span>
#include <vector>

namespace glint {

// The fraction of the picture, y up, for a cursor in pixels of the picture, counted from its top
// left: the middle of the pixel, to five decimals, so that recordings are short and land on the
// same pixel. Outside the picture it lies outside 0 to 1.
glm::dvec2 mouse_fraction(glm::dvec2 cursor, glm::ivec2 size);

// Collects what a person does. Replayed at the same times, the events give the same Inputs as the
// InputState that was fed beside it. Mouse moves that no frame sees (with the button up, or
// followed by another within the frame) are left out.
//
// While time stands, frames cannot be told apart: what happens then is seen when time goes on, no
// longer as new.
class Recorder {
public:
    // `time` is that of the last frame drawn; `state` as that frame left it is where replay will
    // start from.
    void start(double time, const InputState& state);

    void mouse(glm::dvec2 fraction, bool down);
    void key(int code, bool down);

    // The frame at this time has seen all so far. Recording ends when time has gone back.
    void frame_drawn(double time);

    // Ends recording and hands out the events, in order of time.
    std::vector<Event> stop();

    bool recording() const { return recording_; }

private:
    std::vector<Event> events_, pending_;
    double last_time_ = 0.0;
    bool recording_ = false;
};

// Feeds the events in (from, to], ordered by time, to a live input; a person may take over at any
// moment. After a jump: a new InputState, from minus infinity.
void replay_into(InputState& state, std::span<const Event> events, double from, double to);

}  // namespace glint
