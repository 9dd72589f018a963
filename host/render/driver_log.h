// What a driver says of a pass's text, as diagnostics with places in the user's files.
#pragma once

#include "render/pass_text.h"

#include <string>
#include <vector>

namespace glint {

// The driver's log about a text as diagnostics. Reads the forms of Mesa "0:12(5): error: …", NVIDIA
// "0(12) : error C1: …" and ANGLE or Intel "ERROR: 0:12: …".
Diagnostics read_driver_log(const Scene& scene, const std::string& log, const PassText& text);

// The lines of a log, without white space and zeros at their ends. One that quotes a name of 300 kB
// is cut: nobody reads it, and matching a regular expression takes stack for every character.
std::vector<std::string> lines_of(const std::string& log);

// Of a text that the driver refused, and said nothing that we can read.
Diagnostic refusal_without_words(const Scene& scene, const PassText& text);

// A complaint of the linker, which has no place. The commonest one is said better than drivers do.
Diagnostic link_diagnostic(const Scene& scene, std::size_t pass, std::string text);

}  // namespace glint
