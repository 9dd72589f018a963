// What simulations stood at when their first frame was drawn, kept between runs: the next start
// need not play them up to there again.
#pragma once

#include "offline/snapshot.h"
#include "window/live/kept_files.h"

#include <optional>
#include <string>

namespace glint {

class StartStates {
public:
    // One file a state, by a digest of all that it follows from. An empty folder keeps none.
    explicit StartStates(std::filesystem::path folder, std::uintmax_t most_bytes = 128u << 20)
        : files_(std::move(folder), most_bytes) {}

    // Begins to read the state of a preset at its time, beside the window.
    void read(const Preset& preset, const std::string& renderer);

    // What was found, once; waits for the reader. Nothing where there is none, or no whole one.
    std::optional<Snapshot> take();

    // Keeps the state of the preset that was read() last, as KeptFiles does, once.
    void keep(Snapshot snapshot);

private:
    KeptFiles files_;
    std::string name_;  // in the folder; empty: nothing is to be kept
    Provenance provenance_;
    std::future<std::optional<Snapshot>> reading_;
};

}  // namespace glint
