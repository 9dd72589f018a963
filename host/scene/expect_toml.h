// `[expect]` as TOML. For preset.cpp, which knows toml++ as well.
#pragma once

#include "scene/expect.h"
#include "scene/toml.h"
#include "scene/toml_text.h"

#include <functional>
#include <string>
#include <vector>

namespace glint {

using TomlWarning = std::function<void(const toml::source_region&, std::string)>;

// Files are relative to the folder. What is wrong is left out, and told.
Expect read_expect(const toml::node& node, const std::filesystem::path& folder,
                   const TomlWarning& warning);

}  // namespace glint
