// Sound files. The only part, with its module, that knows libsndfile.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace glint {

constexpr int kSoundRate = 44100;  // Hz

struct Sound {
    std::vector<std::int16_t> samples;  // left and right in turn, 44.1 kHz
    long count() const { return static_cast<long>(samples.size() / 2); }
    double seconds() const { return static_cast<double>(count()) / kSoundRate; }
};

// Reads wav, flac, ogg or mp3, of any rate; of more than two channels the first two. Throws
// std::runtime_error with a whole sentence when the file is missing or no sound.
Sound read_sound(const std::filesystem::path& file);

// Whether the extension is one of wav flac ogg.
bool can_write_sound(const std::filesystem::path& file);

// Writes pairs of 16 bits to an open, empty file, of the kind that the name's extension says. Equal
// calls give equal files, but for ogg, whose streams are numbered at random.
class SoundWriter {
public:
    // Throws std::runtime_error with a whole sentence.
    SoundWriter(int descriptor, const std::filesystem::path& name);
    ~SoundWriter();
    SoundWriter(const SoundWriter&) = delete;
    SoundWriter& operator=(const SoundWriter&) = delete;

    void append(std::span<const std::int16_t> samples);
    // To be called last. Returns the errno of what the system refused, or 0.
    int finish();

private:
    void* writer_;
};

}  // namespace glint
