// Where the pictures of a sequence go: to files of their own, into a film, or to stdout.
#pragma once

#include "base/numbered_name.h"
#include "base/workers.h"
#include "media/film.h"
#include "offline/options.h"
#include "scene/preset.h"

namespace glint {

enum class Target { pictures, film, raw, states };

// How pictures of this sequence can be told from others.
struct Making {
    std::string inputs;  // what they follow from
    std::string drawer;  // and who draws them

    std::string of(int frame) const;
};

// Whether the file is there, whole, and says that it was made so: a Making, or the beginning of
// one.
bool is_made_from(const std::filesystem::path& file, const std::string& making);

// Top row first. Throws std::runtime_error.
void write_to_stdout(const Image& image);

// Encodes in threads of its own while the GPU draws.
class SequenceOutput {
public:
    // Keeps references.
    SequenceOutput(const SequenceOptions& options, Target target, const Preset& preset,
                   std::string gpu, Making making);

    // Where the target is a film. Its sound is a WAV file, or null.
    void begin_film(std::unique_ptr<TemporaryFile> sound);

    bool floats() const { return target_ == Target::pictures && holds_floats(options_.output); }

    // Of what memory is free, once the renderer has its own, so many pictures may be on their way
    // to their files at once, those included that are still read back. Throws std::runtime_error
    // where not one may.
    std::size_t pictures_in_memory() const;

    // `count` at most are encoded or wait for it.
    void limit(std::size_t count) { workers_.limit(count); }

    // Waits until one more may be. Throws what went wrong with one before.
    void wait_for_room() { workers_.wait_for_room(); }

    // Whether an earlier run has left this frame's picture; always false without --resume.
    // To look, it takes the room of one picture. Throws as wait_for_room() does.
    bool has(int frame);

    // Takes a picture as RGBA. Throws what went wrong with one before.
    void write(const Frame& frame, std::vector<std::byte> rgba);

    // Waits until all that was taken stands in its file.
    void wait() { workers_.finish(); }

    void finish();

private:
    void encode(const Frame& frame, std::vector<std::byte> rgba);

    const SequenceOptions& options_;
    Target target_;
    const Preset& preset_;
    std::string gpu_;
    Making making_;
    std::optional<NumberedName> name_;
    std::optional<Film> film_;
    Workers workers_;  // goes first: its threads use all of the above
};

}  // namespace glint
