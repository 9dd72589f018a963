// Where in a person's text the blame for a slow, endless or failing pass probably lies.
#pragma once

#include "scene/scene.h"

#include <optional>
#include <string>
#include <string_view>

namespace glint {

// The place of the loop that is most likely never to end: one without a condition, or the one with
// the largest constant in it, from 10,000 on. Nothing when no loop stands out.
std::optional<Place> likely_endless_loop(const Scene& scene);

// Where a pass, by its name, reads a sampler for the first time: neither a declaration nor another
// pass's tab; where the pass begins when that is not found.
Place reading_place(const Scene& scene, const std::string& pass, std::string_view sampler);

// Where the entry function of a pass, by its name, begins; the scene's first line when it is not
// found.
Place entry_place(const Scene& scene, const std::string& pass);

}  // namespace glint
