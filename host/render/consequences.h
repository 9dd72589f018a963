// Of several complaints of a driver about one mistake, one is told.
#pragma once

#include "base/diagnostic.h"

#include <string_view>

namespace glint {

// How a complaint ends whose candidates follow, and how it goes on where the place is a macro's.
inline constexpr std::string_view kCandidates = "; candidates are:", kInMacro = " (in what ";

// How one ends that was told before: what follows from it is left out with it.
inline constexpr std::string_view kAgain = "; once more";

Diagnostics with_candidates_joined(Diagnostics list);
Diagnostics with_vectors_named(Diagnostics list);
Diagnostics without_consequences(const Diagnostics& list);

}  // namespace glint
