// Macros that Mesa's preprocessor reads otherwise than those of browsers.
#pragma once

#include "glsl/edits.h"

namespace glint {

// Of nothing, where a name is kept apart from what stands behind it.
constexpr const char* kGap = "#define glint_gap\n";

// Changes what would become another text. True where the changed text needs kGap before it.
bool mend_macros(const Reading& reading, Edits& edits);

// The site's compiler defines none of the macros by which extensions tell that they are there.
void hide_extensions(const Reading& reading, Edits& edits);

}  // namespace glint
