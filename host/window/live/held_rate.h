// Holds a frame rate by the resolution: which share of its full size a picture is drawn at.
//
// A pure machine, fed with the times of frames. The cost of a scene is taken to go with its pixels;
// where that turns out wrong, a lower resolution is given up again. Upwards, where part of it goes
// with something else, the next share is tried. Shares are few, so that the picture does not
// breathe, and a share that was tried in vain is not tried again before frames have grown quicker.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace glint {

class HeldRate {
public:
    // Of the sides of the full picture.
    static constexpr std::array kShares = {1.0,    0.75,  0.5,     0.375, 0.25,
                                           0.1875, 0.125, 0.09375, 0.0625};

    // What one frame takes of the time that there is for it, ms.
    struct Cost {
        double scene = 0.0;   // goes with its pixels
        double beside = 0.0;  // what shows it, and the panels, at any share
    };

    // A scene before its first frame. What a frame at full size is expected to take (a scene of 0:
    // not known), and the share that did the last time that it was open (0: not known), which
    // counts for more.
    void begin(Cost full, double last_share, double wanted_ms);

    // A frame was drawn at share(), and took so long. True when the share has changed.
    bool hear(Cost cost);

    // Another rate to be held from now on, ms a frame.
    void want(double wanted_ms);

    double share() const { return kShares[at_]; }

    // What the scene's frame would take at full size, ms, as far as is known; 0 otherwise.
    double full_ms() const;

private:
    double room_ms() const;
    bool go(std::size_t to);
    bool go_down(double median_ms);
    bool go_up(double median_ms);
    std::size_t place_above(double median_ms) const;
    double predicted(double ms, std::size_t at) const;
    std::size_t place_for(double full_ms) const;

    double wanted_ms_ = 50.0;
    std::size_t at_ = 0, lowest_ = kShares.size() - 1;
    std::vector<double> heard_;   // ms, the scene's part of the last few frames at this share
    std::vector<double> beside_;  // ms, the other part of the last few frames
    int frames_ = 0;              // at this share
    int roomy_ = 0;               // frames in a row with room for a larger share
    int patience_ = 12;           // such frames before going up
    bool came_up_ = false;
    // Before the last step up: there it took so long. What came back soon is noted by share (ms).
    std::size_t came_from_ = 0;
    double came_from_ms_ = 0.0;
    std::array<double, kShares.size()> refused_ms_{};
    // Before the last step down: there it took so long.
    std::size_t before_at_ = 0;
    double before_ms_ = 0.0;
    double lowest_ms_ = 0.0;  // what it took where lower shares were given up
    double expected_full_ms_ = 0.0;
};

}  // namespace glint
