// The C face of glint-sound.so, the only binary that is linked with libsndfile, libsamplerate and
// KissFFT. No exception and no C++ type crosses it. What may fail returns 1, or 0 with a cause (no
// sentence) in `cause`.
#pragma once

#include <stddef.h>
#include <stdint.h>

extern "C" {

// Hands pairs of left and right at 44.1 kHz of an open file to `take`, block by block; it returns 0
// to give up.
typedef int GlintSoundRead(int descriptor,
                           int (*take)(void* user, const int16_t* pairs, size_t count), void* user,
                           char* cause, size_t cause_size);

// Writes such pairs to an empty file open for reading and writing, as "wav", "flac" or "ogg". Null
// when the library refuses.
typedef void* GlintSoundOpen(int descriptor, const char* format, char* cause, size_t cause_size);
typedef void GlintSoundAppend(void* writer, const int16_t* pairs, size_t count);
// Frees the writer. Returns the errno of what the system refused, or 0.
typedef int GlintSoundClose(void* writer);

// The lower 512 magnitudes of the spectrum of 2048 values, each divided by 2048.
typedef void GlintSpectrum(const float* values, float* magnitudes);

GlintSoundRead glint_sound_read;
GlintSoundOpen glint_sound_open;
GlintSoundAppend glint_sound_append;
GlintSoundClose glint_sound_close;
GlintSpectrum glint_spectrum;
}
