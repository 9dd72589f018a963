#include "window/live/start_states.h"

#include "base/hash.h"
#include "base/temporary_file.h"
#include "window/live/kept_files.h"

#include <chrono>
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

void write_file(const fs::path& file, const Snapshot& snapshot, std::uintmax_t most_bytes) {
    try {
        make_folder(file.parent_path());
        write_snapshot(file, snapshot);
        forget_oldest(file.parent_path(), most_bytes);
    } catch (const std::exception&) {
        // A disk that is full or not ours; no memory.
    }
}

}  // namespace

void StartStates::read(const Preset& preset, const std::string& renderer) {
    file_.clear();
    if (folder_.empty() || preset.time <= 0.0) return;
    provenance_ = provenance_at_start(preset, renderer);
    file_ = folder_ / (digest_of(provenance_) + ".exr");
    std::error_code error;
    if (!fs::is_regular_file(file_, error)) return;
    reading_ = std::async(std::launch::async,
                          [file = file_, wanted = provenance_] { return read_file(file, wanted); });
}

std::optional<Snapshot> StartStates::take() {
    return reading_.valid() ? reading_.get() : std::nullopt;
}

void StartStates::keep(Snapshot snapshot) {
    const bool is_writing =
        writing_.valid() && writing_.wait_for(std::chrono::seconds(0)) != std::future_status::ready;
    if (file_.empty() || is_writing) return;
    snapshot.provenance = provenance_;
    writing_ = std::async(std::launch::async,
                          [file = std::exchange(file_, {}), snapshot = std::move(snapshot),
                           most = most_bytes_] { write_file(file, snapshot, most); });
}

}  // namespace glint
