// A scene as a web page: one file, which needs no network and nothing else.
#pragma once

#include "offline/options.h"

#include <filesystem>

namespace glint {

// Whether the name is that of a page.
bool is_page(const std::filesystem::path& output);

// Writes the planned graph of the scene (offline/page_plan.h) and the program that draws it in a
// browser (offline/page/) into one file. Needs a current context. Throws what main() turns into
// exit codes.
void write_page(const ExportOptions& options);

}  // namespace glint
