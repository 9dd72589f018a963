// The controls of a web page: the browser's own, written as HTML, which its script moves and reads.
#pragma once

#include "scene/preset.h"

#include <string>

namespace glint {

// A row of every tweak in order, by group.
std::string page_controls(const Preset& preset);

}  // namespace glint
