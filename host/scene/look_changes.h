// What has changed between two states of one look, laid over a third.
#pragma once

#include "scene/preset.h"
#include "scene/tweak_values.h"

#include <string>
#include <vector>

namespace glint {

// Tweaks whose value or lock in `now` is another than in `before` get those of `now`; all others
// stay as they are. Of the shown set that is one entry of the undo list; in the other one what a
// person has changed stays. `tweaks` are those of the scene of `now`. Returns the names of those
// that had a value which neither of both has.
std::vector<std::string> lay_changes_over(const Preset& before, const Preset& now,
                                          TweakValues& tweaks);

// The names that a preset locks of tweaks that its scene does not have today.
std::vector<std::string> locks_without_tweak(const Preset& preset);

}  // namespace glint
