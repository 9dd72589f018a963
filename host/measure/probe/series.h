// Values of many pixels or frames: their range, as a table, as a plot, as a picture.
#pragma once

#include "measure/probe/probe.h"

#include <filesystem>
#include <string>
#include <vector>

namespace glint {

// Of a map's cells, rows bottom up: those of the pixel's row ("x") or column ("y"), or all ("map").
ProbeSeries series_of(const std::vector<ProbeCell>& cells, glm::ivec2 size, glm::ivec2 pixel,
                      const std::string& along);

// One place more, with this value; null: none was reached there.
void add_to(ProbeSeries& series, double at, const ProbeValue* row);

// A table of up to four columns and a plot of them.
std::string shown(const ProbeSeries& series);

// As floats as they are (exr, tif, hdr), a missing component as 0, with alpha 0 where it was not
// reached; in bytes from the smallest value to the largest, what is not finite in magenta.
void write_map(const std::filesystem::path& file, const std::vector<ProbeCell>& cells,
               glm::ivec2 size);

}  // namespace glint
