#include "window/live/start_states.h"

#include "base/hash.h"

#include <exception>
#include <utility>

namespace glint {
namespace {

namespace fs = std::filesystem;

// The window plays with uniforms, at the rate of a sequence.
Provenance provenance_at_start(const Preset& preset, const std::string& renderer) {
    Provenance provenance = provenance_of(preset, Playback{}.fps, false);
    provenance.emplace_back("start", std::to_string(Playback{.end = preset.time}.last_frame()));
    provenance.emplace_back("renderer", renderer);
    return provenance;
}

std::string digest_of(const Provenance& provenance) {
    Hash digest;
    for (const auto& [name, text] : provenance) digest.add(name), digest.add(text);
    return digest.text();
}

std::optional<Snapshot> read_file(const fs::path& file, const Provenance& wanted) {
    try {
        Snapshot snapshot = read_snapshot(file);
        if (snapshot.provenance == wanted) return snapshot;
    } catch (const std::exception&) {
        // None is there, or another version wrote it: the scene is played from its start.
    }
    return std::nullopt;
}

}  // namespace

void StartStates::read(const Preset& preset, const std::string& renderer) {
    name_.clear();
    if (files_.folder().empty() || preset.time <= 0.0) return;
    provenance_ = provenance_at_start(preset, renderer);
    name_ = digest_of(provenance_) + ".exr";
    const fs::path file = files_.folder() / name_;
    std::error_code error;
    if (!fs::is_regular_file(file, error)) return;
    reading_ = std::async(std::launch::async,
                          [file, wanted = provenance_] { return read_file(file, wanted); });
}

std::optional<Snapshot> StartStates::take() {
    return reading_.valid() ? reading_.get() : std::nullopt;
}

void StartStates::keep(Snapshot snapshot) {
    if (name_.empty()) return;
    snapshot.provenance = provenance_;
    files_.keep(std::exchange(name_, {}), [snapshot = std::move(snapshot)](const fs::path& file) {
        write_snapshot(file, snapshot);
    });
}

}  // namespace glint
