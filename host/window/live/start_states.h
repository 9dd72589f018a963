// What simulations stood at when their first frame was drawn, kept between runs: the next start
// need not play them up to there again.
#pragma once

#include "offline/snapshot.h"

#include <cstdint>
#include <filesystem>
#include <future>
#include <optional>

namespace glint {

class StartStates {
public:
    // One file a state, by a digest of all that it follows from, all together within `most_bytes`;
    // the oldest go. An empty folder keeps none.
    explicit StartStates(std::filesystem::path folder, std::uintmax_t most_bytes = 128u << 20)
        : folder_(std::move(folder)), most_bytes_(most_bytes) {}

    // Begins to read the state of a preset at its time, beside the window.
    void read(const Preset& preset, const std::string& renderer);

    // What was found, once; waits for the reader. Nothing where there is none, or no whole one.
    std::optional<Snapshot> take();

    // Writes the state of the preset that was read() last, whole or not at all, on a thread of its
    // own. Where it cannot be written, nothing is kept.
    void keep(Snapshot snapshot);

private:
    std::filesystem::path folder_;
    std::uintmax_t most_bytes_;
    std::filesystem::path file_;
    Provenance provenance_;
    std::future<std::optional<Snapshot>> reading_;
    std::future<void> writing_;
};

}  // namespace glint
