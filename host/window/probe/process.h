// `glint probing`: the process that answers what a window asks of its scene's values
// (window/trial/prober.h).
#pragma once

#include <string>

namespace glint {

// Answers one order after the other, at standard input, which is a socket. Throws UsageError when
// it is none.
void run_probing(const std::string& device);

}  // namespace glint
