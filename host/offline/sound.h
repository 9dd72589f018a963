// `glint sound`: the mainSound of a scene to a file.
#pragma once

#include "base/temporary_file.h"
#include "offline/common.h"
#include "scene/passes.h"

#include <filesystem>

namespace glint {

constexpr long kMostSoundSamples = 0x7fffffff / 4;                     // as a WAV file can hold
constexpr double kMostSoundSeconds = kMostSoundSamples / kSampleRate;  // whole ones

// What was heard. Throws what main() turns into exit codes.
Preset run_sound(const SoundOptions& options);

// Makes the sound of a scene, which has one, block by block. Needs a current context.
class SoundRenderer {
public:
    // The preset must outlive this. Throws Stop when it does not compile.
    SoundRenderer(const Preset& preset, const ProgramOptions& options);

    static constexpr long kBlock = long{kSoundBlockWidth} * kSoundBlockRows;  // samples

    // The kBlock samples from `index` times that on: left and right in turn, from -1 to 1.
    std::vector<float> block(long index);

    // The same as the scene gives them, RGBA: beyond -1 and 1, or no numbers at all.
    std::vector<float> drawn(const Frame& frame);
    Frame frame_of(long index) const;
    Renderer& renderer() { return renderer_; }

private:
    const Preset& preset_;
    Renderer renderer_;
};

// Writes the sound of a scene, which has one, to a file of the kind that the name says: 44.1 kHz,
// 16 bits, `count` samples from `first` on. Returns the errno of what the system refused, or 0.
// Needs a current context. Throws Stop when it does not compile.
int write_sound(const Preset& preset, bool specialise, long first, long count,
                const TemporaryFile& out, const std::filesystem::path& name);

}  // namespace glint
