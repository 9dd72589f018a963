// `glint sequence`: many frames of a scene to numbered pictures, to a film, or to another program.
#pragma once

#include "offline/picture.h"

namespace glint {

struct SequenceOptions : PictureOptions {
    // "out.%04d.png", "out.mp4", or "-" for raw RGB on stdout; empty: only walk the simulation and
    // save its states
    std::string output;
    std::string frames;   // "A:B" or "A:B:STEP", both ends included; empty: the first ten seconds
    std::string shard;    // "K/N": only the K-th of N shares, K from 1; empty: all
    bool resume = false;  // leave pictures alone that are there and are what would be written
    // "frames/%06d.png": check that these are the pictures of this sequence, and make the film of
    // them instead of drawing; without `output` only check
    std::string from_pictures;
};

// Throws what main() turns into exit codes. Frame k is, bit for bit, the still of `--frame k`.
void run_sequence(const SequenceOptions& options);

}  // namespace glint
