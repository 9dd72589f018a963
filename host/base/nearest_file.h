// The file that was probably meant by a name that leads nowhere.
#pragma once

#include <filesystem>

namespace glint {

// As a person would type it: the same name with another ending or in a folder below, a like name in
// the same folder, the same one in a folder beside, or any of that in a folder whose own name was
// mistyped. Empty where none is near.
std::filesystem::path nearest_file(const std::filesystem::path& missing);

}  // namespace glint
