// A film, encoded by FFmpeg in another process.
#pragma once

#include "base/temporary_file.h"
#include "media/image.h"

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>

namespace glint {

// Whether the extension is one of mp4 webm gif mov.
bool is_film(const std::filesystem::path& file);

// Why no film of this kind has pictures of this size, as a whole sentence; empty when it may.
std::string size_refusal_of_film(const std::filesystem::path& file, glm::ivec2 size);

// The size that such a film has: all but gif have even sides, and repeat a last odd column or row.
glm::ivec2 size_in_film(const std::filesystem::path& file, glm::ivec2 size);

// Bytes of memory that FFmpeg takes for such a film.
std::size_t film_encoder_bytes(const std::filesystem::path& file, glm::ivec2 size);

// Whether it has a sound track: all but gif.
bool has_sound(const std::filesystem::path& file);

// Pictures as bytes, top row first, RGB: what FFmpeg calls rawvideo in rgb24.
std::vector<std::byte> raw_frame(const Image& image);

// Writes all bytes to a descriptor. Throws std::system_error.
void write_all(int descriptor, std::span<const std::byte> bytes);

class Film {
public:
    // The codec follows from the extension: H.264 (mp4), VP9 (webm), ProRes 422 HQ (mov), a palette
    // a frame and at most 50 frames a second, the others left out (gif). `sound` is a WAV file, or
    // null. Throws std::runtime_error when there is no ffmpeg, or the folder cannot be written.
    Film(const std::filesystem::path& file, glm::ivec2 size, double fps,
         std::unique_ptr<TemporaryFile> sound);
    ~Film();  // without finish() nothing stays behind
    Film(const Film&) = delete;
    Film& operator=(const Film&) = delete;

    // The next frame, RGB in bytes. Throws std::runtime_error when FFmpeg gave up.
    void write(const Image& image);

    // Waits for FFmpeg and gives the film its name. Throws when it failed.
    void finish();

private:
    int end();
    std::runtime_error failure() const;

    std::filesystem::path file_;
    double frames_shown_;      // of those that are written, as a share
    std::int64_t frames_ = 0;  // that were written
    std::unique_ptr<TemporaryFile> sound_;
    TemporaryFile out_;
    pid_t process_ = 0;
    int input_ = -1;   // where frames go
    int errors_ = -1;  // an unnamed file that takes FFmpeg's complaints
};

}  // namespace glint
