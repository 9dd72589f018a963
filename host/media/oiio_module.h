// The C face of glint-oiio.so, the only binary that is linked with OpenImageIO. No exception and no
// C++ type crosses it. What fails returns 0 or null, with a cause (no sentence) in `cause`.
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

struct GlintOiioFormat {
    const char* codec;        // OpenImageIO's name for the kind of file
    const char* compression;  // empty: what suits most
    int half;                 // 16-bit floats
    int quality;              // of a jpeg; 0: 95
    int tile;                 // pixels; 0: by rows
};

struct GlintExrPart {
    const char* name;
    int width, height;
    int channels;  // up to four
    int half;      // 16-bit floats, else 32-bit
    void* pixels;  // rows bottom up, tightly packed
};

// Begins a file that is empty and open for reading and writing; the pixels of `shape` do not
// matter.
typedef void* GlintOiioBegin(int descriptor, const GlintOiioFormat* format,
                             const GlintOiioPicture* shape, const GlintOiioText* texts,
                             size_t text_count, int* error, char* cause, size_t cause_size);

// The rows below those that were written. `error` gets the errno of what the system refused, or 0.
typedef int GlintOiioWrite(void* file, const GlintOiioPicture* band, int* error, char* cause,
                           size_t cause_size);

// Ends the file, whole or not, and frees what it used.
typedef int GlintOiioEnd(void* file, int* error, char* cause, size_t cause_size);

// Fills `picture` but for its pixels, asks `allocate` for their room (null: give up), and fills
// that.
typedef int GlintOiioRead(const char* file, const char* format, GlintOiioPicture* picture,
                          void* (*allocate)(void* user, const GlintOiioPicture*), void* user,
                          char* cause, size_t cause_size);

// An EXR of many parts. The texts are the first part's. OpenImageIO opens these files itself and
// forgets what the system refuses at the end; so `memory` names a file in memory.
typedef int GlintExrWrite(const char* memory, const GlintExrPart* parts, size_t part_count,
                          const GlintOiioText* texts, size_t text_count, char* cause,
                          size_t cause_size);

// Tells of the first part's texts, then asks for each part's room as GlintOiioRead does.
typedef int GlintExrRead(const char* file, void (*tell)(void* user, const GlintOiioText*),
                         void* (*allocate)(void* user, const GlintExrPart*), void* user,
                         char* cause, size_t cause_size);

GlintOiioBegin glint_oiio_begin;
GlintOiioWrite glint_oiio_write;
GlintOiioEnd glint_oiio_end;
GlintOiioRead glint_oiio_read;
GlintExrWrite glint_exr_write;
GlintExrRead glint_exr_read;
}
