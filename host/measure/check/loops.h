// How many turns the loops of a frame take.
#pragma once

#include "measure/check/subject.h"
#include "measure/probe/probe.h"

#include <cstdint>
#include <string>
#include <vector>

namespace glint {

class LoopTurns {
public:
    // Throws ProbeRefused.
    explicit LoopTurns(CheckSubject& subject);

    // Draws the subject's frame and counts. False where it is not finite.
    bool count(const Frame& frame);
    // Of all frames so far: the pixel with the most, and in which pass.
    std::uint32_t most() const { return most_; }
    const std::string& pass() const { return pass_; }
    // Of the last frame, all passes together, for each pixel of the picture.
    double a_pixel() const { return turns_ / pixels_; }

private:
    CheckSubject& subject_;
    std::vector<Probe> probes_;  // by pass
    std::uint32_t most_ = 0;
    std::string pass_;
    double turns_ = 0.0, pixels_ = 1.0;
};

}  // namespace glint
