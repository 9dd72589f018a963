// `glint sound`: the mainSound of a scene to a file.
#pragma once

#include "offline/common.h"

#include <functional>

namespace glint {

constexpr long kMostSoundSamples = 0x7fffffff / 4;  // as a WAV file can hold

// Throws what main() turns into exit codes.
void run_sound(const SoundOptions& options);

// Makes the sound of a scene, which has one, block by block. Needs a current context.
class SoundRenderer {
public:
    // The preset must outlive this. Throws Stop when it does not compile.
    SoundRenderer(const Preset& preset, bool specialise);

    // The 8192 samples from `index` times that on: left and right in turn, from -1 to 1.
    std::vector<float> block(long index);

private:
    const Preset& preset_;
    Renderer renderer_;
};

// Stereo samples of a scene's sound, left and right in turn, 44.1 kHz, 16 bits, from `first` on;
// `take` gets them block by block. The scene has one. Needs a current context. Throws Stop when it
// does not compile.
void render_sound(const Preset& preset, bool specialise, long first, long count,
                  const std::function<void(std::span<const std::int16_t>)>& take);

}  // namespace glint
