// `glint sequence`: many frames of a scene to numbered pictures, to a film, or to another program.
#pragma once

#include "modes/snapshot.h"

namespace glint {

struct SequenceOptions {
    ViewOptions view;
    // "out.%04d.png", "out.mp4", or "-" for raw RGB on stdout; empty: only walk the simulation and
    // save its states
    std::string output;
    std::string frames;    // "A:B" or "A:B:STEP", both ends included; empty: the first ten seconds
    double fps = 60.0;     // Hz; frame k stands at k / fps
    int samples = 1;       // sub-pixel positions averaged in linear light
    double shutter = 0.0;  // degrees that it stays open, 360 a frame; over the samples
    FileFormat format{};
    std::string shard;    // "K/N": only the K-th of N shares, K from 1; empty: all
    bool resume = false;  // leave pictures alone that are there and are what would be written
    StateOptions state;
    // "frames/%06d.png": check that these are the pictures of this sequence, and make the film of
    // them instead of drawing; without `output` only check
    std::string from_pictures;
};

// Throws what main() turns into exit codes. Frame k is, bit for bit, the still of `--frame k`.
void run_sequence(const SequenceOptions& options);

}  // namespace glint
