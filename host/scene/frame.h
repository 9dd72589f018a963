// The inputs of one draw: time, mouse, keys, date.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

// JavaScript key codes, as the site's keyboard texture counts them: left 37, space 32, A 65.
inline constexpr int kKeyCount = 256;

// The code of a key's name ("up", "space", "a", "7", "f1", or a number), or -1.
int key_code(std::string_view name);

// The shortest name that key_code reads as this code.
std::string key_name(int code);

// Mouse and keys as one draw sees them.
struct Input {
    glm::vec4 mouse{0.0f};  // iMouse, pixels, with the site's signs
    std::array<std::uint8_t, kKeyCount> held{}, pressed{},
        toggled{};  // 0 or 255: rows 0, 1, 2 of the texture
    bool operator==(const Input&) const = default;
};

// One thing that a person did, at a time. Either a key or the mouse.
struct Event {
    double time = 0.0;      // s
    int key = -1;           // key code; -1: a mouse event
    bool down = false;      // of the key, or of the mouse button, after the event
    glm::dvec2 mouse{0.0};  // fraction of the picture, y up; mouse events only
    bool operator==(const Event&) const = default;
};

// Follows events and gives the input of each frame by the site's rules (mouse signs, pressed in
// this frame, toggles).
class InputState {
public:
    void mouse(glm::dvec2 fraction, bool down);
    void key(int code, bool down);  // repeats of a held key do not count
    void apply(const Event& event);

    // The input of the frame that is about to be drawn at this size in pixels; ends the frame: what
    // was pressed is no longer new afterwards.
    Input next_frame(glm::ivec2 size);

    // The fewest events that lead another one, or a new InputState, to where this one stands, all
    // at this time.
    std::vector<Event> as_events(double time) const;
    std::vector<Event> as_events(double time, const InputState& from) const;

private:
    glm::dvec2 position_{0.0}, click_{0.0};
    bool clicked_ever_ = false, down_ = false, pressed_now_ = false;
    Input keys_;
};

// Where all events up to the time `to` have led; what happened in (from, to] counts as new. Events
// are in order of time.
InputState input_after(std::span<const Event> events, double from, double to);

// The input of a frame that is drawn then at this size.
Input replay(std::span<const Event> events, double from, double to, glm::ivec2 size);

// A calendar moment: iDate is built from it. Exports start from a fixed one, so that they are
// reproducible.
struct Date {
    int year = 2000, month = 1, day = 1;  // month and day from 1
    double seconds = 0.0;                 // since midnight
    bool operator==(const Date&) const = default;
};

// year, month from 0, day, seconds since midnight, `elapsed` seconds after `start`, midnights
// crossed.
glm::vec4 shadertoy_date(const Date& start, double elapsed);

// time in units of 1/65536 s, modulo 2^32, exact for any double time up to 2^36 s.
std::uint32_t tick(double time);

struct Frame {
    double time = 0.0;             // s
    double time_delta = 1.0 / 60;  // s
    double frame_rate = 60.0;      // Hz
    int frame = 0;                 // since reset
    double exposure = 0.0;  // s that the shutter stays open from `time` on; averaged pictures only
    glm::vec4 date{0.0f};   // iDate
    Input input;
    // Of the picture in whose pixels the mouse is counted, where it is drawn at another size: there
    // it has the same place. 0: as it is drawn.
    glm::ivec2 mouse_size{0};
    // What was done so far, from a preset or at the window: step passes read the input of their own
    // step's time from these, so that a simulation does not depend on the frame rate. May begin
    // with a state, as events of long ago.
    std::span<const Event> events;
    // s; how much simulated time may be caught up in one frame, at least one step; the rest is
    // dropped. Exports drop nothing.
    double longest_catch_up = std::numeric_limits<double>::infinity();
};

}  // namespace glint
