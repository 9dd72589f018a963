// A study of all quality tweaks at once, as a panel asks for it in place of a tweak's name.
#pragma once

namespace glint {

inline constexpr const char* kAllTogether = "all quality tweaks together";

}  // namespace glint
