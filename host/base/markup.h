// Text within HTML and XML.
#pragma once

#include <string>
#include <string_view>

namespace glint {

// As it may stand between tags and in a quoted attribute, where line ends stay line ends. What XML
// cannot hold becomes U+FFFD: control characters, and bytes that are no UTF-8.
std::string markup_escaped(std::string_view text);

}  // namespace glint
