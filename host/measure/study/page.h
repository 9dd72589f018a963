// A study's report as a page that opens with no network: index.html, with its diagrams inside and
// its pictures beside it.
#pragma once

#include "measure/rows/study.h"
#include "offline/named_files.h"

#include <filesystem>
#include <span>
#include <vector>

namespace glint {

// Throws UsageError where one of the files that a report is to write, all in one folder, stands
// there and is somebody else's. Those of an earlier report have beside them its data, a JSON object
// of ours: `data`, with an entry `key`; where that is damaged, index.html with this `title` tells.
void require_own_report(const std::vector<NamedFile>& outputs, const std::filesystem::path& data,
                        const char* key, const char* title);

// Writes `folder`/index.html. The diagrams are drawn by gnuplot; where it is missing, the page says
// so in their place.
void write_page(const std::filesystem::path& folder, std::span<const Study> studies);

}  // namespace glint
