// Shaders of the site, from files: its JSON in both dialects, or a folder of tabs. They become
// scene files.
#pragma once

#include "base/diagnostic.h"
#include "glsl/source_text.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace glint {

struct ReadScene;

// In the order in which the site draws them.
inline constexpr std::array<std::string_view, 8> kShadertoyTabs = {
    "common", "bufferA", "bufferB", "bufferC", "bufferD", "cubeA", "image", "sound"};

// What an export writes beside the tabs: all of them, with what each reads.
inline constexpr const char* kShadertoyFile = "shadertoy.json";

// What one iChannel of a tab reads.
struct ShadertoyInput {
    int channel = 0;     // 0 to 3
    std::string kind;    // "buffer", "texture", "cubemap", "volume", "keyboard", "music", …
    std::string buffer;  // "bufferA" or "cubeA", where a tab fills it; empty otherwise
    std::string file;    // "/media/a/08b42b….png" on the site
    std::vector<std::string> faces{};  // of a cube of six files that we exported: all six
    std::string filter, wrap;          // as the site spells them; empty: the default
    std::optional<bool> vflip;
    bool operator==(const ShadertoyInput&) const = default;
};

struct ShadertoyTab {
    std::string name;  // "bufferA" … "bufferD", "cubeA", "image", "sound", "common"
    std::string code;
    std::vector<ShadertoyInput> inputs;
    bool operator==(const ShadertoyTab&) const = default;
};

struct Shadertoy {
    std::string id, title, author, description;  // what is not known is empty
    std::vector<ShadertoyTab> tabs;              // in the order in which the site draws them
};

// Every shader of a file. What is wrong goes to diagnostics; with errors there, the list is empty.
// Of two tabs that are the same word for word, one is taken, with a warning; so in a folder.
std::vector<Shadertoy> read_shadertoys(const std::filesystem::path& json, Diagnostics& diagnostics);

// Whether a file stands below a folder, and no link on the way leads out of it. Neither need exist.
bool is_within(const std::filesystem::path& file, const std::filesystem::path& folder);

// What the site's exports call the output that a tab fills.
int output_id(std::string_view tab);

// Whether a folder holds a shader's tabs, in any spelling of their names.
bool is_shadertoy_folder(const std::filesystem::path& folder);

// One shader from `common.glsl bufferA.glsl … image.glsl`, in any spelling of these names. What a
// tab reads is told by the folder's kShadertoyFile; without one, iChannel0 to 3 become the buffers
// A to D that are there. Links that lead out of the folder are left out with a warning each, unless
// they may lead `anywhere`.
std::optional<Shadertoy> read_shadertoy_folder(const std::filesystem::path& folder,
                                               Diagnostics& diagnostics, bool anywhere = false);

// The text of a scene file that draws the same. Media that the site does not ship are replaced by
// noise of the same size, with a warning each; a file of that name beside `from`, or elsewhere in
// its folder (`anywhere`: or outside it) is used instead. `folder` is where the scene will stand.
std::string scene_text(const Shadertoy& shader, const std::filesystem::path& from,
                       const std::filesystem::path& folder, Diagnostics& diagnostics,
                       bool anywhere = false);

// Of a scene that is kept as a shader of the site: the first in the file. Its places are those of
// the scene file that `glint import` would write.
SourceText imported_source(const std::filesystem::path& json, Diagnostics& diagnostics);

// A stranger's shader may name files in words that only Glint knows: what leads out of its folder
// is an error.
void refuse_outside(const std::filesystem::path& json, ReadScene& read);

}  // namespace glint
