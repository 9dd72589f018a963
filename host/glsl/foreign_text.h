// Texts for VS Code's Shader Toy, rewritten in place as a scene of ours: `#iUniform`, `#iChannel0`
// with its `::MinFilter`, `::MagFilter`, `::WrapMode` and `::Type`, and `#iKeyboard`.
#pragma once

#include "base/diagnostic.h"
#include "glsl/macro.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

struct ForeignText {
    std::string text;
    std::vector<int> lines;  // for each line of `text`, the line of the file it stands for, from 1
};

// Whether a text has any of these directives.
bool is_foreign(const ScannedText& text);

// Rewrites one file. The scene's own file (`is_root`) also gets the passes of all shaders that it
// and they name as channels: each becomes a tab that includes that file. What is wrong, or has no
// counterpart here, goes to diagnostics.
// Directives in branches that are not compiled are left as they are.
ForeignText rewrite_foreign(const std::filesystem::path& file, std::string_view text,
                            const Known& known, bool is_root, Diagnostics& diagnostics);

}  // namespace glint
