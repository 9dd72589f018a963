// What `glint --version` says.
#pragma once

#include <string>

namespace glint {

// Version and commit, the driver that would draw (asked for a context; why not, where there is
// none), and the libraries that this program was built with. No line end behind the last line.
std::string version_text();

}  // namespace glint
