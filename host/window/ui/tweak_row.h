// One tweak in its panel: a label that explains, resets and has a menu, the control, the lock.
#pragma once

#include "window/ui/interface.h"

namespace glint {

// `index` is that of the open scene's tweak.
void tweak_row(Build& build, TweaksState& state, std::size_t index);

}  // namespace glint
