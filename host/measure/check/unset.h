// What a scene reads before setting it.
#pragma once

#include "glsl/zeros.h"
#include "measure/check/subject.h"

#include <functional>
#include <string>
#include <vector>

namespace glint {

// Of all passes that this draws, each once, in the order of the text.
std::vector<Unset> unset_values(const Preset& preset, const Renderer& renderer, bool specialise);

// Marks, in the order in which they are tried.
inline constexpr FirstValue kMarks[] = {FirstValue::nan, FirstValue::large, FirstValue::negative};

// `list` shows as a whole, by what is declared in these bytes. Of two that show only together it is
// the first.
const Unset& first_that_shows(const std::vector<Unset>& list,
                              const std::function<bool(Span)>& shows);

// "counts on uninitialised values: FILE:LINE:COLUMN: …"
std::string words_of(const Scene& scene, const Unset& unset);

}  // namespace glint
