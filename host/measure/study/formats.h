// The format of a buffer as a knob of a study: what smaller texels cost in error, and save.
#pragma once

#include "measure/study/plan.h"

namespace glint {

// Whether it is written as a word of a buffer is: "waves.format". Tweaks' names have no dot.
bool names_a_format(const std::string& name);

struct FormatsAsked {
    std::string name;                  // "waves.format"
    std::vector<std::string> formats;  // empty: 32, 16 and 8 bits, with the channels that it has
    std::optional<std::string> reference{}, second{};  // rgba32f, and none, where nothing is said
};
// `drawn` as in SceneFacts. Throws UsageError for buffers that the scene has not, or that nothing
// reads, and for words that are no format.
Knob format_knob(const Preset& preset, const std::vector<bool>& drawn, const FormatsAsked& asked);

}  // namespace glint
