// What a text of ProbeKind::faults calls.
#pragma once

#include <string>

namespace glint {

// GLSL: for each operation a function that notes operands outside of its domain, and how far off
// that they are, and does the same.
std::string fault_functions();

}  // namespace glint
