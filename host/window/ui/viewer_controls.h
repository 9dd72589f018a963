// How the pass viewer shows a buffer, and what it finds in it: counts, histogram, values.
#pragma once

#include "window/ui/interface.h"

namespace glint {

void viewer_controls(Build& build);

}  // namespace glint
