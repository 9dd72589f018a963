// How the pass viewer shows a buffer, and what it finds in it: counts, histogram, values.
#pragma once

#include "window/ui/interface.h"

namespace glint {

// Draws them at the cursor, as wide as there is room. Edits build.settings.view; reads
// build.facts.pixel_facts and pixel_values, which are there while view.inspect asks for them.
void viewer_controls(Build& build);

}  // namespace glint
