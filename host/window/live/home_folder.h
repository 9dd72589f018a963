// Where the window keeps what it remembers of a person's work.
#pragma once

#include <filesystem>

namespace glint {

// Of Glint below what this variable names (XDG_STATE_HOME for one), else below this folder of the
// home. Who has no home gets one among the temporary files, which nobody else can read; where that
// cannot be had, a place where nothing can be kept.
std::filesystem::path home_folder(const char* variable, const char* fallback);

}  // namespace glint
