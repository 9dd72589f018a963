// The site's names for what a text calls otherwise: its channels, what is a constant there.
#pragma once

#include "glsl/reading.h"

#include <span>
#include <string>
#include <string_view>

namespace glint {

// What the host declares of this name, such as a sampler, and the words that mean it there.
struct SiteName {
    std::string name, words;
    std::string note{};  // a comment that explains it; empty for none
};

struct SiteNamed {
    std::string defines, text;
};

// `text` where those words mean what these names did: by a #define, or word by word where the text
// gives the name to something of its own, too: a local, a parameter, a member, the component of a
// vector. A name of which the text does not speak is left out.
SiteNamed with_site_names(const std::string& text, const Known& known,
                          std::span<const SiteName> names);

// This name, or one like it where the text has a macro of that.
std::string free_of_macros(const Reading& reading, const std::string& name);

}  // namespace glint
