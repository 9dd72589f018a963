// `glint export`: a scene as the tabs of a Shadertoy, or as a web page.
#pragma once

#include "offline/options.h"

namespace glint {

// Where the output is no page (offline/page.h): writes image.glsl, bufferA.glsl … one text a tab,
// ready to paste, and all of them as shadertoy.json. A tab holds only what its pass needs, with
// tweaks as constants. What the site cannot do is said on stderr. Throws what main() turns into
// exit codes; more than the site can hold (four buffers, four channels) is a UsageError, and
// nothing is written.
void run_export(const ExportOptions& options);

}  // namespace glint
