// `glint probe`: any value of a pass, where and when a person asks.
#pragma once

#include "measure/probe/options.h"
#include "scene/preset.h"

namespace glint {

void run_probe(const ProbeOptions& options);

// Draws the frame once more where its text asserts anything, and warns of what does not hold.
void say_broken_assertions(Preset preset, const ProbeOptions& options);

}  // namespace glint
