// The state of a simulation between two frames, in a file: from there it goes on to the last bit.
//
// Time, mouse, keys and date of a frame follow from its number and the preset's events, so that a
// state is the number of the next frame, the buffers, and the clocks of the passes with a step. The
// file is an EXR with a part for each texture, 32-bit and 16-bit floats bit for bit, so that other
// programs can show it.
#pragma once

#include "offline/common.h"

namespace glint {

// What a simulation follows from, as names and texts. A state belongs to runs of the same
// provenance.
using Provenance = std::vector<std::pair<std::string, std::string>>;
Provenance provenance_of(const Preset& preset, double fps, bool specialise);

struct Snapshot {
    int frame = 0;         // the next one to be played
    double time = 0.0;     // s, of the frame before it
    std::string renderer;  // may be another one; its last digits too, then
    Provenance provenance;
    std::vector<PassState> passes;
};

// Why a file is of no use here, as a whole sentence: exit code 4 where it cannot be read or is not
// a whole state, 2 where it is one of something else.
struct StateRefused : std::runtime_error {
    StateRefused(ExitCode exit_code, const std::string& sentence)
        : std::runtime_error(sentence), code(exit_code) {}
    ExitCode code;
};

// Written beside its name and renamed when whole. Throws std::runtime_error.
void write_snapshot(const std::filesystem::path& file, const Snapshot& snapshot);

// Throws StateRefused.
Snapshot read_snapshot(const std::filesystem::path& file);

// Starts loading what reads and writes states, where they are asked for, as
// prepare_image_library() does.
void prepare_states(const StateOptions& options);

// The states of one run: which it starts from and which it leaves behind.
class States {
public:
    // Keeps references. `settle` frames follow the end of `playback`. With `resume`, a run may
    // start from what an earlier one has saved. Throws UsageError.
    States(const StateOptions& options, const Preset& preset, Renderer& renderer,
           const Playback& playback, int settle, Provenance provenance, std::string gpu,
           bool resume = false);

    // Brings the renderer to a state from which frame `wanted` can be reached, and returns the next
    // frame to be played: 0 where there is no such state. Throws Stop where the one that was named
    // is of no use; of many, such a one is passed over with a warning.
    int start(int wanted);

    // Whether the state before frame k is to be kept, and keeping it.
    bool is_due(int k) const;
    void save(int k) const;

private:
    int start_from(const std::filesystem::path& file, int wanted);
    int start_from_newest(const std::string& name, int wanted);
    Frame frame(int k) const;
    int last_frame() const { return playback_.last_frame() + settle_; }

    const StateOptions& options_;
    const Preset& preset_;
    Renderer& renderer_;
    Playback playback_;
    int settle_;
    Provenance provenance_;
    std::string gpu_;
    bool resume_;
};

}  // namespace glint
