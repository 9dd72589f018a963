// A pass's text as the site would have it.
#pragma once

#include "glsl/edits.h"
#include "scene/preset.h"

#include <cstddef>
#include <string>
#include <vector>

namespace glint {

// What draws a pass, with tweaks as constants and annotations as plain comments; without uniforms
// and what the pass does not reach. Channels and the entry's other name are not seen to.
struct SiteText {
    std::string text;
    std::vector<EditMap> maps;  // to Scene::text, one after the other

    // The byte of Scene::text that one of these stands for.
    std::size_t origin(std::size_t at) const;
};
SiteText site_text(const Preset& preset, std::size_t pass);

// A tab's text without the lines that an earlier export put before it, which have come back since,
// and without empty lines at both ends.
std::string without_heads(const std::string& text);

// A statement at the end of what fills a buffer of this format: what a reader sees of channels that
// it has not. `colour`: the variable.
std::string missing_channels_text(PixelFormat format, const std::string& colour);

}  // namespace glint
