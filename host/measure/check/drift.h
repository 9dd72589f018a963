// What simulations keep, over many frames: curves of their magnitude, and whether these run away.
#pragma once

#include "measure/check/subject.h"

#include <optional>
#include <string>
#include <vector>

namespace glint {

class StateCurves {
public:
    // Of what is fed back, after a frame.
    void add(const CheckSubject& subject);

    // Steady growth by a factor a frame, however small: "sums grows by 0.01 % a frame". From that
    // frame on, or later where it stands still at first.
    std::string growth(std::size_t from = 0) const;
    // Whether the largest value rose faster than any power of time, beyond `usual` by far; or
    // stands beyond it at a limit, its sign to and fro.
    bool explodes(float usual) const;
    // Whether it has come to stand beyond `usual`, by far, as what a clamp holds there; and whether
    // its sign goes to and fro meanwhile.
    bool stands_beyond(float usual) const;
    bool chatters() const;
    // Whether the largest value ever rises a hundredfold from frame to frame, not by a leap.
    bool multiplies() const;
    // Whether hardly anything has changed in the last eighth of the frames.
    bool rests() const;
    float largest() const;
    float largest_from(std::size_t frame) const;
    float largest_before(std::size_t frame) const;
    std::size_t frames() const { return largest_.size(); }

private:
    std::size_t unchanged() const;
    std::vector<double> sum_of_moving(std::size_t index) const;

    struct Curve {
        std::string name;           // of what: "waves.x", "waves"
        std::vector<double> means;  // squares, by frame; or the largest of these
    };
    std::vector<Curve> curves_;
    std::vector<float> largest_, signed_;  // by frame; that with its sign
};

}  // namespace glint
