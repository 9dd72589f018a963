// Saving a preset: as text, with the person's own comments, order and spacing.
#pragma once

#include "scene/preset.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace glint {

struct PresetText {
    std::optional<std::string> text;  // empty when there are errors
    Diagnostics diagnostics;
};

// The text that `file` has to hold to read as this preset; the caller writes it. Paths become
// relative to the folder of `file`.
//
// `existing` is what the file holds now, or what the preset was read from; empty gives a new file.
// Of an existing text only the values that differ are replaced, where they stand. New keys go to
// the end of their table. No key is removed but channels that are off and a title that is empty: a
// tweak that is back at its default keeps its line, since it was part of the look, and keys that
// nobody knows stay. Events that differ are written anew as a whole, without the comments between
// them. Line ends stay as they are. Saving twice gives the same bytes. An existing text that is no
// TOML is an error: a person has to mend it.
PresetText write_preset(const Preset& preset, const std::filesystem::path& file,
                        std::string_view existing = {});

// Whether a preset's text, in `file`, names this scene; not where it cannot be read. No file is
// touched.
bool names_scene(std::string_view text, const std::filesystem::path& file, const Scene& scene);

}  // namespace glint
