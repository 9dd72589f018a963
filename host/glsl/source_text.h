// A scene's text made even: one kind of line end, includes expanded, and every byte's place in the
// files that a person wrote.
#pragma once

#include "base/diagnostic.h"
#include "glsl/macro.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

struct SourceText {
    std::vector<std::filesystem::path> files;  // the first one read is files[0]
    // Every line ends with '\n'. `#version`, `#line`, `#include` and `#pragma` are blanked where
    // they are compiled. (Pragmas change no picture, and Mesa refuses some that browsers take.)
    std::string text;
    std::vector<Origin> origins;  // one for each line
    std::vector<std::size_t> line_begins;

    // Columns count characters, not bytes, as editors do.
    Place place(std::size_t offset) const;
    // The file that a byte comes from.
    const std::filesystem::path& file(std::size_t offset) const;
    std::size_t line_index(std::size_t offset) const;  // into origins
};

// Reads a file with its includes, those in branches that may be compiled. What is wrong goes to
// diagnostics; the text is whole all the same.
SourceText read_source(const std::filesystem::path& file, const Known& known,
                       Diagnostics& diagnostics);

// The same for a text that stands in no file: its places are those that it would have in `file`,
// and `made_from` is files[0].
SourceText made_source(const std::filesystem::path& file, const std::filesystem::path& made_from,
                       std::string_view text, const Known& known, Diagnostics& diagnostics);

}  // namespace glint
