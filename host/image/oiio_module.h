// The C face of glint-oiio.so, the only binary that is linked with OpenImageIO. No exception and no
// C++ type crosses it. Both functions return 1, or 0 with a cause (no sentence) in `cause`.
#pragma once

#include <stddef.h>

extern "C" {

struct GlintOiioPicture {
    int width, height, channels;
    int is_float;  // 32-bit float, else 8-bit
    void* pixels;  // rows bottom up, tightly packed
};

struct GlintOiioText {
    const char* name;
    const char* value;
};

// Writes to an empty file open for reading and writing. `error` gets the errno of what the system
// refused, or 0.
typedef int GlintOiioWrite(int descriptor, const char* format, const GlintOiioPicture* picture,
                           const GlintOiioText* texts, size_t text_count, int* error, char* cause,
                           size_t cause_size);

// Fills `picture` but for its pixels, asks `allocate` for their room (null: give up), and fills
// that.
typedef int GlintOiioRead(const char* file, const char* format, GlintOiioPicture* picture,
                          void* (*allocate)(void* user, const GlintOiioPicture*), void* user,
                          char* cause, size_t cause_size);

GlintOiioWrite glint_oiio_write;
GlintOiioRead glint_oiio_read;
}
