// Scenes and presets that lie about: those of a folder, and those that come with the program.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace glint {

// Presets, then scenes, each by name.
std::vector<std::filesystem::path> scenes_in(const std::filesystem::path& folder);

// The presets that come with the program, one a scene: from presets/ in the nearest folder above
// the program that has one, or has one in share/glint. Empty where it was taken elsewhere alone.
std::vector<std::filesystem::path> examples();

// A page of the documentation, from here where it lies below; where none comes with the program,
// its name in the repository.
std::filesystem::path documentation(const std::string& page);

// The picture that comes with a preset, of the repository's gallery. Empty where there is none.
std::filesystem::path gallery_picture(const std::filesystem::path& preset);

}  // namespace glint
