// `glint import`: from the site's files to scene files.
#pragma once

#include "modes/common.h"

namespace glint {

struct ImportOptions {
    std::filesystem::path input;   // a .json file of the site, or a folder of tabs
    std::filesystem::path output;  // a .frag file; of several shaders, the first one's
};

// Writes a scene file for every shader of the input (out.frag, out-2.frag, …) and returns their
// names. What is there already stays: somebody may have worked on it. Throws Stop, UsageError or
// std::runtime_error; then nothing has been written.
std::vector<std::filesystem::path> import_shadertoys(const ImportOptions& options);

}  // namespace glint
