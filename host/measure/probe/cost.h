// What a pass does at its pixels: turns of loops, reads of textures, calls; and whether these
// counts explain its milliseconds.
#pragma once

#include "measure/probe/session.h"

namespace glint {

// Counts lines at a grid of pixels and the whole at every one; `heat` (where it is not empty) gets
// a picture of the latter. Throws ProbeRefused.
ProbeCost cost_of(ProbeSession& session, const ProbeOptions& options,
                  const std::filesystem::path& heat);

std::string shown(const ProbeCost& cost);

}  // namespace glint
