#include "media/sound.h"

#include "base/canonical_name.h"
#include "base/module.h"
#include "base/readable_file.h"
#include "base/temporary_file.h"
#include "media/sound_module.h"
#include "media/spectrum.h"

#include <array>
#include <utility>

namespace glint {
namespace {

namespace fs = std::filesystem;

struct SoundModule {
    GlintSoundRead* read;
    GlintSoundOpen* open;
    GlintSoundAppend* append;
    GlintSoundClose* close;
    GlintSpectrum* spectrum;
};

const SoundModule& module() {
    static const SoundModule kModule = [] {
        void* file = open_module("glint-sound.so", "sound");
        return SoundModule{.read = find_function<GlintSoundRead>(file, "glint_sound_read"),
                           .open = find_function<GlintSoundOpen>(file, "glint_sound_open"),
                           .append = find_function<GlintSoundAppend>(file, "glint_sound_append"),
                           .close = find_function<GlintSoundClose>(file, "glint_sound_close"),
                           .spectrum = find_function<GlintSpectrum>(file, "glint_spectrum")};
    }();
    return kModule;
}

int take(void* user, const std::int16_t* pairs, std::size_t count) {
    auto& samples = static_cast<Sound*>(user)->samples;
    try {
        samples.insert(samples.end(), pairs, pairs + 2 * count);
        return 1;
    } catch (...) {
        return 0;  // no memory
    }
}

}  // namespace

Sound read_sound(const fs::path& file) {
    const ReadableFile in(file);
    Sound sound;
    std::array<char, 512> cause{};
    if (!module().read(in.descriptor(), take, &sound, cause.data(), cause.size()))
        throw cannot_decode(file, cause.data());
    if (sound.samples.empty()) throw cannot_read(file, "It holds no sound");
    return sound;
}

bool can_write_sound(const fs::path& file) {
    const std::string ending = ending_of(file);
    return ending == ".wav" || ending == ".flac" || ending == ".ogg";
}

SoundWriter::SoundWriter(int descriptor, const fs::path& name) {
    std::array<char, 512> cause{};
    writer_ =
        module().open(descriptor, ending_of(name).substr(1).c_str(), cause.data(), cause.size());
    if (!writer_) throw cannot_write(name, cause.data());
}

SoundWriter::~SoundWriter() {
    finish();
}

void SoundWriter::append(std::span<const std::int16_t> samples) {
    module().append(writer_, samples.data(), samples.size() / 2);
}

int SoundWriter::finish() {
    void* writer = std::exchange(writer_, nullptr);
    return writer ? module().close(writer) : 0;
}

void spectrum(std::span<const float, kSpectrumSize> values,
              std::span<float, kSpectrumBins> magnitudes) {
    module().spectrum(values.data(), magnitudes.data());
}

}  // namespace glint
