// `glint import`: from the site's files to scene files.
#pragma once

#include "base/diagnostic.h"
#include "offline/options.h"

namespace glint {

// Writes a scene file for every shader of the input (out.frag, out-2.frag, …) and returns their
// names. What is there already stays: somebody may have worked on it. With errors in `diagnostics`
// nothing has been written. Throws UsageError, and std::runtime_error where a file cannot be
// written.
std::vector<std::filesystem::path> import_shadertoys(const ImportOptions& options,
                                                     Diagnostics& diagnostics);

// Whether a file or folder that is opened or dropped is to be imported.
bool is_shadertoy(const std::filesystem::path& file);

// As import_shadertoys, to NAME.frag beside NAME.json; one that was made before is kept. Prints the
// diagnostics.
struct ImportedBeside {
    std::filesystem::path scene;  // empty: there is none
    std::string notice;           // what a person is told
};
ImportedBeside import_beside(const std::filesystem::path& input);

// As import_shadertoys, for the command line: prints the diagnostics and the names. Throws Stop as
// well.
void run_import(const ImportOptions& options);

}  // namespace glint
