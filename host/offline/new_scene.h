// `glint new`: a commented scene to begin with.
#pragma once

#include <filesystem>
#include <span>
#include <string_view>

namespace glint {

struct SceneTemplate {
    std::string_view name;  // "raymarch"
    std::string_view text;  // of fragments/new/raymarch.frag
};

// The first is taken where nobody chooses.
std::span<const SceneTemplate> scene_templates();

// Writes the template of this name to `file`, behind which ".frag" is put unless it ends so, and
// returns the file's name. What is there already stays. Throws UsageError where there is no such
// template, and std::runtime_error where the file is there or cannot be written.
std::filesystem::path write_new_scene(const std::filesystem::path& file, std::string_view from);

}  // namespace glint
