// One name for a file, however it was named.
#pragma once

#include <filesystem>
#include <string>

namespace glint {

// Absolute and without links, whether anything is there yet or not, so that it stays when the
// current folder goes. Of what cannot be followed, such as a loop of links, the name as it stands.
// Throws nothing.
std::filesystem::path canonical_name(const std::filesystem::path& file);

// What a file's name ends with, in small letters: ".toml"; "" for nothing.
std::string ending_of(const std::filesystem::path& file);

}  // namespace glint
