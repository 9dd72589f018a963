// The files that a call names, and that none of those it writes is another of them.
#pragma once

#include "scene/preset.h"

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace glint {

struct NamedFile {
    std::string role;  // for messages: "-o", "--save-state", "the scene"
    std::string name;  // a file, or a numbered name such as "out.%04d.png"
    // Which numbers a numbered name stands for.
    int first = 0, last = std::numeric_limits<int>::max();
};

// What a preset is read from: itself, its scene with all includes, and what its samplers read.
std::vector<NamedFile> files_read_for(const Preset& preset);

// What its [expect] names.
std::vector<NamedFile> files_expected(const Preset& preset);

// Throws UsageError where an output is an input or another output, however the two are spelled, and
// through links, hard or symbolic, too. Numbered names are taken for one where two of their files
// might be. An empty name is no file.
void require_apart(const std::vector<NamedFile>& outputs, const std::vector<NamedFile>& inputs);

// Throws UsageError where a file stands at the place of the folder that `-o` names, and of `-`.
void require_folder(const std::filesystem::path& output);

}  // namespace glint
