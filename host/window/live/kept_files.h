// Folders of a cache that do not grow without end.
#pragma once

#include <cstdint>
#include <filesystem>

namespace glint {

// Removes the files that were written longest ago, until all of the folder together are within
// `most_bytes`. What cannot be removed, or is gone already, does not matter.
void forget_oldest(const std::filesystem::path& folder, std::uintmax_t most_bytes);

}  // namespace glint
