// A study's report as a page that opens with no network: index.html, with its diagrams inside and
// its pictures beside it.
#pragma once

#include "measure/rows/study.h"

#include <filesystem>
#include <span>

namespace glint {

// Throws UsageError where `folder` has an index.html of somebody else: a report of ours has its
// `data`, such as study.json, beside it.
void require_own_page(const std::filesystem::path& folder, const char* data);

// Writes `folder`/index.html. The diagrams are drawn by gnuplot; where it is missing, the page says
// so in their place.
void write_page(const std::filesystem::path& folder, std::span<const Study> studies);

}  // namespace glint
