// One name for a file, however it was named.
#pragma once

#include <filesystem>

namespace glint {

// Absolute and without links, whether anything is there yet or not, so that it stays when the
// current folder goes. Of what cannot be followed, such as a loop of links, the name as it stands.
// Throws nothing.
std::filesystem::path canonical_name(const std::filesystem::path& file);

}  // namespace glint
