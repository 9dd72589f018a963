// Zeros in a pass's text for what it reads before setting it.
#pragma once

#include "render/pass_text.h"

namespace glint {

// Changes the text on its lines, and keeps account of columns and of what was unset.
void write_zeros(PassText& pass, const std::optional<UnsetRange>& marked);

}  // namespace glint
