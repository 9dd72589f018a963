// Which lines of a text ran at a pixel.
#pragma once

#include "glsl/reading.h"
#include "measure/probe/probe.h"
#include "scene/scene.h"
#include "window/trial/prober.h"

#include <vector>

namespace glint {

// By line of the text, of those within `asked`: from which sites were reached, `hits` by site. A
// line without a site of its own did as the one before it in its function did; what the pass does
// not call did not run.
std::vector<LineState> line_states(const Scene& scene, const Reading& reading,
                                   const std::vector<bool>& reached, const Probed& probed,
                                   const std::vector<std::uint32_t>& hits, Span asked);

}  // namespace glint
