// What a pass does at its pixels: turns of loops, reads of textures, calls; and whether these
// counts explain its milliseconds.
#pragma once

#include "measure/probe/session.h"

namespace glint {

// Counts lines at a grid of pixels and the whole at every one; `heat` (where it is not empty) gets
// a picture of the latter. Throws ProbeRefused.
ProbeCost cost_of(ProbeSession& session, const ProbeOptions& options,
                  const std::filesystem::path& heat);

// Of a map's cells, without lines.
ProbeCost totals_of(const std::vector<ProbeCell>& cells);
// The ten dearest, counted at a grid of pixels of a buffer of this size.
std::vector<ProbeLineCost> dearest_lines(Probe& probe, Renderer& renderer, const Frame& frame,
                                         glm::ivec2 size);
// All that a pixel's cell has counted.
double count_of(const ProbeCell& cell);

std::string shown(const ProbeCost& cost);

}  // namespace glint
