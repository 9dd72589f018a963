// What a still and the pictures of a sequence have in common: how they are made.
#pragma once

#include "offline/named_files.h"
#include "offline/snapshot.h"

namespace glint {

// What is drawn for them.
struct PictureKind {
    std::size_t pass = kImagePass;
    bool floats = false;  // kept as floats, or as bytes
    bool tiles = false;   // may be drawn in tiles
};

CompileOptions compile_options(const PictureOptions& options, const PictureKind& kind);
RenderOptions render_options(const PictureOptions& options, const PictureKind& kind,
                             glm::ivec2 size);

// Throws UsageError where two of the files that a call writes are one, or one of them is read: the
// picture, and the state that is saved. `pictures` are read, too.
void require_files_apart(const PictureOptions& options, const NamedFile& output,
                         const NamedFile& pictures, const Preset& preset);

// Throws std::runtime_error where one of them cannot be written; of numbered ones the first is
// asked.
void require_files_writable(const PictureOptions& options, const NamedFile& output);

// Seconds that the shutter stays open. Throws UsageError where nothing can be drawn between two
// frames.
double exposure_of(const PictureOptions& options, const PassGraph& graph);

// What the picture's file tells of where it comes from.
Metadata metadata_of(const PictureOptions& options, const Preset& preset, const Frame& frame,
                     const std::string& renderer);

}  // namespace glint
