// Recording mouse and keys in the live window as a preset's events, and playing them there.
#pragma once

#include "scene/frame.h"

#include <glm/vec2.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace glint {

// The fraction of the picture, y up, for a cursor in pixels of the picture, counted from its top
// left: the middle of the pixel, to five decimals, so that recordings are short and land on the
// same pixel. Outside the picture it lies outside 0 to 1.
glm::dvec2 mouse_fraction(glm::dvec2 cursor, glm::ivec2 size);

// What a scene asks for.
struct InputReads {
    bool mouse = true, keys = true;
};

// Collects what a person does. Replayed at the same times, the events give the same Inputs as the
// InputState that was fed beside it. Mouse moves that no frame sees (with the button up, or
// followed by another within the frame) are left out.
//
// While time stands, frames cannot be told apart: what happens then is replayed in the first frame
// that moves on.
class Recorder {
public:
    // After the frame at `time`, or minus infinity before any; replay starts from the state that
    // it left, where `before`, the events that go before it, do not lead there anyway, and as far
    // as `reads` goes: the rest would be seen by nobody.
    void start(double time, const InputState& state, std::span<const Event> before = {},
               const InputReads& reads = {});

    // The same, but what it has left is new to nobody.
    void go_on_from(double time, const InputState& state);

    void mouse(glm::dvec2 fraction, bool down);
    void key(int code, bool down);
    // What a preset's events did, at its own time since the last frame.
    void replayed(const Event& event);

    // The frame at this time has seen all so far. Recording ends when time has gone back; stop()
    // has what was recorded until then.
    void frame(double time);

    // What has been recorded, in order of time.
    std::span<const Event> events() const { return events_; }
    // What lies before this time is kept as the state that it led to, which is new to nobody.
    void forget_before(double time);

    // Ends recording and hands out the events, in order of time. What no frame has seen is lost;
    // what frames have seen while time stood comes right behind it. What a person holds then comes
    // up behind that, for nothing else would let it go.
    std::vector<Event> stop();

    bool recording() const { return recording_; }
    // The time of the last frame that was recorded.
    double end() const { return last_time_; }

private:
    // Keys and the button that are down.
    struct Held {
        std::array<bool, kKeyCount> keys{};
        bool mouse = false;
        glm::dvec2 position{0.0};  // of the mouse, when its button was last down
        void follow(const Event& event);
    };
    std::vector<Event> releases() const;

    std::vector<Event> events_, pending_;   // pending: of the frame to come
    std::size_t seen_ = 0;                  // of these, by frames at which time stood
    std::optional<std::size_t> last_move_;  // in pending_, with nothing of the mouse after it
    Held held_;                             // by a person, or by a preset's events
    Held own_, seen_own_;                   // by a person alone; of that what frames have seen
    double last_time_ = 0.0;
    bool recording_ = false;
};

// Those in (from, to]; events are in order of time.
std::span<const Event> events_between(std::span<const Event> events, double from, double to);

}  // namespace glint
